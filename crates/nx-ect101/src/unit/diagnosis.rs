//! The events of the unit itself: faults, the findings of its start, actions of a user on the CPU Unit's side.

use arrayvec::ArrayVec;
use device::Start;
use unit_model::{CurrentError, RecordedEvent};
use wire::{AlStatus, AlStatusCode};

use crate::diagnosis::{OCCURRED_MAX, Occurrence};
use crate::events::{Event, EventCode, EventLevel, EventLog};
use crate::fault::Fault;
use crate::indicators::{IndicatorCauses, Indicators, NxCondition};
use crate::memory::ErrorLog;
use crate::outage::Outage;
use crate::settings::LevelNotChangeable;
use crate::unit::NxEct101;
use coe_kit::indicators::PortCondition;

impl NxEct101 {
    /// The cause of a fault appears. Some faults are detected immediately, others when the unit starts or when
    /// the master requests a state (manual, 8-3-4, detection timing).
    pub fn inject(&mut self, fault: Fault) {
        self.objects.diagnosis.inject(fault);
    }

    /// The cause of a fault disappears. Its effect remains until the recovery in the manual.
    pub fn remove(&mut self, fault: Fault) {
        self.objects.diagnosis.remove(fault);
    }

    /// Something fails without an event, immediately.
    pub const fn begin_outage(&mut self, outage: Outage) {
        self.outages.begin(outage);
    }

    /// The cause of an outage disappears. It lasts until the next start of the unit.
    pub const fn end_outage(&mut self, outage: Outage) {
        self.outages.end(outage);
    }

