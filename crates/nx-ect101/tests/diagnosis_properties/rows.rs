//! The events again, written from the manual and not from the table of the code (8-3-3, 8-4-3, 8-5-2).

use nx_ect101::Fault;

/// Event level in a diagnosis message (A-6-4).
pub(crate) const INFORMATION: u16 = 0;
pub(crate) const OBSERVATION: u16 = 1;
pub(crate) const MINOR_FAULT: u16 = 2;

pub(crate) const MEMORY_BROKEN: u32 = 0x0020_0000;
pub(crate) const SM_EVENT_MODE: u32 = 0x3932_0000;
pub(crate) const MISMATCH_M_TO_C: u32 = 0x3917_0000;
pub(crate) const MISMATCH_C_TO_M: u32 = 0x3916_0000;
pub(crate) const MESSAGE_DISCARDED: u32 = 0x8022_0000;
pub(crate) const LOG_CLEARED: u32 = 0x9040_0000;
pub(crate) const RESTARTED: u32 = 0x94B8_0000;

/// Emergency error codes with their events (8-4-3). Events that are not listed are in no error log of object 10F3.
const EMERGENCY_CODES: [(u16, &[u32]); 21] = [
    (0x5540, &[0x1041_0000]),
    (0x5600, &[0x0945_0000]),
    (0x6140, &[0x0946_0000]),
    (0x6150, &[0x4020_0000]),
    (0x6350, &[0x391A_0000]),
    (0x6351, &[0x391B_0000]),
    (0x6352, &[0x3913_0000]),
    (0x6353, &[0x3919_0000]),
    (0x6354, &[0x391C_0000]),
    (0x6355, &[0x391D_0000]),
    (0xA000, &[0x3505_0000, 0x3506_0000, 0x3507_0000, 0x3509_0000, 0x350A_0000, 0x3518_0000]),
    (0xA000, &[0x3914_0000, 0x3915_0000, 0x391E_0000, 0x391F_0000, 0x392C_0000, 0x392D_0000]),
    (0xA000, &[0x392E_0000, 0x392F_0000, SM_EVENT_MODE, 0x3933_0000]),
    (0xFF00, &[LOG_CLEARED]),
    (0xFF10, &[0x350B_0000]),
    (0xFF11, &[0x350C_0000]),
    (0xFF12, &[0x3934_0000]),
    (0xFF13, &[0x8500_0000]),
    (0xFF20, &[0x8020_0000]),
    (0xFF21, &[0x8024_0000]),
    (0xFF22, &[MESSAGE_DISCARDED]),
];
/// The two whose level can be changed.
const MISMATCH_CODES: [(u16, u32); 2] = [(0xFF30, MISMATCH_M_TO_C), (0xFF31, MISMATCH_C_TO_M)];

/// The emergency error code; none if the error log of object 10F3 does not have the event.
pub(crate) fn emergency_code(event: u32) -> Option<u16> {
    let mismatch = MISMATCH_CODES.iter().find(|row| row.1 == event).map(|row| row.0);
    mismatch.or_else(|| EMERGENCY_CODES.iter().find(|row| row.1.contains(&event)).map(|row| row.0))
}

/// Whether an emergency message can report it: "Possible" (8-4-3).
pub(crate) fn can_be_notified(event: u32) -> bool {
    matches!(emergency_code(event), Some(0x5540 | 0x6350..=0x6355 | 0xFF20 | 0xFF30 | 0xFF31))
}

/// The level, unless a user has changed it (8-3-3).
pub(crate) fn level(event: u32) -> u16 {
    match event {
        LOG_CLEARED | RESTARTED => INFORMATION,
        MESSAGE_DISCARDED => OBSERVATION,
        _ => MINOR_FAULT,
    }
}

/// Recorded in the access event log (8-3-3, log category).
pub(crate) fn is_access_event(event: u32) -> bool {
    matches!(event, LOG_CLEARED | RESTARTED)
}

/// When a fault is found (8-3-4, detection timing).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Found {
    AtStart,
    AtOnce,
    /// By the check for it.
    ByCheck,
    /// At each injection, and it does not persist.
    Passing,
}

/// A fault, its event and how it is found; the AL status code of one that keeps the unit in INIT (0: none).
#[derive(Clone, Copy, Debug)]
pub(crate) struct FaultRow {
    pub(crate) fault: Fault,
    pub(crate) event: u32,
    pub(crate) found: Found,
    pub(crate) stops_in_init: Option<u16>,
}

const fn row(fault: Fault, event: u32, found: Found, stops_in_init: Option<u16>) -> FaultRow {
    FaultRow { fault, event, found, stops_in_init }
}

/// In the order of their priority.
pub(crate) const FAULTS: [FaultRow; 9] = [
    row(Fault::NonVolatileMemory, MEMORY_BROKEN, Found::AtStart, Some(0x0002)),
    row(Fault::Esc, 0x0945_0000, Found::AtStart, Some(0)),
    row(Fault::Processing, 0x4020_0000, Found::AtOnce, Some(0x0001)),
    row(Fault::ClockNotSynchronized, 0x8024_0000, Found::AtOnce, Some(0x8004)),
    row(Fault::SiiVerification, 0x0946_0000, Found::ByCheck, Some(0x0014)),
    row(Fault::ControlParameters, 0x1041_0000, Found::AtStart, None),
    row(Fault::IoCommunications, 0x8020_0000, Found::AtOnce, None),
    row(Fault::SmEventMode, SM_EVENT_MODE, Found::ByCheck, None),
    row(Fault::MessageCommunications, MESSAGE_DISCARDED, Found::Passing, None),
];

/// The row of a fault.
pub(crate) fn of_fault(fault: Fault) -> FaultRow {
    FAULTS.into_iter().find(|row| row.fault == fault).expect("every fault has a row")
}

/// The event of an AL status code that the stack finds, and the code for the master (8-5-2). The unit's list
/// has no code for a bootstrap that does not exist.
pub(crate) fn of_al_status_code(code: u16) -> (Option<u32>, u16) {
    let event = match code {
        0x0011 | 0x0013 => 0x350B_0000,
        0x0012 => 0x350C_0000,
        0x0016 => 0x3934_0000,
        0x001B => 0x8500_0000,
        0x001D => 0x3505_0000,
        0x001E => 0x3506_0000,
        0x001F => 0x3507_0000,
        0x0029 => 0x3933_0000,
        0x0030 => 0x3518_0000,
        _ => return (None, code),
    };
    (Some(event), if code == 0x0013 { 0x0011 } else { code })
}
