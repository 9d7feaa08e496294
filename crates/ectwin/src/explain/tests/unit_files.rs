//! Keys of the unit file, and the I/O ports that it allocates.

use super::{explained, subjects};
use crate::explain::{Subject, explain};

/// Unit files of the project.
const UNIT_FILES: [(&str, &str); 3] = [
    ("nx-ect101.toml", include_str!("../../../../../units/nx-ect101.toml")),
    ("nx-ect101-1200-bytes.toml", include_str!("../../../../../units/nx-ect101-1200-bytes.toml")),
    ("nx-ect101-mixed-520-bytes.toml", include_str!("../../../../../units/nx-ect101-mixed-520-bytes.toml")),
];

/// Every I/O port, its variable and its AT specification, of every unit file of the project.
#[test]
fn every_io_port_of_the_cpu_unit_is_explained() {
    for (file, text) in UNIT_FILES {
        let file =
            nx_ect101::unit_file::UnitFile::parse(text).unwrap_or_else(|errors| panic!("{file}: {errors}"));
        let variables = plc::DeviceVariables::of(file.variable_table());
        for (_, variable) in variables.iter() {
            let port = variable.port.as_ref().unwrap_or(&variable.name);
            for name in [Some(port), Some(&variable.name), variable.at.as_ref()].into_iter().flatten() {
                let known = subjects(name);
                let is_port = |subject: &Subject| matches!(subject, Subject::Port(known) if known == port);
                assert!(known.iter().any(is_port), "{name}: {known:?}");
            }
        }
    }
    assert!(explained("SDO Communications Enabled").contains("bit         0 of EtherCAT Slave Status"));
    assert!(
        explained("NX Unit I/O Data Active Status")
            .starts_with("I/O port NX Unit I/O Data Active Status: BOOL, programs read it")
    );
    assert!(explained("_NXB_UnitErrFlagTbl").contains("ARRAY[0..32] OF BOOL"));
    let entry = explained("UINTs 03 C to M");
    assert!(
        entry.contains("I/O port UINTs 03 C to M: ARRAY[0..14] OF UINT, programs read and write it"),
        "{entry}"
    );
    assert!(entry.contains("NX object 0x7000:03: UINTs 03 C to M"), "{entry}");
}

/// Every key of the reader, by its path and by its last word; a number alone is an object or an event.
#[test]
fn every_key_of_the_unit_file_is_explained() {
    let of_cpu = plc::CPU_KEYS.map(|key| format!("cpu.{key}"));
    for path in nx_ect101::unit_file::keys().into_iter().chain(of_cpu) {
        let last = path.rsplit_once('.').map_or(path.as_str(), |(_, last)| last);
        let is_number = last.starts_with(|first: char| first.is_ascii_digit());
        for name in [path.as_str(), if is_number { &path } else { last }] {
            let known = subjects(name);
            let is_key = |subject: &Subject| matches!(subject, Subject::Key(known) if *known == path);
            assert!(known.iter().any(is_key), "{name}: {known:?}");
        }
        assert!(explain(&path).unwrap().iter().all(|known| !known.name.is_empty()), "{path}: no words");
    }
    let fail_soft = explained("fail_soft");
    assert!(fail_soft.starts_with("key cpu.fail_soft: fail-soft operation of the NX bus"), "{fail_soft}");
    assert!(
        fail_soft.ends_with("  section     [cpu]\n  type, range true, false\n  default     true"),
        "{fail_soft}"
    );
    assert!(explained("outputs_before_op").contains("section     the top of the file"));
    assert!(explained("start_up").contains("\"300ms\" at each restart"));
    assert!(explained("times").ends_with("keys        transitions, sii, mailbox"));
    assert!(explained("assign").contains("keys        rx, tx"));
    assert!(explained("times.transitions.PS").contains("the request waits in AL control"));
    assert!(explained("pdo.mapping.1602").contains("section     [pdo]"));
}
