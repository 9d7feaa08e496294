//! Reading a scenario file: its text becomes a script; lines and columns are kept separately, for messages.

mod draft;
mod entries;
mod nearest;
mod places;
mod reader;
mod said;
mod steps;

use core::ops::Range;

use user_file::{Wanted, of_another_kind};

use crate::model::Script;
use crate::ready::{Draft, Files, ScenarioError, ScenarioErrors, Texts, ready};
use crate::run::Scenario;
use entries::File;
use nearest::nearest_name;
use reader::Reader;

impl Scenario {
    /// Reads the text of a scenario file. `files` returns the text of a unit file or of a user program, by its
    /// path relative to the scenario.
    ///
    /// # Errors
    /// The mistakes, in the order of the file: text that is not TOML (then nothing else is checked), unknown
    /// keys, invalid sentences, units that do not exist, steps that contradict each other, and problems of
    /// programs, with their positions in their files.
    pub fn parse(
        text: &str,
        files: impl FnMut(&str) -> Result<String, String>,
    ) -> Result<Self, ScenarioErrors> {
        Self::parse_with(text, &mut Texts(files))
    }

    /// Reads the text of a scenario file that may also refer to folders of programs.
    ///
    /// # Errors
    /// As [`Scenario::parse`].
    pub fn parse_with(text: &str, files: &mut dyn Files) -> Result<Self, ScenarioErrors> {
        let file = file(text)?;
        let mut reader = Reader::new(text);
        let draft = reader.draft(file);
        let (scenario, problems) = ready(draft, files);
        for problem in problems {
            let span = reader.places.of(problem.part);
            reader.refuse(span, problem.message, problem.help);
        }
        reader.errors().map_or(Ok(scenario), Err)
    }
}

impl Script {
    /// Reads the text of a scenario file without the files that it refers to.
    ///
    /// # Errors
    /// The mistakes, in the order of the file, as far as they are visible without units and programs.
    pub fn parse(text: &str) -> Result<Self, ScenarioErrors> {
        let file = file(text)?;
        let mut reader = Reader::new(text);
        let Draft { script, .. } = reader.draft(file);
        reader.errors().map_or(Ok(script), Err)
    }
}

/// The parts of a file.
fn file(text: &str) -> Result<File, ScenarioErrors> {
    let alone = |span: Range<usize>, message: String, help: String| ScenarioErrors {
        list: vec![ScenarioError::in_text(text, span, message, help)],
        more: 0,
    };
    if let Some(refusal) = of_another_kind(text.as_bytes(), "", Wanted::Scenario) {
        return Err(alone(0..0, refusal.message, refusal.help));
    }
    toml::from_str(text).map_err(|error| {
        let help = nearest_name(error.message()).map(|name| format!("did you mean `{name}`?"));
        alone(error.span().unwrap_or_default(), error.message().to_owned(), help.unwrap_or_default())
    })
}
