//! Words of the project, from docs/glossary.md itself.

use std::sync::LazyLock;

use super::{Explanation, Fact, Subject, page};

const GLOSSARY: &str = include_str!("../../../../docs/glossary.md");

static ROWS: LazyLock<Vec<Row>> = LazyLock::new(|| rows(GLOSSARY));

/// A row of a table of the glossary.
#[derive(Debug, PartialEq, Eq)]
struct Row {
    section: &'static str,
    /// As in the glossary: one word, or several with commas between them.
    words: &'static str,
    meaning: String,
}

/// Each word with the row that explains it.
pub(super) fn words() -> impl Iterator<Item = (&'static str, &'static str)> {
    ROWS.iter().flat_map(|row| split(row.words).map(|word| (word, row.words)))
}

/// The words of each row, as in the glossary.
pub(super) fn rows_of_words() -> impl Iterator<Item = &'static str> {
    ROWS.iter().map(|row| row.words)
}

/// The row of these words.
pub(super) fn explanation(words: &'static str) -> Option<Explanation> {
    let row = ROWS.iter().find(|row| row.words == words)?;
    let facts = vec![Fact::new("glossary", row.section)];
    let (subject, name) = (Subject::Word(row.words), row.meaning.clone());
    Some(Explanation { subject, name, facts, advice: Vec::new(), sections: Vec::new() })
}

/// `SyncManager (SM)` is two words, and so is `RUN mode, PROGRAM mode`.
fn split(words: &'static str) -> impl Iterator<Item = &'static str> {
    let parts = words.split([',', '(', ')']).map(|word| word.trim().trim_matches('`'));
    parts.filter(|word| !word.is_empty())
}

fn rows(text: &'static str) -> Vec<Row> {
    let mut rows = Vec::new();
    for section in page::sections(text) {
        for row in section.tables.iter().flat_map(|table| &table.rows) {
            if let [words, meaning] = row[..] {
                rows.push(Row { section: section.heading, words, meaning: page::plain(meaning) });
            }
        }
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_of_the_glossary_is_read() {
        let lines = GLOSSARY.lines().filter(|line| line.starts_with("| ") && *line != "| word | meaning |");
        assert_eq!(ROWS.len(), lines.count());
        assert!(ROWS.iter().all(|row| !row.section.is_empty() && !row.meaning.is_empty()));
    }

    #[test]
    fn a_row_may_have_several_words() {
        let words = |words| split(words).collect::<Vec<_>>();
        assert_eq!(words("SyncManager (SM)"), ["SyncManager", "SM"]);
        assert_eq!(words("expedited, normal, segmented"), ["expedited", "normal", "segmented"]);
        assert_eq!(words("`SmBuffers`"), ["SmBuffers"]);
    }
}
