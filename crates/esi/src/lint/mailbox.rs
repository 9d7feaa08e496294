//! The mailbox: protocols and init commands.

use objects::{AccessRights, Entry};

use super::finding::Report;
use super::rules;
use crate::describe::DeviceObjects;
use crate::file::{DeviceElement, InitCommandElement};
use crate::{MailboxProtocols, Transition};

pub(super) fn check(device: &DeviceElement, report: &dyn Report) {
    let Some(mailbox) = &device.mailbox else { return };
    if mailbox.protocols.is_empty() {
        let message = "the mailbox has no protocol";
        report.report(rules::MAILBOX_PROTOCOLS, mailbox.place, message.into());
    }
    for (name, _) in (mailbox.protocols - MailboxProtocols::COE).iter_names() {
        let message = format!("the mailbox has the protocol {name}, which is not emulated");
        report.report(rules::PROTOCOL_UNSUPPORTED, mailbox.place, message);
    }
    let (Some(coe), Some(objects)) = (&mailbox.coe, DeviceObjects::of(device)) else { return };
    for command in coe.init_commands.iter().filter(|command| !command.depends_on_slot) {
        check_command(command, &objects, report);
    }
}

fn check_command(command: &InitCommandElement, objects: &DeviceObjects<'_>, report: &dyn Report) {
    let address = format!("{}:{}", command.index, command.sub);
    let object = objects.object(command.index);
    // The standard has these objects, though few dictionaries list them.
    let is_of_standard =
        matches!(command.index.0, 0x1600..=0x17FF | 0x1A00..=0x1BFF | 0x1C10..=0x1C3F | 0xF030);
    let Some(entry) = object.as_ref().and_then(|object| object.entry(command.sub)) else {
        if !is_of_standard || object.is_some() {
            let message = format!("the init command writes {address}, which is not in the dictionary");
            report.report(rules::INIT_COMMAND_OBJECT, command.place, message);
        }
        return;
    };
    for transition in command.transitions.iter().filter(|transition| !is_writable(entry, **transition)) {
        let letters = transition.letters();
        let message = format!("the init command writes {address} at {letters}, where it is read-only");
        report.report(rules::INIT_COMMAND_OBJECT, command.place, message);
    }
    // A text may be shorter than its entry.
    let is_exact = command.data.len() == entry.size_bytes();
    let is_text = matches!(entry.data_type.0, 0x0009..=0x000B) && command.data.len() < entry.size_bytes();
    if !command.complete_access && !is_exact && !is_text {
        let (found, size) = (command.data.len(), entry.size_bytes());
        let message = format!("the init command writes {found} bytes to {address}, which has {size}");
        report.report(rules::INIT_COMMAND_LENGTH, command.place, message);
    }
}

/// Whether an entry is writable in the state in which a master writes at a transition: before it on the way up, and
/// behind it on the way down.
fn is_writable(entry: &Entry, transition: Transition) -> bool {
    let state = match transition {
        Transition::Ip | Transition::Ps | Transition::Sp | Transition::Op => AccessRights::WRITE_PRE_OP,
        Transition::So | Transition::Os => AccessRights::WRITE_SAFE_OP,
        // There is no CoE in INIT and BOOT.
        Transition::Pi | Transition::Si | Transition::Oi | Transition::Ib | Transition::Bi => return true,
    };
    entry.access.contains(state)
}
