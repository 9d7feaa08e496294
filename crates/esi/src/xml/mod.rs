//! The ESI file (ETG.2000): elements in the order of the EtherCATInfo schema; the same input gives the same text.

mod device;
mod dictionary;
mod document;
mod hex;
#[cfg(test)]
mod tests;

use objects::ObjectTable;

use crate::DeviceDescription;
use document::{Document, ENGLISH};
use hex::hex32;

/// The ESI file of a device and its object dictionary. Numbers with a fixed width are written as `#x…`.
#[must_use]
pub fn xml(description: &DeviceDescription, table: &ObjectTable) -> String {
    let mut document = Document::new();
    document.element("EtherCATInfo", &[("Version", "1.6")], |document| {
        document.element("Vendor", &[], |document| {
            document.text("Id", &hex32(description.vendor.id));
            document.text("Name", &description.vendor.name);
        });
        document.element("Descriptions", &[], |document| {
            document.element("Groups", &[], |document| group(document, description));
            document.element("Devices", &[], |document| device::write(document, description, table));
        });
    });
    document.finish()
}

fn group(document: &mut Document, description: &DeviceDescription) {
    document.element("Group", &[], |document| {
        document.text("Type", &description.group.group_type);
        document.text_with("Name", &[("LcId", ENGLISH)], &description.group.name);
    });
}
