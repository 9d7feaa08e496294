//! A happening becomes a record: names come from the tables of the standard and of the models.

use esc::Port;
use plant::{Happening, HappeningKind, Mapping};
use time::Instant;
use unit_model::{EventLevel, Model, RecordedEvent};
use wire::{AlStatus, AlStatusCode};

use super::messages;
use super::names::UnitName;
use super::record::{Detail, Record};

/// The record of a happening; `unit` is its unit, if it is known.
pub(super) fn record(happening: &Happening, names: &[UnitName]) -> Record {
    let position = happening.position.map(usize::from);
    let unit = position.and_then(|position| names.get(position));
    let record = of_kind(happening, unit.map(|unit| unit.model));
    let name = || unit.map(|unit| unit.name.clone()).unwrap_or_default();
    Record { unit: position.map(|position| (position + 1, name())), ..record }
}

fn of_kind(happening: &Happening, model: Option<&'static dyn Model>) -> Record {
    let at = happening.at;
    match happening.kind {
        HappeningKind::Power { on } => {
            let words = if on { "is switched on" } else { "is switched off" };
            brief(at, "power", words).with("on", on)
        }
        HappeningKind::State { before, status, code } => state(at, before, status, code, model),
        HappeningKind::Event(event) => recorded(at, &event, model),
        HappeningKind::Emergency(emergency) => messages::emergency(at, &emergency, model),
        HappeningKind::EmergenciesLost { count } => {
            let words = format!("{count} emergencies are lost: no room for them, or no mailbox");
            brief(at, "emergencies_lost", words).with("count", count)
        }
        HappeningKind::Sdo(sdo) => messages::sdo(at, &sdo, model),
        HappeningKind::MessageReceived(message) => messages::message(at, &message, "from_master"),
        HappeningKind::MessageSent(message) => messages::message(at, &message, "to_master"),
        HappeningKind::Mapping(mapping) => self::mapping(at, &mapping),
        HappeningKind::Link { port, present } => {
            let port = match port {
                Port::In => "IN",
                Port::Out => "OUT",
            };
            let words = if present { "has a link" } else { "has no link" };
            brief(at, "link", format!("port {port} {words}")).with("port", port).with("present", present)
        }
        HappeningKind::Indicator { place, pattern } => {
            let names = model.map_or(&[][..], |model| model.indicators());
            let name = names.get(usize::from(place)).copied().unwrap_or("?");
            let words = format!("{name} is {}", pattern.id());
            let record = Record::new(at, "indicator", Detail::Programs, words);
            record.with("indicator", name).with("pattern", pattern.id())
        }
        HappeningKind::Fault { place, injected } => {
            let names = model.map_or(&[][..], |model| model.faults());
            let name = names.get(usize::from(place)).copied().unwrap_or("?");
            let words = if injected { "is injected" } else { "is removed" };
            brief(at, "fault", format!("fault {name} {words}")).with("fault", name).with("present", injected)
        }
        HappeningKind::Carrier { present } => {
            let words = if present { "the link has a carrier" } else { "the link has no carrier" };
            brief(at, "carrier", words).with("present", present)
        }
        HappeningKind::Master { present } => {
            let gone = format!("the master has sent no frame for {}", plant::MASTER_GONE_AFTER);
            let words = if present { "a master sends frames".to_owned() } else { gone };
            brief(at, "master", words).with("present", present)
        }
        HappeningKind::FrameFaultEnded { number } => {
            let words = format!("fault {number} of frames has ended");
            brief(at, "frame_fault", words).with("number", number).with("present", false)
        }
    }
}

fn brief(at: Instant, kind: &'static str, words: impl Into<String>) -> Record {
    Record::new(at, kind, Detail::Brief, words.into())
}

fn state(
    at: Instant,
    before: AlStatus,
    status: AlStatus,
    code: AlStatusCode,
    model: Option<&'static dyn Model>,
) -> Record {
    let (from, to) = (before.state.to_string(), status.state.to_string());
    let code_words = format!("0x{:04X}", code.0);
    // With the device ID in it, the register shows no code.
    let name = (code.0 != 0 && !status.device_id_loaded).then(|| al_status_name(code, model)).flatten();
    let mut words = format!("is in {to}");
    if status.error {
        words.push_str(&format!(" with AL status code {code_words}"));
        words.extend(name.map(|name| format!(" ({name})")));
    } else if status.device_id_loaded {
        words.push_str(&format!(" and shows Explicit Device ID {code_words}"));
    }
    if before.state != status.state {
        words.push_str(&format!(", was in {from}"));
    } else if before.error && !status.error {
        words.push_str(", the error is acknowledged");
    }
    brief(at, "state", words)
        .with("from", from)
        .with("to", to)
        .with("error", status.error)
        .with("al_status_code", code_words)
        .with_optional("al_status_name", name)
}

/// The name of an AL status code: of the standard, or of the maker.
pub(crate) fn al_status_name(code: AlStatusCode, model: Option<&'static dyn Model>) -> Option<&'static str> {
    let of_maker = model.and_then(|model| {
        let mut rows = model.tables().al_status_codes.iter();
        rows.find(|row| row.code == code).map(|row| row.name)
    });
    of_maker.or_else(|| code.row().map(|row| row.meaning))
}

fn recorded(at: Instant, event: &RecordedEvent, model: Option<&'static dyn Model>) -> Record {
    let name = model.and_then(|model| model.event(event.code)).map_or("", |info| info.name);
    let attached = event.attached.values();
    let mut words = format!("records {} {name} ({})", event.code, event.level.words());
    if !attached.is_empty() {
        let values: Vec<String> = attached.iter().map(|value| format!("{value:#X}")).collect();
        words.push_str(&format!(", attached information {}", values.join(", ")));
    }
    brief(at, "event", words)
        .with("event", event.code.to_string())
        .with("event_name", name)
        .with("level", level_id(event.level))
        .with("attached", attached.to_vec())
}

/// The level as in lists for programs.
pub(crate) fn level_id(level: EventLevel) -> String {
    level.words().replace(' ', "_")
}

fn mapping(at: Instant, mapping: &Mapping) -> Record {
    let Mapping { sync_manager, is_outputs, physical_start, length_bytes, logical_start } = *mapping;
    let direction = if is_outputs { "outputs" } else { "inputs" };
    let physical = format!("0x{physical_start:04X}");
    let logical = logical_start.map(|start| format!("0x{start:08X}"));
    let at_logical = match &logical {
        Some(start) => format!("from logical address {start}"),
        None => "no FMMU maps them".to_owned(),
    };
    let words = format!(
        "maps {length_bytes} bytes of {direction}: SM {} at {physical}, {at_logical}",
        sync_manager.0
    );
    Record::new(at, "mapping", Detail::Full, words)
        .with("sync_manager", sync_manager.0)
        .with("direction", direction)
        .with("physical_start", physical)
        .with("length_bytes", length_bytes)
        .with_optional("logical_start", logical)
}
