//! Sections and tables of the project's own pages, as printed.

/// The text under one heading of a page.
#[derive(Debug, Default)]
pub(super) struct PageSection {
    /// The heading without its marks.
    pub(super) heading: &'static str,
    /// The first sentence below it; empty if there is a table first.
    pub(super) sentence: String,
    pub(super) tables: Vec<Table>,
}

/// A table of a page.
#[derive(Debug)]
pub(super) struct Table {
    /// The last line of the text above it.
    pub(super) title: Option<&'static str>,
    pub(super) header: Vec<&'static str>,
    pub(super) rows: Vec<Vec<&'static str>>,
}

/// The sections of a page in their order; the part before the first heading of this level is left out.
pub(super) fn sections(page: &'static str) -> Vec<PageSection> {
    let parts = page.split("\n## ").skip(1);
    parts.map(|part| part.split_once('\n').map_or_else(PageSection::default, section)).collect()
}

fn section((heading, text): (&'static str, &'static str)) -> PageSection {
    let blocks: Vec<&str> = text.split("\n\n").map(str::trim).filter(|block| !block.is_empty()).collect();
    let titles = text
        .split("\n\n")
        .map(|block| block.lines().last())
        .scan(None, |title, last| Some(core::mem::replace(title, last)));
    let tables = text.split("\n\n").zip(titles).filter_map(|(block, title)| table(block, title)).collect();
    let first = blocks.first().filter(|block| !block.starts_with(['|', '`']));
    let sentence = first.map_or_else(String::new, |block| first_sentence(&plain(block)));
    PageSection { heading, sentence, tables }
}

/// The table of a block, with or without a line of text above it.
fn table(block: &'static str, title: Option<&'static str>) -> Option<Table> {
    let mut rows = block.lines().filter_map(cells);
    Some(Table { title, header: rows.next()?, rows: rows.collect() })
}

/// The cells of a row; none for any other line, and for the one below the header.
fn cells(line: &'static str) -> Option<Vec<&'static str>> {
    let row = line.strip_prefix("| ")?.strip_suffix(" |")?;
    Some(row.split(" | ").map(str::trim).collect())
}

/// Text without markup: links are replaced by their words, and backticks are removed. A link alone in parentheses only
/// refers to another place, and is left out.
pub(super) fn plain(text: &str) -> String {
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let mut plain = String::new();
    let mut rest = text.as_str();
    while let Some((before, words, behind)) = link(rest) {
        match (before.strip_suffix(" ("), behind.strip_prefix(')')) {
            (Some(before), Some(behind)) => {
                plain.push_str(before);
                rest = behind;
            }
            _ => {
                plain.push_str(before);
                plain.push_str(words);
                rest = behind;
            }
        }
    }
    plain.push_str(rest);
    plain.replace(['`', '*'], "")
}

/// The first link of a text: the text before it, its words, the text after it.
fn link(text: &str) -> Option<(&str, &str, &str)> {
    let (words_and_before, behind) = text.split_once("](")?;
    let (before, words) = words_and_before.rsplit_once('[')?;
    let (_, behind) = behind.split_once(')')?;
    Some((before, words, behind))
}

fn first_sentence(text: &str) -> String {
    text.split_once(". ").map_or(text, |(sentence, _)| sentence).trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_sentences_and_tables_are_read() {
        let page = "# Page\n\nIntro.\n\n## One `key`\nA [link](a.md#b) and `code`. More.\n\n| key | effect |\n|---|---|\n| `a` | is *b* |\n\n## Two\n| key | effect |\n|---|---|\n";
        let [one, two] = &sections(page)[..] else { panic!("two sections") };
        assert_eq!((one.heading, one.sentence.as_str()), ("One `key`", "A link and code"));
        assert_eq!((one.tables[0].header.as_slice(), one.tables[0].rows.len()), (&["key", "effect"][..], 1));
        assert_eq!(plain(one.tables[0].rows[0][1]), "is b");
        assert_eq!(
            plain("it waits ([more](a.md#b)); a [link](c.md) (as [here](d.md))"),
            "it waits; a link (as here)"
        );
        assert_eq!((two.sentence.as_str(), two.tables[0].rows.len()), ("", 0));
    }
}
