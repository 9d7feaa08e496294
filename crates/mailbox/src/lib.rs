//! Mailbox services: request bytes in, reply bytes or abort code out.
//!
//! [`Mailbox`] answers messages that a master has written to SyncManager 0, and provides the messages for
//! SyncManager 1. It depends neither on the slave controller nor on the unit: values come from an
//! [`objects::ObjectServer`]. After construction it allocates nothing.
//!
//! ```
//! use std::sync::Arc;
//! use mailbox::{AbortProfile, Mailbox, MailboxSizes};
//! use objects::{AccessRights, Dictionary, Entry, Object, ObjectCode, ObjectTable};
//! use wire::{AlState, DataType, ObjectIndex, SubIndex};
//!
//! let value = Entry {
//!     sub: SubIndex::ZERO,
//!     name: "Device Type".into(),
//!     data_type: DataType::UNSIGNED32,
//!     bit_length: 32,
//!     access: AccessRights::READ,
//!     default: vec![0x89, 0x13, 0, 0],
//!     limits: vec![],
//! };
//! let device_type = Object {
//!     index: ObjectIndex(0x1000),
//!     name: "Device Type".into(),
//!     code: ObjectCode::Variable,
//!     data_type: DataType::UNSIGNED32,
//!     complete_access: false,
//!     entries: vec![value],
//! };
//! let mut objects = Dictionary::new(Arc::new(ObjectTable::new(vec![device_type])));
//! let sizes = MailboxSizes { receive_bytes: 128, send_bytes: 128 };
//! let mut mailbox = Mailbox::new(sizes, AbortProfile::CIA_301, objects.shared_table());
//!
//! // SDO upload of 0x1000:00, message counter 1.
//! let request = [10, 0, 0, 0, 0, 0x13, 0x00, 0x20, 0x40, 0x00, 0x10, 0x00, 0, 0, 0, 0];
//! let mut reply = [0; 128];
//! let length_bytes = mailbox.request(&request, AlState::PreOp, &mut objects, &mut reply);
//! assert_eq!(length_bytes, Some(16));
//! assert_eq!(reply[8..16], [0x43, 0x00, 0x10, 0x00, 0x89, 0x13, 0, 0]);
//! ```

mod abort_profile;
mod checks;
mod emergencies;
mod info;
mod mailbox;
mod notes;
mod outbox;
mod sdo;

pub use abort_profile::AbortProfile;
pub use emergencies::EmergencyLost;
pub use mailbox::{Mailbox, MailboxSizes};
pub use notes::{MailboxNote, MessageContent, MessageNote, SdoDirection, SdoEnd, SdoNote, SdoValue};
