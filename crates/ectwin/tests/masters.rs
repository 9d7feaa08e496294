//! Real masters take units to OP through the built command, over a cable between two network namespaces.
//!
//! The scripts of the masters are in tests/masters. What a master sees is judged there; here the run is set
//! up, ended as a user ends it, and its capture read by tshark.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;

use testbed::{MasterSide, Process, add_veth_pair, has_program, in_network_namespace, python_with, skip};

/// Masters run in real time: two of them at once would disturb each other.
static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());

const MASTER_INTERFACE: &str = "m0";
const UNIT_INTERFACE: &str = "u0";

/// One run: the units of a line, and the script of the master with its arguments.
struct Run {
    test: &'static str,
    units: &'static [&'static str],
    script: &'static str,
    arguments: &'static [&'static str],
    /// Display filters of tshark that must match at least one frame each; without any, nothing is captured.
    visible: &'static [&'static str],
}

impl Run {
    /// Everything, or a skip that is counted.
    fn run(&self) {
        let _alone = ONE_AT_A_TIME.lock();
        let Some(python) = python_with("pysoem") else { return skip(self.test, "pysoem is not installed") };
        if !has_program("tshark") {
            return skip(self.test, "tshark is not installed");
        }
        in_network_namespace(self.test, || self.run_inside(&python));
    }

    fn run_inside(&self, python: &Path) {
        let capture = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{}.pcapng", self.test));
        add_veth_pair(MASTER_INTERFACE, UNIT_INTERFACE);
        let mut ectwin = Process::start(&mut self.ectwin(&capture));
        let link = format!("raw:{UNIT_INTERFACE}");
        let ready = ectwin.wait_for_line("ready ").to_string();
        assert_eq!(ready, format!("ready link={link} units={}", self.units.len()));

        let script = top_folder().join("tests/masters").join(self.script);
        let mut master = Command::new(python);
        master.arg(script).arg(MASTER_INTERFACE).args(self.arguments);
        let mut master = MasterSide::start(MASTER_INTERFACE, &master);
        assert_eq!(master.wait(), 0, "exit code of {}", self.script);

        ectwin.interrupt();
        let ended = ectwin.wait();
        assert_eq!(ended.code(), Some(0), "ectwin after SIGINT");
        self.read_capture(&capture);
    }

    fn ectwin(&self, capture: &Path) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ectwin"));
        command.arg("run").args(self.units.iter().map(|unit| top_folder().join("units").join(unit)));
        command.args(["--link", &format!("raw:{UNIT_INTERFACE}")]);
        if !self.visible.is_empty() {
            command.arg("--pcap").arg(capture);
        }
        command
    }

    fn read_capture(&self, capture: &Path) {
        if self.visible.is_empty() {
            return;
        }
        assert_eq!(count(capture, "_ws.malformed"), 0, "malformed frames in {}", capture.display());
        for filter in self.visible {
            assert!(count(capture, filter) > 0, "no frame matches `{filter}` in {}", capture.display());
        }
    }
}

