//! Emergencies, event logs and the messages of the diagnosis history.

use crate::rows::{ConditionRow, OrderRow, PRE_OP, Steps, condition, order};

const EMERGENCIES: &str = r#"{ master = "write SDO 10F3:05 of unit 1 as 01 00" }"#;
const ALLOWED: &str = r#"{ expect = "object 10F3:05 of unit 1 is 01 00", within = "100ms" }"#;
const BROKEN: &str = r#"{ unit = "break IoCommunications of unit 1" }"#;
/// The cause persists, so that each reset reports the error again.
const AGAIN: &str = r#"{ unit = "reset the errors of unit 1" }"#;
const LATER: &str = r#"{ after = "50ms", line = "be quiet" }"#;
const INIT: &str = r#"{ master = "request INIT of unit 1" }"#;
const IN_INIT: &str = r#"{ expect = "unit 1 is in INIT", within = "10ms" }"#;
const RESTART: &str = r#"{ unit = "restart unit 1" }"#;
const LATER_RESTART: &str = r#"{ after = "1s", unit = "restart unit 1" }"#;

const ENABLED: Steps = &[PRE_OP, EMERGENCIES, ALLOWED, LATER];
const SENT: Steps = &[PRE_OP, EMERGENCIES, ALLOWED, BROKEN];
const SENT_TWICE: Steps = &[PRE_OP, EMERGENCIES, ALLOWED, BROKEN, LATER, AGAIN];
/// In INIT there is no mailbox.
const LOST: Steps = &[PRE_OP, EMERGENCIES, ALLOWED, INIT, IN_INIT, BROKEN, LATER];

const TWO_LOST: Steps = &[PRE_OP, EMERGENCIES, ALLOWED, INIT, IN_INIT, BROKEN, LATER, AGAIN, LATER];

pub(crate) fn orders() -> Vec<OrderRow> {
    vec![order(
        "read no emergencies",
        &[PRE_OP, EMERGENCIES, ALLOWED],
        // One is in the mailbox, 16 wait for it: of 21 four are lost.
        &[BROKEN, r#"{ unit = "reset the errors of unit 1", repeat = 20, every = "20ms" }"#],
        "4 emergencies of unit 1 are lost",
        "10ms",
    )]
}

pub(crate) fn conditions() -> Vec<ConditionRow> {
    [emergencies(), logs(), messages()].into_iter().flatten().collect()
}

fn emergencies() -> Vec<ConditionRow> {
    vec![
        condition("the master has received emergency 0xFF20 from unit 1", SENT, ENABLED, "50ms"),
        condition("the master has received emergency 0xFF20 2 times from unit 1", SENT_TWICE, SENT, "50ms"),
        condition(
            "the master has received emergency 0xFF20 from unit 1 with register 0x00",
            SENT,
            ENABLED,
            "50ms",
        ),
        condition(
            "the master has received emergency 0xFF20 from unit 1 with data 00 00 00 20 80",
            SENT,
            ENABLED,
            "50ms",
        ),
        condition(
            "the master has received emergency 0xFF20 from unit 1 with register 0x00 and data 00 00 00 20 80",
            SENT,
            ENABLED,
            "50ms",
        ),
        condition("no emergency of unit 1 is lost", SENT, LOST, "0s"),
        condition("one emergency of unit 1 is lost", LOST, SENT, "10ms"),
        condition("2 emergencies of unit 1 are lost", TWO_LOST, LOST, "10ms"),
    ]
}

fn logs() -> Vec<ConditionRow> {
    const TWICE: Steps = &[RESTART, LATER_RESTART];
    const BROKEN_TWICE: Steps = &[BROKEN, LATER, AGAIN];
    vec![
        condition("the system event log of unit 1 has 80200000", &[BROKEN], &[RESTART], "10ms"),
        condition("the system event log of unit 1 has 80200000 2 times", BROKEN_TWICE, &[BROKEN], "10ms"),
        condition("the system event log of unit 1 is empty", &[RESTART], &[BROKEN, LATER], "0s"),
        condition("the access event log of unit 1 has 94B80000", &[RESTART], &[BROKEN], "10ms"),
        condition("the access event log of unit 1 has 94B80000 2 times", TWICE, &[RESTART], "10ms"),
        condition("the access event log of unit 1 is empty", &[BROKEN, LATER], &[RESTART, LATER], "0s"),
    ]
}

fn messages() -> Vec<ConditionRow> {
    const OTHER: &str = r#"{ unit = "break MessageCommunications of unit 1" }"#;
    vec![
        condition(
            "diagnosis message 1 of unit 1 is 80200000",
            &[BROKEN, OTHER],
            &[OTHER, BROKEN, LATER],
            "10ms",
        ),
        condition(
            "the newest diagnosis message of unit 1 is 80200000",
            &[OTHER, BROKEN],
            &[BROKEN, OTHER, LATER],
            "10ms",
        ),
        condition(
            "diagnosis message 1 of unit 1 without its time begins with 00 E8 20 FF 12 00 20 80",
            &[BROKEN, LATER],
            &[OTHER, LATER],
            "10ms",
        ),
        condition("unit 1 has one diagnosis message", &[BROKEN, LATER], &[BROKEN, OTHER, LATER], "10ms"),
        condition("all units have one diagnosis message", &[BROKEN, LATER], &[BROKEN, OTHER, LATER], "10ms"),
        condition("unit 1 has 2 diagnosis messages", &[BROKEN, OTHER, LATER], &[BROKEN, LATER], "10ms"),
        condition("all units have 2 diagnosis messages", &[BROKEN, OTHER, LATER], &[BROKEN, LATER], "10ms"),
    ]
}
