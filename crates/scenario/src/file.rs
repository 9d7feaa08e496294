//! Reading a scenario file: its text becomes a script; lines and columns are kept separately, for messages.

mod draft;
mod groups;
mod names;
mod parameters;
mod places;
mod preludes;
mod reader;
mod rebase;
mod said;
mod steps;
mod values;

use std::collections::BTreeSet;

use user_file::{Problem, Reader, Section, Wanted, read_toml};

use crate::model::Script;
use crate::ready::{
    Draft, Files, Problem as Mistake, Remembered, ScenarioErrors, Texts, ready, ready_for_line,
};
use crate::run::{Scenario, UnitSource};
use names::{Named, Names};
use parameters::{CASES_MAX, Parameters, USE};
use preludes::{Here, Read, Whole, read_whole};

impl Scenario {
    /// Reads the text of a scenario file that is one case. `files` returns the text of a unit file or of a user program, by
    /// its path relative to the scenario.
    ///
    /// # Errors
    /// The mistakes, in the order of the file: text that is not TOML (then nothing else is checked), unknown
    /// keys, invalid sentences, units that do not exist, steps that contradict each other, and problems of
    /// programs, with their positions in their files. Parameters that make several cases, which [`Scenario::cases`] reads.
    pub fn parse(
        text: &str,
        files: impl FnMut(&str) -> Result<String, String>,
    ) -> Result<Self, ScenarioErrors> {
        Self::parse_with(text, &mut Texts(files))
    }

    /// Reads the text of a scenario file that is one case and may also refer to folders of programs.
    ///
    /// # Errors
    /// As [`Scenario::parse`].
    pub fn parse_with(text: &str, files: &mut dyn Files) -> Result<Self, ScenarioErrors> {
        let one = read_toml(text, Wanted::Scenario, |reader, file| {
            cases((text, reader), file, Number::One, files, scenario)?.pop()
        });
        one.map_err(ScenarioErrors::of_file)
    }

    /// Reads all cases of a scenario file: one for each combination of the values of its parameters, in the order in which
    /// the last parameter changes first. Without parameters it is one case.
    ///
    /// # Errors
    /// As [`Scenario::parse`], of the first case with mistakes, and the mistakes of the parameters.
    pub fn cases(text: &str, files: &mut dyn Files) -> Result<Vec<Self>, ScenarioErrors> {
        let mut files = Remembered::of(files);
        let all = read_toml(text, Wanted::Scenario, |reader, file| {
            cases((text, reader), file, Number::Any, &mut files, scenario)
        });
        all.map_err(ScenarioErrors::of_file)
    }

    /// Reads the text of a scenario file that is one case, for a line with another master than those of scenarios: what only
    /// those do or know is refused. `units` are those of the line; without them it has the units of the scenario.
    ///
    /// # Errors
    /// As [`Scenario::parse`]; orders to the scripted master, and conditions about it; units that are not those of the line.
    pub fn parse_for_line(
        text: &str,
        files: &mut dyn Files,
        units: Option<Vec<UnitSource>>,
    ) -> Result<Self, ScenarioErrors> {
        let one = read_toml(text, Wanted::Scenario, |reader, file| {
            let make = |draft: Draft, case: Option<String>, files: &mut dyn Files| {
                let (scenario, problems) = ready_for_line(draft, files, units.clone());
                (Self { case, ..scenario }, problems)
            };
            cases((text, reader), file, Number::One, files, make)?.pop()
        });
        one.map_err(ScenarioErrors::of_file)
    }

    /// The text of each case of a scenario file, in the order of [`Scenario::cases`]: its parameters have one value there.
    ///
    /// # Errors
    /// Text that is not TOML, and the mistakes of the parameters.
    pub fn texts_of_cases(text: &str) -> Result<Vec<String>, ScenarioErrors> {
        let texts = read_toml(text, Wanted::Scenario, |reader, file| {
            let parameters = Parameters::read(reader, file)?;
            let count = parameters.count();
            if let Some(problem) = too_many(count, Number::Any) {
                reader.refuse(parameters.span.clone(), problem);
                return None;
            }
            Some((0..count).map(|number| parameters.text_of_case(text, number)).collect())
        });
        texts.map_err(ScenarioErrors::of_file)
    }
}

