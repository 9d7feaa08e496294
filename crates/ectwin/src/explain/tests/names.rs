//! Names of all tables, and words that are a part of them or near them.

use std::collections::BTreeMap;

use nx_ect101::Event;
use wire::{AlStatusCode, ObjectIndex, SdoAbort, SubIndex};

use super::{explained, refused, subjects};
use crate::explain::{DocumentedKind, Subject, TEXT_BYTES_MAX, emergency, explain, names};

#[test]
fn names_of_events_objects_and_registers_are_explained() {
    assert_eq!(subjects("esc error"), [Subject::Event(Event::ESC_ERROR)]);
    assert_eq!(subjects("Identity Object"), [Subject::Object(ObjectIndex(0x1018))]);
    assert_eq!(subjects("Production Info"), [Subject::NxObject(ObjectIndex(0x1001))]);
    assert_eq!(subjects("0x10F3:04"), [Subject::Entry(ObjectIndex(0x10F3), SubIndex(4))]);
}

#[test]
fn words_within_names_find_them() {
    assert_eq!(explained("identity"), "object 0x1018: Identity Object\nNX object 0x1000: NX Bus Identity");
    assert!(
        explained("Data M to C").contains("NX object 0x6000: UINTs Data M to C"),
        "{}",
        explained("Data M to C")
    );
    assert!(explained("event log").starts_with("word event log, system event log, access event log: "));
    let many = refused("object to be mapped");
    assert!(many.starts_with("`object to be mapped` is a part of "), "{many}");
    assert!(many.contains("give more words of the name, such as `1st "), "{many}");
    assert!(!refused("entit").contains("Identity"), "a part of a word is none of its words");
}

/// Every heading of an explanation is itself explained.
#[test]
fn every_heading_is_explained_by_its_own_words() {
    let codes = AlStatusCode::TABLE.iter().map(|row| Subject::AlStatus(row.code));
    let aborts = SdoAbort::TABLE.iter().map(|row| Subject::Abort(row.code));
    let emergencies = emergency::known().map(Subject::Emergency);
    let named = names::all().map(|(_, subject)| subject);
    let all = named.chain(codes).chain(aborts).chain(emergencies);
    for (heading, subject) in all.map(|subject| (subject.to_string(), subject)).collect::<BTreeMap<_, _>>() {
        assert!(subjects(&heading).contains(&subject), "{heading}");
    }
}

#[test]
fn every_function_and_block_of_structured_text_is_explained() {
    for entry in st::reference() {
        for name in [entry.name.to_owned(), entry.name.to_lowercase()] {
            assert!(subjects(&name).contains(&Subject::Library(entry.name)), "{name}");
        }
    }
    let counter = explained("CTU");
    assert!(counter.starts_with("Structured Text CTU: "), "{counter}");
    for fragment in ["\n  group       function blocks", "\n  inputs      CU: BOOL", "\n  returns     Q: BOOL"]
    {
        assert!(counter.contains(fragment), "{fragment}: {counter}");
    }
    assert!(explained("ResetNXBError").contains("Execute: BOOL"));
}

#[test]
fn names_of_rules_and_of_tables_in_the_pages_are_explained() {
    for (text, expected) in [
        ("sm_order", "setting rule sm_order: "),
        ("IoCommunications", "fault of scenarios IoCommunications: causes the event 80200000"),
        ("UINT", "data type UINT: 0 to 65535"),
        ("bool", "data type BOOL: FALSE, TRUE"),
        ("P_PRGER", "variable P_PRGER: TRUE after an error of the program"),
        ("P_Off", "variable P_On; P_Off: TRUE always; never"),
        ("_EC_PDSlavTbl", "variable _EC_PDSlavTbl: element n is TRUE while the slave"),
        ("16#2C00", "ErrorID 16#2C00: the unit refuses"),
        ("ErrorID 2C02", "ErrorID 16#2C02: no answer within TimeOut"),
        ("late_polls", "counter late_polls: number of polls"),
        ("destroyed", "counter destroyed: number of frames that did not return"),
        ("unsent", "counter unsent: number of answers"),
    ] {
        assert!(explained(text).contains(expected), "{text}: {}", explained(text));
    }
}

/// The tables in the pages are complete: every fault of the model, and every elementary type.
#[test]
fn every_fault_and_every_type_is_explained() {
    let faults = plant::default_model().faults().iter().map(|name| (*name, DocumentedKind::Fault));
    let types = plc::Elementary::ALL.iter().map(|known| (known.name(), DocumentedKind::DataType));
    for (name, kind) in faults.chain(types) {
        let is_it = |subject: &Subject| matches!(subject, Subject::Documented(known, _) if *known == kind);
        assert!(subjects(name).iter().any(is_it), "{name}");
    }
}

#[test]
fn an_unknown_word_is_refused_with_a_near_one_only() {
    assert!(refused("watchdgo").starts_with("`watchdgo` is not known; is `watchdog` meant?"));
    for text in
        ["", "0x", "hello", "123456789", "-1", "+1B", "hex", "banana bread", ":", "1018:", "pump", "a", "to"]
    {
        assert!(!refused(text).contains("meant"), "{text}: {}", refused(text));
    }
}

#[test]
fn a_text_longer_than_every_name_is_repeated_in_part() {
    let message = explain(&"a".repeat(100_000)).unwrap_err().to_string();
    assert_eq!(message, format!("`{}...` is not known", "a".repeat(40)));
    let longest = names::all().map(|(name, _)| name.len()).max();
    assert!(longest <= Some(TEXT_BYTES_MAX), "{longest:?}");
}
