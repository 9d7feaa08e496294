//! What a unit model brings: objects, process data, checks, and nothing of the protocol.

use esc::SmIndex;
use objects::ObjectServer;
use time::{Duration, Instant};
use wire::{AlState, AlStatusCode};

use crate::action::Action;
use crate::state_machine::Check;
use crate::sync_mode::SyncMode;

/// The ports of the slave: whether the cable there has a partner at its other end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PortLinks {
    /// Port IN, towards the master.
    pub in_port: bool,
    /// Port OUT, towards the slaves behind.
    pub out_port: bool,
}

/// Why the stack calls the unit's refresh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RefreshCause {
    /// The period of the unit ([`Unit::refresh_period`]) is over.
    Period,
    /// The master has exchanged process data with a unit that follows them ([`SyncMode`]).
    SyncManager,
    /// A state or a status has changed between two periods, and the master is to see it at once.
    Change,
}

/// One refresh: what the SyncManagers hold, for the unit to take and to fill. Several SyncManagers of one direction
/// follow each other in the order of their numbers.
pub struct Exchange<'a> {
    /// Why it happens.
    pub cause: RefreshCause,
    /// State of the EtherCAT state machine at this refresh.
    pub state: AlState,
    /// The links at the ports.
    pub links: PortLinks,
    /// The newest whole outputs; none unless the slave is in OP, the master has sent outputs since it
    /// entered SAFE-OP, and the process data watchdog is alive.
    pub outputs: Option<&'a [u8]>,
    /// The inputs to fill, as long as the mapping makes them; empty below SAFE-OP. They hold older inputs on entry.
    pub inputs: &'a mut [u8],
}

/// Why a slave starts again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// Its power was cycled.
    PowerOn,
    /// Someone restarted it, locally.
    Restart,
    /// The master has reset the ESC by register 0x0040.
    EscReset,
}

/// A unit model on the slave stack: queries that the stack asks when it needs the answer, and actions that it takes
/// ([`Unit::take_action`]).
pub trait Unit {
    /// The object dictionary behind CoE; none for a unit without a mailbox.
    fn objects(&mut self) -> Option<&mut dyn ObjectServer> {
        None
    }

    /// How many bytes the mapping that is set now gives to a SyncManager of [`crate::DataLength::Mapped`].
    fn mapped_bytes(&self, _sync_manager: SmIndex) -> u16 {
        0
    }

    /// The synchronisation mode that the master has set by an object; none: the first one of the description.
    fn sync_mode(&self) -> Option<SyncMode> {
        None
    }

    /// The master asks for a state that has to be checked: PRE-OP ([`Check::Mailbox`]), BOOT
    /// ([`Check::Bootstrap`]) or SAFE-OP ([`Check::ProcessData`]). `found` is what the stack has against it, in the
    /// order in which the first one counts; mostly nothing. The unit adds its own and may name the stack's in its
    /// own terms.
    ///
    /// # Errors
    /// The AL status code that the slave shows; it keeps its state.
    fn check_transition(
        &mut self,
        _now: Instant,
        _check: Check,
        found: &[AlStatusCode],
    ) -> Result<(), AlStatusCode> {
        found.first().map_or(Ok(()), |&code| Err(code))
    }

    /// The stack refuses a request that is no transition, or leaves a state on its own, for this reason. The
    /// AL status code that the slave shows, which is mostly the same.
    fn al_error(&mut self, _now: Instant, code: AlStatusCode) -> AlStatusCode {
        code
    }

    /// The state machine has arrived in `state`.
    fn entered(&mut self, _now: Instant, _state: AlState) {}

    /// Time between two refreshes by the unit's own timer; none: it is refreshed at changes, and as its
    /// synchronisation mode says.
    fn refresh_period(&self) -> Option<Duration>;

    /// Moves data between the SyncManagers and the application.
    fn refresh(&mut self, now: Instant, exchange: Exchange<'_>);

    /// Takes the next thing that the unit wants; none if it wants nothing. The stack asks with every poll, after a
    /// refresh and after a mailbox request.
    fn take_action(&mut self) -> Option<Action> {
        None
    }

    /// Explicit Device ID that the slave shows when AL control bit 5 asks; none when it has none.
    fn explicit_device_id(&self) -> Option<u16> {
        None
    }

    /// How many emergency messages the unit itself had no room for, since power-on.
    fn emergencies_lost(&self) -> u64 {
        0
    }

    /// The slave starts again, for the reason `start`. `sii_image` is the EEPROM, which is loaded right after. The
    /// stack forgets fault and station alias: what persists is an action again. The AL status code that the master
    /// finds in INIT; none: no error.
    fn restart(&mut self, _now: Instant, _start: Start, _sii_image: &mut [u8]) -> Option<AlStatusCode> {
        None
    }

    /// The processor of the unit runs, and initializes the rest: half of the start-up time is over.
    fn initializing(&mut self, _now: Instant) {}

    /// The slave loses its power. It is restarted with [`Start::PowerOn`] when it gets it back.
    fn power_off(&mut self, _now: Instant) {}
}

/// A line of many models holds `Box<dyn Unit>`.
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
