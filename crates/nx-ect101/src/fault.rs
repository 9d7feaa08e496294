//! Faults that can be injected into a unit: failures of hardware and the NX bus, as an input of the core.

use wire::AlStatusCode;

use crate::events::{DetectionTiming, Event, EventCode, IoRefreshEffect, Recovery};

/// The cause of an event that does not result from a setting or a master.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Fault {
    /// The non-volatile memory is broken. Detected when the unit starts.
    NonVolatileMemory,
    /// The EtherCAT slave controller is broken. Detected when the unit starts.
    Esc,
    /// The SII information does not match the unit. Detected at INIT to PRE-OP.
    SiiVerification,
    /// The CPU Unit has lost the Unit operation settings. Detected when the unit starts.
    ControlParameters,
    /// The master has set another synchronization than Free-Run. Detected at PRE-OP to SAFE-OP.
    SmEventMode,
    /// The unit's software has failed.
    Processing,
    /// The NX bus does not carry I/O.
    IoCommunications,
    /// The unit has lost the time of the NX bus.
    ClockNotSynchronized,
    /// A message frame is discarded: once per injection.
    MessageCommunications,
}

impl AsRef<str> for Fault {
    fn as_ref(&self) -> &str {
        self.name()
    }
}

impl Fault {
    /// All faults. If there are several, the master reads the AL status code of the first.
    pub const ALL: [Self; 9] = [
        Self::NonVolatileMemory,
        Self::Esc,
        Self::Processing,
        Self::ClockNotSynchronized,
        Self::SiiVerification,
        Self::ControlParameters,
        Self::IoCommunications,
        Self::SmEventMode,
        Self::MessageCommunications,
    ];

    /// The fault with this name, such as `Processing`.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|fault| fault.name() == name)
    }

    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::NonVolatileMemory => "NonVolatileMemory",
            Self::Esc => "Esc",
            Self::SiiVerification => "SiiVerification",
            Self::ControlParameters => "ControlParameters",
            Self::SmEventMode => "SmEventMode",
            Self::Processing => "Processing",
            Self::IoCommunications => "IoCommunications",
            Self::ClockNotSynchronized => "ClockNotSynchronized",
            Self::MessageCommunications => "MessageCommunications",
        }
    }

    /// The event that it raises.
    #[must_use]
    pub const fn event(self) -> EventCode {
        match self {
            Self::NonVolatileMemory => Event::NON_VOLATILE_MEMORY_HARDWARE_ERROR,
            Self::Esc => Event::ESC_ERROR,
            Self::SiiVerification => Event::SII_VERIFICATION_ERROR,
            Self::ControlParameters => Event::CONTROL_PARAMETER_ERROR,
            Self::SmEventMode => Event::SM_EVENT_MODE_SETTING_ERROR,
            Self::Processing => Event::PROCESSING_ERROR,
            Self::IoCommunications => Event::IO_COMMUNICATIONS_ERROR,
            Self::ClockNotSynchronized => Event::CLOCK_NOT_SYNCHRONIZED_ERROR,
            Self::MessageCommunications => Event::MESSAGE_COMMUNICATIONS_ERROR,
        }
    }

    /// The fault that raises this event; none for an event with another cause.
    #[must_use]
    pub fn of_event(code: EventCode) -> Option<Self> {
        Self::ALL.into_iter().find(|fault| fault.event() == code)
    }

    /// The AL status code that the master reads; none if the event sets none.
    #[must_use]
    pub fn al_status_code(self) -> Option<AlStatusCode> {
        self.row().al_status_code
    }

    pub(crate) fn row(self) -> &'static Event {
        match Event::find(self.event()) {
            Some(event) => event,
            None => panic!("tables/events.toml: no row {}", self.event()),
        }
    }

    /// Whether it is detected when the unit starts, and at no other time.
    pub(crate) fn is_found_at_start(self) -> bool {
        self.row().detection_timing == DetectionTiming::NxUnitPowerOn
    }

    /// Whether it is detected immediately. The manual does not define the timing of NX Unit I/O Communications Error.
    pub(crate) fn is_found_at_once(self) -> bool {
        matches!(self.row().detection_timing, DetectionTiming::Continuous | DetectionTiming::Unspecified)
    }

    /// Whether it occurs only in a unit that has power: its software or the NX bus fails. The causes of the others are
    /// in the hardware and in settings, and are there without power too.
    pub(crate) fn is_of_operation(self) -> bool {
        self.is_found_at_once() || self == Self::MessageCommunications
    }

    /// Whether an error reset clears it, after its cause is gone; the others persist until the unit starts.
    pub(crate) fn goes_with_reset(self) -> bool {
        self.row().recovery == Recovery::ResetErrorByFailsoft
    }

    /// Whether the fail-soft operation of the NX bus determines what stops with it.
    pub(crate) fn is_fail_soft(self) -> bool {
        matches!(
            self.row().recovery,
            Recovery::ResetErrorByFailsoft | Recovery::RestartNxUnitThenResetErrorByFailsoft
        )
    }

    /// Whether I/O refreshing stops, or does not start.
    pub(crate) fn stops_io(self) -> bool {
        matches!(self.row().io_refresh, IoRefreshEffect::NotPerformed | IoRefreshEffect::Stops)
    }

    /// Whether the unit goes to INIT and stays there.
    pub(crate) fn stops_in_init(self) -> bool {
        self.row().stops_in_init()
    }
}

