//! A case of a campaign.

use std::path::Path;

use scenario::Scenario;
use user_file::on_one_line;

use super::case_files::file_stem;

/// Maximum number of cases of one campaign: lists of them are kept in memory.
pub(crate) const CASES_MAX: u64 = 10_000_000;

/// One scenario with one seed.
pub(crate) struct Case<'a> {
    /// Its number, from 1.
    pub(crate) number: u64,
    /// The number of cases in all parts.
    pub(crate) count: u64,
    /// The campaign.
    pub(crate) fingerprint: u64,
    /// The file.
    pub(crate) path: &'a Path,
    /// Its contents.
    pub(crate) scenario: &'a Scenario,
    /// The seed of its random generator.
    pub(crate) seed: u64,
}

impl Case<'_> {
    /// The file, with the values of its parameters.
    pub(crate) fn named(&self) -> String {
        named(&self.path.to_string_lossy(), self.scenario.case.as_deref())
    }

    /// Its name in a report for CI systems.
    pub(crate) fn test_name(&self) -> String {
        test_name(&title(self.scenario), self.scenario.case.as_deref(), self.seed)
    }

    /// The name of its files without its ending.
    pub(super) fn file_stem(&self) -> String {
        file_stem(self.number, self.path, self.scenario.case.as_deref(), self.seed)
    }
}

/// The title of a scenario, in one line.
pub(crate) fn title(scenario: &Scenario) -> String {
    scenario.title.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The name of a test case: `frames are lost (loss = 1, seed 7)`.
pub(super) fn test_name(title: &str, parameters: Option<&str>, seed: u64) -> String {
    let parameters: String = parameters.iter().map(|parameters| format!("{parameters}, ")).collect();
    format!("{title} ({parameters}seed {seed})")
}

/// A file with the values of its parameters: `line.toml (loss = 1, state = OP)`.
pub(crate) fn named(file: &str, parameters: Option<&str>) -> String {
    let file = on_one_line(file);
    match parameters {
        Some(parameters) => format!("{file} ({})", on_one_line(parameters)),
        None => file,
    }
}
