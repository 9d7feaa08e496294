//! The rules for the slaves of a network.

use std::collections::{BTreeMap, BTreeSet};

use wire::ObjectIndex;

use super::finding::Report;
use super::rules;
use crate::file::{NetworkSlave, NetworkSyncManager, PreviousPort};

pub(crate) fn check(slaves: &[NetworkSlave], report: &dyn Report) {
    for slave in slaves {
        check_identity(slave, report);
        check_mailbox(slave, report);
        check_process_data(slave, report);
    }
    check_positions(slaves, report);
    check_identifications(slaves, report);
    check_connections(slaves, report);
}

fn check_identity(slave: &NetworkSlave, report: &dyn Report) {
    if slave.vendor_id.is_none() || slave.product_code.is_none() {
        let message = format!("the slave `{}` has no VendorId or no ProductCode; read as 0", name(slave));
        report.report(rules::NETWORK_IDENTITY, slave.place, message);
    }
}

fn check_mailbox(slave: &NetworkSlave, report: &dyn Report) {
    let Some(mailbox) = &slave.mailbox else { return };
    if mailbox.to_slave.is_none() || mailbox.from_slave.is_none() {
        let message = format!("the mailbox of `{}` has no area in a direction", name(slave));
        report.report(rules::NETWORK_MAILBOX, mailbox.place, message);
    }
}

fn check_process_data(slave: &NetworkSlave, report: &dyn Report) {
    let lengths: BTreeMap<ObjectIndex, u32> =
        slave.pdos().map(|pdo| (pdo.index.index, pdo.bit_length())).collect();
    for sync_manager in &slave.sync_managers {
        check_sync_manager(sync_manager, &lengths, report);
    }
}

fn check_sync_manager(
    sync_manager: &NetworkSyncManager,
    lengths: &BTreeMap<ObjectIndex, u32>,
    report: &dyn Report,
) {
    let NetworkSyncManager { place, number, bytes, pdos, .. } = sync_manager;
    let unknown = pdos.iter().filter(|(_, index)| !lengths.contains_key(index));
    for (place, index) in unknown.clone() {
        let message = format!("the slave has no PDO {index}, which is assigned to SyncManager {number}");
        report.report(rules::PDO_NOT_THERE, *place, message);
    }
    let bits: u32 = pdos.iter().filter_map(|(_, index)| lengths.get(index)).sum();
    let expected = bits.div_ceil(8);
    let Some(bytes) = bytes.filter(|_| !pdos.is_empty() && unknown.count() == 0) else { return };
    if u32::from(bytes) != expected {
        let message =
            format!("SyncManager {number} has {bytes} bytes, but the PDOs assigned to it have {expected}");
        report.report(rules::NETWORK_LENGTH, *place, message);
    }
}

/// Slaves that may be absent move those behind them: the file has the positions of one case only.
fn check_positions(slaves: &[NetworkSlave], report: &dyn Report) {
    let mut addresses = BTreeSet::new();
    let is_fixed = slaves.iter().all(|slave| slave.hot_connect_group.is_none());
    for (place_in_file, slave) in slaves.iter().enumerate() {
        let address = slave.station_address.unwrap_or(0);
        if address == 0 || !addresses.insert(address) {
            let wrong = if address == 0 { "which is none" } else { "as a slave before it" };
            let message = format!("the slave `{}` has the station address {address}, {wrong}", name(slave));
            report.report(rules::STATION_ADDRESS, slave.place, message);
        }
        if let Some(position) =
            slave.position.filter(|position| usize::from(*position) != place_in_file && is_fixed)
        {
            let message = format!(
                "the slave `{}` is at place {place_in_file} of the file, but its AutoIncAddr says {position}",
                name(slave)
            );
            report.report(rules::POSITION, slave.place, message);
        }
    }
}

fn check_identifications(slaves: &[NetworkSlave], report: &dyn Report) {
    let mut known = BTreeSet::new();
    for slave in slaves {
        let Some(identification) = slave.identification else { continue };
        if !known.insert((identification.register, identification.value)) {
            let message = format!(
                "the slave `{}` has the number {} of a slave before it",
                name(slave),
                identification.value
            );
            report.report(rules::IDENTIFICATION_TWICE, slave.place, message);
        }
    }
}

fn check_connections(slaves: &[NetworkSlave], report: &dyn Report) {
    let (mut before, mut used) = (BTreeSet::new(), BTreeSet::new());
    for slave in slaves {
        if let Some(previous) = slave.previous_port() {
            check_previous(slave, previous, &before, report);
            if !used.insert((previous.station_address, previous.port)) && previous.port.is_some() {
                let message = format!("the slave `{}` is at the port of a slave before it", name(slave));
                report.report(rules::PORT_TWICE, previous.place, message);
            }
        }
        before.extend(slave.station_address);
    }
}

fn check_previous(
    slave: &NetworkSlave,
    previous: &PreviousPort,
    before: &BTreeSet<u16>,
    report: &dyn Report,
) {
    if previous.port.is_none() {
        let message = format!("the port to which `{}` is connected has no letter from A to D", name(slave));
        report.report(rules::PREVIOUS_LETTER, previous.place, message);
    }
    let address = previous.station_address;
    if !address.is_some_and(|address| before.contains(&address)) {
        let found = address.map_or("no address".to_owned(), |address| format!("station address {address}"));
        let message = format!(
            "the slave `{}` is connected to {found}, which no slave before it has; read as connected to the slave before",
            name(slave)
        );
        report.report(rules::PREVIOUS_SLAVE, previous.place, message);
    }
}

fn name(slave: &NetworkSlave) -> String {
    user_file::shown(&slave.name).to_string()
}
