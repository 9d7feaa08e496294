//! Codes in every usual notation, and their meanings.

use nx_ect101::{Event, EventCode};
use wire::{AlStatusCode, ObjectIndex, SdoAbort, SubIndex};

use super::{refused, subjects};
use crate::explain::{Subject, al_status_codes, explain, sdo_abort_codes};

#[test]
fn every_code_of_the_tables_has_its_advice() {
    assert!(
        al_status_codes::ADVICE.iter().map(|row| row.0).eq(AlStatusCode::TABLE.iter().map(|row| row.code))
    );
    assert!(sdo_abort_codes::ADVICE.iter().map(|row| row.0).eq(SdoAbort::TABLE.iter().map(|row| row.code)));
}

#[test]
fn a_code_may_be_written_in_every_usual_way() {
    for text in ["0x001B", "001B", "1B", "0x1b", "0X001B", " 1b ", "001B hex", "1bhex"] {
        assert_eq!(subjects(text), [Subject::AlStatus(AlStatusCode::SYNC_MANAGER_WATCHDOG)], "{text}");
    }
    for text in ["0x0602_0000", "06020000", "0x06020000", "6020000", "0602_0000"] {
        assert_eq!(subjects(text), [Subject::Abort(SdoAbort::OBJECT_DOES_NOT_EXIST)], "{text}");
    }
    for text in ["391E0000", "391e0000", "0x391E0000", "0x391E_0000", "391E0000 hex", "391E0000hex"] {
        assert_eq!(subjects(text), [Subject::Event(EventCode(0x391E_0000))], "{text}");
    }
    assert_eq!(subjects("9450000"), [Subject::Event(Event::ESC_ERROR)], "without its leading zero");
    assert_eq!(explain("8004").unwrap()[0].name, "CPU Unit error (NX-ECT101)");
}

#[test]
fn a_code_with_several_meanings_is_explained_as_all_of_them() {
    let memory = Subject::Event(Event::NON_VOLATILE_MEMORY_HARDWARE_ERROR);
    assert_eq!(
        subjects("0x0020"),
        [Subject::AlStatus(AlStatusCode::NEEDS_COLD_START), memory, Subject::Register(0x20)]
    );
    assert_eq!(subjects("0x5600"), [Subject::Emergency(0x5600)]);
    assert_eq!(subjects("0x391E"), [Subject::Event(EventCode(0x391E_0000))], "a text ID");
    assert_eq!(subjects("0xA000E800"), [Subject::Emergency(0xA000)], "a diagnosis code");
}

#[test]
fn a_kind_before_a_number_leaves_out_the_others() {
    let entry = Subject::NxEntry(ObjectIndex(0x6000), SubIndex(1));
    for text in ["NX6000:01", "NX 6000:01", "nx object 0x6000:1", "NX  6000:01 "] {
        assert_eq!(subjects(text), [entry], "{text}");
    }
    assert_eq!(subjects("NX6000"), [Subject::NxObject(ObjectIndex(0x6000))]);
    assert_eq!(subjects("AL status 20"), [Subject::AlStatus(AlStatusCode::NEEDS_COLD_START)]);
    assert_eq!(subjects("register 0x20"), [Subject::Register(0x20)]);
    assert!(refused("NX 6000:FF").starts_with("object 0x6000 has no subindex FF"));
    for text in ["NX 1C32", "event 0x1018", "NX", "NX watchdgo", "nxwatchdog"] {
        assert!(refused(text).contains("is not known"), "{text}");
    }
}

#[test]
fn an_emergency_error_code_lists_its_events() {
    let [esc] = &explain("5600").unwrap()[..] else { panic!("one meaning") };
    assert_eq!((esc.name.as_str(), esc.advice.len()), ("ESC Error", 1));
    let [shared] = &explain("A000").unwrap()[..] else { panic!("one meaning") };
    assert_eq!(shared.name, "PRE-OP to SAFE-OP not successful, 16 events");
    assert_eq!(shared.sections[0].facts.len(), 16);
}

#[test]
fn an_al_status_code_lists_its_events() {
    let text = explain("0x0016").unwrap()[0].to_string();
    assert!(text.ends_with("In the NX-ECT101\n  event       39340000 Mailbox Setting Error"), "{text}");
    assert!(explain("0x0013").unwrap()[0].sections.is_empty(), "no event of the unit has it");
}

#[test]
fn an_unknown_code_is_refused_with_those_that_exist_and_with_a_near_one_only() {
    let unknown = refused("0x0099");
    let first = "0x0099 is not known as AL status code, emergency error code, text ID, object or register\nAL status codes: 0000-0004, ";
    assert!(unknown.starts_with(first), "{unknown}");
    assert!(unknown.contains("objects: 1000, 1008-100A, 1018,"), "{unknown}");
    assert!(refused("06020001").contains("; is SDO abort code 0x0602_0000, "));
    assert!(refused("391E0001").contains("; is event 391E0000, Illegal PDO Entry Added M to C, meant?"));
    assert!(refused("5601").contains("; is emergency error code 0x5600, ESC Error, meant?"));
    assert!(
        refused("12345678")
            .starts_with("0x1234_5678 is not known as event code, SDO abort code or diagnosis code\n")
    );
}
