//! The events of a unit, and the channels to which they are reported (manual, 8-3 to 8-6).
//!
//! An event that occurs is reported to every channel in its row of the event table: the diagnosis history with
//! time stamp, the access log, the current errors with the error status, an emergency message. If the cause
//! persists, resetting the errors records the event again.

mod current_errors;
mod faults;
mod message;
mod occurrence;
mod standing;

use arrayvec::ArrayVec;
use coe_kit::history::HistoryRequests;
use unit_model::{AttachedInformation, CurrentError, RecordedEvent};
use wire::{Emergency, SdoAbort};

use crate::events::{Event, EventCode, EventLevel, EventLog, Notified};
use crate::fault::FaultSet;
use crate::memory::{ErrorLog, LogRecord};
use crate::settings::{EventLevels, NewestAcknowledged};

pub use current_errors::{CURRENT_ERRORS_MAX, current_error_bytes};
pub use message::DIAGNOSIS_MESSAGE_BYTES;
pub(crate) use occurrence::Occurrence;

use current_errors::CurrentErrors;
use standing::Standing;

/// Emergencies that wait for the slave stack to take them; it takes them in every step of the unit.
const EMERGENCIES_MAX: usize = 16;
/// Number of events that are kept for the observer of the unit.
pub const OCCURRED_MAX: usize = 64;
/// Attached information 2 of NX Message Communications Error: the NX bus.
const NX_BUS: u32 = 0;

/// All events of a unit.
#[derive(Debug, Default)]
pub(crate) struct Diagnosis {
    log: ErrorLog,
    log_changed: bool,
    current: CurrentErrors,
    /// Configuration errors and mismatches whose causes persist.
    standing: Standing,
    /// The faults whose causes are injected.
    injected: FaultSet,
    /// The faults whose causes the unit itself detects.
    seen: FaultSet,
    /// The faults that the unit has found. They remain after their causes.
    found: FaultSet,
    /// Those of them that the start has found and that are not reported yet.
    untold: FaultSet,
    emergencies: ArrayVec<Emergency, EMERGENCIES_MAX>,
    /// Number of those for which there was no room, since power-on.
    emergencies_lost: u64,
    /// The events since the last query.
    occurred: ArrayVec<RecordedEvent, OCCURRED_MAX>,
    /// 10F3:03 and :05.
    requests: HistoryRequests,
    levels: EventLevels,
    /// System time of the CPU Unit in nanoseconds since 1970-01-01 00:00:00; 0: not known.
    time_ns: u64,
}

impl Diagnosis {
    /// No events have occurred yet, apart from those in the log.
    pub(crate) fn new(log: ErrorLog) -> Self {
        Self { log, ..Self::default() }
    }

    /// The unit starts: conditions that lasted only until then are cleared, and the faults of its hardware are
    /// detected. They are reported with [`Diagnosis::tell_start`], when the time is known.
    pub(crate) fn start(&mut self, levels: EventLevels, acknowledged_reads: NewestAcknowledged) {
        self.current.clear();
        self.standing.clear();
        self.emergencies.clear();
        self.requests.start(acknowledged_reads);
        self.levels = levels;
        self.find_at_start();
    }

    /// The system time of the CPU Unit, the time stamp of events from now on.
    pub(crate) const fn set_time(&mut self, time_ns: u64) {
        self.time_ns = time_ns;
    }

    /// 10F8: the system time of the CPU Unit.
    pub(crate) const fn time_ns(&self) -> u64 {
        self.time_ns
    }

    /// An event occurs. It is reported to every channel in its row.
    pub(crate) fn raise(&mut self, occurrence: Occurrence) {
        let Some(event) = Event::find(occurrence.event) else { return };
        let level = self.levels.of(event);
        // The observer takes them in every step; without an observer the first ones are kept.
        let attached = AttachedInformation::of(&occurrence.details);
        let _ = self.occurred.try_push(RecordedEvent { code: event.code, level, attached });
        self.record(event, level, &occurrence);
        self.list(event, &occurrence);
        if self.requests.emergencies_enabled() && event.emergency_notified == Notified::Possible {
            self.send_emergency(event);
        }
    }

    /// Adds the error, if the event is one.
    fn list(&mut self, event: &Event, occurrence: &Occurrence) {
        let level = self.levels.of(event);
        if event.reported_as_current_error && level != EventLevel::Information {
            self.current
                .add(level, CurrentError { event: event.code, detail: occurrence.details.first().copied() });
        }
    }

    /// An event occurs whose cause persists: resetting the errors records it again.
    pub(crate) fn raise_standing(&mut self, occurrence: Occurrence) {
        self.standing.add(occurrence.clone());
        self.raise(occurrence);
    }

