//! How master and CPU Unit see an event, channel by channel (manual, 8-1-1).

use unit_model::CurrentError;
use unit_model::tables::Fact;

use super::{al_status, words};
use crate::diagnosis::{DIAGNOSIS_MESSAGE_BYTES, current_error_bytes};
use crate::events::{EcatEffect, Event, EventLevel, Notified};
use crate::fault::Fault;
use crate::memory::LogRecord;

/// When an emergency message is sent for an event that is notified.
pub(super) const EMERGENCIES_ARE_SENT: &str = "if 10F3:05 is 1, in PRE-OP, SAFE-OP and OP";

/// The channels to the master.
pub(super) fn master(event: &Event) -> Vec<Fact> {
    vec![
        Fact::new("state", words::ecat(event.ecat_effect)),
        Fact::new("AL status", al_status_code(event)),
        Fact::new("emergency", emergency(event)),
        Fact::new("10F3", diagnosis_history(event)),
        Fact::new("2002:01", error_status(event)),
        Fact::new("2003, 2004", current_error(event)),
    ]
}

/// The channels to the CPU Unit.
pub(super) fn cpu_unit(event: &Event) -> Vec<Fact> {
    // A fault that is not a current error, such as a broken memory, counts.
    let has_error = event.reported_as_current_error || Fault::of_event(event.code).is_some();
    let error = if has_error { "TRUE while the error persists" } else { "as without the event" };
    let mut facts = vec![
        Fact::new("I/O refresh", words::io_refresh(event.io_refresh)),
        Fact::new("program", event.user_program.as_str()),
        Fact::new("unit error", format!("NX Unit Error Status is {error}")),
    ];
    if event.cpu_error_indicator_flashes {
        facts.push(Fact::new("indicator", "ERROR of the CPU Unit flashes"));
    }
    facts
}

fn al_status_code(event: &Event) -> String {
    let Some(code) = event.al_status_code else { return "no AL status code".into() };
    let name = al_status::name(code);
    let is_one_of_several = event.ecat_effect == EcatEffect::StopPreop;
    let first = if is_one_of_several {
        "; of several errors detected together the first one sets the code"
    } else {
        ""
    };
    format!("0x{:04X} ({name}) in register 0x0134, with the error bit in 0x0130{first}", code.0)
}

fn emergency(event: &Event) -> String {
    match (event.emergency_code, event.emergency_notified) {
        (None, _) => "none: it has no emergency error code".into(),
        (Some(code), Notified::NotPossible) => {
            format!("none is sent; its emergency error code is 0x{code:04X}")
        }
        (Some(code), Notified::Possible) => {
            let bytes = emergency_bytes(code, event);
            format!("0x{code:04X}, {}: {bytes}", EMERGENCIES_ARE_SENT)
        }
    }
}

/// The eight bytes of the message (manual, 8-4-1).
fn emergency_bytes(code: u16, event: &Event) -> String {
    let [c0, c1] = code.to_le_bytes();
    let [e0, e1, e2, e3] = event.code.0.to_le_bytes();
    hex(&[c0, c1, 0, 0, e0, e1, e2, e3])
}

/// The diagnosis message without its time stamp (manual, A-6-4).
fn diagnosis_history(event: &Event) -> String {
    if !event.logged {
        return "no record".into();
    }
    let message = diagnosis_message(event, event.level);
    let code = u32::from(word(&message, 2)) << 16 | u32::from(word(&message, 0));
    let (flags, text_id) = (word(&message, 4), word(&message, 6));
    let as_observation = if event.changeable_level {
        let flags = word(&diagnosis_message(event, EventLevel::Observation), 4);
        format!(" (0x{flags:04X} as an observation)")
    } else {
        String::new()
    };
    let parameters = match flags >> 8 {
        0 => "",
        1 => ", one parameter of 32 bits",
        _ => ", two parameters of 16 bits",
    };
    format!(
        "a record: diagnosis code 0x{code:08X}, flags 0x{flags:04X}{as_observation}, text ID 0x{text_id:04X}{parameters}; \
         10F3:04 and PDO 1BFE become TRUE"
    )
}

/// The message of the unit, with zeros for time and attached information.
fn diagnosis_message(event: &Event, level: EventLevel) -> [u8; DIAGNOSIS_MESSAGE_BYTES] {
    let details = event.attached_information.iter().map(|_| 0).collect();
    LogRecord { event: event.code, level, time_ns: 0, details }.diagnosis_message()
}

/// The two bytes at `at`, little endian.
fn word(bytes: &[u8], at: usize) -> u16 {
    bytes.get(at..at + 2).and_then(|bytes| bytes.try_into().ok()).map_or(0, u16::from_le_bytes)
}

/// Sysmac Error Status, which is also in PDO 1BFF.
fn error_status(event: &Event) -> String {
    if !event.reported_as_current_error {
        return "as without the event".into();
    }
    let bit = |level| match level {
        EventLevel::MinorFault => "bit 5 (Minor Fault)",
        EventLevel::Observation => "bit 4 (Observation)",
        EventLevel::Information => "no bit",
    };
    let as_observation = if event.changeable_level { " or bit 4 (Observation)" } else { "" };
    format!("{}{as_observation} is set, also in PDO 1BFF", bit(event.level))
}

/// The twelve bytes of the entry of 2003 or 2004 (manual, A-6-7).
fn current_error(event: &Event) -> String {
    if !event.reported_as_current_error {
        return "no entry".into();
    }
    let object = match (event.level, event.changeable_level) {
        (_, true) => "2004, or 2003 as an observation",
        (EventLevel::Observation, false) => "2003",
        _ => "2004",
    };
    let has_detail = !event.attached_information.is_empty();
    let bytes = current_error_bytes(&CurrentError { event: event.code, detail: has_detail.then_some(0) });
    if has_detail {
        let before = bytes.get(..8).unwrap_or_default();
        return format!("{object}: {}, then attached information 1 in four bytes", hex(before));
    }
    format!("{object}: {}", hex(&bytes))
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02X}")).collect::<Vec<_>>().join(" ")
}
