//! A packet socket: bound to one interface after another, with the VLAN tags of its frames and the kernel's
//! count of frames that it dropped.

use std::io::{self, Write};
use std::os::fd::{AsFd, AsRawFd, BorrowedFd};

use socket2::{Domain, Socket, Type};
use uapi::c;

use super::vlan;
use crate::filter::ETHERCAT_COMING_IN;

/// Room for one burst: SOEM sends the process data of 1,000 units, 250 frames, at once.
const RECEIVE_BUFFER_BYTES: usize = 8 << 20;

/// Hardware types of interfaces, of which a loopback interface is refused for another reason.
const WITH_ETHERNET_HEADER: [u16; 2] = [c::ARPHRD_ETHER, c::ARPHRD_LOOPBACK];

/// Whether a socket was not bound because of the frames of the interface.
pub(super) fn is_without_ethernet(error: &io::Error) -> bool {
    error.kind() == io::ErrorKind::Unsupported && error.raw_os_error().is_none()
}

/// A packet socket. Only its creation requires CAP_NET_RAW: an existing socket may be bound to another
/// interface without it.
pub(super) struct PacketSocket {
    socket: Socket,
}

impl PacketSocket {
    /// A socket that receives nothing before it is bound, so that no frame bypasses its filter.
    pub(super) fn new() -> io::Result<Self> {
        let socket = Socket::new(Domain::PACKET, Type::RAW, None)?;
        socket.attach_filter(&ETHERCAT_COMING_IN)?;
        socket.set_nonblocking(true)?;
        let socket = Self { socket };
        socket.set(c::PACKET_AUXDATA, &1_i32)?;
        socket.enlarge_receive_buffer();
        Ok(socket)
    }

    /// Another handle of the same socket.
    pub(super) fn try_clone(&self) -> io::Result<Self> {
        self.socket.try_clone().map(|socket| Self { socket })
    }

    /// From now on, receives and sends on this interface, and receives frames for any address there.
    pub(super) fn bind(&self, interface_index: u32) -> io::Result<()> {
        let index = i32::try_from(interface_index).map_err(|_| io::ErrorKind::InvalidInput)?;
        let every_protocol = (c::ETH_P_ALL as u16).to_be();
        let address = c::sockaddr_ll {
            sll_family: c::AF_PACKET as u16,
            sll_protocol: every_protocol,
            sll_ifindex: index,
            sll_hatype: 0,
            sll_pkttype: 0,
            sll_halen: 0,
            sll_addr: [0; 8],
        };
        uapi::bind(self.socket.as_raw_fd(), &address)?;
        self.refuse_other_headers()?;
        self.set(c::PACKET_ADD_MEMBERSHIP, &promiscuous(index))
    }

    /// No longer asks for frames for any address on this interface, to which the socket was bound. An interface that
    /// was removed asks for nothing.
    pub(super) fn leave(&self, interface_index: u32) {
        if let Ok(index) = i32::try_from(interface_index) {
            let _gone = self.set(c::PACKET_DROP_MEMBERSHIP, &promiscuous(index));
        }
    }

    /// Refuses an interface whose frames have no Ethernet header, such as a TUN interface.
    fn refuse_other_headers(&self) -> io::Result<()> {
        let mut address: c::sockaddr_ll = uapi::pod_zeroed();
        uapi::getsockname(self.socket.as_raw_fd(), &mut address)?;
        if WITH_ETHERNET_HEADER.contains(&address.sll_hatype) {
            return Ok(());
        }
        Err(io::Error::new(io::ErrorKind::Unsupported, "its frames have no Ethernet header"))
    }

    /// Receives a frame, with its VLAN tag.
    pub(super) fn receive(&self, buffer: &mut [u8]) -> io::Result<usize> {
        let mut control = [0_u8; vlan::CONTROL_BYTES];
        let mut message = uapi::MsghdrMut {
            iov: &mut [&mut *buffer][..],
            control: Some(&mut control[..]),
            name: uapi::sockaddr_none_mut(),
            flags: 0,
        };
        let (frame, _, control) = uapi::recvmsg(self.socket.as_raw_fd(), &mut message, 0)?;
        let length_bytes = frame.len();
        Ok(match vlan::tag_in(control) {
            Some(tag) => vlan::insert(tag, buffer, length_bytes),
            None => length_bytes,
        })
    }

    pub(super) fn send(&self, frame: &[u8]) -> io::Result<()> {
        let mut writer = &self.socket;
        writer.write(frame).map(|_| ())
    }

    /// Number of frames since the last call for which there was no room in the receive buffer.
    pub(super) fn take_dropped(&self) -> u64 {
        // `tpacket_stats`: packets, drops. Reading them resets them to 0.
        let mut statistics = [0_u32; 2];
        let read =
            uapi::getsockopt(self.socket.as_raw_fd(), c::SOL_PACKET, c::PACKET_STATISTICS, &mut statistics);
        read.map_or(0, |_| u64::from(statistics[1]))
    }

    /// The room for waiting frames, as the kernel counts it: about half of it for their bytes.
    pub(super) fn receive_buffer_bytes(&self) -> usize {
        self.socket.recv_buffer_size().unwrap_or(0)
    }

    /// Beyond the limit of the system if permitted (CAP_NET_ADMIN), else up to the limit.
    fn enlarge_receive_buffer(&self) {
        use rustix::net::sockopt::set_socket_recv_buffer_size_force;
        if set_socket_recv_buffer_size_force(&self.socket, RECEIVE_BUFFER_BYTES).is_err() {
            // The kernel cuts a value above its limit.
            let _limited = self.socket.set_recv_buffer_size(RECEIVE_BUFFER_BYTES);
        }
        let (is, wanted) = (self.receive_buffer_bytes() >> 11, RECEIVE_BUFFER_BYTES >> 10);
        if is < wanted {
            tracing::info!("the receive buffer has {is} KiB, not {wanted} KiB: {HELP_FOR_BUFFER}");
        } else {
            tracing::info!("the receive buffer has {is} KiB");
        }
    }

    fn set<T>(&self, option: i32, value: &T) -> io::Result<()> {
        Ok(uapi::setsockopt(self.socket.as_raw_fd(), c::SOL_PACKET, option, value)?)
    }
}

fn promiscuous(index: i32) -> c::packet_mreq {
    c::packet_mreq { mr_ifindex: index, mr_type: c::PACKET_MR_PROMISC as u16, mr_alen: 0, mr_address: [0; 8] }
}

/// How to enlarge the receive buffer.
pub(super) const HELP_FOR_BUFFER: &str =
    "`sudo sysctl -w net.core.rmem_max=8388608` raises the limit, CAP_NET_ADMIN at the start goes beyond it";

impl AsFd for PacketSocket {
    fn as_fd(&self) -> BorrowedFd<'_> {
        self.socket.as_fd()
    }
}
