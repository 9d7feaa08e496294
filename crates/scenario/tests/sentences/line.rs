//! Actions on the line.

use crate::rows::{IN_OP, OP, OrderRow, order};

const ASK: &str = r#"{ master = "request OP of unit 1" }"#;
const WATCHDOG: &str = "unit 1 is in SAFE-OP with AL status code 0x001B";

pub(crate) fn rows() -> Vec<OrderRow> {
    vec![
        order("unplug cable 1", &[OP, IN_OP], &[], WATCHDOG, "120ms"),
        order("plug cable 1", &[r#"{ line = "unplug cable 1" }"#], &[OP], "unit 1 is in OP", "100ms"),
        order("lose all process data frames", &[OP, IN_OP], &[], WATCHDOG, "120ms"),
        order(
            "lose the answers of all process data frames",
            &[OP, IN_OP],
            &[
                r#"{ cpu = "set the inputs of unit 1 to 2A" }"#,
                r#"{ after = "20ms", expect = "unit 1 is in OP" }"#,
            ],
            "input byte 2 of unit 1 is 00",
            "0s",
        ),
        order(
            "delay all frames by 5ms",
            &[],
            &[ASK, r#"{ after = "4ms", cpu = "start the task of unit 1" }"#],
            "unit 1 is in INIT",
            "0s",
        ),
        // A refused request that acknowledges is refused again.
        order(
            "duplicate all frames",
            &[],
            &[r#"{ master = "acknowledge and request OP of unit 1" }"#],
            "unit 1 has recorded 350B0000 2 times",
            "5ms",
        ),
        order(
            "cut all frames to 20 bytes",
            &[],
            &[ASK, r#"{ after = "4ms", cpu = "start the task of unit 1" }"#],
            "unit 1 is in INIT",
            "0s",
        ),
        order("corrupt the next 1 frames on cable 1", &[], &[ASK], "register 0x0300 of unit 1 is 01", "5ms"),
        order(
            "lower the working counter of all process data frames",
            &[OP, IN_OP],
            &[],
            "the working counter of unit 1 is 2",
            "5ms",
        ),
        order(
            "lower the working counter of all process data frames by 3",
            &[OP, IN_OP],
            &[],
            "the working counter of unit 1 is 0",
            "5ms",
        ),
        // The master sends the request again after 2 ms.
        order(
            "swap all frames with the next one",
            &[],
            &[ASK, r#"{ after = "1ms", cpu = "start the task of unit 1" }"#],
            "unit 1 is in INIT",
            "0s",
        ),
        order(
            "end storm",
            &[r#"{ line = "lose all frames called storm" }"#],
            &[OP],
            "unit 1 is in OP",
            "100ms",
        ),
        order("be quiet", &[r#"{ line = "lose all frames" }"#], &[OP], "unit 1 is in OP", "100ms"),
    ]
}
