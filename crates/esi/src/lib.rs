//! ESI and SII: written and read from one device description.
//!
//! A [`DeviceDescription`] is plain data and knows of no unit model. [`sii::image`] makes the EEPROM image
//! of it, [`xml`] the ESI file; both tell the same, because both read the same description and, for the
//! dictionary, the same [`objects::ObjectTable`] that answers online.

mod description;
mod process_data;
pub mod sii;
mod startup;
mod xml;

pub use description::{
    CoeDetails, DeviceDescription, GeneralFlags, Group, Mailbox, MailboxArea, MailboxProtocols, PortPhysics,
    Vendor,
};
pub use process_data::{FmmuUsage, Pdo, PdoEntry, SyncManager, SyncManagerType};
pub use startup::{DiagMessage, EscPresets, InitCommand, Timeouts, Transition};
pub use xml::xml;

#[cfg(test)]
mod tests;
