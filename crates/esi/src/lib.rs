//! ESI and SII: written and read from one device description.
//!
//! A [`DeviceDescription`] is plain data and independent of unit models. [`sii::image`] makes the EEPROM image
//! from it, [`xml`] the ESI file; both agree, because both are made from the same description and, for the
//! dictionary, from the same [`objects::ObjectTable`] that answers online. [`mod@file`] reads the ESI files of vendors, and
//! makes both from them.

mod describe;
mod description;
pub mod file;
mod known_device;
pub mod lint;
mod process_data;
pub mod sii;
mod startup;
mod type_names;
#[cfg(feature = "write")]
mod xml;

pub use description::{
    CoeDetails, DeviceDescription, GeneralFlags, Group, Mailbox, MailboxArea, MailboxProtocols, PortPhysics,
    Vendor,
};
pub use known_device::{KnownDevice, NamedBit};
pub use process_data::{FmmuUsage, Pdo, PdoEntry, SyncManager, SyncManagerType};
pub use startup::{DiagMessage, EscPresets, InitCommand, Timeouts, Transition};
pub use type_names::element_type;
#[cfg(feature = "write")]
pub use xml::xml;

#[cfg(test)]
mod tests;
