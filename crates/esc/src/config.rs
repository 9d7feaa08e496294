//! Configuration of an ESC: sizes, features, and the choices in which real controllers differ.

use time::Duration;

/// Configuration of one ESC. The default is an ESC of the ET1100 class with two MII ports.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EscConfig {
    /// FMMUs, 0 to 16.
    pub fmmu_count: u8,
    /// SyncManagers, 0 to 16.
    pub sync_manager_count: u8,
    /// Process data RAM in KiB, 1 to 60.
    pub ram_kib: u8,
    /// What is connected to ports 0 to 3, register 0x0007. Frames pass ports 0 and 1: ports 2 and 3 never have a cable.
    pub ports: [PortKind; 4],
    /// Whether distributed clocks exist (64 bits); without them there is no answer at 0x0900 to 0x09FF.
    pub distributed_clocks: bool,
    /// When an SII command is complete.
    pub sii: SiiTiming,
    /// Whether an enabled SyncManager accepts new settings.
    pub sync_manager_writes: SyncManagerWrites,
}

/// What is connected to a port.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PortKind {
    /// 00: there is no port.
    Missing,
    /// 01: the SII has not configured it.
    NotConfigured,
    /// 10: the next slave on the same backplane.
    Ebus,
    /// 11: a cable.
    Mii,
}

impl PortKind {
    /// The port descriptor of these ports, two bits each, port 0 in bits 1:0.
    pub(crate) fn descriptor(ports: [Self; 4]) -> u8 {
        ports.iter().rev().fold(0, |bits, &port| bits << 2 | port as u8)
    }
}

/// How long an SII command takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SiiTiming {
    /// Complete when the next frame arrives.
    Immediate,
    /// Busy for this long after the frame with the command, as a real EEPROM is (0.1 to 1 ms).
    Busy(Duration),
}

/// The effect of a write to start, length and control of a SyncManager while it is enabled. The bytes are
/// writable only while it is disabled (reference 2.13, C080); some stacks rewrite them nevertheless.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SyncManagerWrites {
    /// Ignored, as in an ET1100. A write that also disables the SyncManager sets them.
    OnlyWhileDisabled,
    /// Accepted; the buffers start again.
    Always,
}

impl Default for EscConfig {
    fn default() -> Self {
        Self {
            fmmu_count: 8,
            sync_manager_count: 8,
            ram_kib: 8,
            ports: [PortKind::Mii, PortKind::Mii, PortKind::Missing, PortKind::Missing],
            distributed_clocks: true,
            sii: SiiTiming::Immediate,
            sync_manager_writes: SyncManagerWrites::OnlyWhileDisabled,
        }
    }
}
