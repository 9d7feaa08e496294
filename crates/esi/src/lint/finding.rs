//! What is wrong with a file: findings with their places.

use core::fmt;

use super::rules::{Level, Rule};
use crate::file::Place;

/// One finding: the rule that is broken, the place, and the value that has been chosen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// The rule.
    pub rule: &'static Rule,
    /// The external file, relative to the ESI file; none for the ESI file itself.
    pub file: Option<String>,
    /// The place in it.
    pub place: Place,
    /// The element, as in XPath.
    pub path: String,
    /// What is wrong, with the value found and the one that is used instead.
    pub message: String,
}

impl fmt::Display for Finding {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { rule, place, message, .. } = self;
        write!(formatter, "{place}: {}: {message} ({})", rule.level, rule.code)
    }
}

/// The findings of a file, limited in number: a damaged file of 50 MB has a million.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Findings {
    list: Vec<Finding>,
    omitted: usize,
    most_severe_omitted: Option<Level>,
}

impl Findings {
    /// Maximum number of findings that are kept.
    pub const MAX: usize = 1_000;

    /// Those that are kept, in the order of their places.
    #[must_use]
    pub fn list(&self) -> &[Finding] {
        &self.list
    }

    /// The number of further findings.
    #[must_use]
    pub const fn omitted(&self) -> usize {
        self.omitted
    }

    /// Whether there is a finding of this level or of a more severe one.
    #[must_use]
    pub fn has(&self, level: Level) -> bool {
        let levels = self.list.iter().map(|finding| finding.rule.level).chain(self.most_severe_omitted);
        levels.max().is_some_and(|most_severe| most_severe >= level)
    }

    pub(crate) fn is_full(&self) -> bool {
        self.list.len() >= Self::MAX
    }

    pub(crate) fn omit(&mut self, rule: &Rule) {
        self.omitted += 1;
        self.most_severe_omitted = self.most_severe_omitted.max(Some(rule.level));
    }

    pub(crate) fn push(&mut self, finding: Finding) {
        if self.is_full() { self.omit(finding.rule) } else { self.list.push(finding) }
    }

    pub(crate) fn append(&mut self, other: Self) {
        self.omitted += other.omitted;
        self.most_severe_omitted = self.most_severe_omitted.max(other.most_severe_omitted);
        for finding in other.list {
            self.push(finding);
        }
    }

    /// In the order of their places, those of external files behind them.
    pub(crate) fn sorted(mut self) -> Self {
        self.list.sort_by(|a, b| (&a.file, a.place, a.rule.code).cmp(&(&b.file, b.place, b.rule.code)));
        self
    }
}

/// Takes findings.
pub(crate) trait Report {
    /// Takes one.
    fn report(&self, rule: &'static Rule, place: Place, message: String);
}

/// Takes findings that have been reported before.
pub(crate) struct Reported;

impl Report for Reported {
    fn report(&self, _rule: &'static Rule, _place: Place, _message: String) {}
}
