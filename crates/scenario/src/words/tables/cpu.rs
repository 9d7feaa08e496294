//! Sentences of the CPU Units.

use plc::OperatingMode;

use crate::model::CpuOrder::{self, *};
use crate::words::sentence::{Sentence, row};

/// All of them.
#[rustfmt::skip]
pub const CPU: &[Sentence<CpuOrder>] = &[
    row("set {units} to PROGRAM mode", "set unit 1 to PROGRAM mode", "the program stands, the values stay",
        |v| SetMode(v.units(0), OperatingMode::Program)),
    row("set {units} to RUN mode", "set unit 1 to RUN mode", "the program runs", |v| SetMode(v.units(0), OperatingMode::Run)),
    row("stop I/O refreshing of {units}", "stop I/O refreshing of unit 1",
        "what an error of the CPU Unit does: NX Unit I/O Communications Error (80200000)",
        |v| SetIoRefreshing(v.units(0), false)),
    row("start I/O refreshing of {units}", "start I/O refreshing of unit 1", "the CPU Unit is well again",
        |v| SetIoRefreshing(v.units(0), true)),
    row("stop the task of {units}", "stop the task of unit 1", "the primary periodic task stands, with its I/O refresh",
        |v| SetTaskRunning(v.units(0), false)),
    row("start the task of {units}", "start the task of unit 1", "the primary periodic task goes on",
        |v| SetTaskRunning(v.units(0), true)),
    row("reset the errors of the NX Bus Function Module of {units}", "reset the errors of the NX Bus Function Module of unit 1",
        "and with them those of the unit; with `fail_soft = false` I/O refreshing starts again, unless the cause persists",
        |v| ResetNxBus(v.units(0))),
    row("cycle the power of the CPU Rack of {units}", "cycle the power of the CPU Rack of unit 1",
        "CPU Unit and unit, off and on at once; RETAIN variables and the non-volatile memory stay", |v| CycleRackPower(v.units(0))),
    row("set the inputs of {unit} to {bytes}", "set the inputs of unit 1 to 01 02 03",
        "data to the master from the first byte on, unless the program writes them", |v| SetInputs(v.unit(0), v.bytes(1))),
    row("let the system time of {units} jump by {duration}", "let the system time of unit 1 jump by 1s",
        "ahead; object 10F8 and the time stamps follow", |v| JumpTime(v.units(0), v.duration(1))),
    row("write {variable} as {value}", "write N1_UINTs_01_C_to_M[0] as 5",
        "a device variable or an element of it, once; the program may write it again", |v| Write { variable: v.variable(0), value: v.text(1) }),
    row("force {variable} to {value}", "force N1_UINTs_01_C_to_M[0] to 5",
        "a device variable or an element of it has this value until it is released, whatever program and unit write",
        |v| Force { variable: v.variable(0), value: v.text(1) }),
    row("release {variable}", "release N1_UINTs_01_C_to_M[0]", "the value stays until it is written or refreshed",
        |v| Release(v.variable(0))),
    row("release all of {units}", "release all of unit 1", "everything that is forced", |v| ReleaseAll(v.units(0))),
    row("load {program} into {unit}", "load programs/a-3-3.st into unit 1",
        "replaces the user program in PROGRAM mode; what is forced stays, and what both programs declare with RETAIN",
        |v| Load { file: v.name(0), unit: v.unit(1) }),
];
