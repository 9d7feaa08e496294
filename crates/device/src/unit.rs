//! What a unit model provides: objects, process data, checks, and no protocol.

use esc::SmIndex;
use objects::ObjectServer;
use time::{Duration, Instant};
use wire::{AlState, AlStatusCode};

use crate::action::Action;
use crate::state_machine::Check;
use crate::sync_mode::SyncMode;

/// The ports of the slave: whether the cable has a partner at its other end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PortLinks {
    /// Port IN, towards the master.
    pub in_port: bool,
    /// Port OUT, towards the next slaves.
    pub out_port: bool,
}

/// Why the stack calls the unit's refresh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RefreshCause {
    /// The period of the unit ([`Unit::refresh_period`]) is over.
    Period,
    /// The master has exchanged process data with a unit that follows them ([`SyncMode`]).
    SyncManager,
    /// A state or a status has changed between two periods, and the master must see it immediately.
    Change,
}

/// One refresh: the contents of the SyncManagers, for the unit to read and to fill. Several SyncManagers of one
/// direction follow each other in the order of their numbers.
pub struct Exchange<'a> {
    /// The reason for the refresh.
    pub cause: RefreshCause,
    /// State of the EtherCAT state machine at this refresh.
    pub state: AlState,
    /// The links at the ports.
    pub links: PortLinks,
    /// The newest complete outputs; none unless the slave is in OP, the master has sent outputs since the slave
    /// entered SAFE-OP, and the process data watchdog has not expired.
    pub outputs: Option<&'a [u8]>,
    /// The inputs to fill, with the length of the mapping; empty below SAFE-OP. On entry they hold older inputs.
    pub inputs: &'a mut [u8],
}

/// Why a slave restarts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// Its power was cycled.
    PowerOn,
    /// It was restarted locally.
    Restart,
    /// The master has reset the ESC by register 0x0040.
    EscReset,
}

/// A unit model on the slave stack: queries that the stack calls when it needs the answer, and actions that it
/// takes ([`Unit::take_action`]).
pub trait Unit {
    /// The object dictionary for CoE; none for a unit without a mailbox.
    fn objects(&mut self) -> Option<&mut dyn ObjectServer> {
        None
    }

    /// Number of bytes of a SyncManager of [`crate::DataLength::Mapped`] in the present mapping.
    fn mapped_bytes(&self, _sync_manager: SmIndex) -> u16 {
        0
    }

    /// The synchronisation mode that the master has set by an object; none: the first one of the description.
    fn sync_mode(&self) -> Option<SyncMode> {
        None
    }

    /// The master requests a state that must be checked: PRE-OP ([`Check::Mailbox`]), BOOT
    /// ([`Check::Bootstrap`]) or SAFE-OP ([`Check::ProcessData`]). `found` contains the findings of the stack,
    /// in the order of their priority; usually none. The unit adds its own findings and may replace the code of
    /// the stack by its own.
    ///
    /// # Errors
    /// The AL status code that the slave shows; the slave keeps its state.
    fn check_transition(
        &mut self,
        _now: Instant,
        _check: Check,
        found: &[AlStatusCode],
    ) -> Result<(), AlStatusCode> {
        found.first().map_or(Ok(()), |&code| Err(code))
    }

    /// The stack refuses a request that is not a transition, or leaves a state without a request, for this
    /// reason. Returns the AL status code that the slave shows, which is usually the same.
    fn al_error(&mut self, _now: Instant, code: AlStatusCode) -> AlStatusCode {
        code
    }

    /// The state machine has reached `state`.
    fn entered(&mut self, _now: Instant, _state: AlState) {}

    /// Time between two refreshes by the unit's own timer; none: the unit is refreshed at changes, and
    /// according to its synchronisation mode.
    fn refresh_period(&self) -> Option<Duration>;

    /// Moves data between the SyncManagers and the application.
    fn refresh(&mut self, now: Instant, exchange: Exchange<'_>);

    /// Takes the next action of the unit; none if there is none. The stack calls this at every poll, after a
    /// refresh and after a mailbox request.
    fn take_action(&mut self) -> Option<Action> {
        None
    }

    /// Explicit Device ID that the slave shows when AL control bit 5 requests it; none if it has none.
    fn explicit_device_id(&self) -> Option<u16> {
        None
    }

    /// Number of emergency messages since power-on for which the unit had no room.
    fn emergencies_lost(&self) -> u64 {
        0
    }

    /// The slave restarts, for the reason `start`. `sii_image` is the EEPROM, which is loaded immediately
    /// afterwards. The stack clears fault and station alias: a fault that persists must be an action again.
    /// Returns the AL status code for the master in INIT; none: no error.
    fn restart(&mut self, _now: Instant, _start: Start, _sii_image: &mut [u8]) -> Option<AlStatusCode> {
        None
    }

    /// The processor of the unit is running, and initializes the rest: half of the start-up time is over.
    fn initializing(&mut self, _now: Instant) {}

    /// The slave's power is switched off. It is restarted with [`Start::PowerOn`] when the power returns.
    fn power_off(&mut self, _now: Instant) {}
}

/// A line of different models holds `Box<dyn Unit>`.
impl<U: Unit + ?Sized> Unit for Box<U> {
    fn objects(&mut self) -> Option<&mut dyn ObjectServer> {
        (**self).objects()
    }

    fn mapped_bytes(&self, sync_manager: SmIndex) -> u16 {
        (**self).mapped_bytes(sync_manager)
    }

    fn sync_mode(&self) -> Option<SyncMode> {
        (**self).sync_mode()
    }

    fn check_transition(
        &mut self,
        now: Instant,
        check: Check,
        found: &[AlStatusCode],
    ) -> Result<(), AlStatusCode> {
        (**self).check_transition(now, check, found)
    }

    fn al_error(&mut self, now: Instant, code: AlStatusCode) -> AlStatusCode {
        (**self).al_error(now, code)
    }

    fn entered(&mut self, now: Instant, state: AlState) {
        (**self).entered(now, state);
    }

    fn refresh_period(&self) -> Option<Duration> {
        (**self).refresh_period()
    }

    fn refresh(&mut self, now: Instant, exchange: Exchange<'_>) {
        (**self).refresh(now, exchange);
    }

    fn take_action(&mut self) -> Option<Action> {
        (**self).take_action()
    }

    fn explicit_device_id(&self) -> Option<u16> {
        (**self).explicit_device_id()
    }

    fn emergencies_lost(&self) -> u64 {
        (**self).emergencies_lost()
    }

    fn restart(&mut self, now: Instant, start: Start, sii_image: &mut [u8]) -> Option<AlStatusCode> {
        (**self).restart(now, start, sii_image)
    }

    fn initializing(&mut self, now: Instant) {
        (**self).initializing(now);
    }

    fn power_off(&mut self, now: Instant) {
        (**self).power_off(now);
    }
}