/// Some of the faults.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct FaultSet(u16);

impl FaultSet {
    const fn bit(fault: Fault) -> u16 {
        1 << fault as u16
    }

    pub(crate) const fn contains(self, fault: Fault) -> bool {
        self.0 & Self::bit(fault) != 0
    }

    pub(crate) const fn insert(&mut self, fault: Fault) {
        self.0 |= Self::bit(fault);
    }

    pub(crate) const fn remove(&mut self, fault: Fault) {
        self.0 &= !Self::bit(fault);
    }

    pub(crate) const fn clear(&mut self) {
        self.0 = 0;
    }

    pub(crate) fn iter(self) -> impl Iterator<Item = Fault> {
        // Mostly there is none.
        let all = if self == Self::default() { &[][..] } else { &Fault::ALL[..] };
        all.iter().copied().filter(move |&fault| self.contains(fault))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_fault_raises_another_event_of_the_table() {
        let events: std::collections::BTreeSet<_> = Fault::ALL.map(Fault::event).into();
        assert_eq!(events.len(), Fault::ALL.len());
        assert!(events.iter().all(|&code| Event::find(code).is_some()));
        assert!(Fault::ALL.into_iter().all(|fault| Fault::of_event(fault.event()) == Some(fault)));
    }

    #[test]
    fn the_table_says_when_a_fault_is_found_and_how_it_goes() {
        let those =
            |is: fn(Fault) -> bool| Fault::ALL.into_iter().filter(|&fault| is(fault)).collect::<Vec<_>>();
        let at_once = [Fault::Processing, Fault::ClockNotSynchronized, Fault::IoCommunications];
        assert_eq!(those(Fault::is_found_at_once), at_once);
        let at_start = [Fault::NonVolatileMemory, Fault::Esc, Fault::ControlParameters];
        assert_eq!(those(Fault::is_found_at_start), at_start);
        assert_eq!(those(Fault::goes_with_reset), [Fault::IoCommunications]);
        let of_operation = [&at_once[..], &[Fault::MessageCommunications]].concat();
        assert_eq!(those(Fault::is_of_operation), of_operation);
    }

    #[test]
    fn a_set_holds_each_fault_on_its_own() {
        for fault in Fault::ALL {
            let mut set = FaultSet::default();
            set.insert(fault);
            assert_eq!(set.iter().collect::<Vec<_>>(), [fault]);
            set.remove(fault);
            assert_eq!(set, FaultSet::default());
        }
    }
}
