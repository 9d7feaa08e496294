//! The kinds of records, and those that a client wants.

use crate::messages::Refusal;

/// Everything.
const ALL: &str = "all";
/// The prefix of a subscription of a variable.
const VARIABLE: &str = "variable:";
/// Kinds that belong to another one: whoever wants that one wants these too.
const BELONG: &[(&str, &str)] =
    &[("frame_fault", "fault"), ("carrier", "link"), ("emergencies_lost", "emergency")];

/// A set of kinds, a bit for each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Subscription(u64);

impl Subscription {
    /// Variables are subscribed too.
    pub(super) const VARIABLES: Self = Self(1 << 63);

    pub(super) const fn and(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    pub(super) const fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    pub(super) const fn meets(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }

    pub(super) const fn is_empty(self) -> bool {
        self.0 == 0
    }
}

/// The kinds that can be subscribed.
#[derive(Debug)]
pub(super) struct Kinds(Vec<&'static str>);

/// What a client names.
pub(super) enum Named<'a> {
    /// Kinds of records.
    Kinds(Subscription),
    /// A variable.
    Variable(&'a str),
}

impl Kinds {
    /// At most 63 of them: one bit is for the variables.
    pub(super) fn of(kinds: impl IntoIterator<Item = &'static str>) -> Self {
        Self(kinds.into_iter().take(63).collect())
    }

    /// The kind of a record; nothing if nobody can subscribe it.
    pub(super) fn kind(&self, name: &str) -> Subscription {
        self.set(|kind| kind == name)
    }

    /// What a word of `subscribe` names.
    pub(super) fn named<'a>(&self, word: &'a str) -> Result<Named<'a>, Refusal> {
        if let Some(variable) = word.strip_prefix(VARIABLE) {
            return Ok(Named::Variable(variable));
        }
        let wanted = self.set(|kind| word == ALL || kind == word || BELONG.contains(&(kind, word)));
        if wanted.is_empty() {
            let names: Vec<&str> = self.0.iter().copied().chain([ALL, "variable:NAME"]).collect();
            return Err(Refusal::unknown("kind of records", word, &names));
        }
        Ok(Named::Kinds(wanted))
    }

    /// The names of a set.
    pub(super) fn names(&self, set: Subscription) -> Vec<String> {
        let those = self.0.iter().filter(|kind| self.kind(kind).meets(set));
        those.map(|kind| (*kind).to_owned()).collect()
    }

    fn set(&self, is_in: impl Fn(&str) -> bool) -> Subscription {
        let bits = self.0.iter().enumerate().filter(|(_, kind)| is_in(kind)).map(|(bit, _)| 1 << bit);
        Subscription(bits.fold(0, |all, bit| all | bit))
    }
}

/// The word of a subscribed variable.
pub(super) fn variable_word(name: &str) -> String {
    format!("{VARIABLE}{name}")
}

/// Whether a word of `unsubscribe` means everything.
pub(super) fn is_all(word: &str) -> bool {
    word == ALL
}
