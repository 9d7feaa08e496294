//! Rows: a sentence with the steps around it, and the required results of their replays.

use scenario::{Files, Recording, Scenario, Wanted};

/// Steps of a scenario, each as a table in a file.
pub(crate) type Steps = &'static [&'static str];

/// All units in OP.
pub(crate) const OP: &str = r#"{ master = "take all units to OP" }"#;
pub(crate) const IN_OP: &str = r#"{ expect = "all units are in OP", within = "1s" }"#;
/// Unit 1 in PRE-OP.
pub(crate) const PRE_OP: &str = r#"{ master = "take unit 1 to PRE-OP" }"#;
pub(crate) const IN_PRE_OP: &str = r#"{ expect = "the master has nothing to do", within = "1s" }"#;

/// The parts of a file in addition to title and steps.
#[derive(Clone, Copy, Default)]
pub(crate) struct Around {
    pub(crate) head: &'static str,
    /// User programs by their names.
    pub(crate) programs: &'static [(&'static str, &'static str)],
    /// The frames of a recorded master: those of [`captured`].
    pub(crate) has_capture: bool,
}

impl Around {
    /// The failing step, if one fails.
    fn failure(&self, steps: &[String]) -> Option<Failed> {
        let Self { head, programs, has_capture } = self;
        let capture = if *has_capture { "capture = \"a.pcapng\"\n" } else { "" };
        let text = format!("title = \"t\"\n{capture}{head}\nsteps = [\n{}\n]\n", steps.join(",\n"));
        let mut scenario = match Scenario::parse_with(&text, &mut Given(programs)) {
            Ok(scenario) => scenario,
            // Without its order a condition on an answer cannot hold.
            Err(errors) if errors.iter().all(|error| error.message.starts_with("no step ")) => {
                let expected = steps.last().and_then(|step| step.split('"').nth(1));
                return expected.map(|text| Failed { text: text.to_owned(), seen: errors.to_string() });
            }
            Err(errors) => panic!("{text}\n{errors}"),
        };
        if *has_capture {
            scenario.load_capture(&captured()).unwrap_or_else(|reason| panic!("{reason}"));
        }
        let report = scenario.replay(1, Recording::new(false, false));
        report.failure.map(|failure| Failed { text: failure.text, seen: failure.seen })
    }
}

