//! Operation modes of distributed clocks.

use std::collections::BTreeSet;

use wire::ObjectIndex;

use super::finding::Report;
use super::rules;
use crate::file::{DeviceElement, OperationMode};

pub(super) fn check(device: &DeviceElement, report: &dyn Report) {
    let Some(clock) = &device.clock else { return };
    let pdos: BTreeSet<ObjectIndex> = device.pdos().map(|pdo| pdo.index.index).collect();
    let mut names = BTreeSet::new();
    for mode in &clock.modes {
        if !names.insert(mode.name.as_str()) {
            let message = format!("the operation mode `{}` is there before", user_file::shown(&mode.name));
            report.report(rules::MODE_TWICE, mode.place, message);
        }
        if mode.assign_activate.is_none() {
            let name = user_file::shown(&mode.name);
            let message =
                format!("the operation mode `{name}` has no AssignActivate; read as 0, without SYNC signals");
            report.report(rules::MODE_WORD, mode.place, message);
        }
        check_sync_managers(device.sync_managers.len(), &pdos, mode, report);
    }
}

fn check_sync_managers(
    count: usize,
    pdos: &BTreeSet<ObjectIndex>,
    mode: &OperationMode,
    report: &dyn Report,
) {
    for sync_manager in &mode.sync_managers {
        let number = sync_manager.number;
        if usize::from(number) >= count {
            let message = format!("the operation mode sets SyncManager {number}, the device has {count}");
            report.report(rules::MODE_SM, sync_manager.place, message);
        }
        for (index, _) in sync_manager.pdos.iter().filter(|(index, _)| !pdos.contains(index)) {
            let message = format!("the operation mode assigns the PDO {index}, which is not there");
            report.report(rules::MODE_SM, sync_manager.place, message);
        }
    }
}
