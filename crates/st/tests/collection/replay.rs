//! Runs a case, and reports where it differs from its expectations.

use st::{Instance, Problems, Stopped, compile};

use crate::case::{Case, Expected};
use crate::host::Recorder;
use crate::scan::{Action, Expectation, Scan};

/// Replays a case; a failure is reported with all the differences of a scan.
pub(crate) fn replay(case: &Case) -> Result<(), String> {
    let compiled = compile(&case.source, &case.globals);
    match (&case.expected, compiled) {
        (Expected::Trace { budget, scans }, Ok(program)) => {
            let mut instance = program.start();
            scans.iter().try_for_each(|scan| replay_scan(&mut instance, scan, *budget))
        }
        (Expected::Problems(expected), Err(problems)) => compare_problems(expected, &problems),
        (Expected::Trace { .. }, Err(problems)) => Err(format!("the program is refused:\n{problems}")),
        (Expected::Problems(_), Ok(_)) => Err("the program is accepted".to_owned()),
    }
}

fn compare_problems(expected: &[String], problems: &Problems) -> Result<(), String> {
    let told = problems.to_string();
    if told.lines().eq(expected.iter().map(String::as_str)) {
        return Ok(());
    }
    Err(format!("expected\n{}\nand told was\n{told}", expected.join("\n")))
}

fn replay_scan(instance: &mut Instance, scan: &Scan, budget: u64) -> Result<(), String> {
    for action in &scan.actions {
        match action {
            Action::Restart => instance.restart(),
            Action::Set(path, value) if instance.set(path, value) => {}
            Action::Set(path, value) => {
                return Err(format!("{}: {path} cannot be set to {value}", scan.line));
            }
        }
    }
    let mut host = Recorder::default();
    let result = instance.scan(scan.time_ns, budget, &mut host);
    let mut differences = differences(instance, scan, &host);
    let fault = result.err().map(|stopped| described(instance, stopped));
    let awaited = scan.expectations.iter().find_map(|expectation| match expectation {
        Expectation::Fault(fault) => Some(fault.clone()),
        _ => None,
    });
    if fault != awaited {
        differences.push(format!("the scan ended by {fault:?}, not by {awaited:?}"));
    }
    if differences.is_empty() { Ok(()) } else { Err(format!("{}\n{}", scan.line, differences.join("\n"))) }
}

fn described(instance: &Instance, stopped: Stopped) -> String {
    let st::Place { line, column, .. } = instance.program().sources().place(stopped.span);
    format!("{} at {line}:{column}", stopped.fault)
}

fn differences(instance: &Instance, scan: &Scan, host: &Recorder) -> Vec<String> {
    let mut all = Vec::new();
    let mut awaited = Vec::new();
    for expectation in &scan.expectations {
        match expectation {
            Expectation::Value(path, expected) => match instance.value(path) {
                Some(value) if value == *expected => {}
                Some(value) => all.push(format!("{path} is {value}, not {expected}")),
                None => all.push(format!("there is no variable {path}")),
            },
            Expectation::Used(used) if *used != instance.used() => {
                all.push(format!("{} statements were used, not {used}", instance.used()));
            }
            Expectation::Told(told) => awaited.push(told.clone()),
            Expectation::Used(_) | Expectation::Fault(_) => {}
        }
    }
    if awaited != host.told {
        all.push(format!("the host was told {:?}, not {awaited:?}", host.told));
    }
    all
}
