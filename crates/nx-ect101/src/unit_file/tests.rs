use proptest::prelude::*;
use unit_model::keys::OutputsRule;
use wire::{AlState, AlStatusCode};

use super::*;
use crate::data_sets::{DataSet, DataSetKind, Direction};
use crate::events::EventLevel;
use crate::unit_information::{UnitVersion, VersionText};

const FACTORY: &str = include_str!("../../../../units/nx-ect101.toml");
const ARRAYS: &str = include_str!("../../../../units/nx-ect101-1200-bytes.toml");
const MIXED: &str = include_str!("../../../../units/nx-ect101-mixed-520-bytes.toml");

/// A file with every key.
const FULL: &str = r#"
model = "nx-ect101"
name = "N1"
unit_number = 1
serial = 1
id_switch = 0x01
alias = 300
device_type = 0x00020001
unit_version = "1.2"
lot_number = 0x1D0B1A00
hardware_version = "V1.10"
software_version = "V1.02 V2.00"
timing = "exact"
outputs_before_op = "not-required"
blank_sii = true
storage = "N1.nvm"

[times]
transitions = { PS = "50ms", SO = "2s" }
sii = "1ms"
mailbox = "10ms"

[refuse]
safe_op = 0x0024
acknowledge = true

[io_allocation.m_to_c]
uints = 6
udint = ["6002:01", "6002:02"]
[io_allocation.c_to_m]
uints = 6

[pdo]
assign.rx = [0x1601]
assign.tx = [0x1A00, 0x1A01, 0x1BFE]
mapping.1601 = 6
mapping.1A03 = ["6002:02", "6001:01"]

[event_levels]
"39170000" = "observation"

[cpu]
task_period = "1ms"
mode = "run"
fail_soft = false
program = "echo.st"
"#;

#[test]
fn a_file_with_every_key_reads_as_written() {
    let file = UnitFile::parse(FULL).unwrap();
    assert_eq!((file.model.value, file.name.value.as_str()), (Model::NxEct101, "N1"));
    assert_eq!((file.unit_number.value, file.serial.value, file.id_switch.value), (1, 1, 1));
    assert_eq!(file.alias.map(|alias| alias.value), Some(300));
    let information = UnitInformation {
        device_type: Some(0x0002_0001),
        unit_version: UnitVersion::parse("1.2"),
        lot_number: Some(0x1D0B_1A00),
        hardware_version: VersionText::parse("V1.10"),
        software_version: VersionText::parse("V1.02 V2.00"),
    };
    assert_eq!(file.information, information);
    assert_eq!(file.timing.value, Timing::Exact);
    assert_eq!(file.slave.outputs_before_op, Some(OutputsRule::NotRequired));
    let ms = Duration::from_millis;
    let times = &file.slave.conduct.transition_times;
    let transition = |from, to| times.of(from, to);
    assert_eq!(transition(AlState::PreOp, AlState::SafeOp), ms(50));
    assert_eq!(transition(AlState::SafeOp, AlState::Op), ms(2000));
    assert_eq!(transition(AlState::Init, AlState::PreOp), ms(0));
    assert_eq!((file.slave.sii_time, file.slave.mailbox_time), (ms(1), Some(ms(10))));
    assert_eq!(file.slave.conduct.refusals.of(AlState::SafeOp), Some(AlStatusCode(0x0024)));
    assert_eq!(file.slave.conduct.refusals.of(AlState::Op), None);
    assert!(file.slave.conduct.ignores_acknowledge && file.slave.is_sii_blank);
    assert_eq!(file.storage.unwrap().value, PathBuf::from("N1.nvm"));
    let [level] = file.event_levels.as_slice() else { panic!("{:?}", file.event_levels) };
    assert_eq!((level.event_code.value.0, level.level.value), (0x3917_0000, EventLevel::Observation));
}

