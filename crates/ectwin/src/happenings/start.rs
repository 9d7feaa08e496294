//! The records at the start: the line, its units, and what the setting rules find in their files.

use time::Instant;

use super::describe::level_id;
use super::names::UnitName;
use super::record::{Detail, Record};
use crate::Setup;

/// The first records of a line that answers `link`. `unix_ns` is the calendar time of power-on.
#[must_use]
pub fn ready(at: Instant, link: &str, unix_ns: u64, setups: &[Setup]) -> Vec<Record> {
    let text = format!("ready link={link} units={}", setups.len());
    let ready = Record::new(at, "ready", Detail::Programs, text);
    let ready = ready.with("link", link).with("units", setups.len()).with("unix_ns", unix_ns);
    let units = setups.iter().enumerate().flat_map(|(position, setup)| {
        let section = setup.file().section();
        let first = unit(at, position, &UnitName::of(section));
        let of_unit = first.unit.clone();
        let records = findings(at, setup).map(move |record| Record { unit: of_unit.clone(), ..record });
        core::iter::once(first).chain(records)
    });
    core::iter::once(ready).chain(units).collect()
}

/// A unit of the line.
pub(super) fn unit(at: Instant, position: usize, unit: &UnitName) -> Record {
    let model = unit.model.name();
    let record = Record::new(at, "unit", Detail::Brief, format!("model {model}")).with("model", model);
    Record { unit: Some((position + 1, unit.name.clone())), ..record }
}

/// The setting rules that a unit file does not satisfy.
pub fn findings(at: Instant, setup: &Setup) -> impl Iterator<Item = Record> + use<> {
    let found = setup.file().section().check_settings().map(|check| check.findings).unwrap_or_default();
    found.into_iter().map(move |finding| {
        let (event, name) = (finding.event.to_string(), finding.event_name);
        let text = format!("{event} {name}: {}. {}", finding.message, finding.correction);
        Record::new(at, "finding", Detail::Brief, text)
            .with("rule", finding.rule)
            .with("event", event)
            .with("level", level_id(finding.level))
            .with("message", finding.message)
            .with("correction", finding.correction)
    })
}
