//! A TAP interface: the master opens it like a network card, and this process is the cable.

use std::io;
use std::task::Waker;

use time::Duration;
use tun_rs::{DeviceBuilder, Layer, SyncDevice};

use crate::claim::Claim;
use crate::descriptor::{may_be_ethercat, receive_from};
use crate::wake_event::WakeEvent;
use crate::{FramePort, LinkSpec, OpenError};

/// This process's end of a TAP interface. The interface is removed with it unless it existed before.
pub(crate) struct TapPort {
    name: String,
    device: SyncDevice,
    wake: WakeEvent,
    _claim: Claim,
}

impl TapPort {
    pub(crate) fn open(name: &str) -> Result<Self, OpenError> {
        let open = || {
            let wake = WakeEvent::new()?;
            let device = make(name)?;
            let claim = Claim::take(device.if_index()?)?;
            Ok(Self { name: name.to_owned(), device, wake, _claim: claim })
        };
        open().map_err(|error| OpenError::of(LinkSpec::Tap(name.to_owned()), error))
    }
}

fn make(name: &str) -> io::Result<SyncDevice> {
    let builder = DeviceBuilder::new().name(name).layer(Layer::L2).inherit_enable_state();
    let device = builder.build_sync()?;
    device.set_nonblocking(true)?;
    // An interface that an administrator created for this user may be opened by the user, but not be set up.
    if let Err(error) = device.enabled(true) {
        tracing::warn!("cannot set {name} up ({error}): `sudo ip link set {name} up`");
    }
    Ok(device)
}

impl TapPort {
    /// The kernel reports a deleted interface as a descriptor in a bad state.
    fn lost(&self, error: io::Error) -> io::Error {
        if error.raw_os_error() != Some(rustix::io::Errno::BADFD.raw_os_error()) {
            return error;
        }
        let name = &self.name;
        let words =
            format!("the interface {name} was deleted; start again with tap:{name} to create it again");
        io::Error::new(io::ErrorKind::NotConnected, words)
    }
}

impl FramePort for TapPort {
    fn receive(&mut self, buffer: &mut [u8], wait: Duration) -> io::Result<Option<usize>> {
        let received = receive_from(&self.device, &self.wake, wait, || self.device.recv(buffer));
        let received = received.map_err(|error| self.lost(error))?;
        // The kernel sends IPv6 and ARP on the new interface first.
        Ok(received.filter(|length_bytes| buffer.get(..*length_bytes).is_some_and(may_be_ethercat)))
    }

    fn send(&mut self, frame: &[u8]) -> io::Result<()> {
        self.device.send(frame).map(|_| ())
    }

    fn link(&self) -> Option<LinkSpec> {
        Some(LinkSpec::Tap(self.name.clone()))
    }

    fn waker(&self) -> Waker {
        self.wake.waker()
    }
}
