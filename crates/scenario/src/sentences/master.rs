//! Sentences of the scripted master.

use crate::orders::MasterOrder::{self, *};
use crate::sentence::Sentence;

const fn row(
    pattern: &'static str,
    example: &'static str,
    meaning: &'static str,
    build: fn(&crate::sentence::Values) -> MasterOrder,
) -> Sentence<MasterOrder> {
    Sentence { pattern, example, meaning, build }
}

/// All of them.
#[rustfmt::skip]
pub const MASTER: &[Sentence<MasterOrder>] = &[
    row("take {units} to {state}", "take all units to OP",
        "goes there as a real master does: SyncManagers, PDO settings, FMMUs, states; process data begin with SAFE-OP",
        |v| Take(v.units(0), v.state(1))),
    row("request {state} of {units}", "request OP of unit 1",
        "writes AL control once, whatever follows; a state may be skipped, or be a number that is none",
        |v| Request { state: v.state(0), units: v.units(1), acknowledge: false }),
    row("acknowledge and request {state} of {units}", "acknowledge and request PRE-OP of unit 1",
        "writes AL control once, with bit 4", |v| Request { state: v.state(0), units: v.units(1), acknowledge: true }),
    row("exchange process data every {period}", "exchange process data every 1ms",
        "sets the cycle; one frame for each unit, from SAFE-OP on", |v| Exchange(v.duration(0))),
    row("stop process data", "stop process data", "sends no process data until they are exchanged again",
        |_| StopExchange),
    row("set the outputs of {unit} to {bytes}", "set the outputs of unit 1 to 01 02 03",
        "output bytes from the first on; those behind stay", |v| SetOutputs(v.unit(0), 0, v.bytes(1))),
    row("set output byte {word} of {unit} to {bytes}", "set output byte 179 of unit 1 to 01",
        "output bytes from this one on, counted from 0", |v| SetOutputs(v.unit(1), v.number(0) as usize, v.bytes(2))),
    row("let {unit} map {word} as {entries}", "let unit 1 map 0x1601 as 7000:01..04",
        "entries of a PDO, written the next time that PRE-OP is passed",
        |v| Map(v.unit(0), v.number(1) as u16, v.entries(2))),
    row("let {unit} assign to {word} the PDOs {numbers}", "let unit 1 assign to 0x1C13 the PDOs 1A00 1A01 1BFE 1BFF",
        "PDO assignment, written the next time that PRE-OP is passed",
        |v| Assign(v.unit(0), v.number(1) as u16, v.numbers(2).into_iter().map(|pdo| pdo as u16).collect())),
    row("give SyncManager {channel} of {unit} {word} bytes", "give SyncManager 2 of unit 1 100 bytes",
        "a wrong length, from the next time on that it is set",
        |v| SyncManagerLength { number: v.number(0) as u8, unit: v.unit(1), length_bytes: v.number(2) as u16 }),
    row("give SyncManager {channel} of {unit} control {byte}", "give SyncManager 2 of unit 1 control 0x24",
        "a wrong control byte, from the next time on that it is set",
        |v| SyncManagerControl { number: v.number(0) as u8, unit: v.unit(1), control: v.number(2) as u8 }),
    row("write SDO {entry} of {unit} as {bytes}", "write SDO 2002:02 of unit 1 as 01",
        "an SDO download of as many bytes, little endian", |v| WriteSdo(v.unit(1), v.entry(0), v.bytes(2))),
    row("read SDO {entry} of {unit}", "read SDO 10F3:06 of unit 1", "an SDO upload",
        |v| ReadSdo(v.unit(1), v.entry(0))),
    row("write register {word} of {unit} as {bytes}", "write register 0x0981 of unit 1 as 01",
        "a write to the ESC", |v| WriteRegister(v.unit(1), v.number(0) as u16, v.bytes(2))),
    row("write register {word} of {unit} in two halves as {bytes}", "write register 0x13A0 of unit 1 in two halves as 01 02 03 04",
        "a split access: two frames, the first half and the second",
        |v| WriteInHalves(v.unit(1), v.number(0) as u16, v.bytes(2))),
    row("use mailbox counter {counter}", "use mailbox counter 3", "for every mailbox message from now on, instead of counting",
        |v| MailboxCounter(v.number(0) as u8)),
    row("read no mailbox", "read no mailbox", "lets the answers lie where they are", |_| ReadNoMailbox),
    row("behave", "behave", "does everything right again: mailbox counter, SyncManagers, mailboxes", |_| Behave),
    row("restart", "restart", "starts anew: forgets its orders and what it has set", |_| Restart),
];
