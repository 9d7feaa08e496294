//! The bytes of EtherCAT: frames, datagrams, mailbox, CoE and SDO headers, states and codes.
//!
//! Frames are edited in place and never copied. Unknown values survive as `Other`: a master may write
//! anything, and a rule further up objects to it.

mod al;
mod build;
mod command;
mod datagram;
mod frame;
mod object;

pub use al::{AlControl, AlState, AlStatus, AlStatusCode, AlStatusCodeRow};
pub use build::{FrameBuilder, Returned, returned_datagrams};
pub use command::Command;
pub use datagram::{
    DATAGRAM_HEADER_BYTES, DATAGRAM_OVERHEAD_BYTES, Datagram, DatagramHeader, WORKING_COUNTER_BYTES,
};
pub use frame::{
    Datagrams, Defect, ETHERCAT_HEADER_BYTES, ETHERTYPE_ETHERCAT, FRAME_BYTES_MAX, FrameKind, Layout,
    UDP_PORT_ETHERCAT, mark_source_address,
};
pub use object::{DataType, ObjectIndex, SubIndex};
