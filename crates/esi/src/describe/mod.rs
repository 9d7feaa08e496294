//! From the elements of a file to the description of a device and its object table.

mod data_types;
mod device;
mod entries;
mod objects;
mod values;

pub(crate) use device::pdo_entry_type;
pub(crate) use objects::{DeviceObjects, Objects};
