//! Sentences of what a master has done: the place `{act}` of conditions.

use crate::model::MasterAct::{self, *};
use crate::words::sentence::{Sentence, row};

/// All of them.
#[rustfmt::skip]
pub const ACTS: &[Sentence<MasterAct>] = &[
    row!("read SDO {entry} of {unit}", "read SDO 1018:04 of unit 1",
        "an SDO upload that the unit has answered with a value; one by complete access is an act on each entry of the object",
        |entry, unit| ReadSdo { unit, entry }),
    row!("written SDO {entry} of {unit}", "written SDO 2002:02 of unit 1",
        "an SDO download that the unit has taken; one by complete access is an act on each entry of the object",
        |entry, unit| WriteSdo { unit, entry, value: None }),
    row!("written {first-bytes} to SDO {entry} of {unit}", "written 01 to SDO 2002:02 of unit 1",
        "the same with exactly this value, of at most eight bytes, little endian; not by complete access",
        |value, entry, unit| WriteSdo { unit, entry, value: Some(value) }),
    row!("read register {word} of {unit}", "read register 0x0130 of unit 1",
        "a frame with a datagram that reads this byte of the ESC, addressed to the unit or to all of them",
        |register, unit| ReadRegister { unit, register }),
    row!("written register {word} of {unit}", "written register 0x0420 of unit 1",
        "a frame with a datagram that writes this byte of the ESC, addressed to the unit or to all of them",
        |register, unit| WriteRegister { unit, register, bytes: None }),
    row!("written {first-bytes} to register {word} of {unit}", "written E8 03 to register 0x0420 of unit 1",
        "the same with these bytes from this register on, in one datagram",
        |bytes, register, unit| WriteRegister { unit, register, bytes: Some(bytes) }),
    row!("read SII word {word} of {unit}", "read SII word 0x0008 of unit 1",
        "the read command for this word of the EEPROM, or for the word before it: one command reads two words",
        |word, unit| ReadSiiWord { unit, word }),
    row!("requested {state} of {unit}", "requested OP of unit 1",
        "a write to AL control with this state, with or without an acknowledge",
        |state, unit| RequestState { unit, state }),
    row!("acknowledged the error of {unit}", "acknowledged the error of unit 1",
        "a write to AL control with bit 4, while the unit shows the error indication",
        |unit| AcknowledgeError { unit }),
    row!("sent outputs to {unit}", "sent outputs to unit 1",
        "a frame with output data of the unit, in SAFE-OP or OP",
        |unit| SendOutputs { unit }),
    row!("sent a wrong mailbox counter to {unit}", "sent a wrong mailbox counter to unit 1",
        "a mailbox message, as the master sends it, whose counter is not the one after that of the message before, 1 after 7; only a message without an answer may come again, with its counter",
        |unit| MiscountMailbox { unit }),
];
