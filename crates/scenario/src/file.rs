//! Reading a scenario file: its text becomes a script; lines and columns are kept separately, for messages.

mod draft;
mod places;
mod reader;
mod steps;
mod values;

use user_file::{Problem, Wanted, read_toml};

use crate::model::Script;
use crate::ready::{Draft, Files, ScenarioErrors, Texts, ready};
use crate::run::Scenario;
use reader::FileReader;

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
        let scenario = read_toml(text, Wanted::Scenario, |reader, file| {
            let mut file_reader = FileReader::new(text, reader);
            let draft = file_reader.draft(file);
            let places = file_reader.places;
            let (scenario, problems) = ready(draft, files);
            for problem in problems {
                let words = Problem::new(problem.message, "").with_help(problem.help);
                reader.refuse(places.of(problem.part), words);
            }
            Some(scenario)
        });
        scenario.map_err(ScenarioErrors::of_file)
    }
}

impl Script {
    /// Reads the text of a scenario file without the files that it refers to.
    ///
    /// # Errors
    /// The mistakes, in the order of the file, as far as they are visible without units and programs.
    pub fn parse(text: &str) -> Result<Self, ScenarioErrors> {
        let script = read_toml(text, Wanted::Scenario, |reader, file| {
            let Draft { script, .. } = FileReader::new(text, reader).draft(file);
            Some(script)
        });
        script.map_err(ScenarioErrors::of_file)
    }
}
