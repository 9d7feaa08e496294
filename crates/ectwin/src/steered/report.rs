//! What a unit shows, for `status`.

use std::collections::BTreeMap;

use coe_kit::indicators::PortCondition;
use control::messages::{UnitError, UnitReport};
use esc::Port;
use unit_model::EventLevel;

use crate::happenings::{al_status_name, level_id};
use crate::unit_side::UnitSide;

/// The ports by their names.
const PORTS: [(&str, Port); 2] = [("IN", Port::In), ("OUT", Port::Out)];

/// Counters of the ESC, each of one byte: name and register.
const COUNTERS: &[(&str, u16)] = &[
    ("invalid_frames_in", 0x0300),
    ("rx_errors_in", 0x0301),
    ("invalid_frames_out", 0x0302),
    ("rx_errors_out", 0x0303),
    ("forwarded_errors_in", 0x0308),
    ("forwarded_errors_out", 0x0309),
    ("processing_unit_errors", 0x030C),
    ("lost_links_in", 0x0310),
    ("lost_links_out", 0x0311),
    ("watchdog_expirations", 0x0442),
];

pub(super) fn of_unit(unit: &mut UnitSide<'_>, position: usize, name: &str) -> UnitReport {
    let power = unit.has_power();
    let (status, code) = (unit.al_status(), unit.al_status_code());
    let model = unit.model();
    UnitReport {
        unit: position + 1,
        name: name.to_owned(),
        model: model.name().to_owned(),
        power,
        state: status.state.to_string(),
        error: status.error,
        al_status_code: format!("0x{:04X}", code.0),
        al_status_name: al_status_name(code, Some(model)).filter(|_| code.0 != 0).map(str::to_owned),
        indicators: indicators(unit),
        errors: errors(unit),
        mode: unit.cpu().mode().to_string(),
        link: PORTS.map(|(name, port)| (name.to_owned(), unit.port(port) != PortCondition::NoLink)).into(),
        counters: counters(unit),
    }
}

fn indicators(unit: &UnitSide<'_>) -> BTreeMap<String, String> {
    let names = unit.model().indicators().iter();
    names.map(|name| ((*name).to_owned(), unit.pattern(name).id().to_owned())).collect()
}

/// A unit without power shows no error.
fn errors(unit: &UnitSide<'_>) -> Vec<UnitError> {
    if !unit.has_power() {
        return Vec::new();
    }
    let levels = [EventLevel::MinorFault, EventLevel::Observation];
    let errors =
        levels.iter().flat_map(|level| unit.current_errors(*level).iter().map(|error| (*level, error.event)));
    let error = |(level, event): (EventLevel, unit_model::EventCode)| UnitError {
        event: event.to_string(),
        event_name: unit.model().event(event).map_or_else(String::new, |info| info.name.to_owned()),
        level: level_id(level),
    };
    errors.map(error).collect()
}

fn counters(unit: &UnitSide<'_>) -> BTreeMap<String, u64> {
    let registers =
        COUNTERS.iter().map(|(name, register)| ((*name).to_owned(), u64::from(unit.register(*register))));
    registers.chain([("emergencies_lost".to_owned(), unit.emergencies_lost())]).collect()
}
