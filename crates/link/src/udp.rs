//! EtherCAT in UDP through an ordinary socket: no root, any machine.

use std::io;
use std::net::{SocketAddr, UdpSocket};
use std::task::Waker;

use socket2::SockRef;
use time::Duration;

use crate::descriptor::receive_from;
use crate::filter::{ANSWER_TOS, NO_ANSWERS, no_answers_and_nothing_from};
use crate::wake_event::WakeEvent;
use crate::{Envelope, FramePort, LinkSpec, OpenError};

/// The Ethernet header with which the segment sees the UDP payload: broadcast, from an address without a
/// manufacturer. The socket does not report the actual headers, and an ESC uses only the source address, which
/// it marks.
const HEADER: [u8; 14] = [0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0x10, 0, 0, 0, 0, 0, 0x88, 0xA4];

/// A UDP socket; answers go to the sender of the last frame.
///
/// Answers are marked in their IP header, and the kernel drops marked datagrams: otherwise two units, or one
/// unit with itself, would answer each other's answers endlessly after one datagram with a forged sender.
pub(crate) struct UdpPort {
    socket: UdpSocket,
    /// With the actual port.
    address: SocketAddr,
    master: Option<SocketAddr>,
    wake: WakeEvent,
}

impl UdpPort {
    pub(crate) fn open(address: SocketAddr) -> Result<Self, OpenError> {
        let open = || {
            let socket = UdpSocket::bind(address)?;
            socket.set_nonblocking(true)?;
            let address = socket.local_addr()?;
            mark_answers(&socket, address)?;
            Ok(Self { socket, address, master: None, wake: WakeEvent::new()? })
        };
        open().map_err(|error| OpenError::of(LinkSpec::Udp(address), error))
    }
}

fn mark_answers(socket: &UdpSocket, address: SocketAddr) -> io::Result<()> {
    let options = SockRef::from(socket);
    if address.ip().is_unspecified() {
        options.attach_filter(&no_answers_and_nothing_from(address.port()))?;
    } else {
        options.attach_filter(&NO_ANSWERS)?;
    }
    // An IPv6 socket may also send to IPv4 addresses.
    options.set_tos_v4(ANSWER_TOS)?;
    if address.is_ipv6() { options.set_tclass_v6(ANSWER_TOS) } else { Ok(()) }
}

impl FramePort for UdpPort {
    fn receive(&mut self, buffer: &mut [u8], wait: Duration) -> io::Result<Option<usize>> {
        let Some((header, payload)) = buffer.split_first_chunk_mut::<{ HEADER.len() }>() else {
            return Err(io::ErrorKind::InvalidInput.into());
        };
        *header = HEADER;
        let Self { socket, address, master, wake } = self;
        let received = receive_from(&*socket, wake, wait, || {
            let (length_bytes, sender) = socket.recv_from(payload)?;
            if sender == *address {
                // Forged: this unit sends nothing to itself.
                return Err(io::ErrorKind::WouldBlock.into());
            }
            *master = Some(sender);
            Ok(length_bytes)
        })?;
        Ok(received.map(|length_bytes| HEADER.len() + length_bytes))
    }

    fn send(&mut self, frame: &[u8]) -> io::Result<()> {
        let (Some(master), Some(payload)) = (self.master, frame.get(HEADER.len()..)) else {
            return Err(io::ErrorKind::NotConnected.into());
        };
        self.socket.send_to(payload, master).map(|_| ())
    }

    fn link(&self) -> Option<LinkSpec> {
        Some(LinkSpec::Udp(self.address))
    }

    fn envelope(&self) -> Envelope {
        Envelope::Udp
    }

    fn waker(&self) -> Waker {
        self.wake.waker()
    }
}

#[cfg(test)]
mod tests {
    use std::net::IpAddr;

    use super::*;
    use crate::FRAME_BUFFER_BYTES;

    const SOON: Duration = Duration::from_secs(10);
    const NEVER: Duration = Duration::from_secs(100_000);

