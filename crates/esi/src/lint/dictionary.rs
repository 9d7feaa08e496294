//! The dictionary: its types and objects, and what it has of device and PDOs.

use objects::AccessRights;
use wire::{ObjectIndex, SubIndex};

use super::finding::Report;
use super::rules;
use crate::describe::{DeviceObjects, Objects};
use crate::file::{DeviceElement, DictionaryElement, EntryElement};

/// Types, objects and values of a dictionary.
pub(crate) fn check(dictionary: &DictionaryElement, report: &dyn Report) {
    let objects = Objects::of(dictionary, false, report);
    for index in objects.indexes() {
        objects.object(index, report);
    }
}

/// The dictionary and the rest of the device.
pub(super) fn check_device(device: &DeviceElement, report: &dyn Report) {
    let Some(objects) = DeviceObjects::of(device) else { return };
    check_mandatory(device, &objects, report);
    check_identity(device, &objects, report);
    let directions = [(&device.rx_pdos, AccessRights::RX_PDO), (&device.tx_pdos, AccessRights::TX_PDO)];
    for (pdos, right) in directions {
        let entries = pdos.iter().flat_map(|pdo| &pdo.entries);
        for entry in entries.filter(|entry| !entry.is_padding() && !entry.index.depends_on_slot) {
            check_entry(entry, right, &objects, report);
        }
    }
}

fn check_mandatory(device: &DeviceElement, objects: &DeviceObjects<'_>, report: &dyn Report) {
    let fixed = [0x1000, 0x1018, 0x1C00].map(ObjectIndex);
    let mapped = device.pdos().filter(|pdo| !pdo.is_virtual && !pdo.index.depends_on_slot);
    let needed = fixed.into_iter().chain(mapped.map(|pdo| pdo.index.index));
    let missing: Vec<String> =
        needed.filter(|index| objects.object(*index).is_none()).map(|index| index.to_string()).collect();
    if let Some((first, rest)) = missing.split_first() {
        let more = if rest.is_empty() { String::new() } else { format!(" and {} more", rest.len()) };
        let message = format!("the dictionary does not have {first}{more}; made from the rest of the device");
        report.report(rules::MANDATORY_OBJECTS, device.place, message);
    }
}

fn check_identity(device: &DeviceElement, objects: &DeviceObjects<'_>, report: &dyn Report) {
    let Some(identity) = objects.object(ObjectIndex(0x1018)) else { return };
    let numbers = [
        (1, "vendor ID", Some(device.vendor.id)),
        (2, "product code", device.device_type.product_code),
        (3, "revision number", device.device_type.revision),
    ];
    for (sub, name, expected) in numbers {
        let given = identity.entry(SubIndex(sub)).map(|entry| entry.default.as_slice());
        let (Some(expected), Some([a, b, c, d])) = (expected, given) else { continue };
        let found = u32::from_le_bytes([*a, *b, *c, *d]);
        // 0 is what generators write that leave the value to the firmware.
        if found != expected && found != 0 {
            let message = format!(
                "1018:{sub:02X} has the {name} 0x{found:08X}, the device has 0x{expected:08X}; that is used"
            );
            report.report(rules::IDENTITY, device.place, message);
        }
    }
}

fn check_entry(entry: &EntryElement, right: AccessRights, objects: &DeviceObjects<'_>, report: &dyn Report) {
    /// Data types as indexes are padding of a certain length.
    const OBJECTS_START: ObjectIndex = ObjectIndex(0x1000);
    let (index, sub) = (entry.index.index, SubIndex(entry.sub.unwrap_or(0)));
    if index < OBJECTS_START {
        return;
    }
    let object = objects.object(index);
    let Some(described) = object.as_ref().and_then(|object| object.entry(sub)) else {
        let message = format!("{index}:{sub} is mapped, but not in the dictionary; made from the PDO");
        return report.report(rules::ENTRY_UNKNOWN, entry.place, message);
    };
    if !described.access.contains(right) {
        let letter = if right == AccessRights::RX_PDO { "R" } else { "T" };
        let message = format!("{index}:{sub} is mapped, but its flags do not have PdoMapping {letter}");
        report.report(rules::ENTRY_MAPPING, entry.place, message);
    }
    if described.bit_length != entry.bit_length {
        let (mapped, bits) = (entry.bit_length, described.bit_length);
        let message = format!("{index}:{sub} has {mapped} bits in the PDO, but {bits} in the dictionary");
        report.report(rules::ENTRY_DICTIONARY_BITS, entry.place, message);
    }
}
