//! One ectwin for an interface, whether it is at the interface or, for a TAP interface, is its cable: two of them would
//! answer each frame twice, or answer each other.

use std::io;
use std::os::linux::net::SocketAddrExt;
use std::os::unix::net::{SocketAddr, UnixDatagram};

/// An interface on which this process answers. The claim is an abstract Unix socket: its name is free again as
/// soon as the process ends, in whatever way, and is local to the network namespace, like the index of the
/// interface.
pub(crate) struct Claim {
    _name: UnixDatagram,
}

impl Claim {
    /// # Errors
    /// [`io::ErrorKind::AddrInUse`]: another ectwin has it.
    pub(crate) fn take(interface_index: u32) -> io::Result<Self> {
        let name = SocketAddr::from_abstract_name(format!("ectwin/interface/{interface_index}"))?;
        UnixDatagram::bind_addr(&name).map(|socket| Self { _name: socket })
    }
}
