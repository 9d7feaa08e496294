//! Real interfaces: raw sockets over a veth pair, and TAP, in network namespaces that the tests create.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

use ectwin_link::{FRAME_BUFFER_BYTES, FramePort, OpenError, open};
use testbed::{add_veth_pair, in_network_namespace, ip, skip};
use time::Duration;

const SOON: Duration = Duration::from_secs(10);

fn open_link(name: &str) -> Box<dyn FramePort> {
    let mut port = open(&name.parse().unwrap()).unwrap();
    port.begin().unwrap();
    port
}

/// Another program of the machine that has the interface open.
fn channel_at(
    name: &str,
) -> (Box<dyn pnet_datalink::DataLinkSender>, Box<dyn pnet_datalink::DataLinkReceiver>) {
    let interface = pnet_datalink::interfaces().into_iter().find(|interface| interface.name == name).unwrap();
    match pnet_datalink::channel(&interface, pnet_datalink::Config::default()).unwrap() {
        pnet_datalink::Channel::Ethernet(sender, receiver) => (sender, receiver),
        _ => panic!("{name} is no Ethernet"),
    }
}

fn is_from(from: u8, frame: &[u8]) -> bool {
    frame.get(6..14) == Some(&[0x10, 0, 0, 0, 0, from, 0x88, 0xA4])
}

/// Checks the port until `agrees` is true, without a time limit.
fn wait_until(port: &mut dyn FramePort, agrees: impl Fn(&dyn FramePort) -> bool) {
    let mut buffer = vec![0; FRAME_BUFFER_BYTES];
    for _ in 0..10_000 {
        if agrees(port) {
            return;
        }
        port.receive(&mut buffer, Duration::from_millis(1)).unwrap();
    }
    panic!("it does not come");
}

/// Receives the next frame, however often the port returns early.
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

/// Sends repeatedly, as a master does: frames are lost while the kernel still sets an interface up, or before
/// the port has detected a new one.
fn send_until_it_arrives(master: &mut Box<dyn FramePort>, unit: &mut Box<dyn FramePort>, request: &[u8]) {
    let mut buffer = [0; FRAME_BUFFER_BYTES];
    let arrives = |_| {
        let _refused_while_down = master.send(request);
        let received = unit.receive(&mut buffer, Duration::from_millis(1)).unwrap();
        received.is_some_and(|length| &buffer[..length] == request)
    };
    assert!((0..10_000).any(arrives), "no frame arrives");
}

/// A frame of `length` bytes with the EtherType `ethertype`, from an address that ends in `from`.
fn frame(ethertype: u16, from: u8, length: usize) -> Vec<u8> {
    let mut frame = vec![0xFF; 6];
    frame.extend([0x10, 0, 0, 0, 0, from]);
    frame.extend(ethertype.to_be_bytes());
    frame.resize(length, 0x5A);
    frame
}

/// An IPv4 frame with UDP to `port`.
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
            // The frames that the master sent do not return to it: the answer is the first frame that it receives.
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
        channel_at("veth1").0.send_to(&frame(0x88A4, 9, 60), None).unwrap().unwrap();
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
fn a_vlan_tag_arrives_with_its_frame_and_goes_back_with_the_answer() {
    in_network_namespace("a_vlan_tag_arrives_with_its_frame_and_goes_back_with_the_answer", || {
        add_veth_pair("veth0", "veth1");
        let (mut master, mut unit) = (open_link("raw:veth0"), open_link("raw:veth1"));
        let tags = [[0x81, 0x00, 0xA0, 100], [0x81, 0x00, 0xE0, 0], [0x88, 0xA8, 0x0F, 0xFF]];
        for (tag, length) in tags.into_iter().zip([1514, 29, 60]) {
            let [mut request, mut answer] = [1, 2].map(|from| frame(0x88A4, from, length));
            request.splice(12..12, tag);
            answer.splice(12..12, tag);
            // The kernel removes the tag on receipt at both ends.
            master.send(&request).unwrap();
            assert_eq!(next(&mut unit), request);
            unit.send(&answer).unwrap();
            assert_eq!(next(&mut master), answer);
        }
        // Frames without a tag are unchanged.
        channel_at("veth0").0.send_to(&frame(0x88A4, 3, 60), None).unwrap().unwrap();
        assert_eq!(next(&mut unit), frame(0x88A4, 3, 60));
    });
}

