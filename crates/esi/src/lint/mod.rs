//! What is wrong with an ESI file, by rule, place and correction.
//!
//! A finding comes from one of two steps. Reading a value reports what is not in the notation of the schema, with the
//! value that is used instead. The rules of the other files here compare the elements of a device with each other.

mod clocks;
mod dictionary;
mod eeprom;
pub mod finding;
mod identity;
mod mailbox;
mod modules;
mod network;
mod pdos;
pub mod rules;
mod sync_managers;

use crate::file::DeviceElement;
use finding::Report;

pub(crate) use dictionary::check as check_dictionary;
pub(crate) use identity::check_all as check_identities;
pub(crate) use modules::Modules;
pub(crate) use network::check as check_network;

/// The rules for one device.
pub(crate) fn check_device(device: &DeviceElement, modules: &Modules<'_>, report: &dyn Report) {
    identity::check(device, report);
    sync_managers::check(device, report);
    pdos::check(device, report);
    mailbox::check(device, report);
    clocks::check(device, report);
    modules::check(device, modules, report);
    dictionary::check_device(device, report);
    eeprom::check(device, report);
}
