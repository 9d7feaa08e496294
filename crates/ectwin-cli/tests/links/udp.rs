//! UDP links: actual ports in the line `ready`, and forged senders.

use std::net::{SocketAddr, TcpStream, UdpSocket};

use socket2::{Domain, Protocol, SockAddr, Socket, Type};
use testbed::{in_network_namespace, ip};

use crate::bench::{BRD, Twin, count, count_units, datagram};

#[test]
fn the_line_ready_names_the_real_ports_so_that_tests_run_beside_each_other() {
    let arguments = ["--link", "udp:127.0.0.1:0", "--modbus", "0"];
    let twins = ["ready-one", "ready-other"].map(|name| Twin::start(name, &arguments));
    let master = UdpSocket::bind("127.0.0.1:0").unwrap();
    for twin in twins {
        let (link, modbus) = (twin.field("link"), twin.field("modbus"));
        assert_eq!(twin.ready, format!("ready link={link} units=1 modbus={modbus}"));
        assert_eq!(count_units(&master, twin.udp()), 1);
        TcpStream::connect(modbus).unwrap();
        twin.end();
    }
}

#[test]
fn a_destroyed_datagram_is_logged_with_its_own_length() {
    let twin = Twin::start("odd-datagrams", &["--link", "udp:127.0.0.1:0"]);
    let master = UdpSocket::bind("127.0.0.1:0").unwrap();
    for length_bytes in [1, 1505, 9000] {
        master.send_to(&vec![0x10; length_bytes], twin.udp()).unwrap();
    }
    // It is answered after them.
    assert_eq!(count_units(&master, twin.udp()), 1);
    let log = twin.end();
    for words in [
        "a UDP datagram of 1 bytes was destroyed: it ends within the EtherCAT header",
        "a UDP datagram of 1505 bytes was destroyed: it is longer than 1,504 bytes",
        "2 frames were destroyed in all, each because it is longer than 1,504 bytes",
    ] {
        assert_eq!(count(&log, words), 1, "`{words}` is not in:\n{log}");
    }
}

/// Sends a datagram whose sender is `from`.
fn forge(from: SocketAddr, to: SocketAddr, payload: &[u8]) {
    let mut bytes = from.port().to_be_bytes().to_vec();
    bytes.extend(to.port().to_be_bytes());
    bytes.extend((8 + payload.len() as u16).to_be_bytes());
    // No checksum.
    bytes.extend([0, 0]);
    bytes.extend(payload);
    let socket = Socket::new(Domain::IPV4, Type::RAW, Some(Protocol::UDP)).unwrap();
    socket.bind(&SockAddr::from(SocketAddr::new(from.ip(), 0))).unwrap();
    socket.send_to(&bytes, &SockAddr::from(SocketAddr::new(to.ip(), 0))).unwrap();
}

#[test]
fn a_forged_sender_makes_no_two_units_answer_each_other_and_none_itself() {
    const TEST: &str = "udp::a_forged_sender_makes_no_two_units_answer_each_other_and_none_itself";
    in_network_namespace(TEST, || {
        ip(&["link", "set", "lo", "up"]);
        let links = ["udp:127.0.0.1:34980", "udp:127.0.0.2:34980", "udp:127.0.0.1:5000"];
        let twins = links.map(|link| Twin::start(&link.replace([':', '.'], "-"), &["--link", link]));
        let addresses = twins.each_ref().map(Twin::udp);
        // Frames that change on their way, and frames that do not: no unit has station address 7.
        for payload in [datagram(BRD, 0, [0; 4], &[0, 0]), datagram(4, 0, [7, 0, 0, 0], &[0, 0])] {
            for from in addresses {
                forge(from, addresses[0], &payload);
            }
        }
        // A master on another machine may use the port of EtherCAT itself.
        let master = UdpSocket::bind("127.0.0.3:34980").unwrap();
        for address in addresses {
            assert_eq!(count_units(&master, address), 1);
        }
        // Two forged ones from each of the two others, and the master's.
        let logs = twins.map(Twin::end);
        for (log, frames) in logs.iter().zip([5, 1, 1]) {
            assert_eq!(count(log, &format!("frames={frames} ")), 1, "{log}");
        }
    });
}
