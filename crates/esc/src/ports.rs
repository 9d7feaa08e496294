//! Ports, links and loops; DL status, from which masters derive the topology (reference 1.8).

use crate::memory::Memory;
use crate::registers::at;

/// A port of an ESC. Frames are processed once: port 0 in, processing unit, ports 3, 1, 2, port 0 out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Port {
    /// Port 0, IN.
    In,
    /// Port 1, OUT.
    Out,
}

impl Port {
    const ALL: [Self; 2] = [Self::In, Self::Out];

    const fn number(self) -> u16 {
        match self {
            Self::In => 0,
            Self::Out => 1,
        }
    }

    /// DL status bits of this port: link, loop closed, communication.
    const fn link_bit(self) -> u16 {
        1 << (4 + self.number())
    }
    const fn closed_bit(self) -> u16 {
        1 << (8 + 2 * self.number())
    }
    const fn communication_bit(self) -> u16 {
        1 << (9 + 2 * self.number())
    }
}

/// The path of a frame at a port.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoopState {
    /// Out through the port.
    Open,
    /// To the next port inside the ESC.
    Closed,
}

/// Link and loop of one port.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PortStatus {
    /// A cable with a partner at its other end.
    pub link: bool,
    /// The path of a frame.
    pub loop_state: LoopState,
}

/// DL control, two bits per port.
const LOOP_AUTO_CLOSE: u32 = 1;
const LOOP_OPEN: u32 = 2;
const LOOP_CLOSED: u32 = 3;
/// Ports 2 and 3 do not exist: their loops are closed.
const MISSING_PORTS_CLOSED: u16 = 1 << 12 | 1 << 14;
const PDI_OPERATIONAL: u16 = 1 << 0;
const PDI_WATCHDOG_OK: u16 = 1 << 1;

/// The two ports of an ESC.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ports {
    status: [PortStatus; 2],
    /// In auto-close mode a loop that has no link, or lost it, remains closed until DL control is written while
    /// there is a link, or a valid frame arrives.
    latched_closed: [bool; 2],
}

impl Ports {
    pub(crate) const fn new() -> Self {
        const UNPLUGGED: PortStatus = PortStatus { link: false, loop_state: LoopState::Closed };
        Self { status: [UNPLUGGED; 2], latched_closed: [false; 2] }
    }

    pub(crate) const fn status(&self, port: Port) -> PortStatus {
        self.status[port.number() as usize]
    }

    /// A cable is plugged or pulled. Returns whether DL status has changed.
    pub(crate) fn set_link(&mut self, port: Port, link: bool, memory: &mut Memory) -> bool {
        let number = usize::from(port.number());
        let lost = self.status[number].link && !link;
        self.status[number].link = link;
        if lost {
            self.latched_closed[number] = true;
            let mode = loop_mode(memory, port);
            if mode != LOOP_OPEN && mode != LOOP_CLOSED {
                memory.count_up(at::LOST_LINKS + port.number());
            }
        }
        self.update(memory)
    }

    /// DL control has been written. Returns whether DL status has changed.
    pub(crate) fn dl_control_written(&mut self, memory: &mut Memory) -> bool {
        for port in Port::ALL {
            if loop_mode(memory, port) == LOOP_AUTO_CLOSE {
                self.latched_closed[usize::from(port.number())] = !self.status(port).link;
            }
        }
        self.update(memory)
    }

    /// A valid frame arrives at a closed port. Returns whether that opens its loop.
    pub(crate) fn frame_arrives(&mut self, port: Port, memory: &mut Memory) -> bool {
        if loop_mode(memory, port) != LOOP_AUTO_CLOSE || !self.status(port).link {
            return false;
        }
        self.latched_closed[usize::from(port.number())] = false;
        self.update(memory)
    }

    /// Recalculates loops and DL status.
    pub(crate) fn update(&mut self, memory: &mut Memory) -> bool {
        for port in Port::ALL {
            let number = usize::from(port.number());
            let link = self.status[number].link;
            let open = match loop_mode(memory, port) {
                LOOP_OPEN => true,
                LOOP_CLOSED => false,
                LOOP_AUTO_CLOSE => link && !self.latched_closed[number],
                _ => link,
            };
            self.status[number].loop_state = if open { LoopState::Open } else { LoopState::Closed };
        }
        let all_closed = self.status.iter().all(|port| port.loop_state == LoopState::Closed);
        if all_closed && self.status[0].link {
            // Port 0 opens if all ports are closed, so that the slave remains reachable.
            self.status[0].loop_state = LoopState::Open;
        }
        let before = memory.u16(at::DL_STATUS);
        let after = self.dl_status(before & (PDI_OPERATIONAL | PDI_WATCHDOG_OK));
        memory.set_u16(at::DL_STATUS, after);
        before != after
    }

    fn dl_status(&self, pdi: u16) -> u16 {
        Port::ALL.into_iter().fold(pdi | MISSING_PORTS_CLOSED, |bits, port| {
            let status = self.status(port);
            let closed = status.loop_state == LoopState::Closed;
            bits | if status.link { port.link_bit() } else { 0 }
                | if closed { port.closed_bit() } else { 0 }
                | if status.link && !closed { port.communication_bit() } else { 0 }
        })
    }
}

/// Sets the bit in DL status that the PDI is operational (SII loaded).
pub(crate) fn set_pdi_operational(memory: &mut Memory, operational: bool) {
    let status = memory.u16(at::DL_STATUS) & !(PDI_OPERATIONAL | PDI_WATCHDOG_OK);
    let pdi = if operational { PDI_OPERATIONAL | PDI_WATCHDOG_OK } else { 0 };
    memory.set_u16(at::DL_STATUS, status | pdi);
}

fn loop_mode(memory: &Memory, port: Port) -> u32 {
    memory.u32(at::DL_CONTROL) >> (8 + 2 * port.number()) & 3
}
