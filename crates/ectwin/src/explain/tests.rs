//! Codes in every usual way of writing, and what each is told to be.

use super::*;

fn codes(text: &str) -> Vec<Code> {
    explain(text)
        .unwrap_or_else(|error| panic!("{text}: {error}"))
        .into_iter()
        .map(|known| known.code)
        .collect()
}

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
        assert_eq!(codes(text), [Code::AlStatus(AlStatusCode::SYNC_MANAGER_WATCHDOG)], "{text}");
    }
    for text in ["0x0602_0000", "06020000", "0x06020000", "6020000", "0602_0000"] {
        assert_eq!(codes(text), [Code::Abort(SdoAbort::OBJECT_DOES_NOT_EXIST)], "{text}");
    }
    for text in ["391E0000", "391e0000", "0x391E0000", "0x391E_0000", "391E0000 hex", "391E0000hex"] {
        assert_eq!(codes(text), [Code::Event(EventCode(0x391E_0000))], "{text}");
    }
    assert_eq!(codes("9450000"), [Code::Event(EventCode::ESC_ERROR)], "without its leading zero");
    assert_eq!(explain("8004").unwrap()[0].name, "CPU Unit error (NX-ECT101)");
}

#[test]
fn a_code_that_is_several_things_is_told_as_all_of_them() {
    let memory = Code::Event(EventCode::NON_VOLATILE_MEMORY_HARDWARE_ERROR);
    assert_eq!(codes("0x0020"), [Code::AlStatus(AlStatusCode::NEEDS_COLD_START), memory]);
    assert_eq!(codes("0x5600"), [Code::Emergency(0x5600)]);
    assert_eq!(codes("0x391E"), [Code::Event(EventCode(0x391E_0000))], "a text ID");
    assert_eq!(codes("0xA000E800"), [Code::Emergency(0xA000)], "a diagnosis code");
}

#[test]
fn an_emergency_error_code_tells_its_events() {
    let [esc] = &explain("5600").unwrap()[..] else { panic!("one meaning") };
    assert_eq!((esc.name.as_str(), esc.advice.len()), ("ESC Error", 1));
    let [shared] = &explain("A000").unwrap()[..] else { panic!("one meaning") };
    assert_eq!(shared.name, "PRE-OP to SAFE-OP not successful, 16 events");
    assert_eq!(shared.sections[0].facts.len(), 16);
}

#[test]
fn an_al_status_code_tells_the_events_behind_it() {
    let text = explain("0x0016").unwrap()[0].to_string();
    assert!(text.ends_with("In the NX-ECT101\n  event       39340000 Mailbox Setting Error"), "{text}");
    assert!(explain("0x0013").unwrap()[0].sections.is_empty(), "no event of the unit has it");
}

#[test]
fn an_unknown_code_is_told_with_the_nearest_one() {
    let told = |text| explain(text).unwrap_err().to_string();
    assert_eq!(
        told("0x0099"),
        "0x0099 is not known as AL status code, emergency error code or text ID; the nearest is AL status code \
         0x0083, temperature too high"
    );
    assert!(told("06020001").contains("SDO abort code 0x0602_0000"));
    assert!(told("391E0001").contains("event 391E0000, Illegal PDO Entry Added M to C"));
    assert!(told("5601").contains("emergency error code 0x5600, ESC Error"));
    for text in ["", "0x", "hello", "123456789", "-1", "+1B", "hex"] {
        assert_eq!(explain(text), Err(Unexplained::NotACode), "{text}");
    }
}

#[test]
fn every_event_is_told_on_every_channel() {
    for event in nx_ect101::Event::all() {
        let explanations = explain(&event.code.to_string()).unwrap();
        let [known] = &explanations[..] else { panic!("{}: one meaning", event.code) };
        assert!(!known.advice.is_empty(), "{}", event.code);
        let headings: Vec<&str> = known.sections.iter().map(|section| section.heading).collect();
        for heading in
            ["What the EtherCAT master sees", "What the CPU Unit sees", "Indicators", "Logs and recovery"]
        {
            assert!(headings.contains(&heading), "{}: {heading}", event.code);
        }
        let facts = known.facts.iter().chain(known.sections.iter().flat_map(|section| &section.facts));
        for fact in facts {
            assert!(fact.label.len() <= 11 && !fact.text.is_empty(), "{}: {}", event.code, fact.label);
        }
    }
}

#[test]
fn what_events_say_is_written_in_sentences() {
    for event in nx_ect101::Event::all() {
        let texts = event.causes.iter().flat_map(|row| [&row.cause, &row.correction]);
        for text in texts.chain([&event.meaning, &event.in_ectwin]) {
            let is_sentence =
                text.starts_with(|first: char| first.is_ascii_uppercase() || first.is_ascii_digit());
            assert!(is_sentence && text.ends_with('.'), "{}: {text}", event.code);
            assert!(!text.contains(['|', '\n']), "{}: a cell of a table: {text}", event.code);
        }
    }
}

#[test]
fn every_fault_is_named_where_its_event_is_told() {
    for fault in nx_ect101::Fault::ALL {
        let event = nx_ect101::Event::find(fault.event()).unwrap();
        assert!(event.in_ectwin.contains(&format!("`{fault:?}`")), "{fault:?}: {}", event.in_ectwin);
    }
}
