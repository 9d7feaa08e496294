//! Sentences of what has a value: the place `{quantity}` of conditions.

use crate::model::Quantity::{self, *};
use crate::words::sentence::{Sentence, row};
use crate::words::tables::act::ACTS;

/// All of them.
#[rustfmt::skip]
pub const QUANTITIES: &[Sentence<Quantity>] = &[
    row!("object {entry} of {unit}", "object 10F3:02 of unit 1",
        "the value in the dictionary, without an SDO; a number by its data type, little endian",
        |entry, unit| Object { unit, entry }),
    row!("register {word} of {unit}", "register 0x0300 of unit 1",
        "from this address to the end of the register, at most 8 bytes; one byte of the RAM; little endian, without a sign",
        |register, unit| Register { unit, register }),
    row!("output byte {word} of {unit}", "output byte 2 of unit 1",
        "as its CPU Unit has it, counted from 0; without a sign",
        |at, unit| OutputByte { unit, at }),
    row!("input byte {word} of {unit}", "input byte 2 of unit 1",
        "as the master has it, counted from 0; without a sign",
        |at, unit| InputByte { unit, at }),
    row!("variable {variable}", "variable N1_UINTs_01_M_to_C[3]",
        "a device variable, or an element of it; a number or a time by its type, little endian",
        |variable| Variable { variable }),
    row!("program variable {name} of {controller}", "program variable Scans of unit 1",
        "a variable that the user program in Structured Text declares",
        |name, controller| ProgramVariable { controller, name }),
    row!("the working counter of {unit}", "the working counter of unit 1",
        "of its process data in the last cycle; none if they have not returned, or are not exchanged",
        |unit| WorkingCounter { unit }),
    row!("the number of records of {event} by {unit}", "the number of records of 85000000 by unit 1",
        "how often the unit has recorded the event since it was switched on",
        |event, unit| Records { unit, event }),
    Sentence { acts: ACTS, ..row!("the number of times the master has {act}", "the number of times the master has read SDO 1018:04 of unit 1",
        "how often it has done so since the beginning",
        |act| Acts { act }) },
    row!("the mean period of the process data of {unit}", "the mean period of the process data of unit 1",
        "a time: the mean of the last 100 periods from frame to frame with process data of the unit; it has no value before there are as many, and a master that stops makes it longer",
        |unit| MeanPeriod { unit }),
    row!("the longest period of the process data of {unit}", "the longest period of the process data of unit 1",
        "a time: the longest of the last 100 periods, the present one included",
        |unit| LongestPeriod { unit }),
    row!("the number of emergencies", "the number of emergencies",
        "that the master has received, from any unit",
        || Emergencies { code: None }),
    row!("the number of emergencies {word}", "the number of emergencies 0xFF30",
        "with this error code",
        |code| Emergencies { code: Some(code) }),
    row!("the number of cycles", "the number of cycles",
        "process data sent, counted from the beginning",
        || Cycles),
];
