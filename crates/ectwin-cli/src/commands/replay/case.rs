//! A case of a campaign.

use std::path::Path;

use scenario::Scenario;

/// Maximum number of cases of one campaign: lists of them are kept in memory.
pub(crate) const CASES_MAX: u64 = 10_000_000;

/// One scenario with one seed.
pub(super) struct Case<'a> {
    /// Its number, from 1.
    pub(super) number: u64,
    /// The number of cases in all parts.
    pub(super) count: u64,
    /// The campaign.
    pub(super) fingerprint: u64,
    /// The file.
    pub(super) path: &'a Path,
    /// Its contents.
    pub(super) scenario: &'a Scenario,
    /// The seed of its random generator.
    pub(super) seed: u64,
}
