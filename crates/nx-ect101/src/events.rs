//! The events of the unit, from `tables/events.toml` (manual, 8-3-3 to 8-5-2).
//!
//! The table is the only definition of an event. Diagnosis, indicators, checks and documents read it from here.

mod attributes;

use std::sync::LazyLock;

use serde::{Deserialize, Serialize};
use wire::AlStatusCode;

use crate::tables;

pub use attributes::{
    AttachedInformation, Cause, DetectionTiming, EcatEffect, IndicatorStatus, IoRefreshEffect, Notified,
    Recovery,
};
pub use unit_model::{EventCode, EventLevel, EventLog};

static EVENTS: LazyLock<EventsFile> =
    LazyLock::new(|| tables::parse("events.toml", include_str!("../tables/events.toml")));

/// The events that the unit itself raises by name; those of the setting rules are in the rule table.
impl Event {
    /// Non-volatile Memory Hardware Error.
    pub const NON_VOLATILE_MEMORY_HARDWARE_ERROR: EventCode = EventCode(0x0020_0000);
    /// ESC Error.
    pub const ESC_ERROR: EventCode = EventCode(0x0945_0000);
    /// SII Verification Error.
    pub const SII_VERIFICATION_ERROR: EventCode = EventCode(0x0946_0000);
    /// Control Parameter Error in Master.
    pub const CONTROL_PARAMETER_ERROR: EventCode = EventCode(0x1041_0000);
    /// Data Size Mismatched between PDO Entry and I/O Entry C to M.
    pub const MISMATCH_C_TO_M: EventCode = EventCode(0x3916_0000);
    /// Data Size Mismatched between PDO Entry and I/O Entry M to C.
    pub const MISMATCH_M_TO_C: EventCode = EventCode(0x3917_0000);
    /// SM Event Mode Setting Error.
    pub const SM_EVENT_MODE_SETTING_ERROR: EventCode = EventCode(0x3932_0000);
    /// NX Unit Processing Error.
    pub const PROCESSING_ERROR: EventCode = EventCode(0x4020_0000);
    /// NX Unit I/O Communications Error.
    pub const IO_COMMUNICATIONS_ERROR: EventCode = EventCode(0x8020_0000);
    /// NX Message Communications Error.
    pub const MESSAGE_COMMUNICATIONS_ERROR: EventCode = EventCode(0x8022_0000);
    /// NX Unit Clock Not Synchronized Error.
    pub const CLOCK_NOT_SYNCHRONIZED_ERROR: EventCode = EventCode(0x8024_0000);
    /// Event Log Cleared.
    pub const EVENT_LOG_CLEARED: EventCode = EventCode(0x9040_0000);
    /// NX Unit Restart.
    pub const UNIT_RESTART: EventCode = EventCode(0x94B8_0000);
}

/// One event of the manual, with the field names and the words of the table.
#[derive(Debug, Deserialize, Serialize)]
pub struct Event {
    /// Its code.
    #[serde(with = "attributes::code")]
    pub code: EventCode,
    /// Its name.
    pub name: String,
    /// Its level, unless a user has changed it.
    pub level: EventLevel,
    /// Whether a user may change its level to observation and back.
    pub changeable_level: bool,
    /// The log category in the manual.
    pub log: EventLog,
    /// The recovery, after its cause is gone.
    pub recovery: Recovery,
    /// When it is detected.
    pub detection_timing: DetectionTiming,
    /// Its effect on the user program.
    pub user_program: String,
    /// Its effect on I/O refreshing with the CPU Unit.
    pub io_refresh: IoRefreshEffect,
    /// Its effect on EtherCAT communications.
    pub ecat_effect: EcatEffect,
    /// The emergency error code; none if it has none.
    #[serde(with = "attributes::emergency_code")]
    pub emergency_code: Option<u16>,
    /// Whether an emergency message can report it to the master.
    pub emergency_notified: Notified,
    /// Whether the diagnosis history, object 10F3, gets a record of it.
    pub logged: bool,
    /// The log in which it is recorded for support software.
    pub event_log: EventLog,
    /// The AL status code that the master reads; none if the event sets none.
    #[serde(with = "attributes::al_status_code")]
    pub al_status_code: Option<AlStatusCode>,
    /// RUN indicator.
    pub run: IndicatorStatus,
    /// ERR indicator.
    pub err: IndicatorStatus,
    /// TS indicator, green.
    pub ts_green: IndicatorStatus,
    /// TS indicator, red.
    pub ts_red: IndicatorStatus,
    /// Whether the ERROR indicator of the CPU Unit flashes.
    pub cpu_error_indicator_flashes: bool,
    /// Attached information 1 to 4.
    pub attached_information: Vec<AttachedInformation>,
    /// Whether objects 2003, 2004 and the error status show it.
    pub reported_as_current_error: bool,
    /// Further information.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
    /// Its meaning, a sentence.
    pub meaning: String,
    /// Its causes and their corrections, the most likely first.
    pub causes: Vec<Cause>,
    /// How to cause it in an emulated unit: a setting, an action of a master, or a fault. A sentence.
    pub in_ectwin: String,
}