    fn loopback() -> (UdpPort, SocketAddr) {
        let port = UdpPort::open("127.0.0.1:0".parse().unwrap()).unwrap();
        let address = port.address;
        (port, address)
    }

    #[test]
    fn the_segment_sees_an_ethernet_frame_and_each_master_its_own_answer() {
        let (mut unit, address) = loopback();
        let masters = [(); 2].map(|()| UdpSocket::bind("127.0.0.1:0").unwrap());
        let mut buffer = [0; FRAME_BUFFER_BYTES];
        for (number, master) in masters.iter().enumerate() {
            master.set_read_timeout(Some(std::time::Duration::from_secs(10))).unwrap();
            master.send_to(&[number as u8; 1500], address).unwrap();
            assert_eq!(unit.receive(&mut buffer, SOON).unwrap(), Some(1514));
            assert_eq!(buffer[..14], HEADER);
            buffer[14] = 0xA5;
            unit.send(&buffer[..1514]).unwrap();
            let mut answer = [0; FRAME_BUFFER_BYTES];
            assert_eq!(master.recv(&mut answer).unwrap(), 1500);
            assert_eq!(answer[..2], [0xA5, number as u8]);
        }
    }

    fn open(address: &str) -> UdpPort {
        UdpPort::open(address.parse().unwrap()).unwrap()
    }

    /// Lets `one` receive a frame whose sender seems to be `other`, and answer it.
    fn answer_goes_to(one: &mut UdpPort, other: &UdpPort) {
        one.master = Some(other.address);
        one.send(&[7; 60]).unwrap();
    }

    #[test]
    fn answers_of_units_are_answered_by_none() {
        let mut buffer = [0; FRAME_BUFFER_BYTES];
        for addresses in [
            ["127.0.0.1:0", "127.0.0.1:0"],
            ["127.0.0.1:0", "127.0.0.2:0"],
            ["[::1]:0", "[::1]:0"],
            ["127.0.0.1:0", "[::ffff:127.0.0.1]:0"],
        ] {
            let [mut one, mut other] = addresses.map(open);
            if addresses[1].contains("ffff") {
                // Both use IPv4.
                other.address = SocketAddr::new([127, 0, 0, 1].into(), other.address.port());
            }
            answer_goes_to(&mut one, &other);
            // A later frame is received: the answer did not wait before it.
            let master = UdpSocket::bind((one.address.ip(), 0)).unwrap();
            master.send_to(&[1; 46], other.address).unwrap();
            assert_eq!(other.receive(&mut buffer, SOON).unwrap(), Some(60), "{addresses:?}");
            assert_eq!(buffer[14], 1, "{addresses:?}");
            assert_eq!(other.receive(&mut buffer, Duration::ZERO).unwrap(), None, "{addresses:?}");
        }
    }

    #[test]
    fn a_frame_that_seems_to_come_from_the_unit_itself_is_dropped() {
        let (mut unit, address) = loopback();
        // Not marked, unlike the frames that the port sends.
        SockRef::from(&unit.socket).set_tos_v4(0).unwrap();
        unit.socket.send_to(&[1; 46], address).unwrap();
        let mut buffer = [0; FRAME_BUFFER_BYTES];
        assert_eq!(unit.receive(&mut buffer, Duration::from_millis(1)).unwrap(), None);
        assert_eq!(unit.send(&[0; 60]).unwrap_err().kind(), io::ErrorKind::NotConnected);
    }

