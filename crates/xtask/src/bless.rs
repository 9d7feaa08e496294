//! `cargo xtask bless`: writes the generated files of the repository. A review reads the differences.

use crate::conformance;
use crate::outcome::Outcome;
use crate::tools;

/// Makes the tests below write the files that they otherwise compare.
const BLESS: &str = "ECTWIN_BLESS";

/// The tests, by package: each compares files with the contents that it would write.
const TESTS: &[(&str, &str)] = &[
    ("ectwin-nx-ect101", "allocation_page"),
    ("ectwin-esi", "rules_page"),
    ("ectwin", "event_pages"),
    ("ectwin", "scenario_reference"),
    ("ectwin-scenario", "values_page"),
    ("ectwin", "structured_text_reference"),
    ("ectwin", "kinds_page"),
    ("ectwin", "behaviours_page"),
    ("ectwin-control", "page"),
];

/// Runs them all.
pub(crate) fn bless() -> Outcome {
    conformance::bless()?;
    TESTS.iter().try_for_each(|(package, test)| {
        let mut command = tools::command("cargo");
        command.args(["test", "--quiet", "-p", package, "--test", test]).env(BLESS, "1");
        tools::run(command)
    })
}
