//! Raw links: the carrier is the link of port IN, and an interface may be removed and added again.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::process::Command;

use ectwin::Duration;
use testbed::{add_veth_pair, in_network_namespace, ip};

use crate::bench::{BRD, Master, Twin, UNIT, count, frame};

const DL_STATUS: u16 = 0x0110;
const LOST_LINKS_OF_PORT_IN: u16 = 0x0310;
/// `IN Port Link ON` of EtherCAT Slave Status.
const IN_PORT_LINK: u8 = 1 << 6;

/// The low byte of EtherCAT Slave Status, as in the CPU Unit.
fn slave_status(modbus: &mut TcpStream) -> u8 {
    // Read Discrete Inputs 0 to 7.
    modbus.write_all(&[0, 1, 0, 0, 0, 6, 1, 2, 0, 0, 0, 8]).unwrap();
    let mut answer = [0; 10];
    modbus.read_exact(&mut answer).unwrap();
    answer[9]
}

fn wait_for_link(modbus: &mut TcpStream, on: bool) {
    let is_so = |_| (slave_status(modbus) & IN_PORT_LINK != 0) == on;
    assert!((0..20_000).any(is_so), "IN Port Link ON does not become {on}");
}

#[test]
fn the_carrier_is_the_link_of_port_in() {
    in_network_namespace("interfaces::the_carrier_is_the_link_of_port_in", || {
        ip(&["link", "set", "lo", "up"]);
        add_veth_pair("m0", "u0");
        let twin = Twin::start("carrier", &["--link", "raw:u0", "--modbus", "0"]);
        let mut modbus = TcpStream::connect(twin.field("modbus")).unwrap();
        let mut master = Master::at("m0");
        assert_eq!(master.read::<1>(DL_STATUS)[0] & 0x10, 0x10);
        wait_for_link(&mut modbus, true);
        for lost in 1..=2 {
            // The master's end, then the unit's.
            let end = if lost == 1 { "m0" } else { "u0" };
            ip(&["link", "set", end, "down"]);
            wait_for_link(&mut modbus, false);
            ip(&["link", "set", end, "up"]);
            wait_for_link(&mut modbus, true);
            assert_eq!(master.read(LOST_LINKS_OF_PORT_IN), [lost]);
            assert_eq!(master.read::<1>(DL_STATUS)[0] & 0x10, 0x10);
        }
        let log = twin.end();
        assert_eq!(count(&log, "u0 has lost its carrier"), 2, "{log}");
        assert_eq!(count(&log, "u0 is up again after "), 2, "{log}");
    });
}

#[test]
fn a_unit_that_starts_without_a_carrier_has_no_link_at_port_in() {
    in_network_namespace("interfaces::a_unit_that_starts_without_a_carrier_has_no_link_at_port_in", || {
        ip(&["link", "set", "lo", "up"]);
        add_veth_pair("m0", "u0");
        ip(&["link", "set", "m0", "down"]);
        let twin = Twin::start("no-carrier", &["--link", "raw:u0", "--modbus", "0"]);
        let mut modbus = TcpStream::connect(twin.field("modbus")).unwrap();
        wait_for_link(&mut modbus, false);
        ip(&["link", "set", "m0", "up"]);
        wait_for_link(&mut modbus, true);
        let log = twin.end();
        assert_eq!(count(&log, "u0 has no carrier"), 1, "{log}");
    });
}

#[test]
fn an_interface_that_is_deleted_and_made_100_times_is_answered_every_time() {
    const TEST: &str = "interfaces::an_interface_that_is_deleted_and_made_100_times_is_answered_every_time";
    in_network_namespace(TEST, || {
        add_veth_pair("m0", "u0");
        let twin = Twin::start("deleted-and-made", &["--link", "raw:u0"]);
        for number in 0..100 {
            Master::at("m0").read::<1>(0);
            // Every second time the new interface exists before the command has missed the old one.
            let signals = (number % 2 == 0).then_some(["STOP", "CONT"]);
            signals.iter().for_each(|[stop, _]| twin.signal(stop));
            ip(&["link", "delete", "u0"]);
            add_veth_pair("m0", "u0");
            signals.iter().for_each(|[_, go_on]| twin.signal(go_on));
        }
        Master::at("m0").read::<1>(0);
        let log = twin.end();
        assert!(count(&log, "u0 is up again after ") > 0, "{log}");
    });
}

#[test]
fn a_second_ectwin_on_an_interface_is_refused() {
    in_network_namespace("interfaces::a_second_ectwin_on_an_interface_is_refused", || {
        add_veth_pair("m0", "u0");
        let first = Twin::start("first", &["--link", "raw:u0"]);
        let second =
            Command::new(env!("CARGO_BIN_EXE_ectwin")).args(["run", UNIT, "--link", "raw:u0"]).output();
        let second = second.unwrap();
        assert_eq!(second.status.code(), Some(3));
        let told = String::from_utf8_lossy(&second.stderr);
        assert!(told.contains("raw:u0 is in use\nhelp: another ectwin answers on this interface"), "{told}");
        Master::at("m0").read::<1>(0);
        // Killed: nothing of it remains.
        drop(first);
        Twin::start("next", &["--link", "raw:u0"]).end();
    });
}

#[test]
fn destroyed_frames_are_warned_of_once_a_kind_and_counted() {
    in_network_namespace("interfaces::destroyed_frames_are_warned_of_once_a_kind_and_counted", || {
        add_veth_pair("m0", "u0");
        let twin = Twin::start("destroyed", &["--link", "raw:u0"]);
        let mut master = Master::at("m0");
        let mut outside = frame(BRD, 0, [0; 4], &[0, 0]);
        // The datagram has more bytes than the length of the EtherCAT header.
        outside[22] = 40;
        for _ in 0..3 {
            assert!(master.send(&outside));
        }
        assert!(master.send(&outside[..15]));
        master.read::<1>(0);
        let log = twin.end();
        assert_eq!(count(&log, "a datagram ends behind its EtherCAT length; further ones"), 1, "{log}");
        assert_eq!(count(&log, "3 frames were destroyed in all, each because a datagram ends"), 1, "{log}");
        assert_eq!(count(&log, "it ends within the Ethernet or the EtherCAT header"), 1, "{log}");
        assert_eq!(count(&log, "destroyed=4 "), 1, "{log}");
    });
}

#[test]
fn a_vlan_tag_comes_back() {
    in_network_namespace("interfaces::a_vlan_tag_comes_back", || {
        add_veth_pair("m0", "u0");
        let twin = Twin::start("vlan", &["--link", "raw:u0"]);
        let mut master = Master::at("m0");
        let mut request = frame(BRD, 0, [0; 4], &[0, 0]);
        request.splice(12..12, [0x81, 0x00, 0x60, 0x05]);
        assert!(master.send(&request));
        let answer = master.receive(Duration::from_secs(10)).unwrap();
        assert_eq!((answer.len(), &answer[12..18]), (request.len(), &request[12..18]));
        // One unit has answered.
        assert_eq!(answer[answer.len() - 2], 1);
        twin.end();
    });
}
