//! Records of the mailbox: SDOs, messages, emergencies.

use mailbox::{MessageContent, MessageNote, SdoDirection, SdoEnd, SdoNote};
use objects::ObjectTable;
use time::Instant;
use unit_model::{EventCode, Model};
use wire::{CoeService, Emergency, MailboxType, SdoAbort, SdoAccess, SdoTarget};

use super::record::{Detail, Record};

/// An SDO that has ended. An aborted one is worth a line of its own.
pub(super) fn sdo(at: Instant, sdo: &SdoNote, model: Option<&'static dyn Model>) -> Record {
    let SdoNote { direction, target, value, end } = sdo;
    let is_complete = target.access == SdoAccess::Complete;
    let direction = match direction {
        Some(SdoDirection::Upload) => "upload",
        Some(SdoDirection::Download) => "download",
        None => "unknown",
    };
    let object = model.and_then(|model| name_of(&model.tables().objects, target));
    let (abort, by) = match end {
        SdoEnd::Done => (None, None),
        SdoEnd::Refused(abort) => (Some(*abort), Some("unit")),
        SdoEnd::AbortedByMaster(abort) => (Some(*abort), Some("master")),
    };
    let mut words = format!("SDO {direction} {:04X}:{:02X}", target.index.0, target.sub.0);
    words.extend(object.iter().map(|name| format!(" {name}")));
    words.push_str(if is_complete { ", complete access" } else { "" });
    match (abort, by) {
        (Some(abort), Some(by)) => {
            words.push_str(&format!(" is aborted by the {by}: {}", abort_words(abort)))
        }
        _ => words.push_str(&format!(", {} bytes: {}{}", value.length_bytes, hex(value.head()), rest(sdo))),
    }
    let detail = if abort.is_some() { Detail::Brief } else { Detail::Full };
    Record::new(at, "sdo", detail, words)
        .with("direction", direction)
        .with("index", format!("0x{:04X}", target.index.0))
        .with("sub", target.sub.0)
        .with("complete_access", is_complete)
        .with_optional("object", object)
        .with("length_bytes", value.length_bytes)
        .with("value", hex(value.head()))
        .with_optional("abort_code", abort.map(|abort| format!("0x{:08X}", abort.0)))
        .with_optional("abort_name", abort.and_then(SdoAbort::row).map(|row| row.meaning))
        .with_optional("aborted_by", by)
}

fn rest(sdo: &SdoNote) -> &'static str {
    let is_longer =
        usize::try_from(sdo.value.length_bytes).is_ok_and(|length| length > sdo.value.head().len());
    if is_longer { " …" } else { "" }
}

fn name_of(objects: &ObjectTable, target: &SdoTarget) -> Option<String> {
    objects.entry(target.index, target.sub).map(|entry| entry.name.to_string())
}

fn abort_words(abort: SdoAbort) -> String {
    let meaning = abort.row().map_or("no published meaning", |row| row.meaning);
    format!("0x{:08X} ({meaning})", abort.0)
}

/// A mailbox message in this direction.
pub(super) fn message(at: Instant, message: &MessageNote, direction: &'static str) -> Record {
    let MessageNote { content, counter, length_bytes, again } = *message;
    // By definition an abort is a request too.
    let is_abort = direction == "to_master" && content == MessageContent::Coe(CoeService::SdoRequest);
    let service = if is_abort { "SDO abort".to_owned() } else { service(content) };
    let arrow = if direction == "from_master" { "gets" } else { "sends" };
    let repeated = if again { ", repeated" } else { "" };
    let words =
        format!("{arrow} a mailbox message: {service}, counter {counter}, {length_bytes} bytes{repeated}");
    Record::new(at, "message", Detail::Full, words)
        .with("direction", direction)
        .with("service", service)
        .with("counter", counter)
        .with("length_bytes", length_bytes)
        .with("again", again)
}

fn service(content: MessageContent) -> String {
    match content {
        MessageContent::Coe(service) => coe(service),
        MessageContent::Error(code) => format!("error reply {code}"),
        MessageContent::Other(protocol) => match protocol {
            MailboxType::Error => "error reply".to_owned(),
            MailboxType::Coe => "CoE".to_owned(),
            MailboxType::Aoe => "AoE".to_owned(),
            MailboxType::Eoe => "EoE".to_owned(),
            MailboxType::Foe => "FoE".to_owned(),
            MailboxType::Soe => "SoE".to_owned(),
            MailboxType::Voe => "VoE".to_owned(),
            MailboxType::Other(number) => format!("protocol {number}"),
        },
    }
}

fn coe(service: CoeService) -> String {
    match service {
        CoeService::Emergency => "emergency",
        CoeService::SdoRequest => "SDO request",
        CoeService::SdoResponse => "SDO response",
        CoeService::TxPdo => "TxPDO",
        CoeService::RxPdo => "RxPDO",
        CoeService::TxPdoRemoteRequest => "TxPDO remote request",
        CoeService::RxPdoRemoteRequest => "RxPDO remote request",
        CoeService::SdoInformation => "SDO information",
        CoeService::Other(number) => return format!("CoE service {number}"),
    }
    .to_owned()
}

/// An emergency that is ready for the master to read.
pub(super) fn emergency(at: Instant, emergency: &Emergency, model: Option<&'static dyn Model>) -> Record {
    let Emergency { code, error_register, manufacturer } = emergency;
    let event = model.and_then(|model| event_of(model, *code));
    let mut words = format!("sends emergency 0x{code:04X}, data {}", hex(manufacturer));
    words.extend(event.iter().map(|(code, name)| format!(" ({code} {name})")));
    Record::new(at, "emergency", Detail::Brief, words)
        .with("error_code", format!("0x{code:04X}"))
        .with("error_register", format!("0x{error_register:02X}"))
        .with("data", hex(manufacturer))
        .with_optional("event", event.map(|(code, _)| code.to_string()))
}

/// The event with this emergency error code; none if several have it.
fn event_of(model: &'static dyn Model, code: u16) -> Option<(EventCode, &'static str)> {
    let rows = model.tables().events.iter();
    let mut those = rows.filter(|row| row.emergency.is_some_and(|known| known.code == code));
    let first = those.next()?;
    those.next().is_none().then_some((first.code, first.name))
}

/// Bytes as in a capture.
fn hex(bytes: &[u8]) -> String {
    let digits: Vec<String> = bytes.iter().map(|byte| format!("{byte:02X}")).collect();
    digits.join(" ")
}
