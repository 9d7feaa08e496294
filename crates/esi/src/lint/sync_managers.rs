//! SyncManagers: texts, directions, areas, lengths, the mailbox.

use super::finding::Report;
use super::rules;
use crate::SyncManagerType;
use crate::file::{DeviceElement, SyncManagerElement};

/// Registers end here, and the memory begins.
const MEMORY_START: u32 = 0x1000;
/// Digital output data of the controller, of which each byte can be a SyncManager.
const DIGITAL_OUTPUTS: core::ops::RangeInclusive<u32> = 0x0F00..=0x0F0F;
/// The memory of a controller that does not indicate it.
const MEMORY_BYTES: u32 = 0x2000;

pub(super) fn check(device: &DeviceElement, report: &dyn Report) {
    for (element, number) in device.sync_managers.iter().zip(0_u8..) {
        check_text(device, element, number, report);
        check_area(device, element, number, report);
        check_lengths(device, element, number, report);
    }
    check_overlap(device, report);
    check_mailbox(device, report);
}

fn check_text(device: &DeviceElement, element: &SyncManagerElement, number: u8, report: &dyn Report) {
    let usage = device.usage(number);
    let name = name(usage);
    if element.named_usage.is_none() && !element.text.is_empty() {
        let text = user_file::shown(&element.text);
        let message = format!("SyncManager {number} has the text `{text}`; read as {name}");
        return report.report(rules::SM_TEXT, element.place, message);
    }
    let is_output = |usage| matches!(usage, SyncManagerType::MailboxOut | SyncManagerType::Outputs);
    let control = element.master_writes().unwrap_or(is_output(usage));
    let has_data = usage != SyncManagerType::Unused && !element.is_virtual;
    let named = element.named_usage.unwrap_or(usage);
    if has_data && (named != usage || control != is_output(usage)) {
        let message = format!(
            "SyncManager {number} is {}, its control byte lets the {} write; read as {name}",
            self::name(named),
            if control { "master" } else { "slave" },
        );
        report.report(rules::SM_DIRECTION, element.place, message);
    }
}

const fn name(usage: SyncManagerType) -> &'static str {
    match usage {
        SyncManagerType::MailboxOut => "MBoxOut",
        SyncManagerType::MailboxIn => "MBoxIn",
        SyncManagerType::Outputs => "Outputs",
        SyncManagerType::Inputs => "Inputs",
        SyncManagerType::Unused | SyncManagerType::Other(_) => "unused",
    }
}

/// The bytes of a SyncManager that is enabled: three buffers, or one of a mailbox or of a single byte.
fn area(device: &DeviceElement, element: &SyncManagerElement, number: u8) -> Option<core::ops::Range<u32>> {
    let start = u32::from(element.start.filter(|_| !element.is_virtual)?);
    let length = element.default_bytes.map_or_else(|| device.default_pdo_bytes(number), u32::from);
    let is_single = element.has_one_buffer() || length <= 1;
    Some(start..start + if is_single { length } else { 3 * length })
}

fn check_area(device: &DeviceElement, element: &SyncManagerElement, number: u8, report: &dyn Report) {
    if element.start.is_none() && !element.is_virtual {
        let message = format!("SyncManager {number} has no start address; read as 0");
        return report.report(rules::SM_START, element.place, message);
    }
    let Some(area) = area(device, element, number).filter(|area| !area.is_empty()) else { return };
    let end = MEMORY_START + device.info.memory_bytes.unwrap_or(MEMORY_BYTES).min(0xF000);
    let is_digital = DIGITAL_OUTPUTS.contains(&area.start) && DIGITAL_OUTPUTS.contains(&(area.end - 1));
    if !is_digital && (area.start < MEMORY_START || area.end > end) {
        let message = format!(
            "SyncManager {number} takes 0x{:04X} to 0x{:04X}, the memory is 0x{MEMORY_START:04X} to 0x{:04X}",
            area.start,
            area.end - 1,
            end - 1
        );
        report.report(rules::SM_MEMORY, element.place, message);
    }
}

fn check_lengths(device: &DeviceElement, element: &SyncManagerElement, number: u8, report: &dyn Report) {
    let lengths = [element.min_bytes, element.default_bytes, element.max_bytes];
    let given: Vec<u16> = lengths.into_iter().flatten().collect();
    if !given.is_sorted() {
        let message = format!("SyncManager {number} has the lengths {given:?}");
        report.report(rules::SM_LENGTHS, element.place, message);
    }
    let pdos = device.default_pdo_bytes(number);
    let Some(default) = element.default_bytes.filter(|_| pdos > 0) else { return };
    if u32::from(default) != pdos {
        let message =
            format!("SyncManager {number} has DefaultSize {default}, its default PDOs take {pdos} bytes");
        report.report(rules::SM_DEFAULT_LENGTH, element.place, message);
    }
}

fn check_overlap(device: &DeviceElement, report: &dyn Report) {
    let numbered = device.sync_managers.iter().zip(0_u8..);
    let mut areas: Vec<_> = numbered
        .filter_map(|(element, number)| Some((area(device, element, number)?, number, element.place)))
        .filter(|(area, ..)| !area.is_empty())
        .collect();
    areas.sort_by_key(|(area, ..)| area.start);
    for pair in areas.windows(2) {
        let [(first, first_number, _), (second, number, place)] = pair else { continue };
        if first.end > second.start {
            let message = format!(
                "SyncManager {number} begins at 0x{:04X}, SyncManager {first_number} ends at 0x{:04X}",
                second.start,
                first.end - 1
            );
            report.report(rules::SM_OVERLAP, *place, message);
        }
    }
}

fn check_mailbox(device: &DeviceElement, report: &dyn Report) {
    let of_usage = |usage| {
        let mut numbered = device.sync_managers.iter().zip(0_u8..);
        numbered.find(|(_, number)| device.usage(*number) == usage).map(|(element, _)| element)
    };
    let found = [SyncManagerType::MailboxOut, SyncManagerType::MailboxIn].map(of_usage);
    match &device.mailbox {
        Some(mailbox) => {
            let usable =
                found.iter().flatten().filter(|element| element.default_bytes.is_some_and(|bytes| bytes > 0));
            if usable.count() != found.len() {
                let message = "the device has a mailbox, but not both SyncManagers for it with a length";
                report.report(rules::SM_MAILBOX, mailbox.place, message.into());
            }
        }
        None => {
            if let Some(element) = found.into_iter().flatten().next() {
                let message = "the device has SyncManagers for a mailbox, but no element Mailbox";
                report.report(rules::SM_WITHOUT_MAILBOX, element.place, message.into());
            }
        }
    }
}
