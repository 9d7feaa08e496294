//! Conditions.

use crate::rows::{Around, ConditionRow, IN_OP, IN_PRE_OP, OP, PRE_OP, condition};

/// A program whose input determines the error: 5 raises an error, 6 never ends, 20 is not an index.
const PROGRAM: Around = Around {
    head: "units = [{ model = \"nx-ect101\", cpu = { program = \"a.st\", statement_budget = 1_000 } }]",
    programs: &[(
        "a.st",
        "VAR n : UINT; table : ARRAY[0..9] OF UINT; END_VAR\n\
         n := N1_UINTs_01_M_to_C[0];\n\
         IF n = 5 THEN SetAlarm(16#101); END_IF;\n\
         WHILE n = 6 DO ; END_WHILE;\n\
         table[n] := 1;",
    )],
    has_capture: false,
};
const CAPTURE: Around = Around { head: "", programs: &[], has_capture: true };
const ANOTHER_UNIT: Around =
    Around { head: "units = [{ model = \"nx-ect101\", serial = 2 }]", programs: &[], has_capture: true };

const RESTART: &str = r#"{ unit = "restart unit 1" }"#;
const BROKEN: &str = r#"{ unit = "break Processing of unit 1" }"#;
const OUTPUTS: &str = r#"{ master = "set output byte 2 of unit 1 to 2A" }"#;
const INPUTS: &str = r#"{ cpu = "set the inputs of unit 1 to 2A" }"#;
const STOPPED: &str = r#"{ cpu = "stop I/O refreshing of unit 1" }"#;
const ACTIVE: &str = r#"{ expect = "the I/O data of unit 1 is active", within = "10ms" }"#;
const VALID: &str = r#"{ expect = "the data of unit 1 is valid", within = "10ms" }"#;
const FORCE_5: &str = r#"{ cpu = "force N1_UINTs_01_M_to_C[0] to 5" }"#;
const FORCE_6: &str = r#"{ cpu = "force N1_UINTs_01_M_to_C[0] to 6" }"#;
const FORCE_20: &str = r#"{ cpu = "force N1_UINTs_01_M_to_C[0] to 20" }"#;

pub(crate) fn rows() -> Vec<ConditionRow> {
    [states_and_events(), data(), programs(), validity(), masters(), captures(), comparisons(), logic()]
        .into_iter()
        .flatten()
        .collect()
}

