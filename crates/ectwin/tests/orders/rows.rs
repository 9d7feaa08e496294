//! A row for each sentence: what is there before, and the effect that can be seen without a master.

/// A sentence and its effect.
pub(crate) struct Row {
    pub(crate) sentence: &'static str,
    /// Orders, and conditions behind `expect`.
    pub(crate) before: &'static [&'static str],
    /// A condition that is true after the order and not before it; none: only a master sees the effect, as in the
    /// scenarios of `scenario/tests/sentences`.
    pub(crate) effect: Option<&'static str>,
    /// Number of faults of frames at work after it.
    pub(crate) faults: usize,
}

const fn row(sentence: &'static str, before: &'static [&'static str], effect: &'static str) -> Row {
    Row { sentence, before, effect: Some(effect), faults: 0 }
}

const fn only_a_master_sees(sentence: &'static str) -> Row {
    Row { sentence, before: &[], effect: None, faults: 0 }
}

const fn fault(sentence: &'static str) -> Row {
    Row { sentence, before: &[], effect: None, faults: 1 }
}

const ACTIVE: &str = "expect the I/O data of unit 1 is active";

pub(crate) const UNIT: &[Row] = &[
    row("restart unit 1", &[], "unit 1 has recorded 94B80000"),
    row("cycle the power of all units", &["power off unit 1"], "unit 1 is in INIT"),
    row("power off unit 1", &[], "not (unit 1 is in INIT)"),
    row("power on unit 1", &["power off unit 1"], "unit 1 is in INIT"),
    row(
        "reset the errors of unit 1",
        &["send 9 NX messages to unit 1", "expect unit 1 has the error 80220000"],
        "unit 1 has no error",
    ),
    row("clear the system event log of unit 1", &[], "unit 1 has recorded 90400000"),
    row("clear the access event log of unit 1", &[], "unit 1 has recorded 90400000"),
    only_a_master_sees("turn the ID switch of unit 1 to 0x2A"),
    only_a_master_sees("corrupt word 7 of the SII of unit 1"),
    only_a_master_sees("spoil word 7 of the SII of unit 1"),
    only_a_master_sees("erase the SII of unit 1"),
    only_a_master_sees("load @right.bin into the SII of unit 1"),
    only_a_master_sees("load @broken.bin as it is into the SII of unit 1"),
    row("replace unit 1 by @other.toml", &[], "object 1018:04 of unit 1 is 4D 00 00 00"),
    only_a_master_sees("let every transition of unit 1 take 500ms"),
    only_a_master_sees("let transition IP of unit 1 take 500ms"),
    only_a_master_sees("let each SII command of unit 1 take 5ms"),
    only_a_master_sees("keep the SII of unit 1 busy for 100ms"),
    only_a_master_sees("let the SDOs of unit 1 take 300ms"),
    only_a_master_sees("let unit 1 refuse SAFE-OP with AL status code 0x0024"),
    only_a_master_sees("let unit 1 ignore acknowledges"),
    only_a_master_sees("let unit 1 behave"),
    row("break Processing of unit 1", &[], "unit 1 has the error 40200000"),
    Row {
        sentence: "repair Processing of unit 1",
        before: &["break Processing of unit 1"],
        effect: None,
        faults: 0,
    },
    Row {
        sentence: "mend Processing of unit 1",
        before: &["break Processing of unit 1"],
        effect: None,
        faults: 0,
    },
];

pub(crate) const CPU: &[Row] = &[
    only_a_master_sees("set unit 1 to PROGRAM mode"),
    row(
        "set unit 1 to RUN mode",
        &["set unit 1 to PROGRAM mode", "force N1_UINTs_01_M_to_C[0] to 7"],
        "program variable counter of unit 1 is 7",
    ),
    row("stop I/O refreshing of unit 1", &[ACTIVE], "unit 1 has recorded 80200000"),
    Row {
        sentence: "start I/O refreshing of unit 1",
        before: &["stop I/O refreshing of unit 1"],
        effect: None,
        faults: 0,
    },
    row("stop the task of unit 1", &[ACTIVE], "unit 1 has recorded 80200000"),
    row(
        "start the task of unit 1",
        &["stop the task of unit 1", "force N1_UINTs_01_M_to_C[0] to 7"],
        "program variable counter of unit 1 is 7",
    ),
    only_a_master_sees("reset the errors of the NX Bus Function Module of unit 1"),
    row(
        "cycle the power of the CPU Rack of unit 1",
        &["power off the CPU Rack of unit 1"],
        "unit 1 is in INIT",
    ),
    row("power off the CPU Rack of unit 1", &[], "not (unit 1 is in INIT)"),
    row("power on the CPU Rack of unit 1", &["power off the CPU Rack of unit 1"], "unit 1 is in INIT"),
    row("send 9 NX messages to unit 1", &[], "unit 1 has recorded 80220000"),
    row("set the inputs of unit 1 to 05 00", &[], "variable N1_UINTs_01_C_to_M[0] has the value 5"),
    only_a_master_sees("let the system time of unit 1 jump by 1s"),
    row("write N1_UINTs_01_C_to_M[0] as 5", &[], "variable N1_UINTs_01_C_to_M[0] has the value 5"),
    row("force N1_UINTs_01_C_to_M[0] to 5", &[], "variable N1_UINTs_01_C_to_M[0] has the value 5"),
    Row {
        sentence: "release N1_UINTs_01_C_to_M[0]",
        before: &["force N1_UINTs_01_C_to_M[0] to 5"],
        effect: None,
        faults: 0,
    },
    Row {
        sentence: "release all of unit 1",
        before: &["force N1_UINTs_01_C_to_M[0] to 5"],
        effect: None,
        faults: 0,
    },
    row("load @nine.st into unit 1", &[], "variable N1_UINTs_01_C_to_M[0] has the value 9"),
];

pub(crate) const LINE: &[Row] = &[
    row("unplug cable 1", &[], "L/A IN of unit 1 is not_lit"),
    row("plug cable 1", &["unplug cable 1"], "not (L/A IN of unit 1 is not_lit)"),
    fault("lose the next 3 frames"),
    fault("lose the answers of 5 % of the mailbox frames"),
    fault("delay 10 % of the frames by 200us"),
    fault("duplicate number 7 of the frames"),
    fault("swap every 10th of the frames with the next one"),
    fault("cut the next 1 frames to 40 bytes"),
    fault("corrupt numbers 3 to 9 of the process data frames on cable 1"),
    fault("lower the working counter of all process data frames"),
    fault("lower the working counter of all LRW frames of unit 1 by 3"),
    Row { sentence: "end storm", before: &["lose all frames called storm"], effect: None, faults: 0 },
    Row { sentence: "be quiet", before: &["lose all frames"], effect: None, faults: 0 },
];
