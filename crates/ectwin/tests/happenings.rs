//! What happens to a twin, as records: every kind, its fields, its words.
#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

mod events_schema;

use std::collections::BTreeSet;

use ectwin::happenings::{Detail, KINDS, Record, findings, lost_records, ready};
use ectwin::link::{FramePort, memory};
use ectwin::master::{Connected, Master};
use ectwin::plant::line::{CableNumber, Choice, Disturbance, FrameFault, FrameKind, Frames, LineOrder};
use ectwin::{AlState, Duration, Fault, Happenings, Instant, OperatingMode, Setup, Twin};
use events_schema::accepts;
use wire::{Command, FrameBuilder, SdoTarget};

const UNIT: &str = "model = \"nx-ect101\"\noutputs_before_op = \"not-required\"\n";

fn connected() -> (Connected<Twin>, Happenings) {
    let mut twin = Twin::from_toml(UNIT).unwrap();
    let happenings = twin.observe();
    (twin.connect(Master::default()), happenings)
}

fn texts(records: &[Record], kind: &str) -> Vec<String> {
    records.iter().filter(|record| record.kind == kind).map(|record| record.text.clone()).collect()
}

/// A record is JSON that the schema accepts, with the level of its row in the table.
fn check(record: &Record) {
    let json = events_schema::valid(record);
    let row = KINDS.iter().find(|row| row.name == record.kind);
    let row = row.unwrap_or_else(|| panic!("the table lacks the kind {}", record.kind));
    let shown_by = match record.detail {
        Detail::Brief | Detail::Full if record.kind == "sdo" => "-vv; -v if aborted",
        Detail::Brief => "-v",
        Detail::Full => "-vv",
        Detail::Programs => "-",
    };
    assert_eq!(row.shown_by, shown_by, "{json}");
    assert_eq!(json["kind"], record.kind);
}

/// A line that has most kinds of happenings, in virtual time.
fn everything() -> Vec<Record> {
    let setups = [Setup::from_toml(UNIT).unwrap()];
    let mut records = ready(Instant::ZERO, "memory", 1_000, &setups);
    let (mut bench, mut happenings) = connected();
    bench.search().unwrap();
    bench.take_to(0, AlState::PreOp).unwrap();
    bench.download(0, SdoTarget::entry(0x10F3, 5), &[1, 0]).unwrap();
    bench.upload(0, SdoTarget::entry(0x9999, 0)).unwrap_err();
    bench.take_to(0, AlState::Op).unwrap();
    bench.run_for(Duration::from_millis(200));
    bench.line.unit(0).inject(Fault::IoCommunications);
    bench.run_for(Duration::from_millis(20));
    bench.line.unit(0).remove(Fault::IoCommunications);
    let lost = Disturbance::new(FrameFault::Lose, Frames::of(Choice::Next(1)).with_kind(FrameKind::Any));
    bench.line.disturb(lost).unwrap();
    bench.run_for(Duration::from_millis(20));
    bench.line.line_order(&LineOrder::Unplug { cable: CableNumber::new(1).unwrap() }).unwrap();
    bench.run_for(Duration::from_millis(200));
    bench.line.unit(0).cycle_power();
    records.extend(happenings.take());
    // Nobody sends a frame any more.
    bench.line.run_for(Duration::from_secs(3));
    records.extend(happenings.take());
    records
}

/// The other kinds, but for carriers.
fn the_rest() -> Vec<Record> {
    let broken = "model = \"nx-ect101\"\n[io_allocation]\nm_to_c.uints = 4\nc_to_m.uints = 6\n";
    let mut records: Vec<Record> = findings(Instant::ZERO, &Setup::from_toml(broken).unwrap()).collect();
    records.push(lost_records(Instant::ZERO, 3));
    let mut bench = without_mailbox(&mut records);
    for order in ["power off unit 1", "power on unit 1", "set unit 1 to PROGRAM mode"] {
        bench.0.line.apply(order).unwrap();
        bench.0.run_for(Duration::from_millis(20));
    }
    records.extend(bench.1.take());
    records
}

#[test]
fn records_of_every_kind_are_valid_by_the_schema() {
    let records: Vec<Record> = everything().into_iter().chain(the_rest()).collect();
    records.iter().for_each(check);
    let seen: BTreeSet<&str> = records.iter().map(|record| record.kind).collect();
    let missing: Vec<&str> = KINDS.iter().map(|row| row.name).filter(|kind| !seen.contains(kind)).collect();
    // Only a real link has one; it is checked in happenings_in_time.rs.
    assert_eq!(missing, ["carrier"], "{seen:?}");
}

#[test]
fn the_schema_refuses_what_is_no_record() {
    let power = r#"{"at_ns":0,"unit":1,"name":"N1","kind":"power","text":"…","on":true}"#;
    assert!(accepts(power));
    for (right, wrong) in [
        ("\"power\"", "\"powder\""),
        ("true", "\"true\""),
        ("\"at_ns\":0,", ""),
        (":0", ":-1"),
        (",\"on\":true", ""),
        ("\"on\":true", "\"on\":true,\"off\":false"),
    ] {
        assert!(!accepts(&power.replacen(right, wrong, 1)), "{wrong}");
    }
    let link = r#"{"at_ns":0,"kind":"link","text":"…","port":"IN","present":true}"#;
    assert!(accepts(link) && !accepts(&link.replace("IN", "MIDDLE")));
    let state = r#"{"at_ns":0,"kind":"state","text":"…","from":"OP","to":"INIT","error":false,"al_status_code":"0x0000"}"#;
    assert!(accepts(state) && !accepts(&state.replace("0x0000", "0000")));
}

