//! `cargo xtask ci`: runs all steps in order, then prints a table of their results.

use std::process::ExitCode;
use std::time::{Duration, Instant};

use clap::Args;

use crate::outcome::Ending;
use crate::tests_step::{self, Scope};
use crate::tools::{self, cargo};
use crate::{advisories, arrows, conformance, fuzz, library, tidy};

/// The options of `cargo xtask ci`.
#[derive(Args)]
pub(crate) struct Options {
    /// Leave out slow checks: the real masters, fuzzers, optional features, doc tests, documentation, licences
    #[arg(long)]
    quick: bool,
    /// Treat a test that cannot run here as a failure (also if CI=true)
    #[arg(long)]
    no_skips: bool,
}

struct Step {
    name: &'static str,
    in_quick: bool,
    run: fn(Scope) -> Ending,
}

/// The fast ones first, so that failures in them are reported early.
const STEPS: &[Step] = &[
    Step { name: "format", in_quick: true, run: |_| cargo(&["fmt", "--all", "--check"]).into() },
    Step { name: "arrows", in_quick: true, run: |_| arrows::check().into() },
    Step { name: "conformance", in_quick: true, run: |_| conformance::check().into() },
    Step { name: "tidy", in_quick: true, run: |_| tidy::check().into() },
    Step { name: "licences", in_quick: false, run: |_| tools::licences().into() },
    Step { name: "advisories", in_quick: false, run: |_| advisories::check() },
    Step { name: "library", in_quick: false, run: |_| library::check().into() },
    Step { name: "clippy", in_quick: true, run: |_| tools::clippy().into() },
    Step { name: "tests", in_quick: true, run: |scope| tests_step::tests(scope).into() },
    Step { name: "fuzz", in_quick: false, run: |_| fuzz::in_gate().into() },
    Step { name: "features", in_quick: false, run: |_| tests_step::features().into() },
    Step { name: "doc tests", in_quick: false, run: |_| tests_step::doc_tests().into() },
    Step { name: "documentation", in_quick: false, run: |_| tools::documentation().into() },
];

struct Ended {
    name: &'static str,
    ending: Ending,
    took: Duration,
}

/// Runs every step and prints the summary. The exit code indicates whether all passed.
pub(crate) fn run(options: &Options) -> ExitCode {
    let scope = if options.quick { Scope::Quick } else { Scope::All };
    tools::forget_skips();
    let ended: Vec<Ended> = STEPS
        .iter()
        .filter(|step| step.in_quick || scope == Scope::All)
        .map(|step| run_step(step, scope))
        .collect();
    let skips = tools::skips();
    let skips_fail = options.no_skips || std::env::var("CI").is_ok_and(|value| value == "true");
    print_summary(&ended, &skips);
    let failed = ended.iter().filter(|step| matches!(step.ending, Ending::Failed(_))).count();
    if skips_fail && !skips.is_empty() {
        println!("what was skipped counts as failed here");
        return ExitCode::FAILURE;
    }
    if failed == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn run_step(step: &Step, scope: Scope) -> Ended {
    println!("== {}", step.name);
    let start = Instant::now();
    let ending = (step.run)(scope);
    if let Ending::Failed(reason) | Ending::NotHere(reason) = &ending {
        println!("{reason}");
    }
    Ended { name: step.name, ending, took: start.elapsed() }
}

fn print_summary(ended: &[Ended], skips: &[String]) {
    println!("\n== summary");
    for step in ended {
        println!("{:>8}  {:<14} {:>6.1} s", word(&step.ending), step.name, step.took.as_secs_f64());
    }
    for step in ended {
        if let Ending::NotHere(reason) = &step.ending {
            println!("not checked here: {}: {reason}", step.name);
        }
    }
    for skip in skips {
        println!("skipped: {skip}");
    }
    println!("skipped: {}{}", skips.len(), reasons(skips));
    println!("{}", counts(ended));
}

const fn word(ending: &Ending) -> &'static str {
    match ending {
        Ending::Passed => "ok",
        Ending::Failed(_) => "FAILED",
        Ending::NotHere(_) => "not here",
    }
}

/// A check that could not be made is counted separately: it has not passed.
fn counts(ended: &[Ended]) -> String {
    let count = |wanted: &str| ended.iter().filter(|step| word(&step.ending) == wanted).count();
    let not_here = match count("not here") {
        0 => String::new(),
        count => format!(", {count} not made here"),
    };
    format!("checks: {} passed, {} failed{not_here}", count("ok"), count("FAILED"))
}

/// The reasons in parentheses, each once: a skip has the form `what: reason`.
fn reasons(skips: &[String]) -> String {
    let mut reasons: Vec<&str> =
        skips.iter().map(|skip| skip.split_once(": ").map_or(skip.as_str(), |(_, reason)| reason)).collect();
    reasons.sort_unstable();
    reasons.dedup();
    if reasons.is_empty() { String::new() } else { format!(" ({})", reasons.join("; ")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_check_that_cannot_be_made_has_neither_passed_nor_failed() {
        let ended = |ending| Ended { name: "x", ending, took: Duration::ZERO };
        let all =
            [Ending::Passed, Ending::NotHere("no index".into()), Ending::Failed("no".into())].map(ended);
        assert_eq!(counts(&all), "checks: 1 passed, 1 failed, 1 not made here");
        assert_eq!(counts(&all[..1]), "checks: 1 passed, 0 failed");
    }

    #[test]
    fn each_reason_is_named_once() {
        let skips = ["a: no tshark", "b: no pysoem", "c: no tshark"].map(String::from);
        assert_eq!(reasons(&skips), " (no pysoem; no tshark)");
        assert_eq!(reasons(&[]), "");
    }
}
