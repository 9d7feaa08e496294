//! Actions on a CPU Unit.

use crate::rows::{Around, IN_OP, OP, OrderRow, Steps, order};

const COPY: Around = Around {
    head: "units = [{ model = \"nx-ect101\", cpu.program = \"builtin:copy\" }]",
    programs: &[],
    has_capture: false,
};
const STOPPING: Around = Around {
    head: "units = [{ model = \"nx-ect101\", cpu = { fail_soft = false } }]",
    programs: &[],
    has_capture: false,
};
const IN_STEP: Around = Around {
    head: "units = [{ model = \"nx-ect101\", refresh_phase = \"0us\", cpu.task_phase = \"0us\" }]",
    programs: &[],
    has_capture: false,
};
const TWO_PROGRAMS: Around = Around {
    head: "units = [{ model = \"nx-ect101\", cpu.program = \"one.st\" }]",
    programs: &[("one.st", "N1_UINTs_01_C_to_M[0] := 1;"), ("two.st", "N1_UINTs_01_C_to_M[0] := 2;")],
    has_capture: false,
};

/// I/O refreshing has stopped.
const STOPPED: Steps = &[
    r#"{ expect = "the I/O data of unit 1 is active", within = "10ms" }"#,
    r#"{ cpu = "stop I/O refreshing of unit 1" }"#,
    r#"{ expect = "the I/O data of unit 1 is not active", within = "10ms" }"#,
];
/// The task has stopped, and the unit has detected it.
const TASK_STOPPED: Steps = &[
    r#"{ expect = "the I/O data of unit 1 is active", within = "10ms" }"#,
    r#"{ cpu = "stop the task of unit 1" }"#,
    r#"{ expect = "unit 1 has recorded 80200000", within = "1s" }"#,
];
/// With fail_soft = false an error of the NX bus stops I/O refreshing.
const BUS_STOPPED: Steps = &[
    r#"{ expect = "the I/O data of unit 1 is active", within = "10ms" }"#,
    r#"{ unit = "break IoCommunications of unit 1" }"#,
    r#"{ expect = "the I/O data of unit 1 is not active", within = "10ms" }"#,
    r#"{ unit = "repair IoCommunications of unit 1" }"#,
    r#"{ unit = "reset the errors of unit 1" }"#,
    r#"{ after = "10ms", expect = "the I/O data of unit 1 is not active" }"#,
];
const FORCED: Steps = &[r#"{ cpu = "force N1_UINTs_01_C_to_M[0] to 5" }"#];
const WRITTEN: Steps = &[r#"{ cpu = "write N1_UINTs_01_C_to_M[0] as 6" }"#];

pub(crate) fn rows() -> Vec<OrderRow> {
    [modes_and_tasks(), data()].into_iter().flatten().collect()
}

fn modes_and_tasks() -> Vec<OrderRow> {
    vec![
        order(
            "set unit 1 to PROGRAM mode",
            &[OP, IN_OP],
            &[
                r#"{ master = "set the outputs of unit 1 to 2A" }"#,
                r#"{ after = "20ms", expect = "the outputs of unit 1 begin with 2A" }"#,
            ],
            "input byte 2 of unit 1 is 00",
            "0s",
        )
        .with(COPY),
        order(
            "set unit 1 to RUN mode",
            &[
                r#"{ cpu = "set unit 1 to PROGRAM mode" }"#,
                r#"{ master = "set the outputs of unit 1 to 2A" }"#,
                OP,
                IN_OP,
            ],
            &[],
            "input byte 2 of unit 1 is 2A",
            "20ms",
        )
        .with(COPY),
        order(
            "stop I/O refreshing of unit 1",
            &[r#"{ expect = "the I/O data of unit 1 is active", within = "10ms" }"#],
            &[],
            "unit 1 has recorded 80200000",
            "20ms",
        ),
        order(
            "start I/O refreshing of unit 1",
            STOPPED,
            &[r#"{ after = "5ms", unit = "reset the errors of unit 1" }"#],
            "the I/O data of unit 1 is active",
            "10ms",
        ),
        order(
            "stop the task of unit 1",
            &[r#"{ expect = "the I/O data of unit 1 is active", within = "10ms" }"#],
            &[],
            "unit 1 has recorded 80200000",
            "1s",
        ),
        order(
            "start the task of unit 1",
            TASK_STOPPED,
            &[r#"{ cpu = "write N1_UINTs_01_C_to_M[0] as 6" }"#, OP],
            "input byte 2 of unit 1 is 06 00",
            "200ms",
        ),
        order(
            "reset the errors of the NX Bus Function Module of unit 1",
            BUS_STOPPED,
            &[],
            "the I/O data of unit 1 is active",
            "10ms",
        )
        .with(STOPPING),
        order("send 9 NX messages to unit 1", &[], &[], "unit 1 has recorded 80220000", "10ms"),
        order("power off the CPU Rack of unit 1", &[OP, IN_OP], &[], "RUN of unit 1 is not_lit", "10ms"),
        order(
            "power on the CPU Rack of unit 1",
            &[OP, IN_OP, r#"{ cpu = "power off the CPU Rack of unit 1" }"#, r#"{ master = "restart" }"#],
            &[OP],
            "the data of unit 1 is valid",
            "2s",
        ),
        order(
            "cycle the power of the CPU Rack of unit 1",
            BUS_STOPPED,
            &[],
            "the I/O data of unit 1 is active",
            "500ms",
        )
        .with(STOPPING),
    ]
}

fn data() -> Vec<OrderRow> {
    vec![
        order(
            "set the inputs of unit 1 to 01 02 03",
            &[OP, IN_OP],
            &[],
            "input byte 2 of unit 1 is 01 02 03",
            "10ms",
        ),
        order(
            "let the system time of unit 1 jump by 3600s",
            &[],
            &[r#"{ at = "1s", cpu = "start the task of unit 1" }"#],
            "object 10F8:00 of unit 1 is 00 6A 4D 5A 98 75 86 18",
            "0s",
        )
        .with(IN_STEP),
        order(
            "write N1_UINTs_01_C_to_M[0] as 5",
            &[],
            &[],
            "variable N1_UINTs_01_C_to_M[0] has the value 5",
            "2ms",
        ),
        order(
            "force N1_UINTs_01_C_to_M[0] to 5",
            &[],
            WRITTEN,
            "variable N1_UINTs_01_C_to_M[0] has the value 5",
            "2ms",
        ),
        order(
            "release N1_UINTs_01_C_to_M[0]",
            FORCED,
            WRITTEN,
            "variable N1_UINTs_01_C_to_M[0] has the value 6",
            "2ms",
        ),
        order(
            "release all of unit 1",
            FORCED,
            WRITTEN,
            "variable N1_UINTs_01_C_to_M[0] has the value 6",
            "2ms",
        ),
        order(
            "load two.st into unit 1",
            &[r#"{ cpu = "set unit 1 to PROGRAM mode" }"#],
            &[r#"{ cpu = "set unit 1 to RUN mode" }"#],
            "variable N1_UINTs_01_C_to_M[0] has the value 2",
            "5ms",
        )
        .with(TWO_PROGRAMS),
    ]
}
