//! From an Ethernet frame to its datagrams.

use crate::datagram::{
    DATAGRAM_HEADER_BYTES, DATAGRAM_OVERHEAD_BYTES, Datagram, DatagramHeader, DatagramView,
};

/// EtherType of EtherCAT in Ethernet II.
pub const ETHERTYPE_ETHERCAT: u16 = 0x88A4;
/// UDP destination port of EtherCAT in UDP, 34980.
pub const UDP_PORT_ETHERCAT: u16 = 0x88A4;
/// Longest Ethernet frame that an ESC accepts, without FCS, with one VLAN tag.
pub const FRAME_BYTES_MAX: usize = 1518;
/// Bytes of the EtherCAT header before the datagrams.
pub const ETHERCAT_HEADER_BYTES: usize = 2;

/// The tags of 802.1Q and 802.1ad, of which a frame has at most one.
const ETHERTYPES_VLAN: [u16; 2] = [0x8100, 0x88A8];
const ETHERTYPE_IPV4: u16 = 0x0800;
const IP_PROTOCOL_UDP: u8 = 17;
const MAC_BYTES: usize = 12;
const UDP_HEADER_BYTES: usize = 8;
const TYPE_DATAGRAMS: u16 = 1;

/// How an ESC classifies a frame (ETG.1000.4; reference 1.1, 1.2, 1.7).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameKind {
    /// Datagrams to process.
    Datagrams(Layout),
    /// EtherCAT of another type than datagrams: forwarded unchanged.
    OtherType,
    /// Not EtherCAT: forwarded or destroyed by the forwarding rule.
    NotEtherCat,
    /// Broken: nothing in it takes effect, and it is counted.
    Defective(Defect),
}

/// The positions of the datagrams in a checked frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    start: usize,
    end: usize,
    udp_checksum_at: Option<usize>,
    is_overlong: bool,
}

/// Why a frame is broken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Defect {
    /// It ends within the Ethernet or the EtherCAT header.
    TooShort,
    /// It is longer than [`FRAME_BYTES_MAX`].
    TooLong,
    /// Its EtherCAT header announces more bytes than were received, and its chain of datagrams does not end before.
    Truncated,
    /// A datagram exceeds the length in the EtherCAT header.
    DatagramBeyondEnd,
}

impl FrameKind {
    /// Checks a frame from its destination address on, without FCS. Bytes after the last datagram are ignored,
    /// whatever the EtherCAT length is: frames of 29 bytes, as they arrive over veth, are valid.
    #[must_use]
    pub fn of(frame: &[u8]) -> Self {
        if frame.len() > FRAME_BYTES_MAX {
            return Self::Defective(Defect::TooLong);
        }
        match locate(frame) {
            Ok(Some(at)) => at.check(frame),
            Ok(None) => Self::NotEtherCat,
            Err(defect) => Self::Defective(defect),
        }
    }
}

impl Layout {
    /// Whether the EtherCAT header announces more bytes than the frame has. All its datagrams are complete.
    #[must_use]
    pub const fn is_overlong(&self) -> bool {
        self.is_overlong
    }

    /// Opens the datagrams one after the other for editing in place.
    #[must_use]
    pub fn datagrams<'a>(&self, frame: &'a mut [u8]) -> Datagrams<'a> {
        Datagrams { rest: frame.get_mut(self.start..self.end) }
    }

    /// Marks the frame as having passed a slave: sets the locally administered bit of the source address, and
    /// clears the UDP checksum, because the data that it covers have changed.
    pub fn mark_passed(&self, frame: &mut [u8]) {
        mark_source_address(frame);
        if let Some(checksum) = self.udp_checksum_at.and_then(|at| frame.get_mut(at..at + 2)) {
            checksum.fill(0);
        }
    }
}

/// Sets the locally administered bit of the source address, as every ESC does in every frame that passes its
/// processing unit; the rest of the address is unchanged.
pub fn mark_source_address(frame: &mut [u8]) {
    if let Some(first) = frame.get_mut(6) {
        *first |= 0x02;
    }
}

/// The datagrams of a frame, in order.
pub struct Datagrams<'a> {
    rest: Option<&'a mut [u8]>,
}

impl<'a> Iterator for Datagrams<'a> {
    type Item = Datagram<'a>;

    #[inline]
    fn next(&mut self) -> Option<Datagram<'a>> {
        let (datagram, rest) = Datagram::open(self.rest.take()?)?;
        self.rest = datagram.header.more_follow.then_some(rest);
        Some(datagram)
    }
}

