//! What a unit model brings: objects, process data, checks, and nothing of the protocol.

use objects::ObjectServer;
use time::{Duration, Instant};
use wire::{AlState, AlStatusCode};

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

/// One refresh: what the SyncManagers hold, for the unit to take and to fill.
pub struct Exchange<'a> {
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

/// A unit model on the slave stack.
pub trait Unit {
    /// The object dictionary behind CoE; none for a unit without a mailbox.
    fn objects(&mut self) -> Option<&mut dyn ObjectServer> {
        None
    }

    /// Lengths of the process data by the mapping that is set now.
    fn process_data(&self) -> ProcessDataAreas;

    /// The unit's own checks at PRE-OP to SAFE-OP, before the stack compares the SyncManagers with
    /// [`Unit::process_data`].
    ///
    /// # Errors
    /// The AL status code that the slave shows; it stays in PRE-OP.
    fn check_mapping(&mut self, _now: Instant) -> Result<(), AlStatusCode> {
        Ok(())
    }

    /// A fault that keeps the slave in INIT: every request for another state is refused with this AL status
    /// code, which is shown from power-on.
    fn fault(&self) -> Option<AlStatusCode> {
        None
    }

    /// The slave starts again, as after power-on. `sii_image` is the EEPROM, which is loaded right after.
    fn restart(&mut self, _now: Instant, _sii_image: &mut [u8]) {}

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
