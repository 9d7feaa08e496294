//! Real interfaces: raw sockets over a veth pair, and TAP, in network namespaces that the tests make.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

use ectwin_link::{FRAME_BUFFER_BYTES, FramePort, OpenError, open};
use testbed::{add_veth_pair, in_network_namespace, ip, skip};
use time::Duration;

const SOON: Duration = Duration::from_secs(10);

fn open_link(name: &str) -> Box<dyn FramePort> {
    open(&name.parse().unwrap()).unwrap()
}

/// Takes the next frame, however often the port comes back early.
fn next(port: &mut dyn FramePort) -> Vec<u8> {
    let mut buffer = vec![0; FRAME_BUFFER_BYTES];
    for _ in 0..1000 {
        if let Some(length) = port.receive(&mut buffer, SOON).unwrap() {
            buffer.truncate(length);
            return buffer;
        }
    }
    panic!("no frame came");
}

/// A frame of `length` bytes that carries `ethertype`, from an address that ends in `from`.
fn frame(ethertype: u16, from: u8, length: usize) -> Vec<u8> {
    let mut frame = vec![0xFF; 6];
    frame.extend([0x10, 0, 0, 0, 0, from]);
    frame.extend(ethertype.to_be_bytes());
    frame.resize(length, 0x5A);
    frame
}

/// An IPv4 frame that carries UDP to `port`.
fn udp_frame(port: u16) -> Vec<u8> {
    let mut frame = frame(0x0800, 1, 60);
    frame[14] = 0x45;
    frame[20..22].fill(0);
    frame[23] = 17;
    frame[36..38].copy_from_slice(&port.to_be_bytes());
    frame
}

#[test]
fn frames_of_any_length_cross_a_raw_link_both_ways() {
    in_network_namespace("frames_of_any_length_cross_a_raw_link_both_ways", || {
        add_veth_pair("veth0", "veth1");
        let (mut master, mut unit) = (open_link("raw:veth0"), open_link("raw:veth1"));
        for length in [14, 15, 29, 60, 1000, 1514] {
            master.send(&frame(0x88A4, 1, length)).unwrap();
            assert_eq!(next(&mut unit), frame(0x88A4, 1, length));
            unit.send(&frame(0x88A4, 2, length)).unwrap();
            // What the master sent itself does not come back to it: the answer is the first thing it sees.
            assert_eq!(next(&mut master), frame(0x88A4, 2, length));
        }
    });
}

#[test]
fn a_raw_link_hears_ethercat_only_and_nothing_that_its_own_machine_sends() {
    let name = "a_raw_link_hears_ethercat_only_and_nothing_that_its_own_machine_sends";
    in_network_namespace(name, || {
        add_veth_pair("veth0", "veth1");
        let (mut master, mut unit) = (open_link("raw:veth0"), open_link("raw:veth1"));
        let mut neighbour = open_link("raw:veth1");
        neighbour.send(&frame(0x88A4, 9, 60)).unwrap();
        for unheard in [frame(0x0806, 1, 60), frame(0x86DD, 1, 60), udp_frame(53), frame(0x0800, 1, 60)] {
            master.send(&unheard).unwrap();
        }
        master.send(&udp_frame(34980)).unwrap();
        master.send(&frame(0x88A4, 1, 60)).unwrap();
        assert_eq!(next(&mut unit), udp_frame(34980));
        assert_eq!(next(&mut unit), frame(0x88A4, 1, 60));
    });
}

#[test]
fn a_cable_that_is_pulled_and_put_back_works_again() {
    in_network_namespace("a_cable_that_is_pulled_and_put_back_works_again", || {
        add_veth_pair("veth0", "veth1");
        let (mut master, mut unit) = (open_link("raw:veth0"), open_link("raw:veth1"));
        ip(&["link", "set", "veth1", "down"]);
        assert_eq!(unit.receive(&mut [0; FRAME_BUFFER_BYTES], SOON).unwrap(), None);
        ip(&["link", "set", "veth1", "up"]);
        master.send(&frame(0x88A4, 1, 60)).unwrap();
        assert_eq!(next(&mut unit), frame(0x88A4, 1, 60));
    });
}

#[test]
fn an_interface_that_is_gone_and_comes_back_works_again() {
    in_network_namespace("an_interface_that_is_gone_and_comes_back_works_again", || {
        add_veth_pair("veth0", "veth1");
        let mut unit = open_link("raw:veth1");
        ip(&["link", "delete", "veth1"]);
        let mut buffer = [0; FRAME_BUFFER_BYTES];
        // Once to see that it is gone, once to look for it.
        for _ in 0..2 {
            assert_eq!(unit.receive(&mut buffer, Duration::from_millis(1)).unwrap(), None);
        }
        assert!(unit.send(&frame(0x88A4, 2, 60)).is_err());
        add_veth_pair("veth0", "veth1");
        assert_eq!(unit.receive(&mut buffer, SOON).unwrap(), None);
        open_link("raw:veth0").send(&frame(0x88A4, 1, 60)).unwrap();
        assert_eq!(next(&mut unit), frame(0x88A4, 1, 60));
    });
}

#[test]
fn a_master_on_a_tap_interface_talks_to_the_unit() {
    let name = "a_master_on_a_tap_interface_talks_to_the_unit";
    in_network_namespace(name, || {
        let mut unit = match open(&"tap:ect0".parse().unwrap()) {
            Ok(unit) => unit,
            Err(error) => return skip(name, &error.to_string()),
        };
        let mut master = open_link("raw:ect0");
        master.send(&frame(0x88A4, 1, 29)).unwrap();
        assert_eq!(next(&mut unit), frame(0x88A4, 1, 29));
        unit.send(&frame(0x88A4, 2, 1514)).unwrap();
        assert_eq!(next(&mut master), frame(0x88A4, 2, 1514));
        let second = open(&"tap:ect0".parse().unwrap()).err().unwrap();
        assert!(matches!(second, OpenError::InUse { .. }), "{second}");
    });
}

#[test]
fn an_interface_that_does_not_exist_is_named_beside_those_that_do() {
    let error = open(&"raw:no-such-if0".parse().unwrap()).err().unwrap();
    assert_eq!(error.to_string(), "there is no network interface \"no-such-if0\"");
    assert!(error.help().contains("lo"), "{}", error.help());
}
