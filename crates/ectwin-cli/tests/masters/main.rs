//! Real masters take units to OP through the built command, over a cable between two network namespaces.
//!
//! The scripts of the masters are in tests/masters. They check what a master sees; here the run is set up,
//! ended like by a user, and its capture read with tshark.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

mod events;
mod faults;
mod import;
mod judge;
mod modbus;
mod programs;
mod run;
mod terminals;

use run::Run;

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
fn pysoem_maps_1200_bytes_in_each_direction() {
    Run {
        test: "pysoem_maps_1200_bytes_in_each_direction",
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

/// Enough to detect a lost or duplicate one; reading a capture of them would take longer than the run.
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

/// The script also shows that one search is not sufficient; the page recommends its function `ready_units`.
#[test]
fn pysoem_waits_for_units_that_are_not_ready() {
    let page = read("docs/user/test-your-master.md");
    let script = read("tests/masters/start_up.py");
    let advice = script.split("\n\n\n").find(|part| part.starts_with("def ready_units("));
    assert!(page.contains(advice.unwrap()), "docs/user/test-your-master.md has another ready_units");
    Run {
        test: "pysoem_waits_for_units_that_are_not_ready",
        units: &["../tests/masters/units/start-up.toml"; 2],
        script: "start_up.py",
        arguments: &["2"],
        // A request for PRE-OP that a unit did not accept.
        visible: &["ecat.reg.alctrl.ctrl == 0x02 && ecat.cnt == 0 && eth.src[0] & 2"],
    }
    .run();
}

fn read(path: &str) -> String {
    std::fs::read_to_string(run::top_folder().join(path)).unwrap()
}
