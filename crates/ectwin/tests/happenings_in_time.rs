//! When records come: of faults of frames, carriers, power, indicators, and units that take the places of others.
#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

#[expect(dead_code, reason = "each test uses a part of it")]
mod events_schema;

use std::{fs, io, path};

use ectwin::happenings::Record;
use ectwin::link::FramePort;
use ectwin::master::{Connected, Master};
use ectwin::plant::line::{Choice, Disturbance, FrameFault, FrameKind, Frames};
use ectwin::{AlState, Duration, Happenings, Instant, Io, ProgramEvent, Setup, Twin};
use wire::{Command, FrameBuilder};

const UNIT: &str = "model = \"nx-ect101\"\nname = \"first\"\n";
const OTHER: &str = "model = \"nx-ect101\"\nname = \"other\"\n";

fn observed(units: usize) -> (Twin, Happenings) {
    let mut twin = Twin::power_on((0..units).map(|_| Setup::from_toml(UNIT).unwrap()));
    let happenings = twin.observe();
    (twin, happenings)
}

fn connected(units: usize) -> (Connected<Twin>, Happenings) {
    let (twin, happenings) = observed(units);
    (twin.connect(Master::default()), happenings)
}

fn texts(records: &[Record], kind: &str) -> Vec<String> {
    records.iter().filter(|record| record.kind == kind).map(|record| record.text.clone()).collect()
}

fn lose(choice: Choice) -> Disturbance {
    Disturbance::new(FrameFault::Lose, Frames::of(choice).with_kind(FrameKind::Any))
}

fn broadcast_read() -> Vec<u8> {
    FrameBuilder::new().physical(Command::Brd, 0, 0x0130, &[0; 2]).finish()
}

#[test]
fn a_fault_that_meets_its_only_frame_at_once_begins_and_ends() {
    let (mut twin, mut happenings) = observed(1);
    twin.disturb(lose(Choice::Next(1))).unwrap();
    twin.frame(&mut broadcast_read());
    let faults = texts(&happenings.take(), "frame_fault");
    assert_eq!(faults.len(), 2, "{faults:?}");
    assert!(faults[0].starts_with("a fault of frames begins: lose"), "{faults:?}");
    assert!(faults[1].starts_with("a fault of frames has ended: lose"), "{faults:?}");

    twin.apply("lose the next 1 frames").unwrap();
    twin.frame(&mut broadcast_read());
    assert_eq!(texts(&happenings.take(), "frame_fault").len(), 2, "by its sentence too");
}

#[test]
fn faults_after_a_new_seed_have_numbers_of_their_own_and_end_in_time() {
    let (mut twin, mut happenings) = observed(1);
    let short = || lose(Choice::All).lasting(Duration::from_millis(5));
    twin.disturb(short()).unwrap();
    twin.seed_faults(7);
    let faults = texts(&happenings.take(), "frame_fault");
    assert_eq!(faults.len(), 2, "the seed ends it: {faults:?}");
    twin.disturb(short()).unwrap();
    twin.run_for(Duration::from_secs(1));
    let records = happenings.take();
    let numbers: Vec<bool> = records
        .iter()
        .filter(|record| record.kind == "frame_fault")
        .map(|record| record.json().contains("\"number\":2,"))
        .collect();
    assert_eq!(numbers, [true, true], "{records:?}");
    let end = records.iter().rfind(|record| record.kind == "frame_fault").unwrap();
    assert_eq!(end.at, Instant::ZERO + Duration::from_millis(5));
}

#[test]
fn a_unit_that_is_switched_off_and_on_makes_a_record_of_each() {
    let (mut twin, mut happenings) = observed(2);
    twin.apply("power off unit 2").unwrap();
    twin.run_for(Duration::from_millis(10));
    twin.apply("power on unit 2").unwrap();
    twin.run_for(Duration::from_millis(10));
    let records = happenings.take();
    let power: Vec<&Record> = records.iter().filter(|record| record.kind == "power").collect();
    assert_eq!(power.len(), 2, "{records:?}");
    assert!(power[0].json().contains("\"unit\":2,") && power[0].json().ends_with("\"on\":false}"));
    assert!(power[1].json().ends_with("\"on\":true}"), "{power:?}");
}

/// Nobody sends a frame any more, and nothing else is due: the line is polled for the indicators.
#[test]
fn the_indicators_of_all_units_follow_the_last_frame_in_time() {
    for units in [1, 3, 23] {
        let (mut bench, mut happenings) = connected(units);
        bench.search().unwrap();
        for unit in 0..units {
            bench.take_to(unit, AlState::PreOp).unwrap();
        }
        bench.run_for(Duration::from_millis(200));
        bench.line.frame(&mut broadcast_read());
        let last_frame = bench.line.now();
        happenings.take();
        bench.line.run_for(Duration::from_secs(3));
        let records = happenings.take();
        let mut shown: Vec<usize> = Vec::new();
        for record in records.iter().filter(|record| record.kind == "indicator") {
            let late = record.at.saturating_since(last_frame);
            assert!(late <= Duration::from_millis(150), "{late} after the last frame: {record:?}");
            shown.extend(record.unit.iter().map(|(number, _)| *number));
        }
        shown.sort_unstable();
        assert!((1..=units).all(|number| shown.contains(&number)), "{shown:?} of {units}");
    }
}

