//! A network interface: frames by `AF_PACKET`.

mod bell;
mod interface;
mod socket;
mod vlan;

use std::io;
use std::sync::Arc;
use std::task::Waker;
use std::time::{Duration as WallDuration, Instant};

use time::Duration;

use crate::descriptor::receive_from;
use crate::wake_event::WakeEvent;
use crate::{FramePort, LinkSpec, OpenError};
use bell::Bell;
use interface::{Interface, Watch};
use socket::{PacketSocket, is_without_ethernet};

/// A raw socket that is bound to one interface, in promiscuous mode.
pub(crate) struct RawPort {
    name: String,
    socket: PacketSocket,
    interface: Arc<Interface>,
    bell: Option<Bell>,
    wake: WakeEvent,
    /// When a frame without carrier was the last reason to look for the carrier, without finding it.
    looked_at: Option<Instant>,
    _watch: Option<Watch>,
}

/// The shortest time between two such looks: each asks the system for all interfaces.
const LOOK_AGAIN: WallDuration = WallDuration::from_millis(10);

impl RawPort {
    pub(crate) fn open(name: &str) -> Result<Self, OpenError> {
        let interfaces = pnet_datalink::interfaces();
        let Some(interface) = interfaces.iter().find(|interface| interface.name == name) else {
            let available = interfaces.into_iter().map(|interface| interface.name).collect();
            return Err(OpenError::NoSuchInterface { name: name.to_owned(), available });
        };
        let open = || {
            // The bell is set up first: changes from here on ring it.
            let bell = Bell::new()?;
            let socket = PacketSocket::new()?;
            let wake = WakeEvent::new()?;
            Ok((bell, Interface::bind(interface, socket.try_clone()?)?, socket, wake))
        };
        let refused = |error| match is_without_ethernet(&error) {
            true => OpenError::NotEthernet { name: name.to_owned() },
            false => OpenError::of(LinkSpec::Raw(name.to_owned()), error),
        };
        let (bell, bound, socket, wake) = open().map_err(refused)?;
        if interface.is_loopback() {
            return Err(OpenError::Loopback { name: name.to_owned() });
        }
        if !interface.is_up() {
            tracing::warn!("{name} is down: `ip link set {name} up` before the master starts");
        } else if !bound.carrier() {
            tracing::warn!("{name} has no carrier: the cable to the master is pulled");
        }
        let interface = Arc::new(bound);
        Ok(Self {
            name: name.to_owned(),
            socket,
            interface,
            bell: Some(bell),
            wake,
            looked_at: None,
            _watch: None,
        })
    }
}

impl RawPort {
    /// A frame has arrived, perhaps faster than the notice of the carrier. Frames that waited in the socket when the
    /// cable was pulled arrive without one.
    fn look_for_carrier(&mut self) {
        let is_too_soon = || self.looked_at.is_some_and(|at| at.elapsed() < LOOK_AGAIN);
        if self.interface.carrier() || is_too_soon() {
            return;
        }
        self.interface.look();
        self.looked_at = (!self.interface.carrier()).then(Instant::now);
    }
}

impl FramePort for RawPort {
    fn begin(&mut self) -> io::Result<()> {
        if let Some(bell) = self.bell.take() {
            self._watch = Some(Watch::start(Arc::clone(&self.interface), bell)?);
        }
        Ok(())
    }

    fn receive(&mut self, buffer: &mut [u8], wait: Duration) -> io::Result<Option<usize>> {
        match receive_from(&self.socket, &self.wake, wait, || self.socket.receive(buffer)) {
            // The interface is down or was removed.
            Err(error) if error.kind() == io::ErrorKind::NetworkDown => {
                self.interface.look();
                Ok(None)
            }
            Ok(Some(length_bytes)) => {
                self.look_for_carrier();
                Ok(Some(length_bytes))
            }
            other => other,
        }
    }

    fn send(&mut self, frame: &[u8]) -> io::Result<()> {
        self.socket.send(frame)
    }

    fn link(&self) -> Option<LinkSpec> {
        Some(LinkSpec::Raw(self.name.clone()))
    }

    fn carrier(&self) -> bool {
        self.interface.carrier()
    }

    fn dropped(&self) -> u64 {
        self.interface.dropped()
    }

    fn waker(&self) -> Waker {
        self.wake.waker()
    }
}
