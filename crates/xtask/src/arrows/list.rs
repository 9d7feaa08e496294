//! Lists of present violations: to be shortened, never to be extended.

use std::collections::BTreeSet;

use crate::outcome::Outcome;
use crate::tools::root;

/// A list in a file beside this one: a header of lines that begin with `#`, then one item per line.
pub(super) struct List {
    /// Its file, from the top folder.
    pub(super) file: &'static str,
    pub(super) text: &'static str,
}

impl List {
    /// The items.
    pub(super) fn items(&self) -> impl Iterator<Item = &'static str> {
        items(self.text)
    }

    /// Writes these items, sorted, below the header of the list.
    pub(super) fn write(&self, items: impl IntoIterator<Item = String>) -> Outcome {
        let head = self.text.lines().take_while(|line| line.starts_with('#')).map(String::from);
        let sorted: BTreeSet<String> = items.into_iter().collect();
        let text: String = head.chain(sorted).map(|line| line + "\n").collect();
        std::fs::write(root().join(self.file), text).map_err(|error| format!("{}: {error}", self.file))
    }
}

/// The lines that are neither empty nor part of the header.
pub(super) fn items(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter(|line| !line.is_empty() && !line.starts_with('#'))
}
