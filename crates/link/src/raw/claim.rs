//! One ectwin for an interface: two of them would answer each frame twice.

use std::io;
use std::os::linux::net::SocketAddrExt;
use std::os::unix::net::{SocketAddr, UnixDatagram};

/// An interface on which this process answers. The claim is an abstract Unix socket: its name is free again as
/// soon as the process ends, in whatever way, and is local to the network namespace, like the index of the
/// interface.
pub(super) struct Claim {
    _name: UnixDatagram,
}

impl Claim {
    /// # Errors
    /// [`io::ErrorKind::AddrInUse`]: another ectwin has it.
    pub(super) fn take(interface_index: u32) -> io::Result<Self> {
        let name = SocketAddr::from_abstract_name(format!("ectwin/raw/{interface_index}"))?;
        UnixDatagram::bind_addr(&name).map(|socket| Self { _name: socket })
    }
}