    #[test]
    fn at_all_addresses_a_frame_from_one_of_them_and_the_port_of_the_unit_is_dropped() {
        let mut buffer = [0; FRAME_BUFFER_BYTES];
        for (bound, own) in [("0.0.0.0:0", "127.0.0.1"), ("[::]:0", "127.0.0.1"), ("[::]:0", "::1")] {
            let mut unit = open(bound);
            let to = SocketAddr::new(own.parse().unwrap(), unit.address.port());
            // As above: not marked. The kernel makes the sender the same address.
            SockRef::from(&unit.socket).set_tos_v4(0).unwrap();
            if to.is_ipv6() {
                SockRef::from(&unit.socket).set_tclass_v6(0).unwrap();
            }
            // Towards an IPv4 address, an IPv6 socket needs it in the form of an IPv6 address.
            let to_as_bound = match (unit.address.ip(), to.ip()) {
                (IpAddr::V6(_), IpAddr::V4(ip)) => SocketAddr::new(ip.to_ipv6_mapped().into(), to.port()),
                _ => to,
            };
            unit.socket.send_to(&[1; 46], to_as_bound).unwrap();
            let master = UdpSocket::bind((to.ip(), 0)).unwrap();
            master.send_to(&[2; 46], to).unwrap();
            assert_eq!(unit.receive(&mut buffer, SOON).unwrap(), Some(60), "{bound} {own}");
            assert_eq!(buffer[14], 2, "{bound} {own}");
            unit.send(&buffer[..60]).unwrap();
            assert_eq!(master.recv(&mut buffer).unwrap(), 46, "{bound} {own}");
        }
    }

    /// The segment sees each of them with its length, so that it can count it; one that is longer than the buffer fills it.
    #[test]
    fn a_datagram_of_any_length_is_received_with_that_length() {
        let (mut unit, address) = loopback();
        let master = UdpSocket::bind("127.0.0.1:0").unwrap();
        let mut buffer = [0; FRAME_BUFFER_BYTES];
        let room_bytes = FRAME_BUFFER_BYTES - HEADER.len();
        for length_bytes in [0, 1, 2, 13, 45, 1504, 1505, room_bytes - 1, room_bytes, room_bytes + 1, 65_507]
        {
            master.send_to(&vec![0x10; length_bytes], address).unwrap();
            let received = unit.receive(&mut buffer, SOON).unwrap();
            assert_eq!(received, Some(HEADER.len() + length_bytes.min(room_bytes)), "{length_bytes}");
            assert_eq!(buffer[..HEADER.len()], HEADER);
        }
    }

    #[test]
    fn a_wait_or_the_next_one_is_ended_by_the_waker() {
        let (mut unit, address) = loopback();
        let mut buffer = [0; FRAME_BUFFER_BYTES];
        let waker = unit.waker();
        waker.wake_by_ref();
        assert_eq!(unit.receive(&mut buffer, NEVER).unwrap(), None);
        // Used once, it ends one wait: this one ends with a frame.
        let master = UdpSocket::bind("127.0.0.1:0").unwrap();
        master.send_to(&[1; 46], address).unwrap();
        assert_eq!(unit.receive(&mut buffer, NEVER).unwrap(), Some(60));
        let waiting = std::thread::spawn(move || unit.receive(&mut buffer, NEVER).unwrap());
        waker.wake();
        assert_eq!(waiting.join().unwrap(), None);
    }

    #[test]
    fn the_link_names_the_port_that_the_kernel_chose() {
        let (unit, address) = loopback();
        assert_ne!(address.port(), 0);
        assert_eq!(unit.link(), Some(LinkSpec::Udp(address)));
    }

    #[test]
    fn before_the_first_frame_there_is_nobody_to_answer() {
        let (mut unit, _) = loopback();
        assert_eq!(unit.receive(&mut [0; FRAME_BUFFER_BYTES], Duration::ZERO).unwrap(), None);
        assert_eq!(unit.send(&[0; 60]).unwrap_err().kind(), io::ErrorKind::NotConnected);
    }

    #[test]
    fn an_address_that_is_taken_or_elsewhere_is_refused() {
        let (_unit, address) = loopback();
        assert!(matches!(UdpPort::open(address), Err(OpenError::InUse { .. })));
        let elsewhere = "192.0.2.1:34980".parse().unwrap();
        assert!(matches!(UdpPort::open(elsewhere), Err(OpenError::AddressNotHere { .. })));
    }
}