#[test]
fn a_cable_that_is_pulled_and_put_back_works_again() {
    in_network_namespace("a_cable_that_is_pulled_and_put_back_works_again", || {
        add_veth_pair("veth0", "veth1");
        let (mut master, mut unit) = (open_link("raw:veth0"), open_link("raw:veth1"));
        assert!(unit.carrier());
        ip(&["link", "set", "veth1", "down"]);
        wait_until(&mut unit, |unit| !unit.carrier());
        ip(&["link", "set", "veth1", "up"]);
        wait_until(&mut unit, |unit| unit.carrier());
        send_until_it_arrives(&mut master, &mut unit, &frame(0x88A4, 1, 60));
    });
}

#[test]
fn the_carrier_goes_with_the_other_end_of_the_cable_and_a_frame_proves_it() {
    in_network_namespace("the_carrier_goes_with_the_other_end_of_the_cable_and_a_frame_proves_it", || {
        add_veth_pair("veth0", "veth1");
        let (mut master, mut unit) = (open_link("raw:veth0"), open_link("raw:veth1"));
        for number in 0..10 {
            ip(&["link", "set", "veth0", "down"]);
            wait_until(&mut unit, |unit| !unit.carrier());
            ip(&["link", "set", "veth0", "up"]);
            // However late the notice of the carrier arrives.
            send_until_it_arrives(&mut master, &mut unit, &frame(0x88A4, number, 60));
            assert!(unit.carrier());
        }
    });
}

#[test]
fn an_interface_that_is_deleted_and_made_again_is_answered_every_time() {
    in_network_namespace("an_interface_that_is_deleted_and_made_again_is_answered_every_time", || {
        add_veth_pair("veth0", "veth1");
        let mut unit = open_link("raw:veth1");
        for number in 0..100 {
            ip(&["link", "delete", "veth1"]);
            if number % 2 == 0 {
                // Otherwise the new interface exists before the old one is missed.
                wait_until(&mut unit, |unit| !unit.carrier());
                assert!(unit.send(&frame(0x88A4, 2, 60)).is_err());
            }
            add_veth_pair("veth0", "veth1");
            let mut master = open_link("raw:veth0");
            send_until_it_arrives(&mut master, &mut unit, &frame(0x88A4, number, 60));
            unit.send(&frame(0x88A4, 200, 60)).unwrap();
            assert_eq!(next(&mut master), frame(0x88A4, 200, 60));
        }
    });
}

#[test]
fn an_interface_that_has_another_name_is_left_as_it_was() {
    in_network_namespace("an_interface_that_has_another_name_is_left_as_it_was", || {
        let is_promiscuous = |name: &str| {
            let shown = std::process::Command::new("ip").args(["-d", "link", "show", name]).output().unwrap();
            let shown = String::from_utf8(shown.stdout).unwrap();
            assert!(shown.contains("promiscuity "), "{shown}");
            !shown.contains("promiscuity 0 ")
        };
        add_veth_pair("veth0", "veth1");
        let mut unit = open_link("raw:veth1");
        assert!(is_promiscuous("veth1"));
        ip(&["link", "set", "veth1", "down"]);
        ip(&["link", "set", "veth1", "name", "other"]);
        wait_until(&mut unit, |unit| !unit.carrier());
        add_veth_pair("veth2", "veth1");
        wait_until(&mut unit, |unit| unit.carrier());
        assert!(is_promiscuous("veth1") && !is_promiscuous("other"));
    });
}

#[test]
fn an_interface_answers_to_one_port_alone_as_long_as_that_lives() {
    in_network_namespace("an_interface_answers_to_one_port_alone_as_long_as_that_lives", || {
        add_veth_pair("veth0", "veth1");
        let unit = open_link("raw:veth1");
        let second = open(&"raw:veth1".parse().unwrap()).err().unwrap();
        assert!(matches!(second, OpenError::InUse { .. }), "{second}");
        assert!(second.help().contains("another ectwin"), "{}", second.help());
        let _other_interface = open_link("raw:veth0");
        drop(unit);
        let _next = open_link("raw:veth1");
    });
}

