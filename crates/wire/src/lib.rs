//! The bytes of EtherCAT: frames, datagrams, mailbox, CoE and SDO headers, states and codes.
//!
//! Frames are edited in place and never copied. Unknown values survive as `Other`: a master may write
//! anything, and a rule further up objects to it.

mod al;
mod object;

pub use al::{AlControl, AlState, AlStatus, AlStatusCode, AlStatusCodeRow};
pub use object::{DataType, ObjectIndex, SubIndex};