/// The files of a scenario: programs and unit files by their names, and images of EEPROMs.
struct Given(&'static [(&'static str, &'static str)]);

impl Files for Given {
    fn text(&mut self, path: &str, _: Wanted) -> Result<String, String> {
        let text = self.0.iter().find(|(name, _)| *name == path);
        text.map(|(_, text)| (*text).to_owned()).ok_or_else(|| format!("no {path}"))
    }

    /// `digital.bin` is that of a terminal, `broken.bin` that of the unit with a wrong checksum.
    fn bytes(&mut self, path: &str) -> Result<Vec<u8>, String> {
        match path {
            "digital.bin" => Ok(sii_image("model = \"digital\"\ninputs = 8")),
            "broken.bin" => {
                let mut image = sii_image("model = \"nx-ect101\"");
                image[14] ^= 0xFF;
                Ok(image)
            }
            other => Err(format!("no {other}")),
        }
    }
}

/// The EEPROM of a unit with this file.
fn sii_image(unit_file: &str) -> Vec<u8> {
    let file = plant::UnitFile::parse(unit_file).unwrap_or_else(|errors| panic!("{errors}"));
    esi::sii::try_image(&file.section().description()).unwrap_or_else(|error| panic!("{error}"))
}

/// The words of a failing step, and the actual state there.
struct Failed {
    text: String,
    seen: String,
}

/// A capture: the way to OP, and a read of the serial number.
fn captured() -> Vec<u8> {
    let text = format!(
        "title = \"t\"\nsteps = [\n{OP},\n{IN_OP},\n{{ master = \"read SDO 1018:04 of unit 1\" }},\n\
         {{ expect = \"the last SDO was taken\", within = \"20ms\" }}\n]\n"
    );
    let scenario = Scenario::parse(&text, |_| Err(String::new())).unwrap_or_else(|errors| panic!("{errors}"));
    scenario.replay(1, Recording::new(false, true)).recording.into_capture().unwrap_or_default()
}

fn expect(condition: &str, within: &str) -> Vec<String> {
    vec![format!("{{ expect = \"{condition}\", within = \"{within}\" }}")]
}

/// Must not be true for this time.
fn never(condition: &str, within: &str) -> Vec<String> {
    let wait = format!("{{ after = \"{within}\", cpu = \"start the task of unit 1\" }}");
    vec![format!("{{ never = \"{condition}\" }}"), wait]
}

fn texts(steps: Steps) -> Vec<String> {
    steps.iter().map(|step| (*step).to_owned()).collect()
}

/// An order, and a condition that is true after it and only after it.
#[derive(Clone)]
pub(crate) struct OrderRow {
    pub(crate) sentence: &'static str,
    around: Around,
    before: Steps,
    /// Steps between the order and the condition.
    behind: Steps,
    condition: &'static str,
    within: &'static str,
}

pub(crate) const fn order(
    sentence: &'static str,
    before: Steps,
    behind: Steps,
    condition: &'static str,
    within: &'static str,
) -> OrderRow {
    let around = Around { head: "", programs: &[], has_capture: false };
    OrderRow { sentence, around, before, behind, condition, within }
}

impl OrderRow {
    pub(crate) const fn with(self, around: Around) -> Self {
        Self { around, ..self }
    }

    /// The condition is true after the order; that it is never true fails; and without the order it is not true.
    pub(crate) fn try_out(&self, key: &str) -> Result<(), String> {
        let Self { sentence, around, condition, within, .. } = self;
        let (before, behind) = (texts(self.before), texts(self.behind));
        let order = vec![format!("{{ {key} = \"{sentence}\" }}")];
        let steps =
            |parts: &[&Vec<String>]| parts.iter().flat_map(|part| (*part).clone()).collect::<Vec<_>>();
        let expected = expect(condition, within);

        let passes = around.failure(&steps(&[&before, &order, &behind, &expected]));
        is_passed(passes).map_err(|failure| format!("`{sentence}`: {failure}"))?;
        let fails = around.failure(&steps(&[&before, &order, &behind, &never(condition, within)]));
        is_failed(fails, condition).map_err(|outcome| format!("`{sentence}`, and never: {outcome}"))?;
        let without = around.failure(&steps(&[&before, &behind, &expected]));
        is_failed(without, condition).map_err(|outcome| format!("without `{sentence}`: {outcome}"))
    }
}

/// A condition, steps after which it is true, and others after which it is not.
#[derive(Clone)]
pub(crate) struct ConditionRow {
    pub(crate) sentence: &'static str,
    around: Around,
    holds: Steps,
    /// The parts around the steps after which it is not true.
    other: Around,
    fails: Steps,
    within: &'static str,
}

pub(crate) const fn condition(
    sentence: &'static str,
    holds: Steps,
    fails: Steps,
    within: &'static str,
) -> ConditionRow {
    let around = Around { head: "", programs: &[], has_capture: false };
    ConditionRow { sentence, around, holds, other: around, fails, within }
}

impl ConditionRow {
    pub(crate) const fn with(self, around: Around) -> Self {
        Self { around, other: around, ..self }
    }

    pub(crate) const fn failing_with(self, other: Around) -> Self {
        Self { other, ..self }
    }

    /// It is true after the first steps, where `never` fails; after the others it fails, and reports the actual state.
    pub(crate) fn try_out(&self) -> Result<(), String> {
        let Self { sentence, around, other, within, .. } = self;
        let (holds, fails) = (texts(self.holds), texts(self.fails));
        let expected = expect(sentence, within);

        let passes = around.failure(&[holds.clone(), expected.clone()].concat());
        is_passed(passes).map_err(|failure| format!("`{sentence}`: {failure}"))?;
        let unwanted = around.failure(&[holds, never(sentence, within)].concat());
        is_failed(unwanted, sentence).map_err(|outcome| format!("never `{sentence}`: {outcome}"))?;
        let failure = other.failure(&[fails, expected].concat());
        is_failed(failure, sentence).map_err(|outcome| format!("`{sentence}` must fail: {outcome}"))
    }
}

fn is_passed(failure: Option<Failed>) -> Result<(), String> {
    failure.map_or(Ok(()), |Failed { text, seen }| Err(format!("`{text}` fails: {seen}")))
}

/// Whether this condition has failed, with the actual state.
fn is_failed(failure: Option<Failed>, condition: &str) -> Result<(), String> {
    match failure {
        None => Err("it passes".to_owned()),
        Some(Failed { text, seen }) if text == condition && !seen.is_empty() => Ok(()),
        Some(Failed { text, seen }) => Err(format!("`{text}` fails: {seen}")),
    }
}
