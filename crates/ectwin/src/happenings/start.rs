//! The records at the start: the line, its units, and what the setting rules find in their files.

use time::Instant;

use super::describe::level_id;
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
        let unit = (position + 1, section.name().to_owned());
        let model = section.model().name();
        let record = Record::new(at, "unit", Detail::Brief, format!("model {model}")).with("model", model);
        let records = core::iter::once(record).chain(findings(at, setup));
        records.map(move |record| Record { unit: Some(unit.clone()), ..record })
    });
    core::iter::once(ready).chain(units).collect()
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
