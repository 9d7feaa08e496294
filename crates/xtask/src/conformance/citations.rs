//! Citations of the reference, in pages and in comments of the code.

use core::fmt;

use crate::sources::Source;

/// The number after the `C` of a conformance statement.
pub(super) type Number = u16;

/// The target of a citation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Cited {
    /// A heading, by its number: `1.7`.
    Section(String),
    /// A conformance statement.
    Statement(Number),
}

impl fmt::Display for Cited {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Section(number) => write!(formatter, "reference {number}"),
            Self::Statement(number) => write!(formatter, "C{number:03}"),
        }
    }
}

/// The word before the number of a section.
const WORD: &str = "eference";

/// All citations of a file with their lines, from 1.
pub(super) fn of(source: &Source) -> Vec<(usize, Cited)> {
    let Some(readable) = readable(source.extension()) else { return Vec::new() };
    let lines: Vec<&str> = source.text.lines().map(readable).collect();
    let mut found = Vec::new();
    for (at, line) in lines.iter().enumerate() {
        let next = lines.get(at + 1).copied().unwrap_or_default();
        let cited = sections(&with_number(line, next)).into_iter().chain(statements(line));
        found.extend(cited.map(|cited| (at + 1, cited)));
    }
    found
}

/// The part of a line that may contain citations, by the kind of the file.
fn readable(extension: &str) -> Option<fn(&str) -> &str> {
    match extension {
        "md" => Some(|line| line),
        "rs" => Some(|line| line.find("//").map_or_else(|| check_name(line), |at| &line[at..])),
        "toml" | "py" | "sh" => Some(|line| line.find('#').map_or("", |at| &line[at..])),
        _ => None,
    }
}

/// A statement in code is the name of a check: a separate string, such as `"C022"`.
fn check_name(line: &str) -> &str {
    let is_name = |text: &&str| statement(text).is_some_and(|(_, rest)| rest.is_empty());
    line.split('"').skip(1).step_by(2).find(is_name).unwrap_or_default()
}

/// If a citation is split before its number at the end of a line, the next line is included.
fn with_number(line: &str, next: &str) -> String {
    let broken = line.trim_end().trim_end_matches(',').ends_with(WORD);
    if broken {
        format!("{line} {}", next.trim_start_matches(['/', '!', '#', ' ']))
    } else {
        line.to_string()
    }
}

fn sections(line: &str) -> Vec<Cited> {
    let mut found = Vec::new();
    for (at, _) in line.match_indices(WORD) {
        let before: Vec<char> = line[..at].chars().rev().take(2).collect();
        let is_word = matches!(before[..], ['r' | 'R'])
            || matches!(before[..], ['r' | 'R', other] if !other.is_alphanumeric());
        let rest = line[at + WORD.len()..].trim_start_matches([',', ' ']);
        if is_word && rest.len() < line.len() - at - WORD.len() {
            found.extend(numbers(rest).into_iter().map(Cited::Section));
        }
    }
    found
}

/// The numbers of a list such as `3.1 to 3.4, 5 and 6.2`.
fn numbers(mut text: &str) -> Vec<String> {
    let mut numbers = Vec::new();
    while let Some((number, rest)) = number(text) {
        numbers.push(number.to_string());
        let next = [", ", " to ", " and "].iter().find_map(|between| rest.strip_prefix(between));
        let Some(next) = next else { break };
        text = next;
    }
    numbers
}

/// A number of a section at the start, and the rest. `8-6` and `16#1` are not numbers of sections.
fn number(text: &str) -> Option<(&str, &str)> {
    let digits = |text: &str| text.len() - text.trim_start_matches(|c: char| c.is_ascii_digit()).len();
    let chapter = digits(text);
    let section = text[chapter..].strip_prefix('.').map_or(0, digits);
    let end = if section == 0 { chapter } else { chapter + 1 + section };
    let is_number =
        chapter > 0 && !text[end..].starts_with(|c: char| c.is_alphanumeric() || "-#%_".contains(c));
    is_number.then(|| text.split_at(end))
}

fn statements(line: &str) -> Vec<Cited> {
    let starts = line
        .match_indices('C')
        .filter(|(at, _)| !line[..*at].ends_with(|c: char| c.is_alphanumeric() || c == '_'));
    starts.filter_map(|(at, _)| statement(&line[at..])).map(|(number, _)| Cited::Statement(number)).collect()
}

/// A statement such as `C056` at the start, and the rest.
pub(super) fn statement(text: &str) -> Option<(Number, &str)> {
    let digits = text.strip_prefix('C')?.get(..3)?;
    let rest = &text[1 + digits.len()..];
    let ends = !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_');
    (ends && digits.chars().all(|c| c.is_ascii_digit())).then_some((digits.parse().ok()?, rest))
}
