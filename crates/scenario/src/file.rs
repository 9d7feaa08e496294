//! Reading a scenario file.

mod entries;
mod error;
mod reader;
mod scenario;
mod steps;
mod times;

use core::ops::Range;

use user_file::{LineNumbers, Mistakes, Wanted, of_another_kind};

use crate::ready::{Files, Texts};
use crate::run::Scenario;
use entries::File;
pub(crate) use entries::{FileEntry, MasterEntry, Paths, StepEntry, UnitEntry};
pub use error::{ScenarioError, ScenarioErrors};
pub(crate) use reader::Reader;

impl Scenario {
    /// Reads the text of a scenario file. `files` gives the text of a unit file or of a user program that it names,
    /// by its path as it is seen from the scenario.
    ///
    /// # Errors
    /// What is wrong, in the order of the file: text that is no TOML (then nothing else is judged),
    /// unknown keys, sentences that are none, units that do not exist, steps that contradict each other, and what is
    /// wrong with programs, with its place in their files.
    pub fn parse(
        text: &str,
        files: impl FnMut(&str) -> Result<String, String>,
    ) -> Result<Self, ScenarioErrors> {
        Self::parse_with(text, &mut Texts(files))
    }

    /// Reads the text of a scenario file that may name folders of programs too.
    ///
    /// # Errors
    /// As [`Scenario::parse`].
    pub fn parse_with(text: &str, files: &mut dyn Files) -> Result<Self, ScenarioErrors> {
        let alone = |span: Range<usize>, message: String, help: String| ScenarioErrors {
            list: vec![ScenarioError::new(text, span, message, help)],
            more: 0,
        };
        if let Some(refusal) = of_another_kind(text.as_bytes(), "", Wanted::Scenario) {
            return Err(alone(0..0, refusal.message, refusal.help));
        }
        let file: File = toml::from_str(text).map_err(|error| {
            alone(error.span().unwrap_or_default(), error.message().to_owned(), String::new())
        })?;
        let mut reader = Reader {
            text,
            lines: LineNumbers::of(text),
            files,
            units: Vec::new(),
            unit_spans: Vec::new(),
            variables: Vec::new(),
            master: None,
            is_ground_missing: false,
            programs: Vec::new(),
            errors: Mistakes::default(),
        };
        let scenario = reader.scenario(file);
        if reader.errors.is_empty() {
            return Ok(scenario);
        }
        let (list, more) = reader.errors.into_parts();
        Err(ScenarioErrors { list, more })
    }
}