impl Script {
    /// Reads the text of a scenario file that is one case, without the files that it refers to.
    ///
    /// # Errors
    /// The mistakes, in the order of the file, as far as they are visible without units and programs.
    pub fn parse(text: &str) -> Result<Self, ScenarioErrors> {
        let script = read_toml(text, Wanted::Scenario, |reader, file| {
            let script =
                |Draft { script, .. }: Draft, _: Option<String>, _: &mut dyn Files| (script, Vec::new());
            let mut none = Texts(|path: &str| Err(format!("{path} is another file")));
            cases((text, reader), file, Number::One, &mut none, script)?.pop()
        });
        script.map_err(ScenarioErrors::of_file)
    }
}

/// How many cases a file may have.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Number {
    One,
    Any,
}

/// A case of a scenario file, and its mistakes.
fn scenario(draft: Draft, case: Option<String>, files: &mut dyn Files) -> (Scenario, Vec<Mistake>) {
    let (scenario, problems) = ready(draft, files);
    (Scenario { case, ..scenario }, problems)
}

/// Reads the cases of a file, until one has a mistake; none then.
fn cases<T>(
    (text, reader): (&str, &mut Reader<'_>),
    file: &Section<'_, '_>,
    wanted: Number,
    files: &mut dyn Files,
    mut make: impl FnMut(Draft, Option<String>, &mut dyn Files) -> (T, Vec<Mistake>),
) -> Option<Vec<T>> {
    let parameters = Parameters::read(reader, file)?;
    let count = parameters.count();
    if let Some(problem) = too_many(count, wanted) {
        reader.refuse(parameters.span.clone(), problem);
        return None;
    }
    let mut made = Vec::new();
    for number in 0..count {
        let refused = reader.refused();
        let named = parameters.case(number);
        let whole =
            read_whole((text, reader), file, &Names::of(&named), files, &Here::scenario(&Read::default()));
        if file.get(USE).is_some() && whole.draft.is_whole {
            refuse_missing(reader, &whole);
        }
        let Whole { draft, places, .. } = whole;
        let case = (!named.is_empty()).then(|| words(&named));
        let (one, problems) = make(draft, case, files);
        let mut told = BTreeSet::new();
        for problem in problems {
            let place = places.of(problem.part);
            let message = places.in_prelude(problem.part).unwrap_or_default() + &problem.message;
            // The values of a `for`, and a prelude that is used twice, can make the same mistake several times.
            if told.insert((place.start, message.clone())) {
                reader.refuse(place, Problem::new(message, "").with_help(problem.help));
            }
        }
        if reader.refused() == refused && number == 0 {
            let help = "each value would make the same case: use the name in a text, or remove it";
            named.iter().for_each(|named| named.refuse_unused(reader, help));
        }
        if reader.refused() > refused {
            return None;
        }
        made.push(one);
    }
    Some(made)
}

/// A scenario needs some keys, wherever they are.
fn refuse_missing(reader: &mut Reader<'_>, whole: &Whole) {
    for key in whole.missing() {
        let problem = Problem::new(format!("`{key}` is missing, also in the preludes"), "");
        reader.refuse(0..0, problem);
    }
}

/// The name of a case: `loss = 1, state = OP`.
fn words(named: &[Named<'_>]) -> String {
    named.iter().map(Named::words).collect::<Vec<_>>().join(", ")
}

fn too_many(count: usize, wanted: Number) -> Option<Problem> {
    match wanted {
        Number::One if count > 1 => {
            let message = format!("the parameters make {count} cases, where one is needed");
            Some(Problem::new(message, "").with_help("give each parameter one value"))
        }
        Number::Any if count > CASES_MAX => {
            let message = format!("the parameters make {count} cases, and a file has at most {CASES_MAX}");
            Some(Problem::new(message, "").with_help("fewer values, or several files"))
        }
        Number::One | Number::Any => None,
    }
}