impl Event {
    /// All events, in the order of the manual.
    #[must_use]
    pub fn all() -> &'static [Self] {
        &EVENTS.event
    }

    /// The event with this code; none if the unit has no such event.
    #[must_use]
    pub fn find(code: EventCode) -> Option<&'static Self> {
        Self::all().iter().find(|event| event.code == code)
    }

    /// The events with this AL status code.
    pub fn of_al_status_code(code: AlStatusCode) -> impl Iterator<Item = &'static Self> {
        Self::all().iter().filter(move |event| event.al_status_code == Some(code))
    }

    /// Whether the unit stays in INIT, or goes there, until it is restarted.
    #[must_use]
    pub fn stops_in_init(&self) -> bool {
        self.ecat_effect == EcatEffect::StopInit
    }
}

/// The table has more fields than this file reads.
#[derive(Deserialize)]
struct EventsFile {
    event: Vec<Event>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_event_of_the_manual_is_there_once() {
        let codes: std::collections::BTreeSet<EventCode> =
            Event::all().iter().map(|event| event.code).collect();
        assert_eq!((Event::all().len(), codes.len()), (38, 38));
    }

    #[test]
    fn an_event_is_found_by_its_code() {
        let event = Event::find(EventCode(0x391E_0000)).expect("an event of the manual");
        assert_eq!(
            (event.code.to_string(), event.name.as_str()),
            ("391E0000".into(), "Illegal PDO Entry Added M to C")
        );
        assert_eq!(event.al_status_code, Some(AlStatusCode::INVALID_OUTPUT_MAPPING));
        let mismatch = Event::find(EventCode(0x3917_0000)).expect("an event of the manual");
        assert!(mismatch.changeable_level && mismatch.al_status_code.is_none());
        assert!(Event::find(EventCode(0x1234_5678)).is_none());
    }

    #[test]
    fn every_named_code_is_an_event_of_that_name() {
        let named = [
            (Event::NON_VOLATILE_MEMORY_HARDWARE_ERROR, "Non-volatile Memory Hardware Error"),
            (Event::ESC_ERROR, "ESC Error"),
            (Event::SII_VERIFICATION_ERROR, "SII Verification Error"),
            (Event::CONTROL_PARAMETER_ERROR, "Control Parameter Error in Master"),
            (Event::MISMATCH_C_TO_M, "Data Size Mismatched between PDO Entry and I/O Entry C to M"),
            (Event::MISMATCH_M_TO_C, "Data Size Mismatched between PDO Entry and I/O Entry M to C"),
            (Event::SM_EVENT_MODE_SETTING_ERROR, "SM Event Mode Setting Error"),
            (Event::PROCESSING_ERROR, "NX Unit Processing Error"),
            (Event::IO_COMMUNICATIONS_ERROR, "NX Unit I/O Communications Error"),
            (Event::MESSAGE_COMMUNICATIONS_ERROR, "NX Message Communications Error"),
            (Event::CLOCK_NOT_SYNCHRONIZED_ERROR, "NX Unit Clock Not Synchronized Error"),
            (Event::EVENT_LOG_CLEARED, "Event Log Cleared"),
            (Event::UNIT_RESTART, "NX Unit Restart"),
        ];
        for (code, name) in named {
            assert_eq!(Event::find(code).map(|event| event.name.as_str()), Some(name));
        }
    }
}