/// The datagrams of a frame in order, for reading; empty if the frame holds none or is broken.
#[must_use]
pub fn datagrams(frame: &[u8]) -> DatagramViews<'_> {
    let rest = match FrameKind::of(frame) {
        FrameKind::Datagrams(layout) => frame.get(layout.start..layout.end),
        FrameKind::OtherType | FrameKind::NotEtherCat | FrameKind::Defective(_) => None,
    };
    DatagramViews { rest }
}

/// The datagrams of a checked frame, in order, for reading. A clone begins where the original is.
#[derive(Clone, Debug)]
pub struct DatagramViews<'a> {
    rest: Option<&'a [u8]>,
}

impl<'a> Iterator for DatagramViews<'a> {
    type Item = DatagramView<'a>;

    #[inline]
    fn next(&mut self) -> Option<DatagramView<'a>> {
        let (datagram, rest) = DatagramView::of(self.rest.take()?)?;
        self.rest = datagram.header.more_follow.then_some(rest);
        Some(datagram)
    }
}

/// The position of the EtherCAT header, before its length is checked.
struct Located {
    header_at: usize,
    udp_checksum_at: Option<usize>,
}

fn locate(frame: &[u8]) -> Result<Option<Located>, Defect> {
    let mut at = MAC_BYTES;
    let mut ethertype = be_u16(frame, at).ok_or(Defect::TooShort)?;
    if ETHERTYPES_VLAN.contains(&ethertype) {
        at += 4;
        ethertype = be_u16(frame, at).ok_or(Defect::TooShort)?;
    }
    at += 2;
    match ethertype {
        ETHERTYPE_ETHERCAT => Ok(Some(Located { header_at: at, udp_checksum_at: None })),
        ETHERTYPE_IPV4 => Ok(locate_in_udp(frame, at)),
        _ => Ok(None),
    }
}

/// EtherCAT in UDP: the ESC checks protocol and destination port, not IP addresses.
fn locate_in_udp(frame: &[u8], ip_at: usize) -> Option<Located> {
    let version_and_length = *frame.get(ip_at)?;
    let ip_header_bytes = usize::from(version_and_length & 0x0F) * 4;
    let is_udp = version_and_length >> 4 == 4 && *frame.get(ip_at + 9)? == IP_PROTOCOL_UDP;
    let udp_at = ip_at + ip_header_bytes;
    let is_ethercat = is_udp && ip_header_bytes >= 20 && be_u16(frame, udp_at + 2)? == UDP_PORT_ETHERCAT;
    is_ethercat.then_some(Located { header_at: udp_at + UDP_HEADER_BYTES, udp_checksum_at: Some(udp_at + 6) })
}

impl Located {
    fn check(&self, frame: &[u8]) -> FrameKind {
        let Some(header) = frame.get(self.header_at..self.header_at + ETHERCAT_HEADER_BYTES) else {
            return FrameKind::Defective(Defect::TooShort);
        };
        let header = u16::from_le_bytes([header[0], header[1]]);
        if header >> 12 != TYPE_DATAGRAMS {
            return FrameKind::OtherType;
        }
        let start = self.header_at + ETHERCAT_HEADER_BYTES;
        let promised_end = start + usize::from(header & 0x07FF);
        let end = promised_end.min(frame.len());
        let is_overlong = promised_end > end;
        match (chain_end(frame.get(start..end).unwrap_or_default()), is_overlong) {
            (ChainEnd::LastDatagram, _) | (ChainEnd::LengthUsedUp, false) => {
                let udp_checksum_at = self.udp_checksum_at;
                FrameKind::Datagrams(Layout { start, end, udp_checksum_at, is_overlong })
            }
            (ChainEnd::LengthUsedUp | ChainEnd::Missing, true) => FrameKind::Defective(Defect::Truncated),
            (ChainEnd::Missing, false) => FrameKind::Defective(Defect::DatagramBeyondEnd),
        }
    }
}

/// How a chain of datagrams ends.
enum ChainEnd {
    /// With a datagram without the more flag.
    LastDatagram,
    /// After a datagram with the more flag, or before the first.
    LengthUsedUp,
    /// A datagram does not fit.
    Missing,
}

fn chain_end(mut area: &[u8]) -> ChainEnd {
    while !area.is_empty() {
        let Some(head) = area.first_chunk::<DATAGRAM_HEADER_BYTES>() else { return ChainEnd::Missing };
        let header = DatagramHeader::unpack(head);
        let Some(rest) = area.get(DATAGRAM_OVERHEAD_BYTES + usize::from(header.length_bytes)..) else {
            return ChainEnd::Missing;
        };
        if !header.more_follow {
            return ChainEnd::LastDatagram;
        }
        area = rest;
    }
    ChainEnd::LengthUsedUp
}

fn be_u16(bytes: &[u8], at: usize) -> Option<u16> {
    let pair = bytes.get(at..at + 2)?;
    Some(u16::from_be_bytes([pair[0], pair[1]]))
}
