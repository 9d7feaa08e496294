//! The bytes of EtherCAT: frames, datagrams, mailbox, CoE and SDO headers, states and codes.
//!
//! Frames are edited in place and never copied. Unknown values are kept as `Other`: a master may write
//! anything, and a rule in a higher layer reports it.

mod al;
mod build;
mod coe;
mod command;
mod datagram;
mod emergency;
mod frame;
mod mailbox;
mod mailbox_writer;
mod object;
mod sdo;
mod sdo_abort;
mod sdo_info;
mod sdo_info_description;
mod sdo_response;
mod sii;

pub use al::{AlControl, AlState, AlStatus, AlStatusCode, AlStatusCodeRow};
pub use build::{FrameBuilder, Returned, returned_datagrams};
pub use coe::{CoeHeader, CoeService};
pub use command::Command;
pub use datagram::{
    DATAGRAM_HEADER_BYTES, DATAGRAM_OVERHEAD_BYTES, Datagram, DatagramHeader, DatagramView,
    WORKING_COUNTER_BYTES,
};
pub use emergency::Emergency;
pub use frame::{
    DatagramViews, Datagrams, Defect, ETHERCAT_HEADER_BYTES, ETHERTYPE_ETHERCAT, FRAME_BYTES_MAX, FrameKind,
    Layout, UDP_PORT_ETHERCAT, datagrams, mark_source_address,
};
pub use mailbox::{MailboxErrorCode, MailboxErrorReply, MailboxHeader, MailboxType};
pub use object::{DataType, EntryAddress, ObjectIndex, SubIndex};
pub use sdo::{SdoAccess, SdoRequest, SdoSyntaxError, SdoTarget};
pub use sdo_abort::{SdoAbort, SdoAbortRow};
pub use sdo_info::{
    SdoInfoHeader, SdoInfoList, SdoInfoOpcode, SdoInfoRequest, SdoInfoSyntaxError, ValueInfo,
    pack_sdo_info_error,
};
pub use sdo_info_description::{EntryDescription, ObjectDescription};
pub use sdo_response::SdoResponse;
pub use sii::{SII_CONFIGURATION_BYTES, sii_checksum};
