//! Keys of the unit file: their list comes from its reader, their description from docs/user/unit-file.md.

use std::sync::LazyLock;

use plc::CPU_KEYS;

use super::page::{self, PageSection, Table};
use super::tables::tables;
use super::{Explanation, Fact, Subject};

const PAGE: &str = include_str!("../../../../docs/user/unit-file.md");

static KEYS: LazyLock<Vec<String>> =
    LazyLock::new(|| tables().keys.iter().cloned().chain(CPU_KEYS.map(|key| format!("cpu.{key}"))).collect());
static SECTIONS: LazyLock<Vec<Described>> = LazyLock::new(|| described(PAGE));

/// A section of the page that describes a section of the file.
#[derive(Debug)]
struct Described {
    /// Sections of the file; the top of the file is empty.
    sections: Vec<&'static str>,
    sentence: String,
    rows: Vec<Row>,
}

/// A row of a table of keys.
#[derive(Debug)]
struct Row {
    /// Paths within the section.
    keys: Vec<String>,
    /// The other cells, each with the name of its column.
    cells: Vec<(&'static str, String)>,
}

/// Each key with its names: the whole path, and its end from each dot on. An end that is a number is an object
/// or an event.
pub(super) fn names() -> impl Iterator<Item = (&'static str, &'static str)> {
    KEYS.iter().flat_map(|path| {
        let ends = path.match_indices('.').filter_map(|(dot, _)| path.get(dot + 1..));
        let ends = ends.filter(|end| !end.starts_with(|first: char| first.is_ascii_digit()));
        ends.chain([path.as_str()]).map(move |name| (name, path.as_str()))
    })
}

/// The description of a key in the page; for a key without a row, that of the section or key around it.
pub(super) fn explanation(path: &'static str) -> Option<Explanation> {
    let around = || path.match_indices('.').rev().map(|(dot, _)| &path[..dot]);
    let (name, mut facts) = row(path)
        .or_else(|| section(path))
        .or_else(|| around().find_map(|path| row(path).or_else(|| section(path))))?;
    let within = within(path);
    facts.extend((!within.is_empty()).then(|| Fact::new("keys", within.join(", "))));
    Some(Explanation { subject: Subject::Key(path), name, facts, advice: Vec::new(), sections: Vec::new() })
}

fn row(path: &str) -> Option<(String, Vec<Fact>)> {
    let (section, row) = SECTIONS.iter().find_map(|described| described.row(path))?;
    let place = if section.is_empty() { "the top of the file".to_owned() } else { format!("[{section}]") };
    let mut facts = vec![Fact::new("section", place)];
    let (name, cells) = row.name_and_cells()?;
    facts.extend(cells.into_iter().map(|(label, text)| Fact::new(*label, text.as_str())));
    Some((name.to_owned(), facts))
}

fn section(path: &str) -> Option<(String, Vec<Fact>)> {
    let within = format!("{path}.");
    let is_it = |section: &&str| *section == path || section.starts_with(&within);
    let described = SECTIONS.iter().find(|described| described.sections.iter().any(is_it))?;
    Some((described.sentence.clone(), Vec::new()))
}

/// The keys of a section.
fn within(path: &str) -> Vec<&'static str> {
    let keys = KEYS.iter().filter_map(|key| key.strip_prefix(path)?.strip_prefix('.'));
    keys.filter(|key| !key.contains('.')).collect()
}

impl Described {
    fn row(&self, path: &str) -> Option<(&'static str, &Row)> {
        self.sections.iter().find_map(|section| {
            let key = match *section {
                "" => path,
                section => path.strip_prefix(section)?.strip_prefix('.')?,
            };
            self.rows.iter().find(|row| row.keys.iter().any(|known| known == key)).map(|row| (*section, row))
        })
    }
}

impl Row {
    /// Its effect, and the other cells. In a table without a column `effect` the first column contains it.
    fn name_and_cells(&self) -> Option<(&str, Vec<&(&'static str, String)>)> {
        let effect = self.cells.iter().position(|(label, _)| *label == "effect").unwrap_or(0);
        let others = self.cells.iter().enumerate().filter(|(at, _)| *at != effect).map(|(_, cell)| cell);
        Some((&self.cells.get(effect)?.1, others.collect()))
    }
}

fn described(page: &'static str) -> Vec<Described> {
    let of_keys = |section: &PageSection| section.heading.contains("`[") || has_keys(section);
    page::sections(page).into_iter().filter(of_keys).map(describe).collect()
}

fn has_keys(section: &PageSection) -> bool {
    section.tables.iter().any(is_of_keys)
}

fn is_of_keys(table: &Table) -> bool {
    table.header.first() == Some(&"key")
}

fn describe(section: PageSection) -> Described {
    let named = section.heading.split("`[").skip(1).filter_map(|rest| rest.split_once("]`"));
    let mut sections: Vec<&str> = named.map(|(name, _)| name).collect();
    if sections.is_empty() {
        sections.push("");
    }
    let tables = section.tables.iter().filter(|table| is_of_keys(table));
    let rows = tables.flat_map(|table| table.rows.iter().map(|cells| Row::new(&table.header, cells)));
    Described { sections, rows: rows.collect(), sentence: section.sentence }
}

impl Row {
    fn new(header: &[&'static str], cells: &[&'static str]) -> Self {
        let keys = cells.first().map_or_else(Vec::new, |cell| keys(cell));
        let others = header.iter().zip(cells).skip(1);
        Self { keys, cells: others.map(|(label, cell)| (*label, page::plain(cell))).collect() }
    }
}

/// The keys of a cell: one, several with commas, or a run of numbers with `…` between the first and the last.
fn keys(cell: &str) -> Vec<String> {
    let named = |part: &str| part.split('`').skip(1).step_by(2).map(str::to_owned).collect::<Vec<_>>();
    match cell.split_once('…').map(|(first, last)| (named(first), named(last))) {
        Some((first, last)) => run(first.first(), last.first()).unwrap_or_default(),
        None => named(cell),
    }
}

fn run(first: Option<&String>, last: Option<&String>) -> Option<Vec<String>> {
    let (place, first) = first?.rsplit_once('.')?;
    let (_, last) = last?.rsplit_once('.')?;
    let number = |digits| u16::from_str_radix(digits, 16).ok();
    Some((number(first)?..=number(last)?).map(|number| format!("{place}.{number:04X}")).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The page describes the keys of the reader, and no others.
    #[test]
    fn the_page_has_a_row_for_each_key_and_no_further_one() {
        for described in SECTIONS.iter() {
            for (section, key) in described.sections.iter().flat_map(|section| {
                described.rows.iter().flat_map(|row| &row.keys).map(move |key| (*section, key))
            }) {
                let path = if section.is_empty() { key.clone() } else { format!("{section}.{key}") };
                assert!(KEYS.contains(&path), "the unit file has no key {path}");
            }
        }
        for path in KEYS.iter().filter(|path| within(path).is_empty()) {
            let is_described = row(path).is_some()
                || path.starts_with("times.transitions.")
                || path.starts_with("event_levels.");
            assert!(is_described, "docs/user/unit-file.md has no row for {path}");
        }
    }
}
