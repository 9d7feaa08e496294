//! Actions on a unit by hand, and its conduct as a slave.

use crate::rows::{Around, IN_OP, IN_PRE_OP, OP, OrderRow, PRE_OP, order};

const OTHER_UNIT: Around = Around {
    head: "",
    programs: &[("other.toml", "model = \"nx-ect101\"\nserial = 77")],
    has_capture: false,
};
const START: &str = r#"{ unit = "cycle the power of unit 1" }"#;

pub(crate) fn rows() -> Vec<OrderRow> {
    [by_hand(), conduct(), faults()].into_iter().flatten().collect()
}

fn by_hand() -> Vec<OrderRow> {
    vec![
        order("restart unit 1", &[], &[], "unit 1 has recorded 94B80000", "10ms"),
        order("cycle the power of all units", &[OP, IN_OP], &[], "unit 1 is in INIT", "10ms"),
        order("power off unit 1", &[OP, IN_OP], &[], "RUN of unit 1 is not_lit", "10ms"),
        order(
            "power on unit 1",
            &[OP, IN_OP, r#"{ unit = "power off unit 1" }"#, r#"{ master = "restart" }"#],
            &[OP],
            "unit 1 is in OP",
            "2s",
        ),
        order(
            "reset the errors of unit 1",
            &[
                r#"{ unit = "break MessageCommunications of unit 1" }"#,
                r#"{ expect = "unit 1 has the error 80220000", within = "10ms" }"#,
            ],
            &[],
            "unit 1 has no error",
            "10ms",
        ),
        order("clear the system event log of unit 1", &[], &[], "unit 1 has recorded 90400000", "5ms"),
        order("clear the access event log of unit 1", &[], &[], "unit 1 has recorded 90400000", "5ms"),
        order(
            "turn the ID switch of unit 1 to 0x2A",
            &[],
            &[
                START,
                PRE_OP,
                r#"{ expect = "unit 1 is in PRE-OP", within = "1s" }"#,
                r#"{ master = "write register 0x0120 of unit 1 as 22 00" }"#,
            ],
            "register 0x0134 of unit 1 is 2A 00",
            "20ms",
        ),
        order(
            "corrupt word 4 of the SII of unit 1",
            &[],
            &[START, PRE_OP],
            "unit 1 is in INIT with AL status code 0x0014",
            "1s",
        ),
        order(
            "spoil word 4 of the SII of unit 1",
            &[],
            &[START, PRE_OP],
            "unit 1 is in INIT with AL status code 0x0014",
            "1s",
        ),
        order(
            "load digital.bin into the SII of unit 1",
            &[],
            &[START, PRE_OP],
            "unit 1 has recorded 09460000",
            "1s",
        ),
        order(
            "load broken.bin as it is into the SII of unit 1",
            &[],
            &[START, PRE_OP],
            "unit 1 is in INIT with AL status code 0x0014",
            "1s",
        ),
        order("replace unit 1 by other.toml", &[], &[], "object 1018:04 of unit 1 is 4D 00 00 00", "1s")
            .with(OTHER_UNIT),
        order(
            "erase the SII of unit 1",
            &[],
            &[START, PRE_OP],
            "unit 1 is in INIT with AL status code 0x0014",
            "1s",
        ),
    ]
}

fn conduct() -> Vec<OrderRow> {
    // Without mailboxes PRE-OP is refused, but only after its time.
    const ASK: &[&str] = &[
        r#"{ master = "request PRE-OP of unit 1" }"#,
        r#"{ after = "499ms", expect = "register 0x0120 of unit 1 is 02 00" }"#,
    ];
    vec![
        order("let every transition of unit 1 take 500ms", &[], ASK, "unit 1 is in INIT", "0s"),
        order("let transition IP of unit 1 take 500ms", &[], ASK, "unit 1 is in INIT", "0s"),
        order(
            "let each SII command of unit 1 take 5ms",
            &[],
            &[
                r#"{ master = "write register 0x0502 of unit 1 as 00 01 08 00 00 00" }"#,
                r#"{ after = "3ms", expect = "unit 1 is in INIT" }"#,
            ],
            "register 0x0502 of unit 1 is 40 81",
            "0s",
        ),
        order(
            "keep the SII of unit 1 busy for 100ms",
            &[],
            &[r#"{ after = "99ms", expect = "unit 1 is in INIT" }"#],
            "register 0x0502 of unit 1 is 40 80",
            "0s",
        ),
        order(
            "let the SDOs of unit 1 take 0s",
            &[PRE_OP, IN_PRE_OP],
            &[r#"{ master = "read SDO 1018:01 of unit 1" }"#],
            "the last SDO gave 83 00 00 00",
            "1ms",
        ),
        order(
            "let unit 1 refuse SAFE-OP with AL status code 0x0024",
            &[],
            &[OP],
            "unit 1 is in PRE-OP with AL status code 0x0024",
            "100ms",
        ),
        order(
            "let unit 1 ignore acknowledges",
            &[
                r#"{ master = "request OP of unit 1" }"#,
                r#"{ expect = "unit 1 is in INIT with AL status code 0x0011", within = "5ms" }"#,
            ],
            &[
                r#"{ master = "acknowledge and request INIT of unit 1" }"#,
                r#"{ after = "10ms", cpu = "start the task of unit 1" }"#,
            ],
            "unit 1 is in INIT with AL status code 0x0011",
            "0s",
        ),
        order(
            "let unit 1 behave",
            &[r#"{ unit = "let unit 1 refuse PRE-OP with AL status code 0x8001" }"#],
            &[OP],
            "unit 1 is in OP",
            "100ms",
        ),
    ]
}

fn faults() -> Vec<OrderRow> {
    vec![
        order("break Processing of unit 1", &[], &[], "unit 1 has the error 40200000", "10ms"),
        order(
            "repair IoCommunications of unit 1",
            &[
                r#"{ unit = "break IoCommunications of unit 1" }"#,
                r#"{ expect = "unit 1 has the error 80200000", within = "10ms" }"#,
            ],
            &[r#"{ unit = "reset the errors of unit 1" }"#],
            "unit 1 has no error",
            "20ms",
        ),
        order(
            "mend IoCommunications of unit 1",
            &[
                r#"{ unit = "break IoCommunications of unit 1" }"#,
                r#"{ expect = "unit 1 has the error 80200000", within = "10ms" }"#,
            ],
            &[r#"{ unit = "reset the errors of unit 1" }"#],
            "unit 1 has no error",
            "20ms",
        ),
    ]
}
