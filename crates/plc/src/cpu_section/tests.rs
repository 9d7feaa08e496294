//! The section of a CPU Unit in unit files of a model that has one key of its own.

use std::path::PathBuf;

use super::*;

/// A unit file of a model with the key `serial`.
fn parse(text: &str) -> Result<WithCpu<Option<u32>>, FileErrors> {
    WithCpu::parse(text, |reader, file| {
        reader.only(file, &["serial", "cpu"]);
        let serial =
            reader.value(file, "serial", |place, value| values::integer(place, value, 0..=9, "0 to 9"));
        Some(serial.map(|serial| serial.value))
    })
}

fn cpu(text: &str) -> CpuSection {
    parse(text).unwrap_or_else(|errors| panic!("{errors}")).cpu
}

#[test]
fn a_file_without_the_section_has_the_defaults() {
    let file = parse("serial = 3").unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!((*file, &file.cpu), (Some(3), &CpuSection::default()));
    let CpuSection { task_period, task_phase, mode, fail_soft, program, statement_budget } = file.cpu;
    assert_eq!((task_period.value, task_phase, program), (Duration::from_millis(1), None, None));
    assert_eq!((mode.value, fail_soft.value), (OperatingMode::Run, FailSoftOperation::FailSoft));
    assert_eq!(statement_budget.value, 100_000);
}

#[test]
fn each_key_is_read() {
    let cpu =
        cpu("[cpu]\ntask_period = \"500us\"\ntask_phase = \"20us\"\nmode = \"program\"\nfail_soft = false\n\
         program = [\"a.st\", \"blocks\"]\nstatement_budget = 7");
    assert_eq!(cpu.task_period.value, Duration::from_micros(500));
    assert_eq!(cpu.task_phase.map(|phase| phase.value), Some(Duration::from_micros(20)));
    assert_eq!((cpu.mode.value, cpu.fail_soft.value), (OperatingMode::Program, FailSoftOperation::Stop));
    assert_eq!(cpu.program.map(|program| program.value), Some(vec![PathBuf::from("a.st"), "blocks".into()]));
    assert_eq!(cpu.statement_budget.value, 7);
}

#[test]
fn one_program_is_a_list_of_one() {
    let program = cpu("cpu.program = \"echo.st\"").program;
    assert_eq!(program.map(|program| program.value), Some(vec![PathBuf::from("echo.st")]));
}

#[test]
fn task_periods_are_those_of_cpu_units() {
    let is_taken = |period: &str| parse(&format!("cpu.task_period = \"{period}\"")).is_ok();
    for period in
        ["125us", "250us", "500us", "750us", "1ms", "1250us", "2ms", "4ms", "8ms", "31750us", "32ms"]
    {
        assert!(is_taken(period), "{period}");
    }
    for period in ["0ms", "1us", "124us", "126us", "249us", "375us", "1100us", "32250us", "100ms", "1s"] {
        assert!(!is_taken(period), "{period}");
    }
}

#[test]
fn what_is_wrong_is_refused_with_its_place_beside_the_mistakes_of_the_model() {
    let wrong = [
        "cpu.task_period = \"1h\"",
        "cpu.task_period = \"33ms\"",
        "cpu.task_period = \"300us\"",
        "cpu.task_period = 1",
        "cpu.task_phase = \"33ms\"",
        "cpu.program = [\"a.st\", 2]",
        "cpu.program = []",
        "cpu.program = 3",
        "cpu.mode = \"RUN\"",
        "[cpu]\nmode = \"walk\"",
        "cpu.fail_soft = \"stop\"",
        "cpu.failsoft = true",
        "cpu.statement_budget = 0",
        "cpu.statement_budget = \"large\"",
        "cpu = \"run\"",
        "[[cpu]]\nmode = \"run\"",
        "[cpu]\nserial = 1",
        "serial = 10\nperiod = 1\n[cpu]\nperiod = 1\ntaskperiod = 1",
    ];
    let told = wrong.map(|text| match parse(text) {
        Ok(file) => panic!("{text}: {file:?}"),
        Err(errors) => format!("{text}:\n{}", errors.in_file("unit.toml")),
    });
    insta::assert_snapshot!(told.join("\n"));
}
