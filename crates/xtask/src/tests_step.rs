//! The tests: with cargo-nextest if it is installed, else with `cargo test`.

use crate::outcome::Outcome;
use crate::tools::{cargo, has_cargo};

/// Which tests to run.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Scope {
    /// All of it.
    All,
    /// The tests that a developer runs between two edits.
    Quick,
}

/// The test binary in which real masters use the built command: half a minute of real time.
const MASTERS: &str = "masters";

/// Features that are off by default: all of them are checked.
const FEATURES: &str = "ectwin-cli/opcua,ectwin-cli/wasm";
/// Those that are also built and tested, and their test binaries. OPC UA is not: its library alone takes more
/// than six minutes of a processor to build. `cargo test -p ectwin-cli --features opcua --test opcua` runs its
/// test.
const TESTED_FEATURES: &str = "ectwin-cli/wasm";
const FEATURE_TESTS: &[&str] = &["wasm_programs"];

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

/// The parts that the default build leaves out: features of the command that are off by default.
///
/// The whole workspace is built, so that little but the command itself is built a second time.
pub(crate) fn features() -> Outcome {
    let all = ["--workspace", "--locked", "--features", FEATURES];
    cargo(&[&["clippy", "--all-targets", "--quiet"], &all[..], &["--", "-D", "warnings"]].concat())?;
    let scope = ["--workspace", "--locked", "--features", TESTED_FEATURES];
    let runner: &[&str] = if has_cargo("nextest") { &["nextest", "run"] } else { &["test"] };
    let tests = FEATURE_TESTS.iter().flat_map(|name| ["--test", *name]);
    cargo(&[runner, &scope[..], &tests.collect::<Vec<_>>(), &["--no-fail-fast"]].concat())
}

pub(crate) fn doc_tests() -> Outcome {
    cargo(&["test", "--workspace", "--locked", "--doc", "--quiet"])
}
