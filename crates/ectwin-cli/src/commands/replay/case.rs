//! A case of a campaign.

use std::path::Path;

use scenario::Scenario;

/// Most cases of one campaign: lists of them are kept in memory.
pub(crate) const CASES_MAX: u64 = 10_000_000;

/// One scenario with one seed.
pub(super) struct Case<'a> {
    /// Its number, from 1.
    pub(super) number: u64,
    /// How many there are in all parts.
    pub(super) count: u64,
    /// Of the campaign.
    pub(super) fingerprint: u64,
    /// The file.
    pub(super) path: &'a Path,
    /// What it says.
    pub(super) scenario: &'a Scenario,
    /// The seed of its dice.
    pub(super) seed: u64,
}
