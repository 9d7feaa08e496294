//! A real master meets faults of frames: it asks for each, and the line here has it.

use std::process::Command;

use ectwin::plant::line::LineOrder;
use ectwin::scenario::words::Spoken;
use ectwin::{Live, Setup, Twin};
use testbed::{MasterSide, add_veth_pair};

use crate::run::{top_folder, with_pysoem};

const UNIT: &str = "model = \"nx-ect101\"\n[cpu]\nprogram = \"builtin:copy\"";
const UNITS: usize = 3;

#[test]
fn pysoem_meets_lost_late_doubled_and_damaged_frames() {
    const TEST: &str = "faults::pysoem_meets_lost_late_doubled_and_damaged_frames";
    with_pysoem(TEST, |python| {
        add_veth_pair("m0", "u0");
        let units = Twin::power_on((0..UNITS).map(|_| Setup::from_toml(UNIT).unwrap()));
        let live = units.serve(ectwin::link::open(&"raw:u0".parse().unwrap()).unwrap()).unwrap();
        let mut command = Command::new(python);
        command.arg(top_folder().join("tests/masters/faults.py")).args(["m0", &UNITS.to_string()]);
        let mut master = MasterSide::start("m0", &command);
        while let Some(sentence) = master.next_line("fault ") {
            begin(&live, &sentence);
            master.say("at work");
        }
        assert_eq!(master.wait(), 0, "exit code of the master");
        live.stop().unwrap();
    });
}

/// Begins a fault. The one before is over by the time at which the master asks for the next.
fn begin(live: &Live, sentence: &str) {
    assert_eq!(live.faults(), [], "before: {sentence}");
    live.line_order(&LineOrder::from_sentence(sentence).unwrap()).unwrap();
}
