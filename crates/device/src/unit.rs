//! What a unit model brings: objects, process data, checks, and nothing of the protocol.

use objects::ObjectServer;
use time::{Duration, Instant};
use wire::{AlState, AlStatusCode, Emergency};

use crate::state_machine::Check;

/// Lengths in bytes of the process data that the mapping asks for. Zero: there is none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ProcessDataAreas {
    /// Outputs, master to slave (RxPDO).
    pub outputs_bytes: u16,
    /// Inputs, slave to master (TxPDO).
    pub inputs_bytes: u16,
}

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
    /// A state or a status has changed between two periods, and the master is to see it at once.
    Change,
}

/// One refresh: what the SyncManagers hold, for the unit to take and to fill.
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
    /// The inputs to fill, `inputs_bytes` long; empty below SAFE-OP. They hold older inputs on entry.
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

/// A unit model on the slave stack.
pub trait Unit {
    /// The object dictionary behind CoE; none for a unit without a mailbox.
    fn objects(&mut self) -> Option<&mut dyn ObjectServer> {
        None
    }

    /// Lengths of the process data by the mapping that is set now.
    fn process_data(&self) -> ProcessDataAreas;

    /// The master asks for a state that has to be checked: PRE-OP ([`Check::Mailbox`]) or SAFE-OP
    /// ([`Check::ProcessData`]). `found` is what the stack has against it, in the order in which the first one
    /// counts; mostly nothing. The unit adds its own and may name the stack's in its own terms.
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

    /// A fault that takes the slave to INIT and keeps it there: every request for another state is refused
    /// with this AL status code, which is shown as long as the fault stands. [`AlStatusCode::NO_ERROR`]
    /// refuses without an error indication.
    fn fault(&self) -> Option<AlStatusCode> {
        None
    }

    /// The slave starts again, for the reason `start`. `sii_image` is the EEPROM, which is loaded right after.
    /// The AL status code that the master finds in INIT; none: no error.
    fn restart(&mut self, _now: Instant, _start: Start, _sii_image: &mut [u8]) -> Option<AlStatusCode> {
        None
    }

    /// The processor of the unit runs, and initializes the rest: half of the start-up time is over.
    fn initializing(&mut self, _now: Instant) {}

    /// The slave loses its power. It is restarted with [`Start::PowerOn`] when it gets it back.
    fn power_off(&mut self, _now: Instant) {}

    /// Takes the oldest emergency message that the unit wants to send. Below PRE-OP it is lost.
    fn take_emergency(&mut self) -> Option<Emergency> {
        None
    }

    /// How many emergency messages the unit itself had no room for, since power-on.
    fn emergencies_lost(&self) -> u64 {
        0
    }

    /// The state machine has arrived in `state`.
    fn entered(&mut self, _now: Instant, _state: AlState) {}

    /// Time between two refreshes (Free-Run).
    fn refresh_period(&self) -> Duration;

    /// Moves data between the SyncManagers and the application.
    fn refresh(&mut self, now: Instant, exchange: Exchange<'_>);

    /// Whether a mailbox request has changed what a refresh tells, since the last call. The stack then
    /// refreshes at once, so that no status that the master reads is older than the response it has got.
    fn take_status_change(&mut self) -> bool {
        false
    }

    /// Explicit Device ID that the slave tells when AL control bit 5 asks; none when it has none.
    fn explicit_device_id(&self) -> Option<u16> {
        None
    }

    /// Station alias that the unit wants in register 0x0012; none leaves what the SII has loaded.
    fn station_alias(&self) -> Option<u16> {
        None
    }
}
