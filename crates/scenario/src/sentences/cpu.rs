//! Sentences of the CPU Units.

use plc::OperatingMode;

use crate::orders::CpuOrder::{self, *};
use crate::sentence::{Sentence, row};

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
    row("set the inputs of {unit} to {bytes}", "set the inputs of unit 1 to 01 02 03",
        "data to the master from the first byte on, unless the program writes them", |v| SetInputs(v.unit(0), v.bytes(1))),
    row("let the system time of {units} jump by {duration}", "let the system time of unit 1 jump by 1s",
        "ahead; object 10F8 and the time stamps follow", |v| JumpTime(v.units(0), v.duration(1))),
];