#[test]
fn unit_numbers_are_those_of_the_nx_bus() {
    let read = |number: u8| UnitFile::parse(&format!("model = \"nx-ect101\"\nunit_number = {number}"));
    for number in 0..=u8::MAX {
        assert_eq!(read(number).is_ok(), (1..=32).contains(&number), "{number}");
    }
}

#[test]
fn mistakes_without_number_are_told_up_to_twenty() {
    let keys: String = (0..20_000).rev().map(|at| format!("key_{at:05} = 1\n")).collect();
    let errors = UnitFile::parse(&format!("{keys}model = \"nx-ect101\"\n")).unwrap_err();
    assert_eq!((errors.iter().count(), errors.more()), (20, 19_980));
    let first = errors.iter().next().unwrap();
    assert_eq!((first.line, first.message.as_str()), (1, "unknown key `key_19999`"));
    assert_eq!(errors.to_string().lines().last(), Some("and 19980 more"));
    // Text that is not TOML at all, with more than one mistake in each line.
    let broken = UnitFile::parse(&"= ] [ \"\n".repeat(20_000)).unwrap_err();
    assert!(broken.iter().count() <= 20 && broken.to_string().len() < 10_000, "{broken}");
}

#[test]
fn a_key_without_end_is_cut() {
    let errors = UnitFile::parse(&format!("model = \"nx-ect101\"\n{} = 1", "k".repeat(100_000))).unwrap_err();
    assert!(errors.to_string().len() < 400, "{}", errors.to_string().len());
}

#[test]
fn entries_are_kept_as_written_with_their_places() {
    let file = UnitFile::parse(FULL).unwrap();
    let io_allocation = file.io_allocation.as_ref().unwrap();
    let [uints, udint] = io_allocation.value.m_to_c.as_slice() else { panic!("{io_allocation:?}") };
    assert_eq!((uints.kind, &uints.entries.value), (DataSetKind::Uints, &Entries::Count(6)));
    let Entries::List(list) = &udint.entries.value else { panic!("{udint:?}") };
    assert_eq!(list[1].value, address(0x6002, 2));
    assert_eq!(&FULL[list[1].span.clone().unwrap()], "\"6002:02\"");
    let pdo = file.pdo.as_ref().unwrap();
    assert_eq!(assigned(&pdo.value.assign_tx), [0x1A00, 0x1A01, 0x1BFE]);
    let [first, second] = pdo.value.mappings.as_slice() else { panic!("{pdo:?}") };
    assert_eq!((first.pdo.value.0, &first.entries.value), (0x1601, &Entries::Count(6)));
    assert_eq!(&FULL[second.pdo.span.clone().unwrap()], "1A03");
    let wrong = [address(0x6002, 2), address(0x6001, 1)];
    assert_eq!(second.entries.value.addresses(second.pdo.value), wrong);
}

#[test]
fn what_is_left_out_is_as_documented() {
    let file = UnitFile::parse("model = \"nx-ect101\"").unwrap();
    assert_eq!(file.name, Located::left_out("N1".into()));
    assert_eq!((file.unit_number.value, file.serial.value, file.id_switch.value), (1, 1, 1));
    assert_eq!(file.timing.value, Timing::Exact);
    assert_eq!((&file.io_allocation, &file.pdo, &file.storage), (&None, &None, &None));
    assert_eq!(file.io_allocation(), IoAllocation::factory());
}

#[test]
fn a_data_set_that_is_left_out_is_not_selected() {
    let file = UnitFile::parse("model = \"nx-ect101\"\n[io_allocation.m_to_c]\nbytes = 3").unwrap();
    let allocation = file.io_allocation();
    assert_eq!(allocation.layout(Direction::MToC).size_bytes(), 30);
    assert_eq!(allocation.layout(Direction::CToM).size_bytes(), 0);
}

