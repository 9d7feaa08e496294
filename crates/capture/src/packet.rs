//! A frame of a capture, and why bytes are not a capture.

use core::fmt;

use crate::{Direction, LINKTYPE_ETHERNET};

/// A frame of a capture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Packet {
    /// Time in nanoseconds since 1970-01-01 UTC.
    pub at_nanos: u64,
    /// Its direction, if the capture contains it.
    pub direction: Option<Direction>,
    /// From its destination address on, without FCS.
    pub frame: Vec<u8>,
}

/// Why the bytes are not a readable capture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotACapture {
    /// They begin neither like a pcapng file nor like a pcap file.
    NoSection,
    /// A block of a pcapng file, or the head or a record of a pcap file, that is cut short or contradicts itself.
    Block {
        /// Its start, in bytes.
        at: usize,
    },
    /// Another link type than Ethernet.
    LinkType {
        /// The link type found.
        link_type: u32,
    },
    /// A packet of an interface that was not described.
    Interface {
        /// The start of the packet, in bytes.
        at: usize,
    },
}

impl fmt::Display for NotACapture {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSection => formatter.write_str("this is neither a pcapng nor a pcap capture"),
            Self::Block { at } => {
                write!(formatter, "the block at byte {at} is cut short or contradicts itself")
            }
            Self::LinkType { link_type } => {
                write!(formatter, "link type {link_type}; only Ethernet, {LINKTYPE_ETHERNET}, can be read")
            }
            Self::Interface { at } => write!(formatter, "the packet at byte {at} is of no interface"),
        }
    }
}

impl core::error::Error for NotACapture {}