fn states_and_events() -> Vec<ConditionRow> {
    const TWICE: &[&str] = &[RESTART, r#"{ after = "1s", unit = "restart unit 1" }"#];
    const LATER: &str = r#"{ after = "1s", line = "be quiet" }"#;
    const ASK: &str = r#"{ master = "request OP of unit 1" }"#;
    vec![
        condition("unit 1 is in OP", &[OP], &[], "100ms"),
        condition("all units are in OP", &[OP], &[], "100ms"),
        condition("unit 1 is in INIT with AL status code 0x0011", &[ASK], &[], "10ms"),
        condition("all units are in INIT with AL status code 0x0011", &[ASK], &[], "10ms"),
        condition("unit 1 has recorded 94B80000", &[RESTART], &[], "10ms"),
        condition("all units have recorded 94B80000", &[RESTART], &[], "10ms"),
        condition("unit 1 has recorded 94B80000 2 times", TWICE, &[RESTART], "10ms"),
        condition("all units have recorded 94B80000 2 times", TWICE, &[RESTART], "10ms"),
        condition("unit 1 has recorded 94B80000 again", &[RESTART], &[RESTART, LATER], "10ms"),
        condition("all units have recorded 94B80000 again", &[RESTART], &[RESTART, LATER], "10ms"),
        condition(
            "unit 1 has recorded nothing",
            &[],
            &[RESTART, r#"{ after = "1s", line = "be quiet" }"#],
            "0s",
        ),
        condition(
            "all units have recorded nothing",
            &[],
            &[RESTART, r#"{ after = "1s", line = "be quiet" }"#],
            "0s",
        ),
        condition("unit 1 has the error 40200000", &[BROKEN], &[], "10ms"),
        condition("all units have the error 40200000", &[BROKEN], &[], "10ms"),
        condition("unit 1 has no error", &[], &[BROKEN, r#"{ after = "10ms", line = "be quiet" }"#], "0s"),
        condition(
            "all units have no error",
            &[],
            &[BROKEN, r#"{ after = "10ms", line = "be quiet" }"#],
            "0s",
        ),
        condition("unit 1 has new messages", &[BROKEN], &[], "10ms"),
        condition("all units have new messages", &[BROKEN], &[], "10ms"),
        condition(
            "unit 1 has no new messages",
            &[],
            &[BROKEN, r#"{ after = "10ms", line = "be quiet" }"#],
            "0s",
        ),
        condition(
            "all units have no new messages",
            &[],
            &[BROKEN, r#"{ after = "10ms", line = "be quiet" }"#],
            "0s",
        ),
        condition(
            "ERR of unit 1 is blinking",
            &[OP, IN_OP, r#"{ master = "request 0x07 of unit 1" }"#],
            &[],
            "10ms",
        ),
    ]
}

fn data() -> Vec<ConditionRow> {
    const WRITE: &str = r#"{ cpu = "write N1_UINTs_01_C_to_M[0] as 5" }"#;
    vec![
        condition(
            "object 10F3:05 of unit 1 is 01 00",
            &[PRE_OP, r#"{ master = "write SDO 10F3:05 of unit 1 as 01 00" }"#],
            &[PRE_OP],
            "50ms",
        ),
        condition(
            "register 0x0010 of unit 1 is 07 00",
            &[r#"{ master = "write register 0x0010 of unit 1 as 07 00" }"#],
            &[],
            "5ms",
        ),
        condition("the outputs of unit 1 begin with 00 00 2A", &[OUTPUTS, OP], &[OP], "100ms"),
        condition("output byte 2 of unit 1 is 2A 00", &[OUTPUTS, OP], &[OP], "100ms"),
        condition(
            "the inputs of unit 1 begin with 17 00 2A 00",
            &[INPUTS, OUTPUTS, OP],
            &[OUTPUTS, OP],
            "100ms",
        ),
        condition("input byte 2 of unit 1 is 2A 00", &[INPUTS, OP], &[OP], "100ms"),
        condition("variable N1_UINTs_01_C_to_M is 05 00", &[WRITE], &[], "2ms"),
        condition("variable N1_UINTs_01_C_to_M[0] has the value 5", &[WRITE], &[], "2ms"),
        condition("variable N1_SDO_Communications_Enabled is TRUE", &[OP], &[], "100ms"),
        condition(
            "variable N1_SDO_Communications_Enabled is FALSE",
            &[],
            &[OP, r#"{ after = "100ms", expect = "unit 1 is in OP" }"#],
            "2ms",
        ),
        condition(
            "the working counter of unit 1 is 3",
            &[OP],
            &[r#"{ line = "lower the working counter of all process data frames" }"#, OP],
            "100ms",
        ),
    ]
}

fn programs() -> Vec<ConditionRow> {
    const AGAIN: &[&str] = &[
        FORCE_5,
        r#"{ after = "5ms", cpu = "force N1_UINTs_01_M_to_C[0] to 0" }"#,
        r#"{ after = "5ms", cpu = "force N1_UINTs_01_M_to_C[0] to 5" }"#,
    ];
    const LATER: &str = r#"{ after = "5ms", line = "be quiet" }"#;
    let rows = [
        condition("program variable n of unit 1 is 5", &[FORCE_5], &[], "5ms"),
        condition("user-defined error 16#101 at unit 1", &[FORCE_5], &[], "5ms"),
        condition("user-defined error 16#101 2 times at unit 1", AGAIN, &[FORCE_5], "5ms"),
        condition("no user-defined error at unit 1", &[], &[FORCE_5, LATER], "0s"),
        condition("task overrun of unit 1", &[FORCE_6], &[], "5ms"),
        condition("no task overrun of unit 1", &[], &[FORCE_6, LATER], "0s"),
        condition("program error of unit 1", &[FORCE_20], &[FORCE_6], "5ms"),
        condition("program error of unit 1 at 5:7", &[FORCE_20], &[FORCE_6], "5ms"),
        condition("no program error of unit 1", &[], &[FORCE_20, LATER], "0s"),
    ];
    rows.into_iter().map(|row| row.with(PROGRAM)).collect()
}

fn validity() -> Vec<ConditionRow> {
    const LATER: &str = r#"{ after = "10ms", line = "be quiet" }"#;
    vec![
        condition("the data of unit 1 is valid", &[OP], &[], "100ms"),
        condition("the data of unit 1 is not valid", &[], &[OP, IN_OP, VALID], "0s"),
        condition("the data M to C of unit 1 is valid", &[OP], &[], "100ms"),
        condition("the data M to C of unit 1 is not valid", &[], &[OP, IN_OP, VALID], "0s"),
        // In SAFE-OP inputs are valid, and outputs are not.
        condition(
            "the data C to M of unit 1 is valid",
            &[r#"{ master = "take unit 1 to SAFE-OP" }"#],
            &[],
            "100ms",
        ),
        condition("the data C to M of unit 1 is not valid", &[], &[OP, IN_OP, VALID], "0s"),
        condition("the I/O data of unit 1 is active", &[], &[ACTIVE, STOPPED, LATER], "10ms"),
        condition("the I/O data of unit 1 is not active", &[ACTIVE, STOPPED], &[ACTIVE], "10ms"),
        condition("the CPU Unit of unit 1 sees an error", &[BROKEN], &[], "10ms"),
        condition(
            "the CPU Unit of unit 1 sees no error",
            &[],
            &[BROKEN, r#"{ expect = "the CPU Unit of unit 1 sees an error", within = "10ms" }"#],
            "0s",
        ),
    ]
}

fn masters() -> Vec<ConditionRow> {
    const NO_OBJECT: &str = r#"{ master = "read SDO 9999:00 of unit 1" }"#;
    const SERIAL: &str = r#"{ master = "read SDO 1018:04 of unit 1" }"#;
    const EMERGENCIES: &str = r#"{ master = "write SDO 10F3:05 of unit 1 as 01 00" }"#;
    const BROKEN: &str = r#"{ unit = "break IoCommunications of unit 1" }"#;
    const MENDED: &str = r#"{ after = "50ms", unit = "repair IoCommunications of unit 1" }"#;
    const RESET: &str = r#"{ unit = "reset the errors of unit 1" }"#;
    const AGAIN: &str = r#"{ after = "50ms", unit = "break IoCommunications of unit 1" }"#;
    const ALLOWED: &str = r#"{ expect = "object 10F3:05 of unit 1 is 01 00", within = "100ms" }"#;
    vec![
        condition("one cycle is done", &[OP], &[], "100ms"),
        condition("50 cycles are done", &[OP], &[], "100ms"),
        condition("the master has nothing to do", &[], &[OP], "0s"),
        condition(
            "the master has given up",
            &[r#"{ master = "give SyncManager 2 of unit 1 100 bytes" }"#, OP],
            &[OP],
            "100ms",
        ),
        condition(
            "the master has given up again",
            &[r#"{ master = "give SyncManager 2 of unit 1 100 bytes" }"#, OP],
            &[
                r#"{ master = "give SyncManager 2 of unit 1 100 bytes" }"#,
                OP,
                r#"{ after = "100ms", line = "be quiet" }"#,
            ],
            "100ms",
        ),
        condition(
            "the last SDO was refused with 0x06020000",
            &[PRE_OP, IN_PRE_OP, NO_OBJECT],
            &[PRE_OP, IN_PRE_OP, SERIAL],
            "20ms",
        ),
        condition(
            "the last SDO gave 01 00 00 00",
            &[PRE_OP, IN_PRE_OP, SERIAL],
            &[PRE_OP, IN_PRE_OP, NO_OBJECT],
            "20ms",
        ),
        condition(
            "the last SDO was taken",
            &[PRE_OP, IN_PRE_OP, EMERGENCIES],
            &[PRE_OP, IN_PRE_OP, NO_OBJECT],
            "20ms",
        ),
        condition(
            "the last SDO of unit 1 was refused with 0x06020000",
            &[PRE_OP, IN_PRE_OP, NO_OBJECT],
            &[PRE_OP, IN_PRE_OP, SERIAL],
            "20ms",
        ),
        condition(
            "the last SDO of unit 1 gave 01 00 00 00",
            &[PRE_OP, IN_PRE_OP, SERIAL],
            &[PRE_OP, IN_PRE_OP, NO_OBJECT],
            "20ms",
        ),
        condition(
            "the last SDO of unit 1 was taken",
            &[PRE_OP, IN_PRE_OP, EMERGENCIES],
            &[PRE_OP, IN_PRE_OP, NO_OBJECT],
            "20ms",
        ),
        condition(
            "the master has received emergency 0xFF20",
            &[PRE_OP, EMERGENCIES, ALLOWED, BROKEN],
            &[PRE_OP, EMERGENCIES, ALLOWED],
            "50ms",
        ),
        condition(
            "the master has received emergency 0xFF20 2 times",
            &[PRE_OP, EMERGENCIES, ALLOWED, BROKEN, MENDED, RESET, AGAIN],
            &[PRE_OP, EMERGENCIES, ALLOWED, BROKEN],
            "50ms",
        ),
    ]
}

const WITH_AN_EMERGENCY: &[&str] = &[
    PRE_OP,
    r#"{ master = "write SDO 10F3:05 of unit 1 as 01 00" }"#,
    r#"{ expect = "object 10F3:05 of unit 1 has bits 0x01", within = "100ms" }"#,
    r#"{ unit = "break IoCommunications of unit 1" }"#,
];

/// Each test of a value, with quantities of each kind; `quantities` has the others.
fn comparisons() -> Vec<ConditionRow> {
    const TWO: &[&str] = &[RESTART, r#"{ after = "1s", unit = "restart unit 1" }"#];
    const LATER: &str = r#"{ after = "10ms", line = "be quiet" }"#;
    vec![
        condition(
            "object 10F3:05 of unit 1 is not 00 00",
            &[PRE_OP, r#"{ master = "write SDO 10F3:05 of unit 1 as 01 00" }"#],
            &[PRE_OP],
            "50ms",
        ),
        condition("the number of records of 94B80000 by unit 1 is 2", TWO, &[RESTART], "10ms"),
        condition("the number of emergencies is 1", WITH_AN_EMERGENCY, &[PRE_OP], "50ms"),
        condition("the number of emergencies 0xFF20 is 1", WITH_AN_EMERGENCY, &[PRE_OP], "50ms"),
        condition("the number of cycles is 50", &[OP], &[], "200ms"),
        condition("the number of records of 94B80000 by unit 1 is at least 2", TWO, &[RESTART], "10ms"),
        condition("the number of records of 94B80000 by unit 1 is at most 1", &[RESTART], TWO, "0s"),
        condition("the number of cycles is above 50", &[OP], &[], "200ms"),
        condition(
            "the working counter of unit 1 is below 3",
            &[r#"{ line = "lower the working counter of all process data frames" }"#, OP],
            &[OP],
            "100ms",
        ),
        condition(
            "register 0x0010 of unit 1 is between 6 and 8",
            &[r#"{ master = "write register 0x0010 of unit 1 as 07 00" }"#],
            &[],
            "5ms",
        ),
        condition(
            "variable N1_UINTs_01_C_to_M begins with 05 00",
            &[r#"{ cpu = "write N1_UINTs_01_C_to_M[0] as 5" }"#],
            &[],
            "2ms",
        ),
        condition("register 0x0130 of unit 1 has bits 0x08", &[OP], &[PRE_OP], "100ms"),
        condition(
            "register 0x0130 of unit 1 has no bits 0x01",
            &[r#"{ master = "take unit 1 to SAFE-OP" }"#],
            &[],
            "100ms",
        ),
        condition("input byte 2 of unit 1 changes", &[OP, IN_OP, INPUTS], &[OP, IN_OP], "10ms"),
        condition(
            "the inputs of unit 1 change",
            &[OP, IN_OP, r#"{ after = "20ms", cpu = "set the inputs of unit 1 to 2A" }"#],
            &[OP, IN_OP, LATER, r#"{ after = "20ms", line = "be quiet" }"#],
            "10ms",
        ),
        condition(
            "the outputs of unit 1 change",
            &[OP, IN_OP, r#"{ after = "20ms", master = "set output byte 2 of unit 1 to 2A" }"#],
            &[OP, IN_OP, LATER],
            "10ms",
        ),
        condition("the outputs of unit 1 do not begin with 00 00 00", &[OUTPUTS, OP], &[OP], "100ms"),
        condition("the outputs of unit 1 have bits 0x00080000", &[OUTPUTS, OP], &[OP], "100ms"),
        condition(
            "the outputs of unit 1 have no bits 0x00080000",
            &[OP, IN_OP, LATER],
            &[OUTPUTS, OP, IN_OP, LATER],
            "0s",
        ),
        condition("the inputs of unit 1 do not begin with 17 00 00", &[INPUTS, OP], &[], "100ms"),
        condition("the inputs of unit 1 have bits 0x00080000", &[INPUTS, OP], &[OP], "100ms"),
        condition("the inputs of unit 1 have no bits 0x00080000", &[OP], &[], "100ms"),
    ]
}

/// Every quantity holds and fails, with a test of its own.
pub(crate) fn quantities() -> Vec<ConditionRow> {
    const WRITE: &str = r#"{ cpu = "write N1_UINTs_01_C_to_M[0] as 5" }"#;
    let program =
        condition("program variable n of unit 1 is at least 5", &[FORCE_5], &[], "5ms").with(PROGRAM);
    let first = vec![
        condition("object 2002:01 of unit 1 is above 0", &[BROKEN], &[], "10ms"),
        condition("register 0x0130 of unit 1 is at least 8", &[OP], &[PRE_OP], "100ms"),
        condition("output byte 2 of unit 1 is not 00", &[OUTPUTS, OP], &[OP], "100ms"),
        condition("input byte 2 of unit 1 is between 0x2A and 0x2A", &[INPUTS, OP], &[OP], "100ms"),
        condition("variable N1_UINTs_01_C_to_M[0] is above 4", &[WRITE], &[], "2ms"),
        program,
        condition(
            "the working counter of unit 1 is not 2",
            &[OP],
            &[r#"{ line = "lower the working counter of all process data frames" }"#, OP],
            "100ms",
        ),
        condition("the number of records of 94B80000 by unit 1 is not 0", &[RESTART], &[], "10ms"),
    ];
    let last = vec![
        condition("the number of emergencies is at least 1", WITH_AN_EMERGENCY, &[PRE_OP], "50ms"),
        condition("the number of emergencies 0xFF20 changes", WITH_AN_EMERGENCY, &[PRE_OP], "50ms"),
        condition("the number of cycles is between 20 and 60", &[OP], &[], "100ms"),
    ];
    [first, crate::acts::quantities(), last].concat()
}

fn logic() -> Vec<ConditionRow> {
    const LATER: &str = r#"{ after = "10ms", line = "be quiet" }"#;
    vec![
        condition("not (unit 1 is in INIT)", &[OP], &[], "100ms"),
        condition("all of (unit 1 is in OP; 20 cycles are done)", &[OP], &[PRE_OP], "200ms"),
        condition("any of (unit 1 is in SAFE-OP; not (unit 1 has no error))", &[BROKEN], &[LATER], "10ms"),
    ]
}

fn captures() -> Vec<ConditionRow> {
    const SENT: &str = r#"{ expect = "the capture is replayed", within = "1s" }"#;
    const LATER: &str = r#"{ after = "10ms", line = "be quiet" }"#;
    let rows = [
        condition("the capture is replayed", &[SENT], &[], "1ms"),
        condition("every answer is as captured", &[SENT, LATER], &[SENT, LATER], "0s")
            .failing_with(ANOTHER_UNIT),
        condition(
            "at most 1 answers differ",
            &[SENT, LATER],
            &[r#"{ unit = "power off unit 1" }"#, SENT, LATER],
            "0s",
        ),
    ];
    let rows = rows.into_iter().zip([CAPTURE, ANOTHER_UNIT, CAPTURE]);
    rows.map(|(row, other)| row.with(CAPTURE).failing_with(other)).collect()
}