#[test]
fn numbers_beyond_a_maximum_are_kept_for_the_rules() {
    let text = "model = \"nx-ect101\"\nio_allocation.m_to_c.uints = 41\npdo.assign.tx = [0x1601]\npdo.mapping.1a01 = 99";
    let file = UnitFile::parse(text).unwrap();
    assert_eq!(file.io_allocation().entries(Direction::MToC, DataSetKind::Uints).len(), 41);
    let pdo = file.pdo.unwrap().value;
    assert_eq!(assigned(&pdo.assign_tx), [0x1601]);
    assert_eq!(pdo.mappings[0].entries.value, Entries::Count(99));
}

/// The manual's three examples (6-3-4): both sides of each file have the total in the manual.
#[test]
fn the_files_of_the_manuals_examples_have_its_totals() {
    for (text, total) in [(FACTORY, 180), (ARRAYS, 1200), (MIXED, 520)] {
        let file = UnitFile::parse(text).unwrap();
        for direction in [Direction::MToC, Direction::CToM] {
            assert_eq!(file.io_allocation().layout(direction).size_bytes(), total);
            assert_eq!(pdo_bytes(&file, direction), total);
        }
    }
}

#[test]
fn the_factory_file_is_the_factory_setting() {
    assert_eq!(UnitFile::parse(FACTORY).unwrap().io_allocation(), IoAllocation::factory());
}

/// Exchanged bytes of the assigned mappings of `direction`.
fn pdo_bytes(file: &UnitFile, direction: Direction) -> usize {
    let pdo = &file.pdo.as_ref().unwrap().value;
    let assigned = assigned(if direction == Direction::MToC { &pdo.assign_rx } else { &pdo.assign_tx });
    let mappings = pdo.mappings.iter().filter(|mapping| assigned.contains(&mapping.pdo.value.0));
    let bytes = mappings.map(|mapping| {
        let set = DataSet::of_pdo(mapping.pdo.value).unwrap();
        assert_eq!(set.direction, direction);
        mapping.entries.value.addresses(set.pdo_entry).len() * usize::from(set.entry_bytes)
    });
    bytes.sum()
}

fn assigned(list: &Option<Located<Vec<Located<wire::ObjectIndex>>>>) -> Vec<u16> {
    list.iter().flat_map(|list| &list.value).map(|pdo| pdo.value.0).collect()
}

const fn address(index: u16, sub: u8) -> EntryAddress {
    EntryAddress { index: wire::ObjectIndex(index), sub: wire::SubIndex(sub) }
}

