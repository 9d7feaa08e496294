//! Sentences of hands on a unit, and of its faults.

use nx_ect101::EventLog;

use crate::model::ConductOrder as Slave;
use crate::model::UnitOrder::{self, *};
use crate::words::sentence::{Sentence, row};

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
    row("erase the SII of {units}", "erase the SII of unit 1",
        "every byte of the EEPROM is FF; a master reads it at once, the unit finds it at its next start", |v| EraseSii(v.units(0))),
    row("let every transition of {units} take {duration}", "let every transition of unit 1 take 500ms",
        "a request waits in AL control: AL status stays, and a further write counts 0",
        |v| Conduct(v.units(0), Slave::EveryTransition(v.duration(1)))),
    row("let transition {transition} of {units} take {duration}", "let transition IP of unit 1 take 500ms",
        "the same, of one transition", |v| Conduct(v.units(1), Slave::Transition(v.transition(0), v.duration(2)))),
    row("let each SII command of {units} take {duration}", "let each SII command of unit 1 take 5ms",
        "the SII interface is busy after each command", |v| Conduct(v.units(0), Slave::SiiTime(v.duration(1)))),
    row("keep the SII of {units} busy for {duration}", "keep the SII of unit 1 busy for 100ms",
        "from now on, once; commands are ignored until then", |v| Conduct(v.units(0), Slave::SiiBusy(v.duration(1)))),
    row("let the SDOs of {units} take {duration}", "let the SDOs of unit 1 take 300ms",
        "from a request to its response", |v| Conduct(v.units(0), Slave::SdoTime(v.duration(1)))),
    row("let {units} refuse {state} with AL status code {word}", "let unit 1 refuse SAFE-OP with AL status code 0x0024",
        "every request for this state; no event is recorded",
        |v| Conduct(v.units(0), Slave::Refuse(v.state(1), v.number(2) as u16))),
    row("let {units} ignore acknowledges", "let unit 1 ignore acknowledges",
        "while it shows an error, a request with bit 4 does nothing", |v| Conduct(v.units(0), Slave::IgnoreAcknowledge)),
    row("let {units} behave", "let unit 1 behave",
        "times and refusals are those of its unit file again; an erased SII stays erased", |v| Conduct(v.units(0), Slave::Behave)),
    row("break {fault} of {units}", "break Processing of unit 1", "the cause of a fault appears",
        |v| Inject(v.units(1), v.fault(0))),
    row("mend {fault} of {units}", "mend Processing of unit 1",
        "the cause of a fault disappears; what it has done stays until its recovery", |v| Remove(v.units(1), v.fault(0))),
];
