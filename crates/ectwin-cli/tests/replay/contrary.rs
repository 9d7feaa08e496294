//! The expectations of each scenario of the collection are effective: if one is inverted, the scenario fails in
//! that line.

use std::fs;
use std::path::Path;

use crate::bench::{Bench, top_folder};

/// The end of an expectation, and its contrary. For rows with the same ending the first one that matches is used.
const CONTRARIES: &[(&str, &str)] = &[
    ("sees no error", "sees an error"),
    ("have no error", "have recorded 94B80000 77 times"),
    ("has no error", "has the error 85000000"),
    ("recorded nothing", "recorded 94B80000 77 times"),
    ("has no new messages", "has new messages"),
    ("has new messages", "has no new messages"),
    ("is not valid", "is valid"),
    ("is valid", "is not valid"),
    ("is not active", "is active"),
    ("is active", "is not active"),
    ("sees an error", "sees no error"),
    ("was taken", "was refused with 0x00000001"),
    ("has given up", "has nothing to do"),
    ("is TRUE", "is FALSE"),
    ("is FALSE", "is TRUE"),
];

/// Words after which the rest of an expectation is replaced, and the replacement.
const REPLACED: &[(&str, &str)] = &[
    (" in ", "BOOT"),
    (" the error ", "94B80000"),
    ("refused with ", "0x00000001"),
    ("the master has received emergency ", "0x0001"),
];

/// The contrary of an expectation, if it can be made mechanically.
fn contrary(words: &str) -> Option<String> {
    if let Some((ending, instead)) = CONTRARIES.iter().find(|(ending, _)| words.ends_with(ending)) {
        return Some(words.replace(ending, instead));
    }
    if let Some((times, "times")) =
        words.rsplit_once(' ').filter(|_| words.contains(" recorded ") || words.contains(" received "))
    {
        return times.rsplit_once(' ').map(|(head, _)| format!("{head} 77 times"));
    }
    if words.contains(" recorded ") {
        return Some(format!("{words} 77 times"));
    }
    if let Some((head, _, instead)) = REPLACED.iter().find_map(|(mark, instead)| {
        words.split_once(mark).map(|(head, rest)| (format!("{head}{mark}"), rest, instead))
    }) {
        return Some(format!("{head}{instead}"));
    }
    let (head, last) = words.rsplit_once(' ')?;
    other_value(last).map(|other| format!("{head} {other}"))
}

/// Another pattern of an indicator, another number or byte.
fn other_value(value: &str) -> Option<String> {
    if value.chars().any(|letter| letter.is_ascii_lowercase()) && !value.starts_with("0x") {
        return Some(if value == "flashing_2s" { "lit" } else { "flashing_2s" }.to_owned());
    }
    let number = u64::from_str_radix(value.trim_start_matches("0x"), 16).ok()?;
    // Two digits are read as a byte, and as a number that also differs.
    Some(format!("{}", if number == 0x77 { 66 } else { 77 }))
}

/// The text with its last expectation inverted, and the line in which its step begins. An expectation with a
/// time could be true earlier, so those without one are preferred.
fn turned(text: &str) -> Option<(String, usize)> {
    const MARK: &str = "expect = \"";
    let places: Vec<usize> = text.match_indices(MARK).map(|(at, _)| at + MARK.len()).collect();
    let has_time = |at: usize| text[at..].split('}').next().is_some_and(|step| step.contains("within"));
    let mut wanted: Vec<usize> = places.iter().rev().copied().filter(|&at| !has_time(at)).collect();
    wanted.extend(places.iter().rev().copied().filter(|&at| has_time(at)));
    wanted.into_iter().find_map(|at| {
        let words = text[at..].split('"').next()?;
        let contrary = contrary(words)?;
        let step = text[..at].rfind('{')?;
        let line = text[..step].matches('\n').count() + 1;
        Some((format!("{}{contrary}{}", &text[..at], &text[at + words.len()..]), line))
    })
}

fn turn_all(from: &Path, to: &Path, lines: &mut Vec<usize>) {
    fs::create_dir_all(to).unwrap();
    let mut paths: Vec<_> = fs::read_dir(from).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    for path in paths {
        let copy = to.join(path.file_name().unwrap());
        if path.is_dir() {
            turn_all(&path, &copy, lines);
        } else if path.extension().is_some_and(|extension| extension == "toml") {
            let text = fs::read_to_string(&path).unwrap();
            let turned = turned(&text);
            let (text, line) = turned.unwrap_or_else(|| panic!("{}: nothing to turn", path.display()));
            fs::write(copy, text).unwrap();
            lines.push(line);
        } else if path.extension().is_some_and(|extension| extension == "st") {
            fs::copy(&path, copy).unwrap();
        }
    }
}

#[test]
fn each_file_changed_in_one_expectation_fails_in_that_line() {
    let bench = Bench::new("contrary");
    let mut lines = Vec::new();
    std::os::unix::fs::symlink(top_folder().join("units"), bench.folder.join("units")).unwrap();
    turn_all(&top_folder().join("scenarios"), &bench.folder.join("scenarios"), &mut lines);
    let ended = bench.ectwin(&["replay", "scenarios", "--json", "out.jsonl"]);
    assert_eq!(ended.code, Some(1), "{}", ended.stderr);
    let results = bench.json_lines("out.jsonl");
    assert_eq!(results.len(), lines.len());
    for (result, line) in results.iter().zip(lines) {
        let (file, failure) = (&result["file"], &result["failure"]);
        assert_eq!(failure["line"], line, "{file}: {failure}");
        assert!(failure["seen"].as_str().is_some_and(|seen| !seen.is_empty()), "{file}");
        let place = format!("{}:{line}: `{}`", file.as_str().unwrap(), failure["step"].as_str().unwrap());
        assert!(ended.stdout.contains(&place), "{place}");
    }
}

#[test]
fn contraries_are_contrary() {
    for (words, expected) in [
        ("unit 1 is in SAFE-OP with AL status code 0x001B", "unit 1 is in BOOT"),
        ("all units are in OP", "all units are in BOOT"),
        ("unit 1 has recorded 85000000", "unit 1 has recorded 85000000 77 times"),
        ("unit 1 has recorded 85000000 1 times", "unit 1 has recorded 85000000 77 times"),
        ("the outputs of unit 1 begin with 01 02", "the outputs of unit 1 begin with 01 77"),
        ("ERR of unit 1 is not_lit", "ERR of unit 1 is flashing_2s"),
        ("the working counter of unit 1 is 3", "the working counter of unit 1 is 77"),
    ] {
        assert_eq!(contrary(words).as_deref(), Some(expected));
    }
}
