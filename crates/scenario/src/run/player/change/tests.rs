//! The table, in sentences.

use super::ends;
use crate::model::{CpuOrder, LineOrder, MasterOrder, Order, UnitOrder};
use crate::words::Spoken;

fn order(text: &str) -> Order {
    let (kind, text) = text.split_once(": ").unwrap_or_else(|| panic!("{text}"));
    match kind {
        "master" => Order::Master(said::<MasterOrder>(text)),
        "unit" => Order::Unit(said::<UnitOrder>(text)),
        "cpu" => Order::Cpu(said::<CpuOrder>(text)),
        "line" => Order::Line(said::<LineOrder>(text)),
        _ => panic!("{kind}"),
    }
}

fn said<T: Spoken>(text: &str) -> T {
    T::from_sentence(text).unwrap_or_else(|problem| panic!("{text}: {}", problem.message))
}

/// An order, conditions that it ends, and conditions that it does not end.
type Row = (&'static str, &'static [&'static str], &'static [&'static str]);

const STATES: &[Row] = &[
    (
        "master: request SAFE-OP of unit 1",
        &[
            "unit 1 is in OP",
            "all units are in OP",
            "units 1 and 3 are in OP",
            "not (unit 1 is in SAFE-OP)",
            "RUN of unit 1 is lit",
            "not (RUN of unit 1 is single_flash)",
            "the data of unit 1 is valid",
            "the data M to C of unit 1 is valid",
            "all of (unit 1 has no error; unit 1 is in OP)",
            "any of (unit 1 is in OP; unit 1 is in PRE-OP)",
        ],
        &[
            "unit 2 is in OP",
            "unit 1 is in SAFE-OP",
            "unit 1 is in SAFE-OP with AL status code 0x001B",
            "not (all units are in SAFE-OP)",
            "RUN of unit 1 is single_flash",
            "ERR of unit 1 is lit",
            "the data of unit 1 is not valid",
            "the data C to M of unit 1 is valid",
            "any of (unit 1 is in OP; unit 2 is in OP)",
            "not (unit 1 is in OP)",
            "unit 1 has no error",
            "the master has nothing to do",
        ],
    ),
    (
        "master: take all units to OP",
        &["not (all units are in OP)", "not (unit 2 is in OP)", "the data M to C of unit 1 is not valid"],
        &["all units are in OP", "the data C to M of unit 1 is not valid", "the data of unit 1 is valid"],
    ),
    (
        "master: acknowledge and request SAFE-OP of unit 1",
        &["unit 1 is in SAFE-OP with AL status code 0x001B"],
        &["unit 1 is in SAFE-OP"],
    ),
    ("master: write register 0x0120 of unit 1 as 04 00", &["unit 1 is in OP"], &["unit 1 is in SAFE-OP"]),
    ("master: write register 0x0130 of unit 1 as 04 00", &[], &["unit 1 is in OP"]),
];

const PROCESS_DATA: &[Row] = &[
    (
        "master: stop process data",
        &[
            "unit 2 is in OP",
            "RUN of unit 1 is lit",
            "the data of unit 1 is valid",
            "the working counter of unit 1 is 3",
            "the working counter of unit 1 is at least 1",
            "the working counter of unit 1 is not 0",
            "the working counter of every datagram is as expected",
        ],
        &[
            "unit 1 is in SAFE-OP",
            "unit 1 is in SAFE-OP with AL status code 0x001B",
            "RUN of unit 1 is single_flash",
            "the data C to M of unit 1 is valid",
            "the data M to C of unit 1 is not valid",
            "the working counter of unit 1 is 0",
            "the working counter of unit 1 is at most 2",
            "the outputs of unit 1 begin with 01",
            "10 cycles are done",
        ],
    ),
    ("master: restart", &["unit 1 is in OP"], &["unit 1 is in SAFE-OP"]),
    ("master: exchange process data every 1ms", &[], &["unit 1 is in SAFE-OP", "unit 1 is in OP"]),
    (
        "line: unplug cable 2",
        &["unit 2 is in OP", "unit 5 is in OP", "all units are in OP", "the working counter of unit 2 is 3"],
        &["unit 1 is in OP", "the working counter of unit 1 is 3", "unit 2 is in PRE-OP"],
    ),
    ("unit: power off units 2 and 4", &["unit 3 is in OP"], &["unit 1 is in OP"]),
    ("cpu: power off the CPU Rack of unit 2", &["unit 3 is in OP"], &["unit 1 is in OP"]),
    ("line: plug cable 2", &["the working counter of unit 3 is 0"], &["the working counter of unit 1 is 0"]),
    (
        "unit: power on unit 2",
        &["the working counter of unit 3 is 0"],
        &["the working counter of unit 1 is 0"],
    ),
    (
        "line: lose all process data frames",
        &[
            "unit 1 is in OP",
            "the working counter of unit 1 is 3",
            "not (the data M to C of unit 1 is not valid)",
        ],
        &["unit 1 is in PRE-OP"],
    ),
    ("line: lose all frames of unit 2", &["unit 2 is in OP"], &["unit 1 is in OP"]),
    (
        "line: lose the next 3 process data frames",
        &["the working counter of every datagram is as expected"],
        &["unit 1 is in OP"],
    ),
    ("line: lose the next 3 frames", &[], &["the working counter of every datagram is as expected"]),
    ("line: lose all mailbox frames", &[], &["unit 1 is in OP"]),
    ("line: lose 50 % of the process data frames", &[], &["unit 1 is in OP"]),
    ("line: lose the answers of all frames", &["the working counter of unit 1 is 3"], &["unit 1 is in OP"]),
    (
        "line: lower the working counter of all process data frames of unit 2",
        &["the working counter of unit 2 is 3", "the working counter of every datagram is as expected"],
        &["the working counter of unit 1 is 3", "unit 2 is in OP"],
    ),
    ("line: corrupt all frames on cable 2", &["unit 2 is in OP"], &["unit 1 is in OP"]),
    ("line: delay all frames by 1ms", &[], &["unit 1 is in OP"]),
    ("line: be quiet", &[], &["unit 1 is in OP", "the working counter of unit 1 is 3"]),
];

const BYTES: &[Row] = &[
    (
        "master: write register 0x0310 of unit 1 as 05 06",
        &[
            "register 0x0310 of unit 1 is 00",
            "register 0x0311 of unit 1 is 05",
            "not (register 0x0310 of unit 1 is 05)",
            "register 0x0310 of unit 1 is below 5",
            "register 0x0310 of unit 1 is not 05",
            "register 0x0310 of unit 1 has no bits 0x04",
        ],
        &[
            "register 0x0310 of unit 1 is 05",
            "register 0x0310 of unit 2 is 00",
            "register 0x0312 of unit 1 is 00",
            "register 0x0310 of unit 1 is at most 5",
            "register 0x0310 of unit 1 changes",
            "register 0x0310 of unit 1 is not 06",
        ],
    ),
    (
        "master: write SDO 2002:02 of unit 1 as 01",
        &[
            "object 2002:02 of unit 1 is 00",
            "object 2002:02 of unit 1 is at most 0",
            "object 2002:02 of unit 1 is not 01",
        ],
        &[
            "object 2002:02 of unit 1 is 01",
            "object 2002:02 of unit 1 is above 0",
            "object 2002:01 of unit 1 is 00",
        ],
    ),
    ("master: write SDO 2002:02 of unit 1 as FF", &[], &["object 2002:02 of unit 1 is below 0"]),
    (
        "master: write SDO 1C12:00 of unit 1 by complete access as 01 00 01 16",
        &["object 1C12:00 of unit 1 is 00", "object 1C12:01 of unit 1 is 00 16"],
        &[
            "object 1C12:00 of unit 1 is 01",
            "object 1C12:01 of unit 1 is 01 16",
            "object 1C13:01 of unit 1 is 00 16",
        ],
    ),
    (
        "master: set output byte 2 of unit 1 to 2A",
        &[
            "output byte 2 of unit 1 is 00",
            "output byte 2 of unit 1 is below 42",
            "not (output byte 2 of unit 1 is 2A)",
        ],
        &[
            "output byte 1 of unit 1 is 00",
            "output byte 2 of unit 1 is at least 42",
            "input byte 2 of unit 1 is 00",
        ],
    ),
];

const HEALTH: &[Row] = &[
    (
        "unit: break Processing of unit 1",
        &[
            "unit 1 has no error",
            "unit 1 has recorded nothing",
            "unit 1 has no new messages",
            "the system event log of unit 1 is empty",
            "the CPU Unit of unit 1 sees no error",
        ],
        &[
            "unit 2 has no error",
            "unit 1 has the error 40200000",
            "unit 1 has new messages",
            "the access event log of unit 1 is empty",
            "unit 1 has recorded 85000000",
        ],
    ),
    ("unit: repair Processing of unit 1", &[], &["unit 1 has the error 40200000", "unit 1 has no error"]),
    (
        "cpu: stop I/O refreshing of unit 1",
        &["the I/O data of unit 1 is active", "the data C to M of unit 1 is valid", "unit 1 has no error"],
        &["the I/O data of unit 1 is not active", "the data of unit 1 is not valid", "unit 1 is in OP"],
    ),
    (
        "cpu: stop the task of unit 1",
        &["the data of unit 1 is valid", "unit 1 has recorded nothing"],
        &["the I/O data of unit 1 is active", "the I/O data of unit 1 is not active"],
    ),
    (
        "cpu: start I/O refreshing of unit 1",
        &["the I/O data of unit 1 is not active"],
        &["the I/O data of unit 1 is active", "unit 1 has the error 80200000"],
    ),
    ("unit: restart unit 1", &[], &["unit 1 is in OP", "unit 1 has no error"]),
];

#[test]
fn each_order_ends_what_it_is_about_and_nothing_else() {
    let rows = [STATES, PROCESS_DATA, BYTES, HEALTH].concat();
    let mut wrong = Vec::new();
    for (text, ended, kept) in rows {
        let order = order(text);
        let each = ended.iter().map(|text| (text, true)).chain(kept.iter().map(|text| (text, false)));
        for (condition, expected) in each {
            if ends(&order, &said(condition)) != expected {
                wrong.push(format!("`{text}`, `{condition}`: expected {expected}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
