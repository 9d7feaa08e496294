//! The ESI file (ETG.2000): elements in the order of the EtherCATInfo schema, the same text each time.

mod device;
mod dictionary;
mod document;
#[cfg(test)]
mod tests;
mod types;

use objects::ObjectTable;

use crate::DeviceDescription;
use document::Document;

/// Language of the texts: English.
const ENGLISH: &str = "1033";

/// The ESI file of a device and its object dictionary. Numbers with a width stand as `#x…`.
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

fn hex8(value: u8) -> String {
    format!("#x{value:02X}")
}

fn hex16(value: u16) -> String {
    format!("#x{value:04X}")
}

fn hex32(value: u32) -> String {
    format!("#x{value:08X}")
}

/// Bytes in the order of memory, as `hexBinary` fields hold them.
fn hex_binary(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02X}")).collect()
}
