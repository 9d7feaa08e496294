//! The rules for files, checked automatically: lengths, words, links, purposes.

use std::collections::BTreeMap;

use crate::metadata;
use crate::outcome::{Outcome, report};
use crate::sources::{self, Source};
use crate::tools::root;

/// Maximum number of lines of code in one file; tests in separate files count in the same way.
const CODE_LINES: usize = 600;
/// Maximum number of lines of a page.
const PAGE_LINES: usize = 400;
/// Maximum number of characters of the sentence that states the purpose of a crate.
const PURPOSE_CHARACTERS: usize = 160;

/// Words that must not remain in a file, split so that this table does not match itself, and the reasons.
const WORDS: &[(&str, &str, &[&str], &str)] = &[
    ("TO", "DO", ALL, "finish it, or file an issue"),
    ("FIX", "ME", ALL, "finish it, or file an issue"),
    ("todo", "!(", RUST, "finish it"),
    ("unimplemented", "!(", RUST, "finish it"),
    ("dbg", "!(", RUST, "use tracing"),
    ("#[igno", "re", RUST, "assert what holds today and say why"),
    ("pytest.mark.", "skip", PYTHON, "say the skip by testbed, so that it is counted"),
];

/// Words that must not occur in a test.
const TEST_WORDS: &[(&str, &str, &[&str], &str)] =
    &[("sleep", "(", SCRIPTS, "a test waits for an event, not for time")];

const ALL: &[&str] = &["rs", "py", "sh", "toml", "md", "yml", "js"];
const RUST: &[&str] = &["rs"];
const PYTHON: &[&str] = &["py"];
const SCRIPTS: &[&str] = &["rs", "py", "sh"];

/// Names that do not describe the contents.
const EMPTY_NAMES: &[&str] = &["utils.rs", "util.rs", "helpers.rs", "helper.rs", "misc.rs", "part2.rs"];

/// Runs all checks.
pub(crate) fn check() -> Outcome {
    let mut findings = purposes()?;
    let sources = sources::read()?;
    findings.extend(decision_numbers(&sources));
    for source in &sources {
        findings.extend(length(source));
        findings.extend(name(source));
        findings.extend(words(source, WORDS));
        findings.extend(dead_links(source));
        if source.is_test() {
            findings.extend(words(source, TEST_WORDS));
        }
    }
    report("tidy", &findings)
}

fn purposes() -> Result<Vec<String>, String> {
    let without = |package: &metadata::Package| {
        let purpose = package.description.as_deref().unwrap_or_default();
        let is_one_line =
            !purpose.is_empty() && !purpose.contains('\n') && purpose.len() <= PURPOSE_CHARACTERS;
        let sentence = is_one_line && purpose.ends_with('.');
        (!sentence).then(|| format!("{}: needs a description: one sentence with its full stop", package.name))
    };
    Ok(metadata::read()?.packages.iter().filter_map(without).collect())
}

/// Each ADR has a number that no other has, and its title has it too.
fn decision_numbers(sources: &[Source]) -> Vec<String> {
    let mut findings = Vec::new();
    let mut paths = BTreeMap::new();
    for source in sources {
        let Some(file) = source.path.strip_prefix("docs/adr/") else { continue };
        let number = file.split('-').next().unwrap_or_default();
        if !source.text.starts_with(&format!("# {number}: ")) {
            findings.push(format!("{}: its title begins with `# {number}: `", source.path));
        }
        if let Some(other) = paths.insert(number, &source.path) {
            findings.push(format!("{}: {other} has the number {number} too", source.path));
        }
    }
    findings
}

fn length(source: &Source) -> Option<String> {
    let limit = match source.extension() {
        "rs" | "py" => CODE_LINES,
        // It grows with every release, and is read from its top.
        "md" if source.path == "CHANGELOG.md" => return None,
        "md" => PAGE_LINES,
        _ => return None,
    };
    let lines = source.text.lines().count();
    (lines > limit).then(|| format!("{}: {lines} lines, {limit} at most: split it by noun", source.path))
}

fn name(source: &Source) -> Option<String> {
    let file = source.path.rsplit('/').next()?;
    EMPTY_NAMES.contains(&file).then(|| format!("{}: name it after what it holds", source.path))
}

fn words(source: &Source, table: &[(&str, &str, &[&str], &str)]) -> Vec<String> {
    let mut findings = Vec::new();
    for (start, end, extensions, remedy) in table {
        if !extensions.contains(&source.extension()) {
            continue;
        }
        let word = format!("{start}{end}");
        let hits = source.text.lines().enumerate().filter(|(_, line)| line.contains(&word));
        findings.extend(hits.map(|(at, _)| format!("{}:{}: `{word}`: {remedy}", source.path, at + 1)));
    }
    findings
}

/// Links of a page to files that do not exist.
fn dead_links(source: &Source) -> Vec<String> {
    if source.extension() != "md" {
        return Vec::new();
    }
    let page = root().join(&source.path);
    let is_dead = |target: &&str| {
        let file = target.split('#').next().unwrap_or_default();
        let is_ours = !file.is_empty() && !file.contains(':');
        is_ours && !page.parent().is_some_and(|folder| folder.join(file).exists())
    };
    let targets = source.text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    targets
        .filter(is_dead)
        .map(|target| format!("{}: links to {target}, which is not there", source.path))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn source(path: &str, text: &str) -> Source {
        Source { path: path.to_string(), text: text.to_string() }
    }

    #[test]
    fn long_files_are_found_by_their_kind() {
        assert_eq!(length(&source("crates/esc/src/lib.rs", &"\n".repeat(CODE_LINES))), None);
        assert!(length(&source("crates/esc/src/lib.rs", &"\n".repeat(CODE_LINES + 1))).is_some());
        assert!(length(&source("docs/glossary.md", &"\n".repeat(PAGE_LINES + 1))).is_some());
        assert_eq!(length(&source("CHANGELOG.md", &"\n".repeat(PAGE_LINES + 1))), None);
        assert_eq!(length(&source("Cargo.lock", &"\n".repeat(10_000))), None);
    }

    #[test]
    fn a_link_to_nowhere_is_found() {
        let page = |text: &str| source("docs/page.md", text);
        assert_eq!(
            dead_links(&page("[a](../Cargo.toml#x), [b](https://example.org), [c](#here)")),
            Vec::<String>::new()
        );
        assert_eq!(dead_links(&page("[a](../no-such-file.md)")).len(), 1);
    }

    #[test]
    fn an_adr_has_a_number_of_its_own() {
        let adr = |path: &str, title: &str| source(&format!("docs/adr/{path}.md"), &format!("# {title}\n"));
        let right = [adr("0001-a", "0001: a"), adr("0002-b", "0002: b"), source("docs/page.md", "# Page")];
        assert_eq!(decision_numbers(&right), Vec::<String>::new());
        let twice = [adr("0001-a", "0001: a"), adr("0001-b", "0001: b")];
        assert_eq!(
            decision_numbers(&twice),
            ["docs/adr/0001-b.md: docs/adr/0001-a.md has the number 0001 too"]
        );
        assert_eq!(decision_numbers(&[adr("0003-c", "0004: c")]).len(), 1);
    }

    #[test]
    fn an_open_end_is_found_with_its_line() {
        let open = format!("fn main() {{\n    {}{}\n}}", "todo", "!()");
        let found = words(&source("crates/esc/src/lib.rs", &open), WORDS);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(found.iter().all(|line| line.starts_with("crates/esc/src/lib.rs:2:")), "{found:?}");
    }
}
