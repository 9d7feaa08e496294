//! The AL status codes that the slave stack of a unit shows by itself.

use std::collections::BTreeSet;

use device::{Condition, DeviceConfig, Requirement, refusal};
use wire::{AlState, AlStatusCode};

/// Those of the conditions that it checks and of the requests that it refuses.
pub(super) fn al_status_codes(config: &DeviceConfig) -> BTreeSet<AlStatusCode> {
    let mailbox = config.mailbox.as_ref();
    let has_boot = mailbox.is_some_and(|mailbox| mailbox.bootstrap.is_some());
    let of_mailbox = mailbox.map(|_| AlStatusCode::INVALID_MAILBOX_CONFIGURATION_PREOP);
    let of_boot = has_boot.then_some(AlStatusCode::INVALID_MAILBOX_CONFIGURATION_BOOT);
    let is_checked = |condition: &&Condition| mailbox.is_some() || condition.requires != Requirement::Mailbox;
    let checked = config.checks.iter().chain(config.watched).filter(is_checked);
    let wanted = AlState::ALL.into_iter().chain([AlState::Other(0)]);
    let refused = wanted.flat_map(|to| AlState::ALL.map(|from| refusal(from, to)));
    let refused = refused.filter(move |code| !has_boot || *code != AlStatusCode::BOOTSTRAP_NOT_SUPPORTED);
    let of_all = [AlStatusCode::EEPROM_ERROR, AlStatusCode::SYNC_MANAGER_WATCHDOG];
    let of_parts = of_mailbox.into_iter().chain(of_boot).chain(of_all);
    checked.map(|condition| condition.otherwise).chain(of_parts).chain(refused).collect()
}
