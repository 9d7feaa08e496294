//! Functions and function blocks of Structured Text, from the table of the library.

use std::sync::LazyLock;

use st::Entry;

use super::{Explanation, Fact, Subject};

static ENTRIES: LazyLock<Vec<Entry>> = LazyLock::new(st::reference);

pub(super) fn names() -> impl Iterator<Item = &'static str> {
    ENTRIES.iter().map(|entry| entry.name)
}

pub(super) fn explanation(name: &'static str) -> Option<Explanation> {
    let entry = ENTRIES.iter().find(|entry| entry.name == name)?;
    let facts = [("group", entry.group), ("inputs", &entry.inputs), ("returns", &entry.outputs)];
    let facts = facts.into_iter().filter(|(_, text)| !text.is_empty());
    Some(Explanation {
        subject: Subject::Library(entry.name),
        name: entry.does.to_owned(),
        facts: facts.map(|(label, text)| Fact::new(label, text)).collect(),
        advice: Vec::new(),
        sections: Vec::new(),
    })
}
