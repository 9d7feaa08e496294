//! The tests: by cargo-nextest where it is installed, else by `cargo test`.

use crate::Outcome;
use crate::tools::{cargo, has_cargo};

/// How much to run.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Scope {
    /// All of it.
    All,
    /// What a developer waits for between two edits.
    Quick,
}

/// The test binary in which real masters drive the built command: half a minute of real time.
const MASTERS: &str = "masters";

pub(crate) fn tests(scope: Scope) -> Outcome {
    if has_cargo("nextest") { nextest(scope) } else { cargo_test(scope) }
}

fn nextest(scope: Scope) -> Outcome {
    let without_masters = format!("not binary({MASTERS})");
    let mut arguments = vec!["nextest", "run", "--workspace", "--locked", "--no-fail-fast"];
    if scope == Scope::Quick {
        arguments.extend(["-E", &without_masters]);
    }
    cargo(&arguments)
}

fn cargo_test(scope: Scope) -> Outcome {
    if scope == Scope::Quick {
        return cargo(&["test", "--workspace", "--locked", "--no-fail-fast", "--lib", "--bins"]);
    }
    cargo(&["test", "--workspace", "--locked", "--no-fail-fast", "--lib", "--bins", "--tests"])
}

pub(crate) fn doc_tests() -> Outcome {
    cargo(&["test", "--workspace", "--locked", "--doc", "--quiet"])
}
