//! The expectations of each scenario of the collection are effective: if one is inverted, the scenario fails in
//! that line.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::bench::{Bench, top_folder};

/// The text with its last expectation inverted, and the line in which its step begins: `expect` becomes `never`. Without
/// `within` it becomes `not (…)`, which is checked at once, so expectations without `within` are preferred.
fn turned(text: &str) -> Option<(String, usize)> {
    const MARK: &str = "expect = \"";
    let steps = text.match_indices(MARK).filter_map(|(at, _)| {
        let begin = text[..at].rfind('{')?;
        let end = at + text[at..].find('}')?;
        Some(begin..end)
    });
    let (timed, at_once): (Vec<_>, Vec<_>) = steps.partition(|step| text[step.clone()].contains("within = "));
    let step = at_once.last().or(timed.last())?.clone();
    let line = text[..step.start].matches('\n').count() + 1;
    Some((format!("{}{}{}", &text[..step.start], contrary(&text[step.clone()])?, &text[step.end..]), line))
}

/// The contrary of a step with an expectation.
fn contrary(step: &str) -> Option<String> {
    let (head, rest) = step.split_once("expect = \"")?;
    let (words, tail) = rest.split_once('"')?;
    let Some((before, time)) = tail.split_once(", within = \"") else {
        return Some(format!("{head}expect = \"not ({words})\"{tail}"));
    };
    let (_, after) = time.split_once('"')?;
    Some(format!("{head}never = \"{words}\"{before}{after}"))
}

/// Copies a folder with one expectation of each scenario inverted; `lines` gets the line of each scenario.
fn turn_all(from: &Path, to: &Path, lines: &mut BTreeMap<PathBuf, usize>) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        let copy = to.join(path.file_name().unwrap());
        if path.is_dir() {
            turn_all(&path, &copy, lines);
        } else if path.extension().is_some_and(|extension| extension == "toml") && is_scenario(&path) {
            let text = fs::read_to_string(&path).unwrap();
            let (text, line) = turned(&text).unwrap_or_else(|| panic!("{}: nothing to turn", path.display()));
            fs::write(&copy, text).unwrap();
            lines.insert(copy, line);
        } else if path.extension().is_none_or(|extension| extension != "trace") {
            // Programs, preludes, units and images, but no golden traces: they are of the scenarios as they were.
            fs::copy(&path, copy).unwrap();
        }
    }
}

/// Unit files lie beside scenarios too.
fn is_scenario(path: &Path) -> bool {
    fs::read_to_string(path).unwrap().contains("\nsteps = [")
}

#[test]
fn each_file_changed_in_one_expectation_fails_in_that_line() {
    let bench = Bench::new("contrary");
    let mut lines = BTreeMap::new();
    std::os::unix::fs::symlink(top_folder().join("units"), bench.folder.join("units")).unwrap();
    turn_all(&top_folder().join("scenarios"), &bench.folder.join("scenarios"), &mut lines);
    let ended = bench.ectwin(&["replay", "scenarios", "--json", "out.jsonl"]);
    assert_eq!(ended.code, Some(1), "{}", ended.stderr);
    let mut left = lines.clone();
    for result in bench.json_lines("out.jsonl") {
        let (file, failure) = (result["file"].as_str().unwrap(), &result["failure"]);
        let path = bench.folder.join(file);
        let line = lines[&path];
        assert_eq!(failure["line"], line, "{file}: {failure}");
        assert!(failure["seen"].as_str().is_some_and(|seen| !seen.is_empty()), "{file}");
        left.remove(&path);
    }
    assert_eq!(left, BTreeMap::new(), "each file has a case");
}
