//! Events with real masters: on every channel while process data are exchanged, after power-off, without a memory.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use nx_ect101::{ErrorLog, EventCode, NonVolatileMemory};

use crate::run::{Line, Run, top_folder, with_pysoem};

const UNIT: &str = "model = \"nx-ect101\"\nstorage = \"N1.nvm\"\n";
const MEMORY_ERROR: EventCode = EventCode(0x0020_0000);
/// The memory is stored soon after a change, without other code waiting for it.
const PATIENCE: Duration = Duration::from_secs(10);

#[test]
fn pysoem_is_told_of_an_event_on_every_channel_while_process_data_run() {
    Run {
        test: "events::pysoem_is_told_of_an_event_on_every_channel_while_process_data_run",
        units: &["../tests/masters/units/mismatch.toml"],
        script: "events.py",
        arguments: &["told"],
        visible: &[
            "ecat_mailbox.coe.type == 1 && eth.src[0] & 2",
            "ecat_mailbox.coe.sdoidx == 0x10f3",
            "ecat_mailbox.coe.sdoidx == 0x2003",
            "ecat_mailbox.coe.sdoidx == 0x2004",
            "ecat_mailbox.coe.abortcode == 0x06090030",
        ],
    }
    .run();
}

/// A unit with a file for its memory, in a separate folder.
struct Unit {
    folder: PathBuf,
}

impl Unit {
    fn new(name: &str) -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        let _gone = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        fs::write(folder.join("unit.toml"), UNIT).unwrap();
        Self { folder }
    }

    fn memory(&self) -> PathBuf {
        self.folder.join("N1.nvm")
    }

    /// Power on, the script of the master, and a signal that ends everything.
    fn run(&self, cable: usize, python: &Path, arguments: &[&str], signal: &str) {
        let line = Line::start(cable, &[self.folder.join("unit.toml")], None);
        line.run_master(python, "events.py", arguments);
        if signal == "KILL" {
            // The contents of the disk are those after a power failure.
            self.wait_for_log(|log| log.system.is_full() && log.system.acknowledged);
        }
        let ended = line.end(signal);
        assert_eq!(ended, if signal == "KILL" { None } else { Some(0) }, "ectwin after SIG{signal}");
    }

    fn log(&self) -> ErrorLog {
        let stored = fs::read(self.memory()).unwrap();
        NonVolatileMemory::decode(&stored).unwrap().error_log().clone()
    }

    fn wait_for_log(&self, is_wanted: impl Fn(&ErrorLog) -> bool) {
        let begin = Instant::now();
        while !is_wanted(&self.log()) {
            assert!(begin.elapsed() < PATIENCE, "not stored: {:?}", self.log());
            std::thread::yield_now();
        }
    }
}

#[test]
fn the_history_that_pysoem_reads_outlives_power_off_and_a_kill() {
    with_pysoem("events::the_history_that_pysoem_reads_outlives_power_off_and_a_kill", |python| {
        let mut cables = 0..;
        let mut run = |unit: &Unit, arguments: &[&str], signal| {
            unit.run(cables.next().unwrap(), python, arguments, signal);
        };
        for signal in ["TERM", "KILL"] {
            let unit = Unit::new(&format!("history-{signal}"));
            let history = unit.folder.join("history.json");
            let history = history.to_str().unwrap();
            run(&unit, &["cause", history], signal);
            let stored = unit.log();
            run(&unit, &["compare", history], "TERM");
            run(&unit, &["compare", history], "TERM");
            assert_eq!(unit.log(), stored, "a start by itself changes nothing");
        }
    });
}

#[test]
fn a_unit_without_memory_says_so_to_pysoem_and_in_no_log() {
    with_pysoem("events::a_unit_without_memory_says_so_to_pysoem_and_in_no_log", |python| {
        let unit = Unit::new("without-memory");
        let empty = unit.folder.join("empty.json");
        let empty = empty.to_str().unwrap();
        unit.run(0, python, &["remember", empty], "TERM");
        let mut damaged = fs::read(unit.memory()).unwrap();
        damaged[200] ^= 1;
        fs::write(unit.memory(), &damaged).unwrap();

        unit.run(1, python, &["damaged"], "TERM");
        assert!(!unit.memory().exists(), "a unit with a damaged memory stores nothing");
        assert_eq!(fs::read(unit.folder.join("N1.nvm.damaged-1")).unwrap(), damaged, "set aside");

        unit.run(2, python, &["compare", empty], "TERM");
        let log = unit.log();
        let mut records = log.system.iter().chain(&log.access);
        assert!(!records.any(|record| record.event == MEMORY_ERROR), "{log:?}");
    });
}

#[test]
fn what_happens_with_pysoem_is_written_as_json_lines() {
    with_pysoem("events::what_happens_with_pysoem_is_written_as_json_lines", |python| {
        let lines = Path::new(env!("CARGO_TARGET_TMPDIR")).join("what-happens-with-pysoem.jsonl");
        let unit = top_folder().join("tests/masters/units/mismatch.toml");
        let line = Line::start_with(0, &[unit], None, &["-vv", "--events", lines.to_str().unwrap()]);
        line.run_master(python, "events.py", &["told"]);
        assert_eq!(line.end("TERM"), Some(0), "ectwin after SIGTERM");
        let text = fs::read_to_string(&lines).unwrap();
        let records: Vec<serde_json::Value> =
            text.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
        let of = |kind: &'static str| records.iter().filter(move |record| record["kind"] == kind);
        let kinds: BTreeSet<&str> = records.iter().filter_map(|record| record["kind"].as_str()).collect();
        let expected = [
            "ready",
            "unit",
            "finding",
            "master",
            "state",
            "sdo",
            "message",
            "mapping",
            "event",
            "emergency",
            "indicator",
        ];
        assert!(expected.iter().all(|kind| kinds.contains(kind)), "{kinds:?}");
        let states: BTreeSet<&str> = of("state").filter_map(|record| record["to"].as_str()).collect();
        assert!(["PRE-OP", "SAFE-OP", "OP"].iter().all(|state| states.contains(state)), "{states:?}");
        assert!(of("event").any(|record| record["event"] == "39170000"), "the mismatch");
        assert!(of("emergency").any(|record| record["error_code"] == "0xFF30"), "its emergency");
        assert!(of("sdo").any(|record| record["abort_code"] == "0x06090030"), "an aborted SDO");
        // A CPU Unit reports at most once a second.
        let others = records.iter().filter(|record| record["kind"] != "cpu");
        let times: Vec<u64> = others.filter_map(|record| record["at_ns"].as_u64()).collect();
        assert!(times.is_sorted(), "in the order of their times: {times:?}");
    });
}
