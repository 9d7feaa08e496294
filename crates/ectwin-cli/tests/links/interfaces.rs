//! Raw links: the carrier is the link of port IN, and an interface may be removed and added again.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::process::Command;

use ectwin::Duration;
use testbed::{add_veth_pair, in_network_namespace, ip};

use crate::bench::{BRD, LRW, Master, Twin, UNIT, count, frame};

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
        assert_eq!(count(&log, "a datagram exceeds its EtherCAT length; further ones"), 1, "{log}");
        assert_eq!(
            count(&log, "3 frames were destroyed in all, each because a datagram exceeds"),
            1,
            "{log}"
        );
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

#[test]
fn two_ectwins_at_both_ends_of_a_cable_do_not_answer_each_other() {
    in_network_namespace("interfaces::two_ectwins_at_both_ends_of_a_cable_do_not_answer_each_other", || {
        add_veth_pair("m0", "u0");
        let [one, other] = ["m0", "u0"].map(|end| Twin::start(end, &["--link", &format!("raw:{end}")]));
        let mut cable = sender_at("m0");
        for first_of_address in [0x10, 0x02] {
            let mut request = frame(BRD, 0, [0; 4], &[0, 0]);
            request[6] = first_of_address;
            cable.send_to(&request, None).unwrap().unwrap();
        }
        one.wait_for("a slave has already answered it");
        let [one, other] = [one, other].map(Twin::end);
        assert_eq!(count(&one, "frames=2 destroyed=2 "), 1, "{one}");
        assert_eq!(count(&other, "frames=2 destroyed=0 "), 1, "{other}");
    });
}

/// Another program of the machine that has the interface open for sending.
fn sender_at(name: &str) -> Box<dyn pnet_datalink::DataLinkSender> {
    let interface = pnet_datalink::interfaces().into_iter().find(|interface| interface.name == name).unwrap();
    match pnet_datalink::channel(&interface, pnet_datalink::Config::default()).unwrap() {
        pnet_datalink::Channel::Ethernet(sender, _) => sender,
        _ => panic!("{name} is no Ethernet"),
    }
}

#[test]
fn a_master_with_a_locally_administered_address_is_served() {
    in_network_namespace("interfaces::a_master_with_a_locally_administered_address_is_served", || {
        add_veth_pair("m0", "u0");
        let twin = Twin::start("local-address", &["--link", "raw:u0"]);
        let mut master = Master::at("m0");
        // A unit answers the one, no unit the other.
        for (command, working_counter) in [(BRD, 1), (LRW, 0)] {
            let mut request = frame(command, 0, [0; 4], &[0, 0]);
            request[6] = 0x02;
            for _ in 0..50 {
                assert!(master.send(&request));
                let answer = master.receive(Duration::from_secs(10)).unwrap();
                assert_eq!(answer[28], working_counter);
            }
        }
        let log = twin.end();
        assert_eq!(count(&log, "destroyed=0 "), 1, "{log}");
    });
}

#[test]
fn the_log_names_an_interface_that_is_renamed_or_deleted_and_the_receive_buffer() {
    const TEST: &str =
        "interfaces::the_log_names_an_interface_that_is_renamed_or_deleted_and_the_receive_buffer";
    in_network_namespace(TEST, || {
        add_veth_pair("m0", "u0");
        let twin = Twin::start("renamed", &["--link", "raw:u0"]);
        ip(&["link", "set", "u0", "down"]);
        twin.wait_for("u0 has lost its carrier");
        ip(&["link", "set", "u0", "name", "u9"]);
        twin.wait_for("u0 is gone: it has the name u9 now");
        ip(&["link", "set", "u9", "name", "u0"]);
        ip(&["link", "set", "u0", "up"]);
        twin.wait_for("u0 is up again after ");
        ip(&["link", "delete", "u0"]);
        twin.wait_for("u0 is gone; waiting for an interface of this name");
        let log = twin.end();
        assert_eq!(count(&log, "the receive buffer has "), 1, "{log}");
    });
}
