//! What the master has done: each act is seen, and is not seen without it.

use crate::rows::{ConditionRow, IN_OP, IN_PRE_OP, OP, PRE_OP, condition};

const SERIAL: &str = r#"{ master = "read SDO 1018:04 of unit 1" }"#;
const NO_OBJECT: &str = r#"{ master = "read SDO 9999:00 of unit 1" }"#;
const REFUSED: &str = r#"{ master = "request OP of unit 1" }"#;
const SHOWN: &str = r#"{ expect = "unit 1 is in INIT with AL status code 0x0011", within = "20ms" }"#;
const TWO_MS: &str = r#"{ master = "exchange process data every 2ms" }"#;

/// One row for each act, in the order of the table.
pub(crate) fn acts() -> Vec<ConditionRow> {
    vec![
        condition(
            "the master has read SDO 1018:04 of unit 1",
            &[PRE_OP, IN_PRE_OP, SERIAL],
            &[PRE_OP, IN_PRE_OP, NO_OBJECT],
            "20ms",
        ),
        condition(
            "the master has written SDO 10F3:05 of unit 1",
            &[PRE_OP, IN_PRE_OP, r#"{ master = "write SDO 10F3:05 of unit 1 as 01 00" }"#],
            &[PRE_OP, IN_PRE_OP, r#"{ master = "read SDO 10F3:05 of unit 1" }"#],
            "20ms",
        ),
        condition(
            "the master has written 01 00 to SDO 10F3:05 of unit 1",
            &[PRE_OP, IN_PRE_OP, r#"{ master = "write SDO 10F3:05 of unit 1 as 01 00" }"#],
            &[PRE_OP, IN_PRE_OP, r#"{ master = "write SDO 10F3:05 of unit 1 as 00 00" }"#],
            "20ms",
        ),
        condition(
            "the master has read register 0x0301 of unit 1",
            &[r#"{ master = "read 2 bytes from register 0x0300 of unit 1" }"#],
            &[r#"{ master = "read register 0x0302 of unit 1" }"#],
            "5ms",
        ),
        condition(
            "the master has written register 0x0421 of unit 1",
            &[r#"{ master = "write register 0x0420 of unit 1 as E8 03" }"#],
            &[r#"{ master = "read 2 bytes from register 0x0420 of unit 1" }"#],
            "5ms",
        ),
        condition(
            "the master has written E8 03 to register 0x0420 of unit 1",
            &[r#"{ master = "write register 0x0420 of unit 1 as E8 03" }"#],
            &[r#"{ master = "write register 0x0420 of unit 1 as E8 04" }"#],
            "5ms",
        ),
        condition(
            "the master has read SII word 0x0009 of unit 1",
            &[r#"{ master = "write register 0x0502 of unit 1 as 00 01 08 00 00 00" }"#],
            &[r#"{ master = "write register 0x0502 of unit 1 as 00 01 0A 00 00 00" }"#],
            "5ms",
        ),
        condition("the master has requested OP of unit 1", &[OP], &[PRE_OP], "100ms"),
        condition(
            "the master has acknowledged the error of unit 1",
            &[REFUSED, SHOWN, r#"{ master = "acknowledge and request INIT of unit 1" }"#],
            &[r#"{ master = "acknowledge and request INIT of unit 1" }"#, REFUSED, SHOWN, PRE_OP_WITHOUT],
            "20ms",
        ),
        condition("the master has sent outputs to unit 1", &[OP], &[PRE_OP], "100ms"),
        condition(
            "the master has sent a wrong mailbox counter to unit 1",
            &[PRE_OP, IN_PRE_OP, SERIAL, r#"{ master = "use mailbox counter 5" }"#, NO_OBJECT, SERIAL],
            &[PRE_OP, IN_PRE_OP, SERIAL, NO_OBJECT, SERIAL],
            "50ms",
        ),
    ]
}

const PRE_OP_WITHOUT: &str = r#"{ master = "request PRE-OP of unit 1" }"#;

/// The conditions on acts, and on the time of process data.
pub(crate) fn conditions() -> Vec<ConditionRow> {
    vec![
        condition(
            "the master has read SDO 1018:04 of unit 1 2 times",
            &[PRE_OP, IN_PRE_OP, SERIAL, SERIAL],
            &[PRE_OP, IN_PRE_OP, SERIAL],
            "20ms",
        ),
        condition(
            "the master has read SDO 1018:04 of unit 1 in this step",
            &[PRE_OP, IN_PRE_OP, SERIAL],
            &[
                PRE_OP,
                IN_PRE_OP,
                SERIAL,
                r#"{ expect = "the master has read SDO 1018:04 of unit 1", within = "20ms" }"#,
            ],
            "20ms",
        ),
        condition(
            "the master has requested SAFE-OP of unit 1 before it has requested OP of unit 1",
            &[OP],
            &[REFUSED, SHOWN, OP],
            "100ms",
        ),
        condition("the process data of unit 1 come every 1ms ± 20 %", &[OP], &[TWO_MS, OP], "300ms"),
    ]
}

/// The quantities that the master makes, in the order of their table.
pub(crate) fn quantities() -> Vec<ConditionRow> {
    vec![
        condition(
            "the number of times the master has read SDO 1018:04 of unit 1 is at least 1",
            &[PRE_OP, IN_PRE_OP, SERIAL],
            &[PRE_OP, IN_PRE_OP],
            "20ms",
        ),
        condition(
            "the mean period of the process data of unit 1 is at most T#1100us",
            &[OP, IN_OP],
            &[TWO_MS, OP, IN_OP],
            "300ms",
        ),
        condition(
            "the longest period of the process data of unit 1 is below T#1500us",
            &[OP, IN_OP],
            &[TWO_MS, OP, IN_OP],
            "300ms",
        ),
    ]
}
