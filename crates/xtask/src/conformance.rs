//! Checks that the protocol reference, the code that cites it and the tests that cover it agree.
//!
//! A citation is `reference 1.7` (a heading of docs/reference) or `C056` (a conformance statement), in comments
//! of the code and in pages. A test covers a statement by a mark: a line of its doc comment, or a comment of a
//! scenario, that begins with the number, `/// C056: …` or `# C056, C066: …`.

mod citations;
mod marks;
mod page;

#[cfg(test)]
mod tests;

use std::collections::{BTreeMap, BTreeSet};

use crate::outcome::{Outcome, report};
use crate::sources::{self, Source};
use crate::tools::root;

use citations::{Cited, Number};
use page::{Page, Pinned};

/// The pages to which citations refer.
const REFERENCE: &str = "docs/reference/";
/// The page with the statements.
const STATEMENTS: &str = "docs/reference/conformance.md";

/// Checks citations and statements.
pub(crate) fn check() -> Outcome {
    report("conformance", &findings(&sources::read()?))
}

/// Writes the column with the tests of each statement.
pub(crate) fn bless() -> Outcome {
    let sources = sources::read()?;
    let page = sources.iter().find(|source| source.path == STATEMENTS);
    let page = page.ok_or_else(|| format!("{STATEMENTS}: is not there"))?;
    let text = Page::of(&page.text).with_places(&places(&sources));
    std::fs::write(root().join(STATEMENTS), text).map_err(|error| format!("{STATEMENTS}: {error}"))
}

fn findings(sources: &[Source]) -> Vec<String> {
    let text = sources.iter().find(|source| source.path == STATEMENTS).map_or("", |source| &source.text);
    let page = Page::of(text);
    let mut findings = wrong_citations(sources, &page);
    findings.extend(page.doubled().map(|number| format!("{STATEMENTS}: C{number:03} has two rows")));
    findings.extend(wrong_statements(&page, &places(sources)));
    findings
}

/// Citations of a heading or a statement that does not exist.
fn wrong_citations(sources: &[Source], page: &Page<'_>) -> Vec<String> {
    let headings = headings(sources);
    let mut findings = Vec::new();
    for source in sources {
        for (line, cited) in citations::of(source) {
            let wrong = match &cited {
                Cited::Section(number) => !headings.contains(number.as_str()),
                Cited::Statement(number) => page.pinned(*number).is_none(),
            };
            if wrong {
                findings.push(format!("{}:{line}: {cited} is not in {REFERENCE}", source.path));
            }
        }
    }
    findings
}

/// The numbers at the start of headings of the reference.
fn headings(sources: &[Source]) -> BTreeSet<&str> {
    let pages = sources.iter().filter(|source| source.path.starts_with(REFERENCE));
    let lines = pages.flat_map(|page| page.text.lines()).filter(|line| line.starts_with('#'));
    let numbers = lines.filter_map(|line| line.trim_start_matches('#').split_whitespace().next());
    numbers.filter(|number| number.starts_with(|first: char| first.is_ascii_digit())).collect()
}

/// Statements without test and reason, with both, or with other files than those with the marks.
fn wrong_statements(page: &Page<'_>, places: &BTreeMap<Number, BTreeSet<&str>>) -> Vec<String> {
    let finding = |(number, pinned): (Number, Pinned<'_>)| {
        let marked = places.get(&number);
        let wrong = match (pinned, marked) {
            (Pinned::Reason(_), None) => return None,
            (Pinned::Reason(_), Some(_)) => {
                "has a test now: take the reason out, then `cargo xtask conformance --bless`"
            }
            (Pinned::Places(_), None) => "has neither a test that names it nor a reason",
            (Pinned::Places(text), Some(marked)) if text == page::places(marked) => return None,
            (Pinned::Places(_), Some(_)) => "is pinned elsewhere: `cargo xtask conformance --bless`",
        };
        Some(format!("{STATEMENTS}: C{number:03} {wrong}"))
    };
    page.statements().filter_map(finding).collect()
}

/// The files with a test of each statement.
fn places(sources: &[Source]) -> BTreeMap<Number, BTreeSet<&str>> {
    let mut places: BTreeMap<Number, BTreeSet<&str>> = BTreeMap::new();
    for source in sources {
        for number in marks::of(source) {
            places.entry(number).or_default().insert(source.path.as_str());
        }
    }
    places
}