/// Wrong files, with a line of `=` between them; the messages for the user are in the snapshot.
const WRONG: &[(&str, &str)] = &[
    ("empty file", ""),
    ("comment only", "# nothing\n"),
    ("not TOML at all", "this is no TOML"),
    ("XML", "<EtherCATInfo/>"),
    ("no value", "model ="),
    ("open text", "model = \"nx-ect101\nname = \"N1\""),
    ("open array", "model = \"nx-ect101\"\npdo.assign.rx = [0x1601"),
    ("duplicate key", "model = \"nx-ect101\"\nserial = 1\nserial = 2"),
    ("duplicate table", "model = \"nx-ect101\"\n[cpu]\n[cpu]"),
    ("two of one mapping", "model = \"nx-ect101\"\npdo.mapping.1A01 = 1\npdo.mapping.1a01 = 2"),
    ("model missing", "name = \"N1\""),
    ("unknown model", "model = \"nx-ect102\""),
    ("model of wrong type", "model = 101"),
    ("unknown keys", "model = \"nx-ect101\"\nunit_nr = 1\nunitnumber = 1\nzzz = 1"),
    ("key in the wrong table", "model = \"nx-ect101\"\n[times]\nserial = 1"),
    ("unit number", "model = \"nx-ect101\"\nunit_number = 33"),
    ("unit number 0", "model = \"nx-ect101\"\nunit_number = 0"),
    ("unit number as text", "model = \"nx-ect101\"\nunit_number = \"1\""),
    ("serial too big", "model = \"nx-ect101\"\nserial = 4294967296"),
    ("serial negative", "model = \"nx-ect101\"\nserial = -1"),
    ("serial a float", "model = \"nx-ect101\"\nserial = 1.5"),
    (
        "serial without end",
        "model = \"nx-ect101\"\nserial = 99999999999999999999999999999999999999999999999999",
    ),
    ("id switch", "model = \"nx-ect101\"\nid_switch = 0x100"),
    ("alias", "model = \"nx-ect101\"\nalias = 0"),
    ("device type", "model = \"nx-ect101\"\ndevice_type = \"NX\""),
    ("unit version", "model = \"nx-ect101\"\nunit_version = \"V1.0\""),
    ("unit version as a number", "model = \"nx-ect101\"\nunit_version = 1.0"),
    ("lot number", "model = \"nx-ect101\"\nlot_number = 4294967296"),
    ("hardware version", "model = \"nx-ect101\"\nhardware_version = \"\""),
    ("software version", "model = \"nx-ect101\"\nsoftware_version = \"V1.00 V2.00 V3.00 V4.00\""),
    ("name with a blank", "model = \"nx-ect101\"\nname = \"N 1\""),
    ("name with a digit first", "model = \"nx-ect101\"\nname = \"1N\""),
    ("name empty", "model = \"nx-ect101\"\nname = \"\""),
    ("timing", "model = \"nx-ect101\"\ntiming = \"fsat\""),
    ("outputs before OP", "model = \"nx-ect101\"\noutputs_before_op = \"notrequired\""),
    ("outputs before OP as truth", "model = \"nx-ect101\"\noutputs_before_op = false"),
    ("blank SII", "model = \"nx-ect101\"\nblank_sii = 1"),
    ("times", "model = \"nx-ect101\"\ntimes = \"1s\""),
    (
        "times of the wrong name",
        "model = \"nx-ect101\"\ntimes.mailboxes = \"1s\"\ntimes.transitions.SPO = \"1s\"",
    ),
    (
        "times too long",
        "model = \"nx-ect101\"\ntimes = { transitions = { PS = \"61s\" }, sii = \"soon\", mailbox = 5 }",
    ),
    ("transitions as a number", "model = \"nx-ect101\"\ntimes.transitions = 20"),
    ("refusals", "model = \"nx-ect101\"\nrefuse = { safeop = 1, op = 0, pre_op = 0x10000, acknowledge = 1 }"),
    ("storage", "model = \"nx-ect101\"\nstorage = \"\""),
    ("unknown data set", "model = \"nx-ect101\"\n[io_allocation.m_to_c]\nuint = 6"),
    ("unknown direction", "model = \"nx-ect101\"\n[io_allocation.m_to_m]\nuints = 6"),
    ("count", "model = \"nx-ect101\"\nio_allocation.m_to_c.uints = 256"),
    ("count as text", "model = \"nx-ect101\"\nio_allocation.m_to_c.uints = \"6\""),
    (
        "entries",
        "model = \"nx-ect101\"\nio_allocation.m_to_c.udint = [\"6002:01\", \"6002-02\", 3, \"60020:1\"]",
    ),
    ("assign no list", "model = \"nx-ect101\"\npdo.assign.rx = 0x1601"),
    ("assign", "model = \"nx-ect101\"\npdo.assign.rx = [0x11601, \"1601\"]"),
    ("mapping of no data set", "model = \"nx-ect101\"\npdo.mapping.1600 = 6\npdo.mapping.1A00 = 6"),
    ("mapping", "model = \"nx-ect101\"\npdo.mapping.1601 = true"),
    (
        "event",
        "model = \"nx-ect101\"\n[event_levels]\n\"39180000\" = \"observation\"\n\"10410000\" = \"observation\"",
    ),
    ("event level", "model = \"nx-ect101\"\nevent_levels.39160000 = \"minor\""),
    ("after letters of more than one byte", "# µs\r\nmodel = \"nx-ect101\" \r\n\"ÄÖ\" = { a = 1 }\r\n"),
    ("everything at once", "model = 1\nserial = -1\nmodell = 2\n[times]\nsii = 3\nmailbox = 4"),
];

