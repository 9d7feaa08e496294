//! What an ESC is built with: sizes, features, and the choices where real controllers differ.

use time::Duration;

/// Build of one ESC. The default is the ESC of the ET1100 class with two MII ports.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EscConfig {
    /// FMMUs, 0 to 16.
    pub fmmu_count: u8,
    /// SyncManagers, 0 to 16.
    pub sync_manager_count: u8,
    /// Process data RAM in KiB, 1 to 60.
    pub ram_kib: u8,
    /// What is behind ports 0 to 3, register 0x0007. Frames pass ports 0 and 1: a further one never has a cable.
    pub ports: [PortKind; 4],
    /// Whether distributed clocks exist (64 bits); without them 0x0900 to 0x09FF do not answer.
    pub distributed_clocks: bool,
    /// When an SII command is finished.
    pub sii: SiiTiming,
    /// Whether an enabled SyncManager takes new settings.
    pub sync_manager_writes: SyncManagerWrites,
}

/// What is behind a port.
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

/// How long the SII takes for a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SiiTiming {
    /// Finished when the next frame comes.
    Immediate,
    /// Busy for this long after the frame with the command, as a real EEPROM is (0.1 to 1 ms).
    Busy(Duration),
}

/// What a write to start, length and control of a SyncManager does while it is enabled. The bytes are
/// writable only while it is disabled (reference 2.13, C080); some stacks rewrite them all the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SyncManagerWrites {
    /// Ignored, as in an ET1100. A write that also disables the SyncManager sets them.
    OnlyWhileDisabled,
    /// Taken over; the buffers start anew.
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