fn top_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// How many frames of `capture` match the display filter, as tshark sees it.
fn count(capture: &Path, filter: &str) -> usize {
    let mut tshark = Command::new("tshark");
    tshark.arg("-r").arg(capture).args(["-Y", filter]).args(["-T", "fields", "-e", "frame.number"]);
    let output = tshark.output().unwrap_or_else(|error| panic!("tshark: {error}"));
    assert!(output.status.success(), "tshark: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8_lossy(&output.stdout).lines().count()
}

/// Datagrams of a start, the way to OP, process data answered, objects read and written.
const BRING_UP: &[&str] = &[
    "ecat.cmd == 0x07 && ecat.ado == 0x0000",
    "ecat.reg.alctrl.ctrl == 0x02",
    "ecat.reg.alstatus.status == 0x08",
    "ecat.cmd == 0x0c && ecat.cnt == 3",
    "ecat_mailbox.coe.sdoidx == 0x1c00",
    "ecat_mailbox.coe.sdoidx == 0x2002",
    "eth.src[0] & 2",
];

#[test]
fn pysoem_exchanges_20000_cycles_with_the_factory_setting() {
    Run {
        test: "pysoem_exchanges_20000_cycles_with_the_factory_setting",
        units: &["nx-ect101.toml"],
        script: "exchange.py",
        arguments: &["1", "factory", "20000"],
        visible: BRING_UP,
    }
    .run();
}

#[test]
fn pysoem_maps_1200_octets_in_each_direction() {
    Run {
        test: "pysoem_maps_1200_octets_in_each_direction",
        units: &["nx-ect101-1200-bytes.toml"],
        script: "exchange.py",
        arguments: &["1", "uint-maximum", "1000"],
        visible: &["ecat_mailbox.coe.sdoidx == 0x1601", "ecat_mailbox.coe.sdoidx == 0x1a01"],
    }
    .run();
}

#[test]
fn pysoem_maps_three_data_sets() {
    Run {
        test: "pysoem_maps_three_data_sets",
        units: &["nx-ect101-mixed-520-bytes.toml"],
        script: "exchange.py",
        arguments: &["1", "mixed", "1000"],
        visible: &["ecat_mailbox.coe.sdoidx == 0x1603", "ecat_mailbox.coe.sdoidx == 0x1c13"],
    }
    .run();
}

#[test]
fn pysoem_maps_outputs_and_inputs_to_the_same_logical_memory() {
    Run {
        test: "pysoem_maps_outputs_and_inputs_to_the_same_logical_memory",
        units: &["nx-ect101-1200-bytes.toml"],
        script: "exchange.py",
        arguments: &["1", "uint-maximum", "1000", "overlap"],
        visible: &["ecat.cmd == 0x0c && ecat.cnt == 3"],
    }
    .run();
}

#[test]
fn pysoem_reads_every_object_and_is_refused_what_it_must_be() {
    const TABLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../nx-ect101/tables/coe_objects.toml");
    Run {
        test: "pysoem_reads_every_object_and_is_refused_what_it_must_be",
        units: &["nx-ect101.toml"],
        script: "objects.py",
        arguments: &[TABLE],
        visible: &["ecat_mailbox.coe.sdoidx == 0x1018", "ecat_mailbox.coe.abortcode == 0x06020000"],
    }
    .run();
}

#[test]
fn pysoem_sends_messages_and_gets_each_of_them_back_once() {
    Run {
        test: "pysoem_sends_messages_and_gets_each_of_them_back_once",
        units: &["nx-ect101-messages.toml"],
        script: "messages.py",
        arguments: &["500"],
        visible: &["ecat_mailbox.coe.sdoidx == 0x3001", "ecat_mailbox.coe.abortcode == 0x08000021"],
    }
    .run();
}

/// So many that a lost or doubled one is found; a capture of them would be read for longer than it took.
#[test]
fn pysoem_sends_10000_messages_without_waiting_and_gets_each_of_them_back_once() {
    Run {
        test: "pysoem_sends_10000_messages_without_waiting_and_gets_each_of_them_back_once",
        units: &["../tests/masters/units/messages-fast.toml"],
        script: "messages.py",
        arguments: &["10000"],
        visible: &[],
    }
    .run();
}

#[test]
fn pysoem_exchanges_with_eight_units_in_a_line() {
    Run {
        test: "pysoem_exchanges_with_eight_units_in_a_line",
        units: &["nx-ect101.toml"; 8],
        script: "exchange.py",
        arguments: &["8", "factory", "2000"],
        // AL status read from the first and from the last station address, answered by one unit each.
        visible: &[
            "ecat.cmd == 0x04 && ecat.adp == 0x1001 && ecat.ado == 0x0130 && ecat.cnt == 1",
            "ecat.cmd == 0x04 && ecat.adp == 0x1008 && ecat.ado == 0x0130 && ecat.cnt == 1",
        ],
    }
    .run();
}

#[test]
fn pysoem_breaks_each_pdo_rule_and_corrects_it() {
    Run {
        test: "pysoem_breaks_each_pdo_rule_and_corrects_it",
        units: &["nx-ect101.toml"],
        script: "rules.py",
        arguments: &["pdo"],
        visible: &[
            "ecat.reg.alstatus.status == 0x02 && ecat.reg.alstatus.err == 1",
            "ecat.reg.alstatuscode == 0x0024",
            "ecat.reg.alstatuscode == 0x0025",
        ],
    }
    .run();
}

#[test]
fn pysoem_meets_units_that_break_each_io_entry_rule() {
    Run {
        test: "pysoem_meets_units_that_break_each_io_entry_rule",
        units: &[
            "../tests/masters/units/type-m-to-c.toml",
            "../tests/masters/units/type-c-to-m.toml",
            "../tests/masters/units/order-m-to-c.toml",
            "../tests/masters/units/order-c-to-m.toml",
            "../tests/masters/units/total-m-to-c.toml",
            "../tests/masters/units/total-c-to-m.toml",
        ],
        script: "rules.py",
        arguments: &["io", "6"],
        visible: &["ecat.reg.alstatus.status == 0x08"],
    }
    .run();
}

#[test]
fn pysoem_exchanges_four_entries_where_only_four_match() {
    Run {
        test: "pysoem_exchanges_four_entries_where_only_four_match",
        units: &["nx-ect101.toml", "../tests/masters/units/four-entries.toml"],
        script: "rules.py",
        arguments: &["partial"],
        visible: &["ecat_mailbox.coe.sdoidx == 0x1601", "ecat_mailbox.coe.sdoidx == 0x1a01"],
    }
    .run();
}
