//! Sentences of hands on a unit, and of its faults.

use nx_ect101::EventLog;

use crate::orders::UnitOrder::{self, *};
use crate::sentence::{Sentence, row};

/// All of them.
#[rustfmt::skip]
pub const UNIT: &[Sentence<UnitOrder>] = &[
    row("restart {units}", "restart unit 1", "restart by support software: NX Unit Restart (94B80000)",
        |v| Restart(v.units(0))),
    row("cycle the power of {units}", "cycle the power of all units", "off, and on at once; the non-volatile memory stays",
        |v| CyclePower(v.units(0))),
    row("power off {units}", "power off unit 1", "no frame passes it any more", |v| PowerOff(v.units(0))),
    row("power on {units}", "power on unit 1", "the unit starts; the non-volatile memory stays", |v| PowerOn(v.units(0))),
    row("reset the errors of {units}", "reset the errors of unit 1", "from the side of the CPU Unit (manual, 8-6)",
        |v| ResetErrors(v.units(0))),
    row("clear the system event log of {units}", "clear the system event log of unit 1",
        "from the side of the CPU Unit: Event Log Cleared (90400000)", |v| ClearLog(v.units(0), EventLog::System)),
    row("clear the access event log of {units}", "clear the access event log of unit 1",
        "from the side of the CPU Unit: Event Log Cleared (90400000)", |v| ClearLog(v.units(0), EventLog::Access)),
    row("turn the ID switch of {unit} to {byte}", "turn the ID switch of unit 1 to 0x2A",
        "in force when the unit starts", |v| SetIdSwitch(v.unit(0), v.number(1) as u8)),
    row("spoil word {word} of the SII of {unit}", "spoil word 7 of the SII of unit 1",
        "flips its bits in the EEPROM; what is loaded at power-on counts from then on", |v| SpoilSii(v.unit(1), v.number(0) as u16)),
    row("break {fault} of {units}", "break Processing of unit 1", "the cause of a fault appears",
        |v| Inject(v.units(1), v.fault(0))),
    row("mend {fault} of {units}", "mend Processing of unit 1",
        "the cause of a fault disappears; what it has done stays until its recovery", |v| Remove(v.units(1), v.fault(0))),
];