    /// The causes of these events are gone.
    pub(crate) fn settle(&mut self, is_gone: impl Fn(EventCode) -> bool) {
        self.standing.remove(is_gone);
    }

    fn record(&mut self, event: &Event, level: EventLevel, occurrence: &Occurrence) {
        let record = || LogRecord {
            event: event.code,
            level,
            time_ns: self.time_ns,
            details: occurrence.details.clone(),
        };
        if event.logged {
            self.log.system.add(record());
            self.log_changed = true;
        }
        if event.event_log == EventLog::Access {
            self.log.add_access(record());
            self.log_changed = true;
        }
    }

    /// An emergency for which the queue is full is lost and counted; the slave stack empties the queue in every step.
    fn send_emergency(&mut self, event: &Event) {
        if let Some(code) = event.emergency_code {
            let [a, b, c, d] = event.code.0.to_le_bytes();
            // Manual, 8-4-1: two reserved bytes, then the event code.
            let emergency = Emergency { code, error_register: 0, manufacturer: [0, a, b, c, d] };
            let is_lost = self.emergencies.try_push(emergency).is_err();
            self.emergencies_lost += u64::from(is_lost);
        }
    }

    /// Takes the events since the last call, the oldest first.
    pub(crate) fn take_occurred(&mut self) -> ArrayVec<RecordedEvent, OCCURRED_MAX> {
        core::mem::take(&mut self.occurred)
    }

    /// Takes the oldest of them.
    pub(crate) fn take_event(&mut self) -> Option<RecordedEvent> {
        self.occurred.pop_at(0)
    }

    /// Takes the oldest emergency message.
    pub(crate) fn take_emergency(&mut self) -> Option<Emergency> {
        self.emergencies.pop_at(0)
    }

    /// Number of messages for which there was no room.
    pub(crate) const fn emergencies_lost(&self) -> u64 {
        self.emergencies_lost
    }

    /// Resets the current errors (manual, 8-6). An error whose cause persists occurs again immediately.
    pub(crate) fn reset_errors(&mut self) {
        self.current.clear();
        self.reset_faults();
        let standing = core::mem::take(&mut self.standing);
        standing.iter().for_each(|occurrence| self.raise(occurrence.clone()));
        self.standing = standing;
    }

    /// A user clears a log from the side of the CPU Unit, and the unit records that.
    pub(crate) fn clear_log(&mut self, log: EventLog) {
        let number = match log {
            EventLog::System => {
                self.clear_history();
                1
            }
            EventLog::Access => {
                self.log.access.clear();
                2
            }
            EventLog::None => return,
        };
        self.raise(Occurrence::new(Event::EVENT_LOG_CLEARED, [number]));
    }
}

/// The reports to the master.
impl Diagnosis {
    /// 2002:01 Sysmac Error Status.
    pub(crate) const fn error_status(&self) -> u8 {
        self.current.status()
    }

    /// The current errors of a level, the oldest first.
    pub(crate) fn current(&self, level: EventLevel) -> &[CurrentError] {
        self.current.of(level)
    }

    /// 10F3:04 New Messages Available.
    pub(crate) const fn has_new_messages(&self) -> bool {
        self.log.system.has_new()
    }

    /// Both logs.
    pub(crate) const fn log(&self) -> &ErrorLog {
        &self.log
    }

    /// Whether a log has changed since the last call.
    pub(crate) const fn take_log_change(&mut self) -> bool {
        core::mem::replace(&mut self.log_changed, false)
    }

    /// The value of 10F3:03 as read.
    pub(crate) const fn newest_acknowledged(&self) -> u8 {
        self.requests.newest_acknowledged(&self.log.system)
    }

    /// Writes 10F3:03: acknowledges a record, or clears the history by 0.
    pub(crate) fn acknowledge(&mut self, sub: u8) -> Result<(), SdoAbort> {
        self.log_changed |= self.requests.acknowledge(&mut self.log.system, sub)?;
        Ok(())
    }

    /// Clears the diagnosis history (10F3:03, 2100). The current errors are kept (A53), and no event reports
    /// this (A54).
    pub(crate) fn clear_history(&mut self) {
        self.requests.clear(&mut self.log.system);
        self.log_changed = true;
    }

    /// 10F3:05 Flags: whether emergency messages are sent.
    pub(crate) const fn emergencies_enabled(&self) -> bool {
        self.requests.emergencies_enabled()
    }

    /// Writes 10F3:05.
    pub(crate) const fn enable_emergencies(&mut self, enabled: bool) {
        self.requests.enable_emergencies(enabled);
    }
}

#[cfg(test)]
mod tests;
