//! The keys of the slave: `outputs_before_op`, `blank_sii`, `[times]`, `[refuse]`.

use core::ops::RangeInclusive;

use device::{Conduct, Refusals, TransitionTimes};
use time::Duration;
use user_file::{DeValue, Problem, Reader, Section, values, wrong_type};
use wire::AlStatusCode;

use super::keys;
use crate::slave_settings::{OutputsRule, SlaveSettings};

/// The longest time is more than any master waits.
const TIMES: RangeInclusive<Duration> = Duration::ZERO..=Duration::from_secs(60);
const OUTPUTS_RULES: [(&str, OutputsRule); 2] =
    [("required", OutputsRule::Required), ("not-required", OutputsRule::NotRequired)];

pub(super) fn slave(reader: &mut Reader<'_>, file: &Section<'_, '_>) -> SlaveSettings {
    let mut slave = SlaveSettings::default();
    let rule = |place: &str, value: &DeValue<'_>| values::choice(place, value, &OUTPUTS_RULES);
    if let Some(rule) = reader.value(file, "outputs_before_op", rule) {
        slave.outputs_before_op = rule.value;
    }
    slave.is_sii_blank = truth(reader, file, "blank_sii");
    times(reader, file, &mut slave);
    refusals(reader, file, &mut slave.conduct);
    slave
}

fn times(reader: &mut Reader<'_>, file: &Section<'_, '_>, slave: &mut SlaveSettings) {
    let Some(section) = reader.section(file, "times") else { return };
    reader.only(&section, &keys::TIMES);
    slave.conduct.transition_times = transitions(reader, &section);
    slave.sii_time = reader.value(&section, "sii", time).map_or(Duration::ZERO, |time| time.value);
    slave.mailbox_time = reader.value(&section, "mailbox", time).map(|time| time.value);
}

/// One time for all transitions, or a table of times for some of them.
fn transitions(reader: &mut Reader<'_>, times: &Section<'_, '_>) -> TransitionTimes {
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
    let letters = keys::transitions();
    reader.only(&section, &letters);
    for letters in letters {
        if let Some(time) = reader.value(&section, letters, time) {
            each.set(letters, time.value);
        }
    }
    each
}

fn refusals(reader: &mut Reader<'_>, file: &Section<'_, '_>, conduct: &mut Conduct) {
    let Some(section) = reader.section(file, "refuse") else { return };
    reader.only(&section, &keys::refuse());
    let mut refusals = Refusals::default();
    for (key, state) in keys::REFUSED_STATES {
        let code = reader.value(&section, key, |place, value| {
            values::integer(place, value, 1..=0xFFFF, "an AL status code, 0x0001 to 0xFFFF")
        });
        refusals.set(state, code.map(|code| AlStatusCode(code.value)));
    }
    conduct.refusals = refusals;
    conduct.ignores_acknowledge = truth(reader, &section, keys::ACKNOWLEDGE);
}

fn time(place: &str, value: &DeValue<'_>) -> Result<Duration, Problem> {
    values::duration(place, value, |time| TIMES.contains(&time), "a time, \"0ms\" to \"60s\"")
}

/// A key that is `true` or `false`; false if left out.
fn truth(reader: &mut Reader<'_>, section: &Section<'_, '_>, key: &str) -> bool {
    reader.value(section, key, values::truth).is_some_and(|truth| truth.value)
}
