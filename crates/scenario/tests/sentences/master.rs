//! Orders of the scripted master.

use crate::rows::{IN_OP, IN_PRE_OP, OP, OrderRow, PRE_OP, order};

pub(crate) fn rows() -> Vec<OrderRow> {
    vec![
        order("take all units to OP", &[], &[], "unit 1 is in OP", "100ms"),
        order("request OP of unit 1", &[], &[], "unit 1 is in INIT with AL status code 0x0011", "20ms"),
        order(
            "acknowledge and request INIT of unit 1",
            &[
                r#"{ master = "request OP of unit 1" }"#,
                r#"{ expect = "unit 1 is in INIT with AL status code 0x0011", within = "20ms" }"#,
            ],
            &[],
            "unit 1 is in INIT",
            "20ms",
        ),
        order("exchange process data every 100us", &[OP, IN_OP], &[], "150 cycles are done", "20ms"),
        order(
            "stop process data",
            &[OP, IN_OP],
            &[],
            "unit 1 is in SAFE-OP with AL status code 0x001B",
            "120ms",
        ),
        order(
            "set the outputs of unit 1 to 01 02 03",
            &[OP, IN_OP],
            &[],
            "the outputs of unit 1 begin with 01 02 03",
            "10ms",
        ),
        order(
            "set output byte 7 of unit 1 to 2A",
            &[OP, IN_OP],
            &[],
            "output byte 7 of unit 1 is 2A",
            "10ms",
        ),
        order(
            "let unit 1 map 0x1601 as 7000:01",
            &[],
            &[r#"{ master = "take unit 1 to SAFE-OP" }"#],
            "object 1601:00 of unit 1 is 01",
            "100ms",
        ),
        order(
            "let unit 1 assign to 0x1C13 the PDOs 1A00 1A01 1BFE 1BFF",
            &[],
            &[r#"{ master = "take unit 1 to SAFE-OP" }"#],
            "object 1C13:00 of unit 1 is 04",
            "100ms",
        ),
        order(
            "give SyncManager 2 of unit 1 100 bytes",
            &[],
            &[OP],
            "unit 1 is in PRE-OP with AL status code 0x001D",
            "100ms",
        ),
        order(
            "give SyncManager 2 of unit 1 control 0x24",
            &[],
            &[OP],
            "register 0x0814 of unit 1 is 24",
            "100ms",
        ),
        order(
            "write SDO 10F3:05 of unit 1 as 01 00",
            &[PRE_OP, IN_PRE_OP],
            &[],
            "object 10F3:05 of unit 1 is 01 00",
            "20ms",
        ),
        order(
            "read SDO 1018:01 of unit 1",
            &[PRE_OP, IN_PRE_OP],
            &[],
            "the last SDO gave 83 00 00 00",
            "20ms",
        ),
        order(
            "write register 0x0010 of unit 1 as 07 00",
            &[],
            &[],
            "register 0x0010 of unit 1 is 07 00",
            "5ms",
        ),
        order(
            "write register 0x2800 of unit 1 in two halves as 01 02 03 04",
            &[],
            &[],
            "register 0x2800 of unit 1 is 01 02 03 04",
            "5ms",
        ),
        order(
            "use mailbox counter 3",
            &[PRE_OP, IN_PRE_OP],
            &[
                r#"{ master = "read SDO 1018:01 of unit 1" }"#,
                r#"{ expect = "the last SDO gave 83 00 00 00", within = "20ms" }"#,
                r#"{ master = "read SDO 1018:04 of unit 1" }"#,
            ],
            "the master has given up",
            "6s",
        ),
        order(
            "read no mailbox",
            &[PRE_OP, IN_PRE_OP],
            &[r#"{ master = "read SDO 1018:04 of unit 1" }"#],
            "the master has given up",
            "6s",
        ),
        order(
            "behave",
            &[PRE_OP, IN_PRE_OP, r#"{ master = "read no mailbox" }"#],
            &[r#"{ master = "read SDO 1018:04 of unit 1" }"#],
            "the last SDO gave 01 00 00 00",
            "20ms",
        ),
        order("restart", &[OP, IN_OP], &[], "unit 1 is in SAFE-OP with AL status code 0x001B", "120ms"),
    ]
}
