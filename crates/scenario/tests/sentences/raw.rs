//! Services in addition to plain SDOs, and what the master sends and reads as it is.

use crate::rows::{ConditionRow, IN_OP, IN_PRE_OP, OP, OrderRow, PRE_OP, Steps, condition, order};

const READY: Steps = &[PRE_OP, IN_PRE_OP];
const READ: &str = r#"{ master = "read register 0x0120 of unit 1" }"#;
const MESSAGE: &str =
    r#"{ master = "send unit 1 the mailbox message 0A 00 00 00 00 13 00 20 40 18 10 04 00 00 00 00" }"#;
/// The mailbox type is 15, which the unit does not have.
const WRONG_TYPE: &str = r#"{ master = "send unit 1 the mailbox message 02 00 00 00 00 1F 00 20" }"#;
const ANSWER: &str =
    "the last mailbox message was answered with 0A 00 00 00 00 13 00 30 43 18 10 04 01 00 00 00";
/// APRD of AL status of the first unit.
const FRAME: &str = r#"{ master = "send the frame FF FF FF FF FF FF 02 00 00 00 00 01 88 A4 0E 10 01 07 00 00 30 01 02 00 00 00 00 00 00 00" }"#;
const FRAME_BACK: &str = "the last frame came back as FF FF FF FF FF FF 02 00 00 00 00 01 88 A4 0E 10 01 07 01 00 30 01 02 00 00 00 01 00 01 00";
const DEAF: &str = r#"{ line = "unplug cable 1" }"#;
const LOST: &str = r#"{ line = "lose all frames" }"#;
const LATER: &str = r#"{ after = "20ms", cpu = "start the task of unit 1" }"#;

pub(crate) fn orders() -> Vec<OrderRow> {
    vec![
        order(
            "write SDO 10F3:05 of unit 1 in segments as 01 00",
            READY,
            &[],
            "object 10F3:05 of unit 1 is 01 00",
            "50ms",
        ),
        order(
            "write SDO 1C12:00 of unit 1 by complete access as 02 00 01 16 02 16",
            READY,
            &[],
            "object 1C12:00 of unit 1 is 02",
            "50ms",
        ),
        order(
            "read SDO 1018:00 of unit 1 by complete access",
            READY,
            &[],
            "the last SDO gave 04 00 83 00 00 00 7C 01 00 00 00 00 01 00 01 00 00 00",
            "50ms",
        ),
        order("read object list 5 of unit 1", READY, &[], "the last SDO gave F3 10", "50ms"),
        order(
            "read the description of object 0x1000 of unit 1",
            READY,
            &[],
            "the last SDO gave 00 10 07 00 00 07 44 65 76 69 63 65 20 54 79 70 65",
            "50ms",
        ),
        order(
            "read the description of entry 1000:00 of unit 1",
            READY,
            &[],
            "the last SDO gave 00 10 00 10 07 00 20 00 07 00 00 00 00 00 44 65 76 69 63 65 20 54 79 70 65",
            "50ms",
        ),
        order("read register 0x0130 of unit 1", READY, &[], "the last register read gave 02 00", "5ms"),
        order(
            "read 8 bytes from register 0x0800 of unit 1",
            READY,
            &[],
            "the last register read gave 00 10 90 01 26 30 01 00",
            "5ms",
        ),
        order(
            "send unit 1 the mailbox message 0A 00 00 00 00 13 00 20 40 18 10 04 00 00 00 00",
            READY,
            &[],
            ANSWER,
            "50ms",
        ),
        order(
            "send the frame FF FF FF FF FF FF 02 00 00 00 00 01 88 A4 0E 10 01 07 00 00 30 01 02 00 00 00 00 00 00 00",
            &[],
            &[],
            FRAME_BACK,
            "5ms",
        ),
    ]
}

pub(crate) fn conditions() -> Vec<ConditionRow> {
    vec![
        condition("the last register read gave 01 00", &[READ], &[PRE_OP, IN_PRE_OP, READ], "5ms"),
        condition(ANSWER, &[PRE_OP, IN_PRE_OP, MESSAGE], &[PRE_OP, IN_PRE_OP, WRONG_TYPE], "50ms"),
        condition(
            "the last mailbox message has no answer",
            &[PRE_OP, IN_PRE_OP, DEAF, MESSAGE],
            &[PRE_OP, IN_PRE_OP, MESSAGE],
            "6s",
        ),
        condition(FRAME_BACK, &[FRAME], &[PRE_OP, IN_PRE_OP, FRAME], "5ms"),
        condition("the last frame did not come back", &[LOST, FRAME], &[FRAME], "5ms"),
        condition(
            "the working counter of every datagram is as expected",
            &[OP, IN_OP, LATER],
            &[OP, IN_OP, r#"{ line = "lower the working counter of all process data frames" }"#, LATER],
            "0s",
        ),
    ]
}
