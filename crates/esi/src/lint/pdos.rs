//! PDOs: indexes, assignment, exclusions, entries.

use std::collections::BTreeSet;

use wire::ObjectIndex;

use super::finding::Report;
use super::rules;
use crate::describe::pdo_entry_type;
use crate::file::{DeviceElement, EntryElement, PdoElement};

/// Maximum number of entries of a PDO.
const ENTRIES_MAX: usize = 255;

pub(super) fn check(device: &DeviceElement, report: &dyn Report) {
    let indexes = indexes(device, report);
    let sync_managers = device.sync_managers.len();
    for (pdos, range) in [(&device.rx_pdos, 0x1600..=0x17FF), (&device.tx_pdos, 0x1A00..=0x1BFF)] {
        for pdo in pdos {
            let index = pdo.index.index;
            if !range.contains(&index.0) {
                let (first, last) = (range.start(), range.end());
                let message = format!("the PDO {index} is outside of 0x{first:04X} to 0x{last:04X}");
                report.report(rules::PDO_INDEX, pdo.place, message);
            }
            if let Some(number) = pdo.sync_manager.filter(|number| usize::from(*number) >= sync_managers) {
                let message =
                    format!("the PDO {index} is at SyncManager {number}, the device has {sync_managers}");
                report.report(rules::PDO_SM, pdo.place, message);
            }
            check_alone(pdo, &indexes, report);
        }
    }
    check_exclusions(device, report);
}

/// The indexes of all PDOs.
fn indexes(device: &DeviceElement, report: &dyn Report) -> BTreeSet<ObjectIndex> {
    let mut indexes = BTreeSet::new();
    for pdo in device.pdos() {
        if !indexes.insert(pdo.index.index) {
            let message = format!("the PDO {} is there before", pdo.index.index);
            report.report(rules::PDO_TWICE, pdo.place, message);
        }
    }
    indexes
}

fn check_alone(pdo: &PdoElement, indexes: &BTreeSet<ObjectIndex>, report: &dyn Report) {
    let index = pdo.index.index;
    if pdo.mandatory && pdo.sync_manager.is_none() {
        let message = format!("the PDO {index} is mandatory, but at no SyncManager");
        report.report(rules::PDO_MANDATORY, pdo.place, message);
    }
    for excluded in pdo.excludes.iter().filter(|excluded| !indexes.contains(&excluded.index)) {
        let message = format!("the PDO {index} excludes {}, which is not there", excluded.index);
        report.report(rules::PDO_EXCLUDE_UNKNOWN, pdo.place, message);
    }
    if pdo.entries.len() > ENTRIES_MAX {
        let message = format!("the PDO {index} has {} entries", pdo.entries.len());
        report.report(rules::PDO_LENGTH, pdo.place, message);
    }
    for entry in pdo.entries.iter().filter(|entry| !entry.is_padding()) {
        check_entry(entry, report);
    }
}

fn check_entry(entry: &EntryElement, report: &dyn Report) {
    let address = format!("{}:{:02X}", entry.index.index, entry.sub.unwrap_or(0));
    match pdo_entry_type(entry) {
        None if entry.type_name.is_empty() => {}
        None => {
            let name = user_file::shown(&entry.type_name);
            let message = format!("the entry {address} has the unknown type `{name}`; only its bits count");
            report.report(rules::ENTRY_TYPE, entry.place, message);
        }
        Some((_, bits)) if bits != u32::from(entry.bit_length) => {
            let (name, length) = (&entry.type_name, entry.bit_length);
            let message =
                format!("the entry {address} has {length} bits, {name} has {bits}; read as {length} bits");
            report.report(rules::ENTRY_TYPE_BITS, entry.place, message);
        }
        Some(_) => {}
    }
}

/// A PDO that an earlier one excludes is not assigned by default.
fn check_exclusions(device: &DeviceElement, report: &dyn Report) {
    for pdos in [&device.rx_pdos, &device.tx_pdos] {
        let mut excluded = BTreeSet::new();
        for pdo in pdos.iter().filter(|pdo| pdo.sync_manager.is_some()) {
            let index = pdo.index.index;
            if excluded.contains(&index) {
                let message =
                    format!("the PDO {index} is excluded by one that is assigned before it; not assigned");
                report.report(rules::PDO_EXCLUDED, pdo.place, message);
            } else {
                excluded.extend(pdo.excludes.iter().map(|excluded| excluded.index));
            }
        }
    }
}
