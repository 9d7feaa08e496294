//! Marks: the statements that a test covers.

use super::citations::{Number, statement};
use crate::sources::Source;

/// The numbers that a file's tests cover.
pub(super) fn of(source: &Source) -> Vec<Number> {
    match source.extension() {
        "rs" => of_tests(&source.text),
        "toml" if source.path.starts_with("scenarios/") => of_comments(&source.text),
        _ => Vec::new(),
    }
}

/// Doc comments count if a test follows.
fn of_tests(text: &str) -> Vec<Number> {
    let (mut marks, mut doc) = (Vec::new(), Vec::new());
    for line in text.lines().map(str::trim) {
        if let Some(comment) = line.strip_prefix("///") {
            doc.extend(leading(comment));
        } else if is_test(line) {
            marks.append(&mut doc);
        } else if !line.starts_with("#[") {
            doc.clear();
        }
    }
    marks
}

fn is_test(line: &str) -> bool {
    line.strip_prefix("#[").is_some_and(|attribute| {
        let path = attribute.split(['(', ']']).next().unwrap_or_default();
        path == "test" || path.ends_with("::test")
    })
}

fn of_comments(text: &str) -> Vec<Number> {
    text.lines().filter_map(|line| line.strip_prefix('#')).flat_map(leading).collect()
}

/// The numbers at the start of a comment.
fn leading(comment: &str) -> Vec<Number> {
    let mut numbers = Vec::new();
    let mut text = comment.trim_start();
    while let Some((number, rest)) = statement(text) {
        numbers.push(number);
        text = rest.strip_prefix(", ").unwrap_or_default();
    }
    numbers
}
