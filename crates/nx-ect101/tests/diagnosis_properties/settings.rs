//! Settings of both sides, correct and not, with their events in the manual (5-3, 8-3-4).

use nx_ect101::{DataSetKind, Direction, IoAllocation, IoEntry, ObjectIndex, SubIndex};

/// An event with its attached information 1.
pub(crate) type Told = (u32, Option<u32>);

/// The settings of a master before it requests SAFE-OP, as the elements of the objects.
#[derive(Clone, Debug)]
pub(crate) struct PdoSetting {
    pub(crate) assigned_rx: Vec<u32>,
    pub(crate) assigned_tx: Vec<u32>,
    /// 1601.
    pub(crate) rx: Vec<u32>,
    /// 1A01.
    pub(crate) tx: Vec<u32>,
    /// The events that keep the unit in PRE-OP, in the order of the rules.
    pub(crate) broken: &'static [Told],
    /// Whether the sizes differ from the allocation of the CPU Unit: M to C, C to M.
    pub(crate) mismatch: [bool; 2],
}

impl PdoSetting {
    /// The position of New Messages Available in the inputs: the byte, in which it is bit 0.
    pub(crate) fn new_messages_at(&self) -> usize {
        2 + 30 * self.tx.len()
    }

    /// The position of Sysmac Error Status in the inputs; none if it is not assigned.
    pub(crate) fn error_status_at(&self) -> Option<usize> {
        self.assigned_tx.contains(&0x1BFF).then(|| self.new_messages_at() + 1)
    }
}

/// The first entries of a data set of 15 UINT.
fn arrays(index: u32, count: u32) -> Vec<u32> {
    (1..=count).map(|sub| index << 16 | sub << 8 | 0xF0).collect()
}

/// Everything correct, with all status.
fn right() -> PdoSetting {
    PdoSetting {
        assigned_rx: vec![0x1601],
        assigned_tx: vec![0x1A00, 0x1A01, 0x1BFE, 0x1BFF],
        rx: arrays(0x7000, 6),
        tx: arrays(0x6000, 6),
        broken: &[],
        mismatch: [false; 2],
    }
}

/// Every event of PRE-OP to SAFE-OP, alone and with others.
pub(crate) fn pdo_settings() -> Vec<PdoSetting> {
    let factory = PdoSetting { assigned_tx: vec![0x1A00, 0x1A01, 0x1BFE], ..right() };
    vec![
        right(),
        PdoSetting { rx: arrays(0x7000, 2), mismatch: [true, false], ..right() },
        PdoSetting { tx: arrays(0x6000, 2), mismatch: [false, true], ..factory.clone() },
        PdoSetting { rx: arrays(0x7000, 7), tx: arrays(0x6000, 1), mismatch: [true; 2], ..right() },
        PdoSetting { assigned_tx: vec![0x1A01], broken: &[(0x3509_0000, None)], ..right() },
        PdoSetting { assigned_rx: vec![0x1A01], broken: &[(0x350A_0000, None)], ..right() },
        PdoSetting { assigned_rx: vec![0x1601, 0x1601], broken: &[(0x392E_0000, None)], ..right() },
        PdoSetting { rx: vec![0x7000_02F0], broken: &[(0x3914_0000, Some(0x1601))], ..right() },
        PdoSetting { tx: vec![0x6000_01F0, 0x6001_0150], broken: &[(0x391F_0000, Some(0x1A01))], ..right() },
        // Two orders, an entry of another data set, one assignment: four at once.
        PdoSetting {
            assigned_tx: vec![0x1A01, 0x1A00],
            rx: vec![0x7000_02F0, 0x7001_0150],
            tx: vec![0x6000_03F0],
            broken: &[
                (0x392F_0000, None),
                (0x391E_0000, Some(0x1601)),
                (0x3914_0000, Some(0x1601)),
                (0x3915_0000, Some(0x1A01)),
            ],
            ..right()
        },
        PdoSetting {
            assigned_rx: vec![0x1601, 0x1603],
            rx: arrays(0x7000, 40),
            broken: &[(0x392C_0000, None)],
            ..factory
        },
        // It is refused for one direction and does not match in the other.
        PdoSetting {
            assigned_tx: vec![0x1A00, 0x1A01, 0x1A03, 0x1BFE],
            rx: arrays(0x7000, 1),
            tx: arrays(0x6000, 40),
            broken: &[(0x392D_0000, None)],
            mismatch: [true, false],
            ..right()
        },
    ]
}

/// The allocation of the CPU Unit.
#[derive(Clone, Debug)]
pub(crate) struct IoSetting {
    pub(crate) allocation: IoAllocation,
    /// The events that prevent the start of I/O refreshing, in the order of the rules.
    pub(crate) broken: &'static [Told],
    /// Whether a direction can be compared with the master's side: M to C, C to M.
    pub(crate) is_sound: [bool; 2],
}

/// Entries of 15 UINT in both directions.
fn allocate(m_to_c: &[(u16, u8)], c_to_m: &[(u16, u8)]) -> IoAllocation {
    let entries = |list: &[(u16, u8)]| {
        list.iter().map(|&(index, sub)| IoEntry { index: ObjectIndex(index), sub: SubIndex(sub) }).collect()
    };
    let mut allocation = IoAllocation::empty();
    allocation.allocate(Direction::MToC, DataSetKind::Uints, entries(m_to_c));
    allocation.allocate(Direction::CToM, DataSetKind::Uints, entries(c_to_m));
    allocation
}

/// The factory setting with more data than the unit can exchange.
fn too_much() -> IoAllocation {
    let mut allocation = IoAllocation::empty();
    for direction in Direction::ALL {
        allocation.select(direction, DataSetKind::Uints, 40);
        allocation.select(direction, DataSetKind::Udint, 1);
    }
    allocation
}

/// Every event of I/O entries, in both directions and in one.
pub(crate) fn io_settings() -> Vec<IoSetting> {
    let six = [1, 2, 3, 4, 5, 6].map(|sub| (0x7000, sub));
    vec![
        IoSetting { allocation: IoAllocation::factory(), broken: &[], is_sound: [true; 2] },
        IoSetting {
            allocation: allocate(&[(0x6000, 2)], &six),
            broken: &[(0x3919_0000, Some(0x1A01))],
            is_sound: [false, true],
        },
        IoSetting {
            allocation: allocate(&[(0x6001, 1), (0x6000, 3)], &[(0x7002, 1), (0x7000, 3)]),
            broken: &[
                (0x391B_0000, Some(0x1A01)),
                (0x391A_0000, Some(0x1601)),
                (0x3919_0000, Some(0x1A01)),
                (0x3913_0000, Some(0x1601)),
            ],
            is_sound: [false; 2],
        },
        IoSetting {
            allocation: too_much(),
            broken: &[(0x391D_0000, None), (0x391C_0000, None)],
            is_sound: [false; 2],
        },
    ]
}