#[test]
fn records_name_states_codes_events_objects_and_faults() {
    let records = everything();
    let states = texts(&records, "state");
    assert!(states[0].starts_with("is in PRE-OP, was in INIT"), "{states:?}");
    let sdos = texts(&records, "sdo");
    assert!(
        sdos.iter().any(|words| words.contains("SDO download 10F3:05") && words.contains("bytes: 01 00")),
        "{sdos:?}"
    );
    let aborted = "SDO upload 9999:00 is aborted by the unit: 0x06020000";
    assert!(sdos.iter().any(|words| words.starts_with(aborted)), "{sdos:?}");
    let mappings = texts(&records, "mapping");
    assert!(
        mappings.iter().any(|words| words.starts_with("maps 180 bytes of outputs: SM 2 at 0x")),
        "{mappings:?}"
    );
    let events = texts(&records, "event");
    assert!(
        events.iter().any(|words| words.starts_with("records 80200000 NX Unit I/O Communications Error (")),
        "{events:?}"
    );
    let emergencies = texts(&records, "emergency");
    assert!(
        emergencies
            .iter()
            .any(|words| words.starts_with("sends emergency 0xFF20, data 00 00 00 20 80 (80200000")),
        "{emergencies:?}"
    );
    assert_eq!(
        texts(&records, "fault"),
        ["fault IoCommunications is injected", "fault IoCommunications is removed"]
    );
    let faults = texts(&records, "frame_fault");
    assert_eq!(faults.len(), 2, "{faults:?}");
    assert!(faults[0].starts_with("a fault of frames begins: lose"), "{faults:?}");
    assert!(faults[1].starts_with("a fault of frames has ended: lose"), "{faults:?}");
    assert_eq!(texts(&records, "link"), ["port IN has no link"]);
    let masters = texts(&records, "master");
    assert_eq!(masters, ["a master sends frames", "the master has sent no frame for 1s"]);
}

#[test]
fn records_come_in_the_order_of_their_times_and_each_once() {
    let (mut bench, mut happenings) = connected();
    bench.search().unwrap();
    bench.take_to(0, AlState::Op).unwrap();
    let records = happenings.take();
    assert!(records.is_sorted_by_key(|record| record.at) && records.len() >= 6, "{records:?}");
    let states = texts(&records, "state");
    let reached: Vec<&str> =
        states.iter().filter_map(|words| words.strip_prefix("is in ")?.split(',').next()).collect();
    assert_eq!(reached, ["PRE-OP", "SAFE-OP", "OP"]);
    assert_eq!(happenings.take(), []);
}

/// The queue holds 8,192 records; an SDO makes three.
#[test]
fn records_for_which_there_is_no_room_are_counted() {
    let (mut bench, mut happenings) = connected();
    bench.search().unwrap();
    bench.take_to(0, AlState::PreOp).unwrap();
    for _ in 0..3_000 {
        bench.upload(0, SdoTarget::entry(0x1018, 1)).unwrap();
    }
    let records = happenings.take();
    let lost = records.last().unwrap();
    check(lost);
    assert_eq!((records.len(), lost.kind), (8_193, "lost"));
    assert!(lost.json().contains("\"lost\":"), "{}", lost.json());
    assert_eq!(happenings.take(), [], "they are reported once");
}

/// A unit that has an emergency to send and no mailbox.
fn without_mailbox(records: &mut Vec<Record>) -> (Connected<Twin>, Happenings) {
    let (mut bench, mut happenings) = connected();
    bench.search().unwrap();
    bench.take_to(0, AlState::PreOp).unwrap();
    bench.download(0, SdoTarget::entry(0x10F3, 5), &[1, 0]).unwrap();
    bench.take_to(0, AlState::Init).unwrap();
    bench.line.unit(0).inject(Fault::IoCommunications);
    bench.run_for(Duration::from_millis(20));
    records.extend(happenings.take());
    (bench, happenings)
}

#[test]
fn emergencies_without_a_mailbox_are_one_record() {
    let mut records = Vec::new();
    without_mailbox(&mut records);
    assert_eq!(texts(&records, "emergencies_lost").len(), 1, "{records:?}");
}

/// On a link: the carrier of a medium in memory never changes, the CPU Unit reports by itself.
#[test]
fn a_link_has_the_reports_of_cpu_units_too() {
    let mut twin = Twin::power_on([Setup::from_toml(UNIT).unwrap().fast()]);
    let mut happenings = twin.observe();
    let (units, mut ours) = memory::pair();
    let live = twin.serve(units).unwrap();
    live.look(0, |unit| unit.cpu().set_mode(OperatingMode::Program));
    ours.send(&FrameBuilder::new().physical(Command::Brd, 0, 0x0130, &[0; 2]).finish()).unwrap();
    let mut records = Vec::new();
    let is_there =
        |records: &[Record], words: &str| records.iter().any(|record: &Record| record.text == words);
    // A machine that is busy elsewhere makes the CPU Unit report that too.
    let expected = ["CPU Unit: PROGRAM mode", "a master sends frames"];
    let limit = std::time::Instant::now() + std::time::Duration::from_secs(10);
    while !expected.iter().all(|words| is_there(&records, words)) {
        assert!(std::time::Instant::now() < limit, "{records:?}");
        records.extend(happenings.take());
        std::thread::yield_now();
    }
    live.stop().unwrap();
    records.iter().for_each(check);
}
