//! The page of conformance statements: tables of number, statement, and the files with its tests.

use std::collections::{BTreeMap, BTreeSet};

use super::citations::Number;

/// The start of a reason: the slave does not have the feature, or does not support it yet.
const REASONS: &[&str] = &["not here: ", "not yet: "];

/// The page, row by row.
pub(super) struct Page<'a> {
    text: &'a str,
    rows: Vec<Row<'a>>,
}

struct Row<'a> {
    line: &'a str,
    number: Number,
    pinned: Pinned<'a>,
}

/// The last column of a statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pinned<'a> {
    /// Files with tests.
    Places(&'a str),
    /// Why there are none.
    Reason(&'a str),
}

impl<'a> Page<'a> {
    pub(super) fn of(text: &'a str) -> Self {
        Self { text, rows: text.lines().filter_map(row).collect() }
    }

    pub(super) fn pinned(&self, number: Number) -> Option<Pinned<'a>> {
        self.rows.iter().find(|row| row.number == number).map(|row| row.pinned)
    }

    pub(super) fn statements(&self) -> impl Iterator<Item = (Number, Pinned<'a>)> {
        self.rows.iter().map(|row| (row.number, row.pinned))
    }

    /// Numbers that occur in two rows.
    pub(super) fn doubled(&self) -> impl Iterator<Item = Number> {
        let mut seen = BTreeSet::new();
        self.rows.iter().map(|row| row.number).filter(move |number| !seen.insert(*number))
    }

    /// The page with the files of the marks in its last column; reasons are kept.
    pub(super) fn with_places(&self, marked: &BTreeMap<Number, BTreeSet<&str>>) -> String {
        let mut text = self.text.to_string();
        for row in self.rows.iter().filter(|row| matches!(row.pinned, Pinned::Places(_))) {
            let places = marked.get(&row.number).map(places).unwrap_or_default();
            if let Some((front, _)) = row.line.trim_end_matches('|').trim_end().rsplit_once('|') {
                text = text.replace(row.line, &format!("{front}| {places} |"));
            }
        }
        text
    }
}

/// A row of a statement: `| C056 | statement | files with tests |`.
fn row(line: &str) -> Option<Row<'_>> {
    let cells: Vec<&str> = line.strip_prefix('|')?.strip_suffix('|')?.split('|').map(str::trim).collect();
    let [number, _, pinned] = cells.as_slice() else { return None };
    let is_reason = REASONS.iter().any(|start| pinned.len() > start.len() && pinned.starts_with(start));
    let pinned = if is_reason { Pinned::Reason(pinned) } else { Pinned::Places(pinned) };
    Some(Row { line, number: number.strip_prefix('C')?.parse().ok()?, pinned })
}

/// Files in the form of the column.
pub(super) fn places(files: &BTreeSet<&str>) -> String {
    let short = |file: &&str| format!("`{}`", file.strip_prefix("crates/").unwrap_or(file));
    files.iter().map(short).collect::<Vec<_>>().join(", ")
}