#[test]
fn cpu_units_report_in_virtual_time_what_is_new_at_once_and_what_repeats_once_a_second() {
    let setup = Setup::from_toml(UNIT).unwrap();
    let overrun = ProgramEvent::TaskOverrun { budget_statements: 1_000 };
    let mut twin = Twin::power_on([setup.program(move |io: &mut Io| io.report(overrun.clone()))]);
    let mut happenings = twin.observe();
    twin.run_for(Duration::from_millis(2_500));
    twin.apply("set unit 1 to PROGRAM mode").unwrap();
    twin.run_for(Duration::from_millis(20));
    let records = happenings.take();
    let reports: Vec<&Record> = records.iter().filter(|record| record.kind == "cpu").collect();
    let words: Vec<bool> =
        reports.iter().map(|record| record.json().contains("\"report\":\"task_overrun\"")).collect();
    assert_eq!(words, [true, true, true, true, false], "{reports:?}");
    let seconds: Vec<u64> = reports.iter().map(|record| record.at.as_nanos() / 1_000_000_000).collect();
    assert_eq!(
        seconds,
        [0, 0, 1, 2, 2],
        "the second one has those that came in the first second: {reports:?}"
    );
    assert_eq!(reports[4].text, "CPU Unit: PROGRAM mode");
    assert_eq!(reports[4].unit, Some((1, "first".to_owned())));
    assert_ne!(twin.unit(0).cpu().take_events().len(), 0, "they can be taken too");
}

#[test]
fn a_unit_that_takes_the_place_of_another_one_has_its_own_name() {
    let file = path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("happenings-other.toml");
    fs::write(&file, OTHER).unwrap();
    let order = format!("replace unit 1 by {}", file.display());
    let names = |records: &[Record]| -> Vec<String> {
        records.iter().filter_map(|record| Some(record.unit.as_ref()?.1.clone())).collect()
    };

    let (mut twin, mut happenings) = observed(1);
    twin.apply("power off unit 1").unwrap();
    twin.run_for(Duration::from_millis(1));
    twin.apply("power on unit 1").unwrap();
    twin.run_for(Duration::from_millis(1));
    twin.apply(order.as_str()).unwrap();
    twin.run_for(Duration::from_millis(1));
    twin.apply("power off unit 1").unwrap();
    twin.run_for(Duration::from_millis(1));
    let records = happenings.take();
    let names_then = names(&records);
    assert_eq!(
        (names_then.first().unwrap().as_str(), names_then.last().unwrap().as_str()),
        ("first", "other")
    );
    let model = records.iter().find(|record| record.kind == "unit").unwrap();
    assert!(model.json().contains("\"name\":\"other\",\"kind\":\"unit\""), "{}", model.json());

    let (twin, mut happenings) = observed(1);
    let (port, _ours) = ectwin::link::memory::pair();
    let live = twin.serve(port).unwrap();
    live.apply(order.as_str()).unwrap();
    live.apply("power off unit 1").unwrap();
    live.stop().unwrap();
    let records = happenings.take();
    let of_power = records.iter().find(|record| record.kind == "power").unwrap();
    assert_eq!(of_power.unit.as_ref().unwrap().1, "other", "{records:?}");
}

/// A cable that is unplugged after some turns of the loop; there is never a frame.
struct Unplugged {
    turns: u8,
}

impl FramePort for Unplugged {
    fn receive(&mut self, _: &mut [u8], _: Duration) -> io::Result<Option<usize>> {
        self.turns = self.turns.checked_sub(1).ok_or(io::ErrorKind::UnexpectedEof)?;
        Ok(None)
    }

    fn send(&mut self, _: &[u8]) -> io::Result<()> {
        Ok(())
    }

    fn carrier(&self) -> bool {
        self.turns > 0
    }
}

#[test]
fn a_carrier_that_is_lost_has_its_time_and_the_unit_loses_its_link_at_once() {
    let (mut twin, mut happenings) = observed(1);
    twin.run_for(Duration::from_millis(7));
    let began = twin.now();
    let live = twin.serve(Unplugged { turns: 3 }).unwrap();
    // The link closes by itself.
    let mut records = Vec::new();
    let limit = std::time::Instant::now() + std::time::Duration::from_secs(10);
    while texts(&records, "link").is_empty() && std::time::Instant::now() < limit {
        records.extend(happenings.take());
        std::thread::yield_now();
    }
    live.stop().unwrap();
    let of = |kind: &str| records.iter().find(|record| record.kind == kind).unwrap();
    let (carrier, link) = (of("carrier"), of("link"));
    assert_eq!(events_schema::valid(carrier)["present"], false);
    assert!(began < carrier.at && carrier.at <= link.at, "{records:?}");
    assert_eq!(link.text, "port IN has no link");
}
