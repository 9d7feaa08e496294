//! The unit file of a terminal.

use device::OutputsBeforeOp;
use time::Duration;
use unit_model::keys::{self, CommonKeys, OutputsRule, Shape, Timing};
use user_file::{DeValue, FileErrors, Located, Problem, Reader, Section, Wanted, read_toml, values};

use crate::channels::Channels;
use crate::description::timeouts;
use crate::settings::{Ports, TerminalSettings};

/// The name of the model.
pub(crate) const MODEL: &str = "digital";
/// The name of a unit whose file has none.
pub(crate) const NAME: &str = "K1";
/// The keys of this model, in addition to those of every model.
pub const KEYS: [&str; 4] = ["inputs", "outputs", "ports", "mailbox"];

/// A terminal has neither.
const SHAPE: Shape = Shape { mailbox: false, boot: false };
/// The controller loads its EEPROM, without further start-up.
const START_UP: Duration = Duration::ZERO;

/// The keys at the top of a file.
pub(crate) fn all_keys() -> Vec<&'static str> {
    ["model"].into_iter().chain(KEYS).chain(keys::KEYS).chain(["cpu", "behaviour", "loopback"]).collect()
}

/// The contents of a terminal's unit file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitFile {
    /// Name of the unit; `K1` if left out.
    pub name: String,
    /// The settings of the terminal.
    pub settings: TerminalSettings,
    /// The file names `refresh_phase`.
    pub(crate) names_refresh_phase: bool,
    /// The settings without the times of the file.
    pub(crate) fast: TerminalSettings,
}

impl UnitFile {
    /// Reads the text of a unit file.
    ///
    /// # Errors
    /// All mistakes, in the order of the file.
    pub fn parse(text: &str) -> Result<Self, FileErrors> {
        read_toml(text, Wanted::UnitFile, |reader, file| {
            if file.get("model").is_none() {
                reader.refuse(0..0, Problem::new("`model` is missing", format!("`model = \"{MODEL}\"`")));
            }
            reader.value(file, "model", |place, value| values::choice(place, value, &[(MODEL, ())]));
            Some(Self::read(reader, file))
        })
    }

    /// Reads the keys of a terminal and those of every model. The caller handles the value of `model`.
    #[must_use]
    pub fn read(reader: &mut Reader<'_>, file: &Section<'_, '_>) -> Self {
        reader.only(file, &all_keys());
        let inputs = reader.value(file, "inputs", channels).map_or(Channels::NONE, |inputs| inputs.value);
        let outputs = reader.value(file, "outputs", channels).map_or(Channels::NONE, |outputs| outputs.value);
        let ports = reader.value(file, "ports", ports).map_or(Ports::TWO, |ports| ports.value);
        reader.value(file, "mailbox", no_mailbox);
        let common = CommonKeys::read(reader, file, SHAPE);
        let settings = |timing| TerminalSettings { inputs, outputs, ports, ..of_common(&common, timing) };
        Self {
            settings: settings(common.timing.value),
            fast: settings(Timing::Fast),
            names_refresh_phase: common.refresh_phase.is_some(),
            name: common.name.as_ref().map_or_else(|| NAME.into(), |name| name.value.clone()),
        }
    }
}

/// The settings of the keys that every model has.
fn of_common(common: &CommonKeys, timing: Timing) -> TerminalSettings {
    let slave = &common.slave;
    let common = &CommonKeys { timing: Located::left_out(timing), ..common.clone() };
    TerminalSettings {
        serial: common.serial.as_ref().map_or(1, |serial| serial.value),
        alias: common.alias.as_ref().map_or(0, |alias| alias.value),
        start_up: common.start_up(START_UP),
        refresh_phase: common.refresh_phase.as_ref().map_or(Duration::ZERO, |phase| phase.value),
        outputs_before_op: outputs_before_op(slave.outputs_before_op),
        sii: slave.sii_timing(timing),
        is_sii_blank: slave.is_sii_blank,
        conduct: slave.conduct(timing),
        ..TerminalSettings::default()
    }
}

