//! The pages and their blocks of code.

use std::path::{Path, PathBuf};

/// One page.
pub(crate) struct Page {
    /// Its path from the top folder.
    pub(crate) name: String,
    pub(crate) blocks: Vec<Block>,
}

/// A fenced block of code.
pub(crate) struct Block {
    /// The line of its fence.
    line: usize,
    /// The word after the fence.
    pub(crate) language: String,
    /// The word after the language.
    pub(crate) file_name: Option<String>,
    pub(crate) text: String,
}

impl Page {
    /// The place of a block, for display.
    pub(crate) fn place(&self, block: &Block) -> String {
        format!("{}:{}", self.name, block.line)
    }
}

/// The top folder of the checkout.
pub(crate) fn top_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// README.md, the pages of docs/user, and the page for authors of unit models.
pub(crate) fn read() -> Vec<Page> {
    let mut names = vec!["README.md".to_owned()];
    names.extend(files("docs/user", "md"));
    names.push("docs/add-a-unit-model.md".to_owned());
    let page = |name: String| Page { blocks: blocks(&text(&name)), name };
    names.into_iter().map(page).collect()
}

/// The texts of the tests that pages may quote.
pub(crate) fn rust_tests() -> Vec<String> {
    let mut names = files("crates/ectwin/tests", "rs");
    names.extend(files("crates/ectwin/tests/guide", "rs"));
    names.extend(files("crates/ectwin/tests/new_model", "rs"));
    names.iter().map(|name| text(name)).collect()
}

fn files(folder: &str, extension: &str) -> Vec<String> {
    let entries =
        std::fs::read_dir(top_folder().join(folder)).unwrap_or_else(|error| panic!("{folder}: {error}"));
    let paths = entries.filter_map(|entry| entry.ok().map(|entry| entry.path()));
    let wanted = paths.filter(|path| path.extension().is_some_and(|found| found == extension));
    let name = |path: PathBuf| path.file_name().map(|name| format!("{folder}/{}", name.display()));
    let mut names: Vec<String> = wanted.filter_map(name).collect();
    names.sort();
    names
}

fn text(name: &str) -> String {
    std::fs::read_to_string(top_folder().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn blocks(page: &str) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut open: Option<Block> = None;
    for (number, line) in (1..).zip(page.lines()) {
        match (line.strip_prefix("```"), &mut open) {
            (Some(_), Some(_)) => blocks.extend(open.take()),
            (Some(words), None) => open = Some(begin(number, words)),
            (None, Some(block)) => block.text.extend([line, "\n"]),
            (None, None) => {}
        }
    }
    blocks
}

fn begin(line: usize, words: &str) -> Block {
    let mut words = words.split_whitespace().map(str::to_owned);
    Block { line, language: words.next().unwrap_or_default(), file_name: words.next(), text: String::new() }
}
