//! EtherCAT in UDP through an ordinary socket: no root, any machine.

use std::io;
use std::net::{SocketAddr, UdpSocket};

use time::Duration;

use crate::port::receive_from;
use crate::{FramePort, LinkSpec, OpenError};

/// The Ethernet header in which the segment sees the UDP payload: to everyone, from an address of no maker.
/// The socket does not show the headers that really came, and an ESC looks at none of them but the source
/// address, which it marks.
const HEADER: [u8; 14] = [0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0x10, 0, 0, 0, 0, 0, 0x88, 0xA4];

/// A UDP socket; answers go to where the last frame came from.
pub(crate) struct UdpPort {
    socket: UdpSocket,
    master: Option<SocketAddr>,
}

impl UdpPort {
    pub(crate) fn open(address: SocketAddr) -> Result<Self, OpenError> {
        let socket =
            UdpSocket::bind(address).and_then(|socket| socket.set_nonblocking(true).map(|()| socket));
        let socket = socket.map_err(|error| OpenError::of(LinkSpec::Udp(address), error))?;
        Ok(Self { socket, master: None })
    }
}

impl FramePort for UdpPort {
    fn receive(&mut self, buffer: &mut [u8], wait: Duration) -> io::Result<Option<usize>> {
        let Some((header, payload)) = buffer.split_first_chunk_mut::<{ HEADER.len() }>() else {
            return Err(io::ErrorKind::InvalidInput.into());
        };
        *header = HEADER;
        let Self { socket, master } = self;
        let received = receive_from(&*socket, wait, || {
            let (length_bytes, sender) = socket.recv_from(payload)?;
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FRAME_BUFFER_BYTES;

    const SOON: Duration = Duration::from_secs(10);

    fn loopback() -> (UdpPort, SocketAddr) {
        let port = UdpPort::open("127.0.0.1:0".parse().unwrap()).unwrap();
        let address = port.socket.local_addr().unwrap();
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