#[test]
fn frames_that_the_kernel_has_no_room_for_are_counted() {
    in_network_namespace("frames_that_the_kernel_has_no_room_for_are_counted", || {
        add_veth_pair("veth0", "veth1");
        let (mut master, mut unit) = (open_link("raw:veth0"), open_link("raw:veth1"));
        // More than 16 MiB, which is what the kernel makes of 8 MiB.
        const SENT: u64 = 40_000;
        for _ in 0..SENT {
            master.send(&frame(0x88A4, 1, 1514)).unwrap();
        }
        let mut buffer = vec![0; FRAME_BUFFER_BYTES];
        let mut received = 0;
        while unit.receive(&mut buffer, Duration::from_millis(100)).unwrap().is_some() {
            received += 1;
        }
        assert!(unit.dropped() > 0);
        assert!(received + unit.dropped() <= SENT);
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
        let (mut to_unit, mut from_unit) = channel_at("ect0");
        to_unit.send_to(&frame(0x88A4, 1, 29), None).unwrap().unwrap();
        assert_eq!(next(&mut unit), frame(0x88A4, 1, 29));
        unit.send(&frame(0x88A4, 2, 1000)).unwrap();
        let answer = std::iter::repeat_with(|| from_unit.next().unwrap().to_vec());
        assert_eq!({ answer }.find(|frame| is_from(2, frame)), Some(frame(0x88A4, 2, 1000)));
        let second = open(&"tap:ect0".parse().unwrap()).err().unwrap();
        assert!(matches!(second, OpenError::InUse { .. }), "{second}");
    });
}

#[test]
fn an_interface_is_answered_by_one_ectwin_even_if_it_is_the_tap_interface_of_another() {
    let name = "an_interface_is_answered_by_one_ectwin_even_if_it_is_the_tap_interface_of_another";
    in_network_namespace(name, || {
        let unit = match open(&"tap:ect0".parse().unwrap()) {
            Ok(unit) => unit,
            Err(error) => return skip(name, &error.to_string()),
        };
        let refused = open(&"raw:ect0".parse().unwrap()).err().unwrap();
        assert_eq!(refused.to_string(), "raw:ect0 is in use");
        assert!(refused.help().contains("the other end of this TAP interface"), "{}", refused.help());
        drop(unit);
        // One that stays without a user, so that a raw link can have it.
        ip(&["tuntap", "add", "dev", "ect0", "mode", "tap"]);
        let _unit = open_link("raw:ect0");
        let refused = open(&"tap:ect0".parse().unwrap()).err().unwrap();
        assert!(matches!(refused, OpenError::InUse { .. }), "{refused}");
    });
}

#[test]
fn an_interface_without_ethernet_frames_is_refused_with_what_it_needs() {
    let name = "an_interface_without_ethernet_frames_is_refused_with_what_it_needs";
    in_network_namespace(name, || {
        if let Err(error) = open(&"tap:ect0".parse().unwrap()) {
            return skip(name, &error.to_string());
        }
        ip(&["tuntap", "add", "dev", "tun0", "mode", "tun"]);
        let refused = open(&"raw:tun0".parse().unwrap()).err().unwrap();
        assert!(matches!(refused, OpenError::NotEthernet { .. }), "{refused}");
        assert!(refused.to_string().contains("tun0 has no Ethernet frames"), "{refused}");
        assert!(refused.help().contains("tap:ect0"), "{}", refused.help());
    });
}

#[test]
fn an_interface_that_does_not_exist_is_named_beside_those_that_do() {
    let error = open(&"raw:no-such-if0".parse().unwrap()).err().unwrap();
    assert_eq!(error.to_string(), "there is no network interface \"no-such-if0\"");
    assert!(error.help().contains("lo"), "{}", error.help());
}

#[test]
fn a_loopback_interface_is_refused_with_what_works() {
    in_network_namespace("a_loopback_interface_is_refused_with_what_works", || {
        let error = open(&"raw:lo".parse().unwrap()).err().unwrap();
        assert!(matches!(error, OpenError::Loopback { .. }), "{error}");
        assert!(error.to_string().contains("lo is a loopback interface"), "{error}");
        for instead in ["udp:127.0.0.1", "tap:ect0", "type veth"] {
            assert!(error.help().contains(instead), "{}", error.help());
        }
    });
}

#[test]
fn a_tap_interface_that_is_deleted_is_named() {
    let name = "a_tap_interface_that_is_deleted_is_named";
    in_network_namespace(name, || {
        let mut unit = match open(&"tap:ect0".parse().unwrap()) {
            Ok(unit) => unit,
            Err(error) => return skip(name, &error.to_string()),
        };
        ip(&["link", "delete", "ect0"]);
        let error = unit.receive(&mut [0; FRAME_BUFFER_BYTES], SOON).unwrap_err();
        assert_eq!(
            error.to_string(),
            "the interface ect0 was deleted; start again with tap:ect0 to create it again"
        );
    });
}
