//! What the kernel passes to the sockets, in its filter language: frames that concern no unit do not wake the process.

use socket2::SockFilter;

/// For raw links: EtherCAT and EtherCAT in UDP, without the frames that this machine sends, because those move
/// away from the unit. (Frames sent by this socket never return to it; those of a master on a shared interface
/// would.)
pub(crate) const ETHERCAT_COMING_IN: [SockFilter; 14] = [
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

/// For UDP links at all addresses of the machine, with this port: as [`NO_ANSWERS`], and without datagrams that come from
/// an address of the machine and this port. Only the unit itself has that port, and it sends nothing to itself. What a
/// machine sends to itself passes its loopback interface, and the kernel drops such senders on other interfaces.
pub(crate) fn no_answers_and_nothing_from(own_port: u16) -> Vec<SockFilter> {
    let from_itself = [
        SockFilter::new(LOAD_HALF_WORD, 0, 0, HARDWARE_TYPE),
        SockFilter::new(JUMP_IF_EQUAL, 0, 3, LOOPBACK),
        SockFilter::new(LOAD_HALF_WORD, 0, 0, UDP_SOURCE_PORT),
        SockFilter::new(JUMP_IF_EQUAL, 0, 1, own_port.into()),
        SockFilter::new(RETURN, 0, 0, 0),
    ];
    from_itself.into_iter().chain(NO_ANSWERS).collect()
}

/// For UDP links: everything except answers of units, which have [`ANSWER_TOS`] in their IP header (IPv4:
/// second byte; IPv6: after the version). The network may change the two ECN bits.
pub(crate) const NO_ANSWERS: [SockFilter; 11] = [
    SockFilter::new(LOAD_BYTE, 0, 0, IP_HEADER),
    SockFilter::new(SHIFT_RIGHT, 0, 0, 4),
    SockFilter::new(JUMP_IF_EQUAL, 3, 0, 6),
    SockFilter::new(LOAD_BYTE, 0, 0, IP_HEADER + 1),
    SockFilter::new(AND, 0, 0, 0xFC),
    SockFilter::new(JUMP_IF_EQUAL, 4, 3, ANSWER_TOS),
    SockFilter::new(LOAD_HALF_WORD, 0, 0, IP_HEADER),
    SockFilter::new(AND, 0, 0, 0x0FC0),
    SockFilter::new(JUMP_IF_EQUAL, 1, 0, ANSWER_TOS << 4),
    SockFilter::new(RETURN, 0, 0, u32::MAX),
    SockFilter::new(RETURN, 0, 0, 0),
];

/// Marks the answers of a unit on UDP: DSCP 3, of the pool for local use (RFC 2474, section 6), which no master
/// uses. The payload cannot mark them: an answer in which no unit took part equals its request.
pub(crate) const ANSWER_TOS: u32 = 0b000011 << 2;

const LOAD_HALF_WORD: u16 = 0x28;
const LOAD_BYTE: u16 = 0x30;
const LOAD_HALF_WORD_INDEXED: u16 = 0x48;
const LOAD_IP_HEADER_LENGTH: u16 = 0xB1;
const AND: u16 = 0x54;
const SHIFT_RIGHT: u16 = 0x74;
const JUMP_IF_EQUAL: u16 = 0x15;
const JUMP_IF_ANY_BIT: u16 = 0x45;
const RETURN: u16 = 0x06;
/// Offset at which the kernel shows the packet type (`SKF_AD_OFF + SKF_AD_PKTTYPE`).
const PACKET_TYPE: u32 = 0xFFFF_F004;
const PACKET_OUTGOING: u32 = 4;
/// Offset at which the kernel shows the hardware type of the interface (`SKF_AD_OFF + SKF_AD_HATYPE`).
const HARDWARE_TYPE: u32 = 0xFFFF_F01C;
const LOOPBACK: u32 = 772;
/// A filter of a UDP socket sees the datagram from its UDP header on.
const UDP_SOURCE_PORT: u32 = 0;
/// Offset at which the kernel shows the IP header of a datagram (`SKF_NET_OFF`).
const IP_HEADER: u32 = 0xFFF0_0000;