fn outputs_before_op(rule: Option<OutputsRule>) -> OutputsBeforeOp {
    match rule {
        Some(OutputsRule::Required) => {
            OutputsBeforeOp::Within(Duration::from_millis(timeouts().safe_op_op_ms.into()))
        }
        Some(OutputsRule::NotRequired) | None => OutputsBeforeOp::NotRequired,
    }
}

fn channels(place: &str, value: &DeValue<'_>) -> Result<Channels, Problem> {
    let expected = "0 to 64";
    let count: u8 = values::integer(place, value, 0..=Channels::MAX.into(), expected)?;
    Channels::new(count).ok_or_else(|| Problem::new(format!("`{place}` is {count}"), expected))
}

fn ports(place: &str, value: &DeValue<'_>) -> Result<Ports, Problem> {
    let expected = "2 to 4";
    let count: u8 = values::integer(place, value, 2..=4, expected)?;
    Ports::new(count).ok_or_else(|| Problem::new(format!("`{place}` is {count}"), expected))
}

/// A terminal with CoE is another device, which does not exist here yet.
fn no_mailbox(place: &str, value: &DeValue<'_>) -> Result<(), Problem> {
    match values::truth(place, value)? {
        false => Ok(()),
        true => Err(Problem::new(format!("`{place}` is true"), "false: terminals have no mailbox yet")),
    }
}

#[cfg(test)]
mod tests {
    use device::SiiTiming;

    use super::*;

    fn settings(text: &str) -> TerminalSettings {
        UnitFile::parse(text).unwrap_or_else(|errors| panic!("{errors}")).settings
    }

    fn messages(text: &str) -> Vec<String> {
        match UnitFile::parse(text) {
            Ok(file) => panic!("{file:?}"),
            Err(errors) => errors.iter().map(ToString::to_string).collect(),
        }
    }

    #[test]
    fn the_shortest_file_is_a_coupler() {
        let file = UnitFile::parse("model = \"digital\"").expect("a right file");
        assert_eq!((file.name.as_str(), file.settings), ("K1", TerminalSettings::default()));
    }

    #[test]
    fn each_key_is_read() {
        let settings = settings(
            "model = \"digital\"\ninputs = 16\noutputs = 8\nports = 3\nmailbox = false\nserial = 9\nalias = 5\n\
             start_up = \"20ms\"\noutputs_before_op = \"required\"\ntimes = { sii = \"1ms\" }\nblank_sii = true\n",
        );
        assert_eq!((settings.inputs.count(), settings.outputs.count(), settings.ports.count()), (16, 8, 3));
        assert_eq!((settings.serial, settings.alias, settings.is_sii_blank), (9, 5, true));
        assert_eq!(settings.start_up.again, Duration::from_millis(20));
        assert_eq!(settings.outputs_before_op, OutputsBeforeOp::Within(Duration::from_secs(9)));
        assert_eq!(settings.sii, SiiTiming::Busy(Duration::from_millis(1)));
    }

    #[test]
    fn what_a_terminal_cannot_be_is_refused_with_its_place() {
        assert_eq!(
            messages("model = \"digital\"\ninputs = 65\noutputs = -1\nports = 5\nmailbox = true\n"),
            [
                "2:10: `inputs` is 65, expected 0 to 64",
                "3:11: `outputs` is -1, expected 0 to 64",
                "4:9: `ports` is 5, expected 2 to 4",
                "5:11: `mailbox` is true, expected false: terminals have no mailbox yet",
            ]
        );
    }

    #[test]
    fn a_key_of_another_model_is_unknown() {
        let [message] = &messages("model = \"digital\"\nid_switch = 1\n")[..] else { panic!("one mistake") };
        assert!(message.starts_with("2:1: unknown key `id_switch`, expected `model`, `inputs`"), "{message}");
        assert_eq!(messages("outputs = 8\n"), ["1:1: `model` is missing, expected `model = \"digital\"`"]);
        assert_eq!(
            messages("model = \"digitel\"\n"),
            ["1:9: `model` is \"digitel\", expected \"digital\"; did you mean `digital`?"]
        );
    }
}
