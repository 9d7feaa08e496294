//! ESI files as vendors write them (ETG.2000): every element that decides something about the slave, with its place.
//!
//! Reading is lenient: what vendors do wrong is read in the only way that makes sense, and is a finding of
//! [`crate::lint`]. [`DeviceElement::description`] and [`DeviceElement::objects`] make from a device what the rest of
//! the house works with.

mod channels;
mod clock;
mod device;
mod dictionary;
mod document;
mod eeprom;
mod element;
mod esi_file;
mod info;
mod mailbox;
mod network;
mod number;
mod pdo;
mod place;
mod profile;
mod read_error;
mod reading;
mod slots;
mod text;

pub use channels::{FmmuElement, SyncManagerElement, SyncUnit};
pub use clock::{ClockElement, ModeSyncManager, OperationMode, SyncSignal};
pub use device::{DeviceElement, DeviceType, HiddenType, SubDevice};
pub use dictionary::{
    DataTypeElement, DictionaryElement, Flags, Given, ObjectElement, SubItemElement, Values,
};
pub use eeprom::EepromElement;
pub use esi_file::{EsiFile, External};
pub use info::InfoElement;
pub use mailbox::{CoeElement, InitCommandElement, MailboxElement};
pub use network::{
    Attachment, CoeCommand, ExplicitIdentification, MailboxBuffer, NetworkClock, NetworkFile, NetworkMailbox,
    NetworkSlave, NetworkSyncManager, PreviousPort, RegisterCommand, Target,
};
pub use pdo::{EntryElement, Oversampling, PdoElement, SlotIndex};
pub use place::Place;
pub use profile::ProfileElement;
pub use read_error::ReadError;
pub use slots::{ModuleElement, SlotElement, SlotsElement};