    /// The faults that the unit has found and has not recovered from.
    pub fn faults(&self) -> impl Iterator<Item = Fault> + '_ {
        self.objects.diagnosis.found()
    }

    /// Takes the events that have occurred since the last call, the oldest first, for the observer of the unit.
    /// At most [`OCCURRED_MAX`] are kept; later ones are dropped until the next call.
    pub fn take_occurred(&mut self) -> ArrayVec<EventCode, OCCURRED_MAX> {
        self.objects.diagnosis.take_occurred().iter().map(|event| event.code).collect()
    }

    /// Takes the oldest of them.
    pub(crate) fn take_occurred_event(&mut self) -> Option<RecordedEvent> {
        self.objects.diagnosis.take_event()
    }

    /// The injected faults, one bit each in the order of their names in the model.
    pub(crate) fn injected_bits(&self) -> u32 {
        let diagnosis = &self.objects.diagnosis;
        if !diagnosis.has_injected() && !self.outages.has_cause() {
            return 0;
        }
        let faults = Fault::ALL.into_iter().map(|fault| diagnosis.is_injected(fault));
        let outages = Outage::ALL.into_iter().map(|outage| self.outages.is_present(outage));
        faults.chain(outages).enumerate().fold(0, |bits, (at, is)| bits | u32::from(is) << at)
    }

    /// A user resets the errors from the side of the CPU Unit (manual, 8-6). An error whose cause persists
    /// occurs again.
    pub fn reset_errors(&mut self) {
        self.look_for_io_communications();
        self.objects.diagnosis.reset_errors();
    }

    /// A user clears a log from the side of the CPU Unit: Event Log Cleared (90400000).
    pub fn clear_event_log(&mut self, log: EventLog) {
        self.objects.diagnosis.clear_log(log);
    }

    /// Changes the level of an event, effective from the next start of the unit (manual, 6-5-1).
    ///
    /// # Errors
    /// [`LevelNotChangeable`].
    pub fn set_event_level(&mut self, code: EventCode, level: EventLevel) -> Result<(), LevelNotChangeable> {
        self.settings.event_levels.set(code, level)
    }

    /// The current errors of a level, the oldest first: objects 2003 and 2004.
    #[must_use]
    pub fn current_errors(&self, level: EventLevel) -> &[CurrentError] {
        self.objects.diagnosis.current(level)
    }

    /// Sysmac Error Status, object 2002:01: bit 4 observation, bit 5 minor fault.
    #[must_use]
    pub const fn error_status(&self) -> u8 {
        self.objects.diagnosis.error_status()
    }

    /// New Messages Available, object 10F3:04.
    #[must_use]
    pub const fn has_new_messages(&self) -> bool {
        self.objects.diagnosis.has_new_messages()
    }

    /// The system event log, which is the diagnosis history 10F3, and the access event log.
    #[must_use]
    pub const fn error_log(&self) -> &ErrorLog {
        self.objects.diagnosis.log()
    }

    /// NX Unit Error Status: the unit has an error (manual, 8-1-1). A fault that is not a current error, such
    /// as a broken memory, counts too.
    pub(super) fn has_error(&self) -> bool {
        let is_faulty = self.objects.diagnosis.found().next().is_some() || self.outages.is_any();
        self.error_status() != 0 || is_faulty
    }

    /// The state of the indicators, for the AL status of the stack and the ports IN and OUT; the unit has power.
    #[must_use]
    pub fn indicators(&self, status: AlStatus, code: AlStatusCode, ports: [PortCondition; 2]) -> Indicators {
        let [in_port, out_port] = ports;
        Indicators::of(&IndicatorCauses {
            power: true,
            nx: self.nx_condition(),
            state: status.state,
            al_error: status.error.then_some(code),
            esc_error: self.faults().any(|fault| fault == Fault::Esc),
            in_port,
            out_port,
        })
    }

    /// The condition that the TS indicator shows: that of the unit as an NX Unit. It is initialized when the
    /// CPU Unit starts I/O refreshing.
    #[must_use]
    pub fn nx_condition(&self) -> NxCondition {
        let faults = self.faults().map(Fault::event);
        let errors = faults.chain(self.io_findings.iter().map(|finding| finding.event));
        let condition = match (self.is_initializing, self.is_starting, self.is_initialized) {
            (false, ..) => NxCondition::WaitingForInitialization,
            (true, false, true) => NxCondition::Normal,
            (true, ..) => NxCondition::Initializing,
        };
        errors.map(NxCondition::Error).chain(self.outages.conditions()).fold(condition, NxCondition::or_worse)
    }

    /// The AL status code of the fault that keeps the unit in INIT, if there is one.
    #[must_use]
    pub fn stop_in_init(&self) -> Option<AlStatusCode> {
        let outage = self.outages.is_any().then_some(AlStatusCode::NO_ERROR);
        self.objects.diagnosis.stop_in_init().or(outage)
    }

    /// The unit restarts; returns the AL status code for the master. A reset of the ESC is not a start of the
    /// unit: its errors remain (manual, 8-6).
    pub(super) fn restart_diagnosis(&mut self, start: Start) -> Option<AlStatusCode> {
        if start == Start::EscReset {
            return None;
        }
        self.start_to_watch();
        self.outages.start();
        let diagnosis = &mut self.objects.diagnosis;
        diagnosis.see_no_more(Fault::SiiVerification);
        if start == Start::PowerOn {
            // A memory that could not be read has been replaced by a new one.
            diagnosis.see_no_more(Fault::NonVolatileMemory);
        }
        diagnosis.start(self.settings.event_levels, self.settings.newest_acknowledged);
        self.is_starting = true;
        self.is_initialized = false;
        if start == Start::PowerOn {
            return None;
        }
        diagnosis.raise(Occurrence::bare(Event::UNIT_RESTART));
        Event::find(Event::UNIT_RESTART).and_then(|event| event.al_status_code)
    }

    /// Reports the findings of the start, once. It waits for the first refresh, in which the time is known.
    pub(super) fn tell_start(&mut self) {
        self.is_initializing = true;
        if !core::mem::take(&mut self.is_starting) {
            return;
        }
        let diagnosis = &mut self.objects.diagnosis;
        diagnosis.tell_start();
        for finding in &self.io_findings {
            diagnosis.raise_standing(Occurrence::of_finding(finding));
        }
    }
}
