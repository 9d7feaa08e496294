//! `cargo xtask ci`: the steps in order, all of them, then a table of how they ended.

use std::process::ExitCode;
use std::time::{Duration, Instant};

use clap::Args;

use crate::outcome::Outcome;
use crate::tests_step::{self, Scope};
use crate::tools::{self, cargo};
use crate::{arrows, conformance, tidy};

/// What `cargo xtask ci` may be told.
#[derive(Args)]
pub(crate) struct Options {
    /// Leave out what takes long: the real masters, optional features, doc tests, documentation, licences
    #[arg(long)]
    quick: bool,
    /// A test that cannot run here is a failure (this is so too when CI=true)
    #[arg(long)]
    no_skips: bool,
}

struct Step {
    name: &'static str,
    in_quick: bool,
    run: fn(Scope) -> Outcome,
}

/// The cheap ones first: who waits wants to hear of them early.
const STEPS: &[Step] = &[
    Step { name: "format", in_quick: true, run: |_| cargo(&["fmt", "--all", "--check"]) },
    Step { name: "arrows", in_quick: true, run: |_| arrows::check() },
    Step { name: "conformance", in_quick: true, run: |_| conformance::check() },
    Step { name: "tidy", in_quick: true, run: |_| tidy::check() },
    Step { name: "licences", in_quick: false, run: |_| tools::licences() },
    Step { name: "clippy", in_quick: true, run: |_| tools::clippy() },
    Step { name: "tests", in_quick: true, run: tests_step::tests },
    Step { name: "features", in_quick: false, run: |_| tests_step::features() },
    Step { name: "doc tests", in_quick: false, run: |_| tests_step::doc_tests() },
    Step { name: "documentation", in_quick: false, run: |_| tools::documentation() },
];

struct Ended {
    name: &'static str,
    outcome: Outcome,
    took: Duration,
}

/// Runs every step and prints the summary. The exit code says whether all passed.
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
    let failed = ended.iter().filter(|step| step.outcome.is_err()).count();
    if skips_fail && !skips.is_empty() {
        println!("what was skipped counts as failed here");
        return ExitCode::FAILURE;
    }
    if failed == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn run_step(step: &Step, scope: Scope) -> Ended {
    println!("== {}", step.name);
    let start = Instant::now();
    let outcome = (step.run)(scope);
    if let Err(reason) = &outcome {
        println!("{reason}");
    }
    Ended { name: step.name, outcome, took: start.elapsed() }
}

fn print_summary(ended: &[Ended], skips: &[String]) {
    println!("\n== summary");
    for step in ended {
        let word = if step.outcome.is_ok() { "ok" } else { "FAILED" };
        println!("{word:>8}  {:<14} {:>6.1} s", step.name, step.took.as_secs_f64());
    }
    for skip in skips {
        println!("skipped: {skip}");
    }
    println!("skipped: {}{}", skips.len(), reasons(skips));
    let failed = ended.iter().filter(|step| step.outcome.is_err()).count();
    println!("checks: {} passed, {failed} failed", ended.len() - failed);
}

/// The reasons in brackets, each once: a skip reads `what: reason`.
fn reasons(skips: &[String]) -> String {
    let mut reasons: Vec<&str> =
        skips.iter().map(|skip| skip.split_once(": ").map_or(skip.as_str(), |(_, reason)| reason)).collect();
    reasons.sort_unstable();
    reasons.dedup();
    if reasons.is_empty() { String::new() } else { format!(" ({})", reasons.join("; ")) }
}

#[cfg(test)]
mod tests {
    use super::reasons;

    #[test]
    fn each_reason_is_named_once() {
        let skips = ["a: no tshark", "b: no pysoem", "c: no tshark"].map(String::from);
        assert_eq!(reasons(&skips), " (no pysoem; no tshark)");
        assert_eq!(reasons(&[]), "");
    }
}
