//! The keys of the slave: `outputs_before_op`, `blank_sii`, `[times]`, `[refuse]`.

use core::ops::RangeInclusive;

use device::{Conduct, Refusals, SiiTiming, TRANSITIONS, Transition, TransitionTimes};
use time::Duration;
use user_file::{DeValue, Reader, Section, values, wrong_type};
use wire::{AlState, AlStatusCode};

use super::times::time;
use super::timing::Timing;

const OUTPUTS_RULES: [(&str, OutputsRule); 2] =
    [("required", OutputsRule::Required), ("not-required", OutputsRule::NotRequired)];
const REFUSED_STATES: [(&str, AlState); 5] = [
    ("init", AlState::Init),
    ("pre_op", AlState::PreOp),
    ("boot", AlState::Boot),
    ("safe_op", AlState::SafeOp),
    ("op", AlState::Op),
];
const ACKNOWLEDGE: &str = "acknowledge";

/// The AL status codes with which a slave refuses a state; 0 is no error.
pub const AL_STATUS_CODES: RangeInclusive<u16> = 1..=0xFFFF;
/// [`AL_STATUS_CODES`] in words.
pub const AL_STATUS_CODES_WORDS: &str = "an AL status code, 0x0001 to 0xFFFF";

/// The features of a model, for which it has keys.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Shape {
    /// A mailbox.
    pub mailbox: bool,
    /// The state BOOT.
    pub boot: bool,
}

/// `outputs_before_op`: whether the transition from SAFE-OP to OP waits for outputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutputsRule {
    /// `required`: like slaves that check it, within the time in the ESI.
    Required,
    /// `not-required`: OP is reached immediately, and the outputs are not valid until they are received.
    NotRequired,
}

/// The settings of the slave in a unit file. The default is a slave that follows its model and is fast.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SlaveKeys {
    /// Whether OP is reached without outputs (`outputs_before_op`); none: like the model.
    pub outputs_before_op: Option<OutputsRule>,
    /// The time of each transition (`[times] transitions`), and the refused states (`[refuse]`).
    pub conduct: Conduct,
    /// Time of an SII command (`[times] sii`).
    pub sii_time: Duration,
    /// Time from a mailbox request to its response (`[times] mailbox`); none: the time of the model.
    pub mailbox_time: Option<Duration>,
    /// The EEPROM is erased, whatever the non-volatile memory contains (`blank_sii`).
    pub is_sii_blank: bool,
}

impl SlaveKeys {
    /// The conduct with this timing: with `fast`, all times are zero; refusals are kept.
    #[must_use]
    pub fn conduct(&self, timing: Timing) -> Conduct {
        let conduct = self.conduct.clone();
        match timing {
            Timing::Exact => conduct,
            Timing::Fast => Conduct { transition_times: TransitionTimes::default(), ..conduct },
        }
    }

    /// When SII commands are complete.
    #[must_use]
    pub fn sii_timing(&self, timing: Timing) -> SiiTiming {
        if timing == Timing::Fast || self.sii_time.is_zero() {
            SiiTiming::Immediate
        } else {
            SiiTiming::Busy(self.sii_time)
        }
    }

    pub(crate) fn read(reader: &mut Reader<'_>, file: &Section<'_, '_>, shape: Shape) -> Self {
        let rule = |place: &str, value: &DeValue<'_>| values::choice(place, value, &OUTPUTS_RULES);
        let mut slave = Self {
            outputs_before_op: reader.value(file, "outputs_before_op", rule).map(|rule| rule.value),
            is_sii_blank: truth(reader, file, "blank_sii"),
            ..Self::default()
        };
        slave.read_times(reader, file, shape);
        refusals(reader, file, shape, &mut slave.conduct);
        slave
    }

    fn read_times(&mut self, reader: &mut Reader<'_>, file: &Section<'_, '_>, shape: Shape) {
        let Some(section) = reader.section(file, "times") else { return };
        reader.only(&section, times_keys(shape));
        self.conduct.transition_times = transitions(reader, &section, shape);
        self.sii_time = reader.value(&section, "sii", time).map_or(Duration::ZERO, |time| time.value);
        self.mailbox_time = reader.value(&section, "mailbox", time).map(|time| time.value);
    }
}

/// The keys of `[times]`.
#[must_use]
pub const fn times_keys(shape: Shape) -> &'static [&'static str] {
    if shape.mailbox { &["transitions", "sii", "mailbox"] } else { &["transitions", "sii"] }
}

/// The keys of `[times.transitions]`: the transitions by the letters of the standard.
#[must_use]
pub fn transition_keys(shape: Shape) -> Vec<&'static str> {
    let has_it = |row: &&Transition| shape.boot || !row.needs_boot();
    TRANSITIONS.iter().filter(has_it).map(|row| row.letters).collect()
}

/// The keys of `[refuse]`.
#[must_use]
pub fn refuse_keys(shape: Shape) -> Vec<&'static str> {
    refused_states(shape).map(|(key, _)| *key).chain([ACKNOWLEDGE]).collect()
}

fn refused_states(shape: Shape) -> impl Iterator<Item = &'static (&'static str, AlState)> {
    REFUSED_STATES.iter().filter(move |(_, state)| shape.boot || *state != AlState::Boot)
}

/// One time for all transitions, or a table of times for some of them.
fn transitions(reader: &mut Reader<'_>, times: &Section<'_, '_>, shape: Shape) -> TransitionTimes {
    const KEY: &str = "transitions";
    let is_table = times.get(KEY).is_some_and(|value| value.get_ref().is_table());
    if !is_table {
        let every = reader.value(times, KEY, |place, value| match value {
            DeValue::String(_) => time(place, value),
            _ => Err(wrong_type(
                place,
                value,
                "a time for all, \"0ms\" to \"60s\", or a table: { PS = \"50ms\" }",
            )),
        });
        return every.map_or(TransitionTimes::default(), |every| TransitionTimes::every(every.value));
    }
    let mut each = TransitionTimes::default();
    let Some(section) = reader.section(times, KEY) else { return each };
    let letters = transition_keys(shape);
    reader.only(&section, &letters);
    for letters in letters {
        if let Some(time) = reader.value(&section, letters, time) {
            each.set(letters, time.value);
        }
    }
    each
}

fn refusals(reader: &mut Reader<'_>, file: &Section<'_, '_>, shape: Shape, conduct: &mut Conduct) {
    let Some(section) = reader.section(file, "refuse") else { return };
    reader.only(&section, &refuse_keys(shape));
    let mut refusals = Refusals::default();
    for (key, state) in refused_states(shape) {
        let code = reader.value(&section, key, |place, value| {
            let range = u64::from(*AL_STATUS_CODES.start())..=u64::from(*AL_STATUS_CODES.end());
            values::integer(place, value, range, AL_STATUS_CODES_WORDS)
        });
        refusals.set(*state, code.map(|code| AlStatusCode(code.value)));
    }
    conduct.refusals = refusals;
    conduct.ignores_acknowledge = truth(reader, &section, ACKNOWLEDGE);
}

/// A key that is `true` or `false`; false if left out.
fn truth(reader: &mut Reader<'_>, section: &Section<'_, '_>, key: &str) -> bool {
    reader.value(section, key, values::truth).is_some_and(|truth| truth.value)
}
