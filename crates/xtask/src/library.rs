//! The library `ectwin` without features: small enough to be a dependency of other projects' tests.

use std::process::Stdio;

use crate::outcome::{Outcome, report};
use crate::tools::{cargo, command};

/// Maximum number of crates that the library needs, including those of this workspace.
const CRATES_MAX: usize = 60;
/// Crates that only the command and the features need.
const KEPT_OUT: &[&str] = &["clap", "miette", "tokio", "quick-junit", "ectwin-modbus"];

pub(crate) fn check() -> Outcome {
    report("the library without features", &findings(&crates()?))?;
    cargo(&["check", "--package", "ectwin", "--no-default-features", "--locked", "--quiet"])
}

/// The names of the crates that the library needs.
fn crates() -> Result<Vec<String>, String> {
    let mut tree = command("cargo");
    tree.args(["tree", "--package", "ectwin", "--no-default-features", "--edges", "normal"]);
    tree.args(["--prefix", "none", "--locked"]).stderr(Stdio::inherit());
    let output = tree.output().map_err(|error| format!("cargo tree: {error}"))?;
    if !output.status.success() {
        return Err(format!("cargo tree: {}", output.status));
    }
    Ok(names(&String::from_utf8_lossy(&output.stdout)))
}

/// Each name once: a line has the form `NAME vVERSION …`, or is empty between the trees of targets.
fn names(tree: &str) -> Vec<String> {
    let mut names: Vec<String> =
        tree.lines().filter_map(|line| line.split_whitespace().next()).map(String::from).collect();
    names.sort_unstable();
    names.dedup();
    names
}

fn findings(crates: &[String]) -> Vec<String> {
    let kept_out = crates.iter().filter(|name| KEPT_OUT.contains(&name.as_str()));
    let mut findings: Vec<String> = kept_out.map(|name| format!("it depends on {name}")).collect();
    if crates.len() > CRATES_MAX {
        findings.push(format!("it pulls in {} crates, {CRATES_MAX} at most", crates.len()));
    }
    if !crates.iter().any(|name| name == "ectwin") {
        findings.push("cargo tree does not list it".to_owned());
    }
    findings
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_counted_once() {
        let tree = "ectwin v0.1.0 (/x)\nserde v1.0.0\nsyn v2.0.0 (proc-macro)\n\nserde v1.0.0 (*)\n";
        assert_eq!(names(tree), ["ectwin", "serde", "syn"]);
    }

    #[test]
    fn too_many_crates_and_those_of_the_command_are_findings() {
        let named = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>();
        assert_eq!(findings(&named(&["ectwin", "serde"])), [""; 0]);
        assert_eq!(findings(&named(&["ectwin", "tokio"])), ["it depends on tokio"]);
        assert_eq!(findings(&[]), ["cargo tree does not list it"]);
        let many: Vec<String> = (0..CRATES_MAX).map(|number| format!("c{number}")).collect();
        let many = [named(&["ectwin"]), many].concat();
        assert_eq!(findings(&many), ["it pulls in 61 crates, 60 at most"]);
    }
}
