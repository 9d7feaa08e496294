//! A network interface: frames by `AF_PACKET`.

use std::io::{self, Read, Write};
use std::os::fd::IntoRawFd;

use pnet_datalink::{Config, NetworkInterface};
use socket2::{Domain, SockFilter, Socket, Type};
use time::Duration;

use crate::port::receive_from;
use crate::{FramePort, LinkSpec, OpenError};

/// What the kernel hands to us, in its own filter language, so that other traffic does not wake us: EtherCAT
/// and EtherCAT in UDP, and nothing that this machine sends out, since that goes away from the unit. (What
/// this socket sends never comes back to it; the masters' own traffic on a shared interface would.)
const FILTER: [SockFilter; 14] = [
    SockFilter::new(LOAD_HALF_WORD, 0, 0, PACKET_TYPE),
    SockFilter::new(JUMP_IF_EQUAL, 11, 0, PACKET_OUTGOING),
    SockFilter::new(LOAD_HALF_WORD, 0, 0, 12),
    SockFilter::new(JUMP_IF_EQUAL, 8, 0, 0x88A4),
    SockFilter::new(JUMP_IF_EQUAL, 0, 8, 0x0800),
    SockFilter::new(LOAD_BYTE, 0, 0, 23),
    SockFilter::new(JUMP_IF_EQUAL, 0, 6, 17),
    SockFilter::new(LOAD_HALF_WORD, 0, 0, 20),
    SockFilter::new(JUMP_IF_ANY_BIT, 4, 0, 0x1FFF),
    SockFilter::new(LOAD_IP_HEADER_LENGTH, 0, 0, 14),
    SockFilter::new(LOAD_HALF_WORD_INDEXED, 0, 0, 16),
    SockFilter::new(JUMP_IF_EQUAL, 0, 1, 34980),
    SockFilter::new(RETURN, 0, 0, u32::MAX),
    SockFilter::new(RETURN, 0, 0, 0),
];

const LOAD_HALF_WORD: u16 = 0x28;
const LOAD_BYTE: u16 = 0x30;
const LOAD_HALF_WORD_INDEXED: u16 = 0x48;
const LOAD_IP_HEADER_LENGTH: u16 = 0xB1;
const JUMP_IF_EQUAL: u16 = 0x15;
const JUMP_IF_ANY_BIT: u16 = 0x45;
const RETURN: u16 = 0x06;
/// Offset at which the kernel shows the packet type (`SKF_AD_OFF + SKF_AD_PKTTYPE`).
const PACKET_TYPE: u32 = 0xFFFF_F004;
const PACKET_OUTGOING: u32 = 4;

/// How often we look whether an interface that is gone has come back.
const LOOK_AGAIN: std::time::Duration = std::time::Duration::from_millis(250);

/// A raw socket that is bound to one interface, in promiscuous mode.
pub(crate) struct RawPort {
    name: String,
    /// Nothing while the interface is gone.
    socket: Option<Socket>,
}

impl RawPort {
    pub(crate) fn open(name: &str) -> Result<Self, OpenError> {
        let interfaces = pnet_datalink::interfaces();
        let Some(interface) = interfaces.iter().find(|interface| interface.name == name) else {
            let available = interfaces.into_iter().map(|interface| interface.name).collect();
            return Err(OpenError::NoSuchInterface { name: name.to_owned(), available });
        };
        let socket = bind(interface).map_err(|error| OpenError::of(LinkSpec::Raw(name.to_owned()), error))?;
        if !interface.is_up() {
            tracing::warn!("{name} is down: `ip link set {name} up` before the master starts");
        }
        Ok(Self { name: name.to_owned(), socket: Some(socket) })
    }

    /// The interface went down: a cable that was pulled, which comes back by itself. Or it went away with its
    /// adapter or its network namespace: then its socket is of no use any more.
    fn went_down(&mut self) {
        if find(&self.name).is_some() {
            tracing::warn!("{} went down", self.name);
        } else {
            tracing::warn!("{} is gone; waiting for an interface of this name", self.name);
            self.socket = None;
        }
    }

    /// Looks for the interface, and rests if it is not there.
    fn come_back(&mut self, wait: Duration) {
        self.socket = find(&self.name).and_then(|interface| bind(&interface).ok());
        if self.socket.is_some() {
            tracing::warn!("{} is back", self.name);
        } else {
            std::thread::sleep(LOOK_AGAIN.min(std::time::Duration::from_nanos(wait.as_nanos())));
        }
    }
}

fn find(name: &str) -> Option<NetworkInterface> {
    pnet_datalink::interfaces().into_iter().find(|interface| interface.name == name)
}

/// pnet binds the socket and makes it promiscuous. Its own receiver has one time-out in whole milliseconds
/// for ever, a buffer of its own and a poll around each call, so frames go past it through a second handle.
fn bind(interface: &NetworkInterface) -> io::Result<Socket> {
    // Protocol 0 hears nothing until it is bound, so nothing slips past the filter.
    let socket = Socket::new(Domain::PACKET, Type::RAW, None)?;
    socket.attach_filter(&FILTER)?;
    let frames = socket.try_clone()?;
    let config = Config { socket_fd: Some(socket.into_raw_fd()), promiscuous: true, ..Config::default() };
    drop(pnet_datalink::channel(interface, config)?);
    frames.set_nonblocking(true)?;
    Ok(frames)
}

impl FramePort for RawPort {
    fn receive(&mut self, buffer: &mut [u8], wait: Duration) -> io::Result<Option<usize>> {
        let Some(socket) = &self.socket else {
            self.come_back(wait);
            return Ok(None);
        };
        let mut reader = socket;
        match receive_from(socket, wait, || reader.read(buffer)) {
            Err(error) if error.kind() == io::ErrorKind::NetworkDown => {
                self.went_down();
                Ok(None)
            }
            received => received,
        }
    }

    fn send(&mut self, frame: &[u8]) -> io::Result<()> {
        let mut writer = self.socket.as_ref().ok_or(io::ErrorKind::NetworkDown)?;
        writer.write(frame).map(|_| ())
    }
}
