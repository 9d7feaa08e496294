//! Codes, objects, indicators and words in every usual notation, and their meanings.

use std::collections::BTreeMap;

use coe_kit::indicators::Pattern;
use nx_ect101::{Event, EventCode};
use objects::ObjectCode;
use wire::{AlState, AlStatusCode, Command, ObjectIndex, SubIndex};

use super::*;

/// Unit files of the project.
const UNIT_FILES: [(&str, &str); 3] = [
    ("nx-ect101.toml", include_str!("../../../../units/nx-ect101.toml")),
    ("nx-ect101-1200-bytes.toml", include_str!("../../../../units/nx-ect101-1200-bytes.toml")),
    ("nx-ect101-mixed-520-bytes.toml", include_str!("../../../../units/nx-ect101-mixed-520-bytes.toml")),
];

fn subjects(text: &str) -> Vec<Subject> {
    explain(text)
        .unwrap_or_else(|error| panic!("{text}: {error}"))
        .into_iter()
        .map(|known| known.subject)
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
fn a_code_that_is_several_things_is_told_as_all_of_them() {
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

fn told(text: &str) -> String {
    to_text(&explain(text).unwrap_or_else(|error| panic!("{text}: {error}")))
}

fn refused(text: &str) -> String {
    let unexplained = explain(text).unwrap_err();
    format!("{unexplained}\n{}", unexplained.help())
}

#[test]
fn every_object_and_every_entry_of_the_tables_is_explained() {
    for object in nx_ect101::object_table().iter() {
        let index = object.index;
        assert!(subjects(&index.to_string()).contains(&Subject::Object(index)), "{index}");
        for entry in &object.entries {
            let text = format!("{:X}:{}", index.0, entry.sub);
            let explanation = told(&text);
            assert!(
                explanation.starts_with(&format!("object {index}:{}: {}", entry.sub, entry.name)),
                "{explanation}"
            );
        }
    }
    for object in nx_ect101::nx_objects() {
        assert!(subjects(&format!("{:04X}", object.index.0)).contains(&Subject::NxObject(object.index)));
        for entry in &object.entries {
            let text = format!("{}:{}", object.index, entry.sub);
            assert!(subjects(&text).contains(&Subject::NxEntry(object.index, entry.sub)), "{text}");
        }
    }
}

#[test]
fn an_object_shows_its_entries_and_an_entry_what_it_does() {
    let identity = told("0x1018");
    assert!(
        identity.starts_with("object 0x1018: Identity Object\n  kind        record, with complete access"),
        "{identity}"
    );
    assert!(
        identity.contains("\n  :02         Product Code, U32, 32 bit, RO, default 0000017C"),
        "{identity}"
    );
    let flags = told("10F3:05");
    for fragment in [
        "object 0x10F3:05: Flags",
        "0 to 1 hex",
        "written in PRE-OP, SAFE-OP, OP",
        "when communications start",
    ] {
        assert!(flags.contains(fragment), "{fragment}: {flags}");
    }
    let status = told("2002:1");
    assert!(status.contains("bit 4       Observation\n  bit 5       Minor Fault"), "{status}");
    let slave_status = told("6003:01");
    assert!(slave_status.contains("NX object 0x6003:01: EtherCAT Slave Status"), "{slave_status}");
    assert!(
        slave_status.contains("bit 9       Ready to Write Message Data to EtherCAT Master"),
        "{slave_status}"
    );
    assert!(told("7000:07").contains("NX object   0x6000:07, Data Set in 15 UINT Arrays"));
}

#[test]
fn an_entry_that_is_not_there_is_told_with_those_that_are() {
    assert_eq!(refused("1018:05"), "object 0x1018 has no subindex 05\nits subindexes are 00, 01, 02, 03, 04");
    assert!(refused("1001:04").contains("its subindexes are 00, 01, 02, 03"), "an NX object");
    assert!(refused("1019:00").starts_with("there is no object 0x1019\n"));
}

#[test]
fn every_register_is_explained_at_each_of_its_bytes() {
    for register in esc::REGISTERS {
        let last = register.offset + (register.count - 1) * register.stride_bytes + register.size_bytes - 1;
        for offset in [register.offset, last] {
            assert!(
                subjects(&format!("{offset:04X}")).contains(&Subject::Register(offset)),
                "0x{offset:04X}"
            );
        }
    }
    let status = told("0x0131");
    assert!(
        status.contains("register 0x0131: AL status\n  offset      0x0130 to 0x0131, 2 bytes"),
        "{status}"
    );
}

#[test]
fn every_indicator_and_pattern_is_explained_by_its_name() {
    for name in indicator::names() {
        let known = subjects(&name.to_lowercase());
        assert!(known.contains(&Subject::Indicator(name)), "{name}");
        assert_eq!(known, names::subjects(name), "{name} is a name, not only a part of names");
    }
    for pattern in Pattern::ALL {
        let written = pattern.id().replace('_', " ");
        assert!(subjects(&written).contains(&Subject::Pattern(pattern)), "{written}");
    }
    let err = told("ERR");
    assert!(err.contains("red         double_flash (200 ms lit, 200 ms dark, 200 ms lit, 1000 ms dark): process data stopped in OP"), "{err}");
    assert!(err.contains("85000000"), "{err}");
    assert_eq!(subjects("L/A").len(), 2, "IN and OUT");
}

/// With `led` next to the name, before and after it, with the pattern, and without.
#[test]
fn every_light_of_every_indicator_is_explained() {
    for indicator in nx_ect101::Indicator::all() {
        for (name, status) in
            indicator.names.iter().flat_map(|name| indicator.status.iter().map(move |row| (name, row)))
        {
            let dark = status.pattern == Pattern::NotLit;
            let colour = if dark { "dark" } else { status.colour.id() };
            let pattern = if dark { "off".to_owned() } else { status.pattern.id().replace('_', " ") };
            for text in [
                format!("{name} {colour}"),
                format!("{colour} {name}"),
                format!("{name} {pattern}"),
                format!("{name} LED {colour}"),
                format!("{pattern} {name} led"),
            ] {
                assert!(subjects(&text).contains(&Subject::Indicator(name)), "{text}");
            }
        }
    }
    let [ts] = &explain("TS green").unwrap()[..] else { panic!("one meaning") };
    assert!(ts.to_string().contains("normal, ready for I/O refreshing"), "{ts}");
    for text in [
        "TS red",
        "red TS",
        "TS flashing",
        "TS flashing red",
        "TS red flashing 1s",
        "L/A green",
        "RUN LED off",
    ] {
        assert!(subjects(text).iter().any(|subject| matches!(subject, Subject::Indicator(_))), "{text}");
    }
    assert!(refused("TS blue").contains("is not known"));
}

#[test]
fn every_function_and_block_of_structured_text_is_explained() {
    for entry in st::reference() {
        for name in [entry.name.to_owned(), entry.name.to_lowercase()] {
            assert!(subjects(&name).contains(&Subject::Library(entry.name)), "{name}");
        }
    }
    let counter = told("CTU");
    assert!(counter.starts_with("Structured Text CTU: "), "{counter}");
    for fragment in ["\n  group       function blocks", "\n  inputs      CU: BOOL", "\n  returns     Q: BOOL"]
    {
        assert!(counter.contains(fragment), "{fragment}: {counter}");
    }
    assert!(told("ResetNXBError").contains("Execute: BOOL"));
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
fn a_gap_is_explained_as_sdo_information_describes_it() {
    let mut gaps = 0;
    for object in nx_ect101::object_table().iter() {
        for sub in (0..=object.max_sub().0).map(SubIndex).filter(|sub| object.is_gap(*sub)) {
            let text = told(&format!("{}:{sub}", object.index));
            assert!(
                text.starts_with(&format!("object {}:{sub}: a gap without data\n", object.index)),
                "{text}"
            );
            gaps += 1;
        }
    }
    assert!(gaps >= 3, "10E0:02, 1C32:03, 1C33:03");
    let text = told("10E0:02");
    for fragment in ["type        none, 0 bit", "access      none", "SDO abort code 0x0609_0011"] {
        assert!(text.contains(fragment), "{fragment}: {text}");
    }
}

#[test]
fn every_word_of_the_glossary_is_explained() {
    for (word, row) in glossary::words() {
        assert!(subjects(word).contains(&Subject::Word(row)), "{word}");
    }
    let watchdog = told("watchdog");
    assert!(
        watchdog.starts_with("word watchdog (WDT): ends OP when no process data was written in time"),
        "{watchdog}"
    );
    assert_eq!(subjects("sync manager"), subjects("SyncManager"));
    assert!(told("DC").contains("distributed clocks"), "its letters are digits too");
    assert!(told("process data").starts_with("word process data: the values"));
}

#[test]
fn names_of_events_objects_and_registers_are_explained() {
    assert_eq!(subjects("esc error"), [Subject::Event(Event::ESC_ERROR)]);
    assert_eq!(subjects("Identity Object"), [Subject::Object(ObjectIndex(0x1018))]);
    assert_eq!(subjects("Production Info"), [Subject::NxObject(ObjectIndex(0x1001))]);
    assert_eq!(subjects("0x10F3:04"), [Subject::Entry(ObjectIndex(0x10F3), SubIndex(4))]);
}

/// Every name of the object dictionary, on both sides.
#[test]
fn every_name_of_an_object_and_of_an_entry_is_explained() {
    for object in nx_ect101::object_table().iter() {
        assert!(subjects(&object.name).contains(&Subject::Object(object.index)), "{}", object.name);
        for entry in &object.entries {
            let known = subjects(&entry.name);
            let is_variable = object.code == ObjectCode::Variable;
            let wanted = if is_variable {
                Subject::Object(object.index)
            } else {
                Subject::Entry(object.index, entry.sub)
            };
            assert!(known.contains(&wanted), "{}:{} {}", object.index, entry.sub, entry.name);
        }
    }
    for object in nx_ect101::nx_objects() {
        assert!(subjects(&object.name).contains(&Subject::NxObject(object.index)), "{}", object.name);
        for entry in &object.entries {
            let wanted = Subject::NxEntry(object.index, entry.sub);
            assert!(subjects(&entry.name).contains(&wanted), "{}:{} {}", object.index, entry.sub, entry.name);
        }
    }
    assert_eq!(subjects("Sysmac Error Status"), [Subject::Entry(ObjectIndex(0x2002), SubIndex(1))]);
    assert_eq!(subjects("minor fault"), subjects("Sysmac Error Status"), "a bit of it");
}

#[test]
fn a_name_of_many_entries_is_told_as_their_list() {
    let text = told("Number of entries");
    assert!(text.contains("object 0x1018:00: Number of entries, Identity Object\nobject "), "{text}");
    assert!(text.lines().all(|line| line.to_lowercase().contains(":00: number of entries, ")), "{text}");
}

/// Every I/O port, its variable and its AT specification, of every unit file of the project.
#[test]
fn every_io_port_of_the_cpu_unit_is_explained() {
    for (file, text) in UNIT_FILES {
        let file =
            nx_ect101::unit_file::UnitFile::parse(text).unwrap_or_else(|errors| panic!("{file}: {errors}"));
        let variables = plc::DeviceVariables::of(file.variable_table());
        for (_, variable) in variables.iter() {
            let port = variable.port.as_ref().unwrap_or(&variable.name);
            for name in [Some(port), Some(&variable.name), variable.at.as_ref()].into_iter().flatten() {
                let known = subjects(name);
                let is_port = |subject: &Subject| matches!(subject, Subject::Port(known) if known == port);
                assert!(known.iter().any(is_port), "{name}: {known:?}");
            }
        }
    }
    assert!(told("SDO Communications Enabled").contains("bit         0 of EtherCAT Slave Status"));
    assert!(
        told("NX Unit I/O Data Active Status")
            .starts_with("I/O port NX Unit I/O Data Active Status: BOOL, programs read it")
    );
    assert!(told("_NXB_UnitErrFlagTbl").contains("ARRAY[0..32] OF BOOL"));
    let entry = told("UINTs 03 C to M");
    assert!(
        entry.contains("I/O port UINTs 03 C to M: ARRAY[0..14] OF UINT, programs read and write it"),
        "{entry}"
    );
    assert!(entry.contains("NX object 0x7000:03: UINTs 03 C to M"), "{entry}");
}

/// Every key of the reader, by its path and by its last word; a number alone is an object or an event.
#[test]
fn every_key_of_the_unit_file_is_explained() {
    let of_cpu = plc::CPU_KEYS.map(|key| format!("cpu.{key}"));
    for path in nx_ect101::unit_file::keys().into_iter().chain(of_cpu) {
        let last = path.rsplit_once('.').map_or(path.as_str(), |(_, last)| last);
        let is_number = last.starts_with(|first: char| first.is_ascii_digit());
        for name in [path.as_str(), if is_number { &path } else { last }] {
            let known = subjects(name);
            let is_key = |subject: &Subject| matches!(subject, Subject::Key(known) if *known == path);
            assert!(known.iter().any(is_key), "{name}: {known:?}");
        }
        assert!(explain(&path).unwrap().iter().all(|known| !known.name.is_empty()), "{path}: no words");
    }
    let fail_soft = told("fail_soft");
    assert!(fail_soft.starts_with("key cpu.fail_soft: fail-soft operation of the NX bus"), "{fail_soft}");
    assert!(
        fail_soft.ends_with("  section     [cpu]\n  type, range true, false\n  default     true"),
        "{fail_soft}"
    );
    assert!(told("outputs_before_op").contains("section     the top of the file"));
    assert!(told("start_up").contains("\"300ms\" at each restart"));
    assert!(told("times").ends_with("keys        transitions, sii, mailbox"));
    assert!(told("assign").contains("keys        rx, tx"));
    assert!(told("times.transitions.PS").contains("the request waits in AL control"));
    assert!(told("pdo.mapping.1602").contains("section     [pdo]"));
}

fn commands() -> impl Iterator<Item = String> {
    Command::ALL.into_iter().map(|command| format!("{command:?}").to_uppercase())
}

#[test]
fn every_command_of_a_datagram_is_explained() {
    for command in commands() {
        assert!(matches!(subjects(&command)[..], [Subject::Word(_)]), "{command}");
    }
}

/// An abbreviation has its full words; abbreviations of states and commands are names.
#[test]
fn every_abbreviation_of_the_glossary_is_known_by_its_words_too() {
    let is_name = |word: &str| {
        AlState::ALL.iter().any(|state| state.to_string() == word)
            || commands().any(|command| command == word)
    };
    let is_abbreviation =
        |word: &str| word.len() <= 4 && word.chars().filter(char::is_ascii_uppercase).count() >= 2;
    for (word, row) in glossary::words() {
        let words = glossary::words().filter(|(_, other)| *other == row).count();
        assert!(!is_abbreviation(word) || is_name(word) || words > 1, "{word}");
    }
    for (abbreviation, words) in
        [("DC", "distributed clocks"), ("WDT", "watchdog"), ("WKC", "working counter")]
    {
        assert!(
            subjects(abbreviation).iter().any(|subject| subjects(words).contains(subject)),
            "{abbreviation}"
        );
    }
}

#[test]
fn words_within_names_find_them() {
    assert_eq!(told("identity"), "object 0x1018: Identity Object\nNX object 0x1000: NX Bus Identity");
    assert!(told("Data M to C").contains("NX object 0x6000: UINTs Data M to C"), "{}", told("Data M to C"));
    assert!(told("event log").starts_with("word event log, system event log, access event log: "));
    let many = refused("object to be mapped");
    assert!(many.starts_with("`object to be mapped` is a part of "), "{many}");
    assert!(many.contains("give more words of the name, such as `1st "), "{many}");
    assert!(!refused("entit").contains("Identity"), "a part of a word is none of its words");
}

#[test]
fn an_unknown_code_is_told_with_those_that_exist_and_with_a_near_one_only() {
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

#[test]
fn an_unknown_word_is_told_with_a_near_one_only() {
    assert!(refused("watchdgo").starts_with("`watchdgo` is not known; is `watchdog` meant?"));
    for text in
        ["", "0x", "hello", "123456789", "-1", "+1B", "hex", "banana bread", ":", "1018:", "pump", "a", "to"]
    {
        assert!(!refused(text).contains("meant"), "{text}: {}", refused(text));
    }
}

#[test]
fn every_event_is_told_on_every_channel() {
    for event in nx_ect101::Event::all() {
        let explanations = explain(&event.code.to_string()).unwrap();
        let [known] = &explanations[..] else { panic!("{}: one meaning", event.code) };
        assert!(!known.advice.is_empty(), "{}", event.code);
        let headings: Vec<&str> = known.sections.iter().map(|section| section.heading.as_ref()).collect();
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

#[test]
fn a_text_longer_than_every_name_is_repeated_in_part() {
    let message = explain(&"a".repeat(100_000)).unwrap_err().to_string();
    assert_eq!(message, format!("`{}...` is not known", "a".repeat(40)));
    let longest = names::all().map(|(name, _)| name.len()).max();
    assert!(longest <= Some(TEXT_BYTES_MAX), "{longest:?}");
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
        assert!(told(text).contains(expected), "{text}: {}", told(text));
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
fn the_bits_of_a_register_are_those_of_its_tables() {
    for (text, expected) in [
        ("0x0120", "\nAL control 0x0120\n  bit 3:0     requested state: 1 INIT"),
        ("AL status", "\n  bit 4       error indication"),
        ("DL status", "\n  bit 0       PDI operational / EEPROM loaded"),
        ("0x0502", "\n  bit 15      busy (r)"),
        ("0x0806", "\nActivate 0x0806+8n\n  bit 0       enable"),
        ("0x080E", "\nActivate 0x0806+8n\n  bit 0       enable"),
    ] {
        assert!(told(text).contains(expected), "{text}: {}", told(text));
    }
    assert!(!told("AL status").contains("acknowledge"), "{}", told("AL status"));
}