#[test]
fn a_wrong_file_is_told_with_place_value_and_expectation() {
    let told: Vec<String> = WRONG
        .iter()
        .map(|(title, text)| {
            let errors = UnitFile::parse(text).unwrap_err();
            format!("{title}:\n{}", errors.in_file("unit.toml"))
        })
        .collect();
    insta::assert_snapshot!(told.join("\n"));
}

/// An object has 255 subindexes at most, and so has a list of entries.
#[test]
fn a_list_has_255_entries_at_most() {
    for (key, entry) in [("io_allocation.m_to_c.uints", "6000:01"), ("pdo.mapping.1601", "7000:01")] {
        let text = |count: usize| {
            format!("model = \"nx-ect101\"\n{key} = [{}]", format!("{entry:?},").repeat(count))
        };
        assert_eq!(UnitFile::parse(&text(255)).err(), None, "{key}");
        let errors = UnitFile::parse(&text(256)).unwrap_err().in_file("u.toml").to_string();
        assert_eq!(
            errors.trim_end(),
            format!("u.toml:2:{}: `{key}` has 256 entries, expected 255 at most", key.len() + 4)
        );
    }
}

#[test]
fn the_least_unit_version_is_the_one_in_the_message() {
    let file = UnitFile::parse("model = \"nx-ect101\"\nunit_version = \"0.0\"").expect("as the message says");
    assert_eq!(file.information.unit_version, UnitVersion::parse("0.0"));
}

#[test]
fn spans_point_at_what_is_wrong() {
    let text = "model = \"nx-ect101\"\n[times]\nsii = \"walk\"";
    let errors = UnitFile::parse(text).unwrap_err();
    let error = errors.iter().next().unwrap();
    assert_eq!((&text[error.span.clone()], error.line, error.column), ("\"walk\"", 3, 7));
}

#[test]
fn a_file_of_deep_tables_is_refused() {
    let text = format!("model = {}", "[".repeat(100_000));
    assert!(UnitFile::parse(&text).is_err());
}

/// Pieces that reach more of the reader than random letters do.
fn pieces() -> impl Strategy<Value = String> {
    let piece = prop::sample::select(vec![
        "model",
        "nx-ect101",
        "\"",
        "=",
        "[",
        "]",
        ".",
        "\n",
        "io_allocation",
        "m_to_c",
        "uints",
        "6",
        "-1",
        "0x",
        "pdo",
        "mapping",
        "1601",
        "assign",
        "rx",
        "event_levels",
        "39170000",
        "cpu",
        "task_period",
        "1ms",
        ",",
        "{",
        "}",
        "ä",
        "#",
    ]);
    prop::collection::vec(piece, 0..60).prop_map(|pieces| pieces.concat())
}

proptest! {
    #[test]
    fn any_text_is_read_or_refused(text in any::<String>()) {
        check_errors(&text)?;
    }

    #[test]
    fn any_pieces_are_read_or_refused(text in pieces()) {
        check_errors(&text)?;
    }

    #[test]
    fn any_damage_is_read_or_refused(at in 0..FACTORY.len(), length in 0usize..40, with in "\\PC{0,3}") {
        let mut text: Vec<u8> = FACTORY.bytes().collect();
        text.splice(at..(at + length).min(FACTORY.len()), with.bytes());
        check_errors(&String::from_utf8_lossy(&text))?;
    }
}

/// Nothing panics; every error is inside the text.
fn check_errors(text: &str) -> Result<(), TestCaseError> {
    if let Err(errors) = UnitFile::parse(text) {
        prop_assert!(errors.iter().count() > 0);
        for error in errors.iter() {
            prop_assert!(error.span.end <= text.len() && error.line >= 1 && error.column >= 1);
            prop_assert!(!error.to_string().contains('\n'));
        }
    }
    Ok(())
}
