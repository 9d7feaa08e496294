//! Each fault against a simple model of it, on a line of terminals.

use device::Network;
use proptest::prelude::*;
use time::{Duration, Instant};
use unit_model::ModelUnit;
use wire::{Command, FrameBuilder, datagrams};

use super::*;
use crate::{PowerConditions, UnitFile};

/// A line of terminals with a master that numbers its frames.
struct Bench {
    units: Network<Box<dyn ModelUnit>>,
    faults: LineFaults<u32>,
    now: Instant,
    log: Log,
}

/// What has happened to the frames, by their numbers.
#[derive(Default)]
struct Log {
    passed: Vec<u32>,
    answered: Vec<(Instant, u32)>,
    lost: Vec<(u32, Direction)>,
    last_answer: Vec<u8>,
}

impl LineEnds<u32> for Log {
    fn passes(&mut self, _: Instant, frame: &[u8], _: &[Met]) {
        self.passed.push(number_of(frame));
    }

    fn returns(&mut self, now: Instant, ticket: u32, answer: Vec<u8>, _: &[Met]) {
        self.answered.push((now, ticket));
        self.last_answer = answer;
    }

    fn is_lost(&mut self, _: Instant, on_way: Direction, frame: &[u8], _: Loss<'_>) {
        self.lost.push((number_of(frame), on_way));
    }
}

/// The number of a frame, in its first datagram.
fn number_of(frame: &[u8]) -> u32 {
    let first = datagrams(frame).next().and_then(|datagram| datagram.data.first_chunk().copied());
    first.map_or(0, u32::from_le_bytes)
}

/// A frame that no unit changes.
fn numbered(number: u32) -> Vec<u8> {
    FrameBuilder::new().physical(Command::Aprd, 1, 0x0130, &number.to_le_bytes()).finish()
}

const MS: Duration = Duration::from_millis(1);

impl Bench {
    fn of(units: usize) -> Self {
        let file = UnitFile::parse("model = \"digital\"\noutputs = 8").expect("a unit");
        let powered = (0..units).map(|_| {
            let powered = file.power_on(Instant::ZERO, &PowerConditions::default(), Box::new(plc::Echo));
            (powered.config, powered.unit)
        });
        let units = Network::power_on(powered.collect::<Vec<_>>(), Instant::ZERO);
        Self { units, faults: LineFaults::new(1), now: Instant::ZERO, log: Log::default() }
    }

    fn with(disturbance: Disturbance) -> Self {
        let mut bench = Self::of(3);
        assert_eq!(bench.order(&LineOrder::Disturb(disturbance)), Ok(()));
        bench
    }

    fn order(&mut self, order: &LineOrder) -> Result<(), LineRefusal> {
        self.faults.order(self.now, order, &mut self.units)
    }

    fn send_frame(&mut self, number: u32, frame: Vec<u8>) {
        let Self { units, faults, now, log } = self;
        let met = faults.meet(*now, &frame, units);
        faults.send(*now, number, frame, met, units, log);
        faults.poll(*now, units, log);
    }

    /// Sends these numbers, one each millisecond.
    fn send(&mut self, numbers: impl IntoIterator<Item = u32>) {
        for number in numbers {
            self.send_frame(number, numbered(number));
            self.run_to(self.now + MS);
        }
    }

    fn run_to(&mut self, end: Instant) {
        while self.faults.deadline() <= end {
            self.now = self.now.max(self.faults.deadline());
            let Self { units, faults, now, log } = self;
            faults.poll(*now, units, log);
        }
        self.now = end;
    }

    fn answered(&self) -> Vec<u32> {
        self.log.answered.iter().map(|(_, number)| *number).collect()
    }

    fn register(&self, position: usize, offset: u16) -> u8 {
        let mut byte = [0];
        self.units.esc(position).expect("a unit").look(offset, &mut byte, self.now);
        byte[0]
    }

    /// The bytes that the master can write at these units: the station alias register has no effect here.
    fn station_address(&self, position: usize) -> u8 {
        self.register(position, 0x0010)
    }
}

fn cable(number: u16) -> CableNumber {
    CableNumber::new(number).expect("from 1")
}

fn name(text: &str) -> FaultName {
    text.parse().expect(text)
}

fn all(fault: FrameFault) -> Disturbance {
    Disturbance::new(fault, Frames::of(Choice::All))
}

/// Gives each unit this station address.
fn address_all(address: u8) -> Vec<u8> {
    FrameBuilder::new().physical(Command::Bwr, 0, 0x0010, &[address, 0]).finish()
}

fn choices() -> impl Strategy<Value = Choice> {
    prop_oneof![
        Just(Choice::All),
        (1..50_u64).prop_map(Choice::Next),
        (1..50_u64).prop_map(Choice::Every),
        (0..30_u64, 1..30_u64).prop_map(|(skip, count)| Choice::Behind { skip, count }),
    ]
}

/// The frames of `sent` that a choice without chance selects.
fn selected(choice: Choice, sent: u32) -> Vec<u32> {
    let is_selected = |number: &u32| {
        let number = u64::from(*number);
        match choice {
            Choice::All => true,
            Choice::Next(count) => number <= count,
            Choice::Every(period) => number.is_multiple_of(period),
            Choice::Behind { skip, count } => (skip + 1..=skip + count).contains(&number),
            Choice::Percent(_) | Choice::PerMille(_) => unreachable!("with chance"),
        }
    };
    (1..=sent).filter(is_selected).collect()
}

proptest! {
    #[test]
    fn the_selected_frames_are_lost_and_the_others_return(choice in choices(), sent in 1..120_u32) {
        let mut bench = Bench::with(Disturbance::new(FrameFault::Lose, Frames::of(choice)));
        bench.send(1..=sent);
        let lost: Vec<u32> = bench.log.lost.iter().map(|(number, _)| *number).collect();
        prop_assert_eq!(&lost, &selected(choice, sent));
        let others: Vec<u32> = (1..=sent).filter(|number| !lost.contains(number)).collect();
        prop_assert_eq!(bench.answered(), others);
    }

    #[test]
    fn every_frame_is_lost_or_answered_and_a_double_one_is_answered_twice(
        choice in choices(),
        sent in 1..120_u32,
        fault in prop_oneof![
            Just(FrameFault::Lose),
            Just(FrameFault::LoseAnswer),
            Just(FrameFault::Duplicate),
            Just(FrameFault::Swap),
            Just(FrameFault::LowerWorkingCounter),
            (1..9_u64).prop_map(|ms| FrameFault::Delay { by: Delay::Always(MS * ms) }),
        ],
        is_back in any::<bool>(),
    ) {
        let direction = if is_back && fault.has_direction() { Direction::Back } else { Direction::Outward };
        let mut bench = Bench::with(Disturbance::new(fault, Frames::of(choice)).towards(direction));
        bench.send(1..=sent);
        bench.run_to(bench.now + MS * 200);
        prop_assert_eq!(bench.faults.waiting(), 0);
        for number in 1..=sent {
            let answers = bench.answered().iter().filter(|answered| **answered == number).count();
            let losses = bench.log.lost.iter().filter(|(lost, _)| *lost == number).count();
            let is_double = fault == FrameFault::Duplicate && selected(choice, sent).contains(&number);
            prop_assert_eq!(answers + losses, if is_double { 2 } else { 1 });
        }
    }

    #[test]
    fn delayed_frames_come_in_the_order_of_their_times(
        delays in proptest::collection::vec(prop_oneof![Just(0), 1..20_u64], 1..60),
    ) {
        let mut bench = Bench::of(1);
        let mut arrivals = Vec::new();
        for (number, delay_ms) in (1..).zip(&delays) {
            if *delay_ms > 0 {
                let by = Delay::Always(MS * *delay_ms);
                let next = Disturbance::new(FrameFault::Delay { by }, Frames::of(Choice::Next(1)));
                prop_assert_eq!(bench.order(&LineOrder::Disturb(next)), Ok(()));
            }
            arrivals.push((bench.now + MS * *delay_ms, *delay_ms == 0, number));
            bench.send([number]);
        }
        bench.run_to(bench.now + MS * 20);
        // One that waits comes before those that are sent at the same time.
        arrivals.sort_by_key(|(at, is_new, number)| (*at, *is_new, *number));
        let expected: Vec<(Instant, u32)> = arrivals.iter().map(|(at, _, number)| (*at, *number)).collect();
        prop_assert_eq!(&bench.log.answered, &expected);
    }
}

#[test]
fn pairs_of_frames_change_places_outward_and_on_the_way_back() {
    let mut bench = Bench::with(all(FrameFault::Swap));
    bench.send(1..=6);
    assert_eq!(bench.log.passed, [2, 1, 4, 3, 6, 5]);
    assert_eq!(bench.answered(), [2, 1, 4, 3, 6, 5]);
    let mut bench = Bench::with(all(FrameFault::Swap).towards(Direction::Back));
    bench.send(1..=6);
    assert_eq!(bench.log.passed, [1, 2, 3, 4, 5, 6]);
    assert_eq!(bench.answered(), [2, 1, 4, 3, 6, 5]);
}

#[test]
fn a_frame_without_a_next_one_passes_after_100_ms_or_when_the_line_is_quiet() {
    let mut bench = Bench::with(all(FrameFault::Swap));
    bench.send([1]);
    bench.run_to(Instant::ZERO + MS * 99);
    assert_eq!(bench.answered(), [0; 0]);
    bench.run_to(Instant::ZERO + MS * 100);
    assert_eq!(bench.answered(), [1]);
    bench.send([2]);
    assert_eq!(bench.order(&LineOrder::BeQuiet), Ok(()));
    bench.run_to(bench.now);
    assert_eq!(bench.answered(), [1, 2]);
}

#[test]
fn random_choices_are_as_frequent_as_they_say_and_the_same_with_the_same_seed() {
    let lost = |choice| {
        let mut bench = Bench::with(Disturbance::new(FrameFault::Lose, Frames::of(choice)));
        bench.send(1..=10_000);
        bench.log.lost.len()
    };
    // The counts of seed 1; their standard deviations are 40 and 15.
    assert!((1_880..=2_120).contains(&lost(Choice::Percent(20))), "{}", lost(Choice::Percent(20)));
    assert!((205..=295).contains(&lost(Choice::PerMille(25))), "{}", lost(Choice::PerMille(25)));
    assert_eq!(lost(Choice::PerMille(25)), lost(Choice::PerMille(25)));
    assert_eq!((lost(Choice::Percent(100)), lost(Choice::PerMille(1_000))), (10_000, 10_000));
}

#[test]
fn random_delays_have_the_limits_the_mean_and_the_deviation_that_they_say() {
    let delays = |by: Delay| {
        let mut bench = Bench::with(all(FrameFault::Delay { by }));
        let (mut delays, mut sent) = (Vec::new(), Instant::ZERO);
        for number in 0..2_000 {
            bench.send_frame(number, numbered(number));
            bench.run_to(bench.now + MS * 20);
            let (at, _) = bench.log.answered.pop().expect("an answer");
            delays.push(at.saturating_since(sent).as_nanos() as f64 / 1e6);
            sent = bench.now;
        }
        let mean = delays.iter().sum::<f64>() / delays.len() as f64;
        let square = |delay: &f64| (delay - mean).powi(2);
        let deviation = (delays.iter().map(square).sum::<f64>() / delays.len() as f64).sqrt();
        let least = delays.iter().copied().fold(f64::MAX, f64::min);
        let most = delays.iter().copied().fold(0.0, f64::max);
        (least, most, mean, deviation)
    };
    // An even distribution over 2 ms has a deviation of 0.577 ms.
    for by in [Delay::Between(MS, MS * 3), Delay::Around(MS * 2, MS)] {
        let (least, most, mean, deviation) = delays(by);
        assert!((1.0..1.01).contains(&least) && (2.99..=3.0).contains(&most), "{least} {most}");
        assert!((1.96..2.04).contains(&mean) && (0.56..0.6).contains(&deviation), "{mean} {deviation}");
    }
    let (least, most, mean, deviation) = delays(Delay::Normal(MS * 5, MS));
    assert!((1.0..3.0).contains(&least) && (7.0..9.0).contains(&most), "{least} {most}");
    assert!((4.93..5.07).contains(&mean) && (0.95..1.05).contains(&deviation), "{mean} {deviation}");
    assert_eq!(delays(Delay::Normal(MS, MS)).0, 0.0, "no delay is below 0");
}

#[test]
fn a_bit_error_is_counted_where_the_frame_is_received() {
    let counters = |direction, number| {
        let mut bench = Bench::with(all(FrameFault::Corrupt { cable: cable(number) }).towards(direction));
        bench.send_frame(1, address_all(7));
        let of_unit =
            |position| [0x0300, 0x0302, 0x0308, 0x0309].map(|offset| bench.register(position, offset));
        assert_eq!(bench.answered(), [0; 0]);
        let addressed = [0, 1, 2].map(|position| bench.station_address(position));
        ([0, 1, 2].map(of_unit), addressed)
    };
    let none = [0; 4];
    let (invalid_at_in, forwarded_at_in) = ([1, 0, 0, 0], [0, 0, 1, 0]);
    let (invalid_at_out, forwarded_at_out) = ([0, 1, 0, 0], [0, 0, 0, 1]);
    assert_eq!(counters(Direction::Outward, 2), ([none, invalid_at_in, forwarded_at_in], [7, 0, 0]));
    assert_eq!(
        counters(Direction::Outward, 1),
        ([invalid_at_in, forwarded_at_in, forwarded_at_in], [0, 0, 0])
    );
    assert_eq!(counters(Direction::Back, 3), ([forwarded_at_out, invalid_at_out, none], [7, 7, 7]));
    assert_eq!(counters(Direction::Back, 1), ([none; 3], [7, 7, 7]), "only the master sees it");
}

#[test]
fn a_frame_that_turns_before_the_cable_does_not_meet_its_fault() {
    for fault in [FrameFault::Lose, FrameFault::Corrupt { cable: cable(3) }] {
        for direction in [Direction::Outward, Direction::Back] {
            let mut lost = all(fault).towards(direction);
            if fault.has_cable() {
                lost = lost.on_cable(cable(3));
            }
            let mut bench = Bench::with(lost);
            bench.send([1]);
            assert_eq!(bench.answered(), [0; 0], "{fault:?} {direction:?}");
            assert_eq!(bench.order(&LineOrder::Unplug { cable: cable(2) }), Ok(()));
            bench.send([2]);
            assert_eq!(bench.answered(), [2], "{fault:?} {direction:?}");
        }
    }
}

#[test]
fn a_loss_on_a_cable_reaches_the_units_before_it_and_on_the_way_back_all() {
    let addressed = |direction| {
        let mut bench = Bench::with(all(FrameFault::Lose).on_cable(cable(3)).towards(direction));
        bench.send_frame(1, address_all(7));
        let lost = bench.log.lost.iter().map(|(_, on_way)| *on_way).collect::<Vec<_>>();
        assert_eq!(lost, [direction]);
        [0, 1, 2].map(|position| bench.station_address(position))
    };
    assert_eq!(addressed(Direction::Outward), [7, 7, 0]);
    assert_eq!(addressed(Direction::Back), [7, 7, 7]);
}

#[test]
fn a_delay_on_a_cable_reaches_the_units_behind_it_later_and_on_the_way_back_all_at_once() {
    let fault = FrameFault::Delay { by: Delay::Always(MS * 5) };
    for (direction, at_once) in [(Direction::Outward, [7, 0, 0]), (Direction::Back, [7, 7, 7])] {
        let mut bench = Bench::with(all(fault).on_cable(cable(2)).towards(direction));
        bench.send_frame(1, address_all(7));
        assert_eq!([0, 1, 2].map(|position| bench.station_address(position)), at_once);
        bench.run_to(Instant::ZERO + MS * 5);
        assert_eq!([0, 1, 2].map(|position| bench.station_address(position)), [7; 3]);
        assert_eq!(bench.log.answered, [(Instant::ZERO + MS * 5, 1)]);
        let counter = datagrams(&bench.log.last_answer).next().map(|datagram| datagram.working_counter);
        assert_eq!(counter, Some(3), "all units have counted");
    }
}

#[test]
fn frames_of_a_unit_are_those_that_address_it() {
    let mut bench =
        Bench::with(Disturbance::new(FrameFault::Lose, Frames::of(Choice::All).of_unit(UnitNumber::at(1))));
    bench.faults.be_quiet(bench.now);
    bench.send_frame(
        1,
        FrameBuilder::new().physical(Command::Apwr, 1_u16.wrapping_neg(), 0x0010, &[7, 0]).finish(),
    );
    let lost = Disturbance::new(FrameFault::Lose, Frames::of(Choice::All).of_unit(UnitNumber::at(1)));
    assert_eq!(bench.order(&LineOrder::Disturb(lost)), Ok(()));
    let frames = [
        (Command::Aprd, 0_u16.wrapping_neg(), false),
        (Command::Aprd, 1_u16.wrapping_neg(), true),
        (Command::Aprd, 2_u16.wrapping_neg(), false),
        (Command::Fprd, 7, true),
        (Command::Fprd, 0, false),
        (Command::Brd, 0, true),
        (Command::Armw, 0, true),
        (Command::Nop, 0, false),
    ];
    for (command, address, is_lost) in frames {
        bench.log = Log::default();
        bench.send_frame(1, FrameBuilder::new().physical(command, address, 0x0130, &[0; 2]).finish());
        assert_eq!(bench.log.lost.len(), usize::from(is_lost), "{command:?} {address}");
    }
}

#[test]
fn kinds_of_frames_are_those_of_their_datagrams() {
    let is_lost = |kind, frame: &[u8]| {
        let mut bench =
            Bench::with(Disturbance::new(FrameFault::Lose, Frames::of(Choice::All).with_kind(kind)));
        bench.send_frame(1, frame.to_vec());
        !bench.log.lost.is_empty()
    };
    let of = |command, offset| FrameBuilder::new().physical(command, 0, offset, &[0; 2]).finish();
    let logical = FrameBuilder::new().logical(Command::Lrw, 0x0500, &[0; 2]).finish();
    let both = FrameBuilder::new()
        .physical(Command::Fprd, 0, 0x0130, &[0; 2])
        .logical(Command::Lrd, 0, &[0])
        .finish();
    assert!(is_lost(FrameKind::Any, &of(Command::Nop, 0)) && is_lost(FrameKind::Any, &[0; 60]));
    assert!(is_lost(FrameKind::ProcessData, &logical) && is_lost(FrameKind::ProcessData, &both));
    assert!(!is_lost(FrameKind::ProcessData, &of(Command::Fprd, 0)));
    assert!(is_lost(FrameKind::Sii, &of(Command::Aprd, 0x050E)));
    assert!(!is_lost(FrameKind::Sii, &of(Command::Aprd, 0x0510)) && !is_lost(FrameKind::Sii, &logical));
    assert!(is_lost(FrameKind::Brd, &of(Command::Brd, 0)) && !is_lost(FrameKind::Brd, &of(Command::Bwr, 0)));
    assert!(is_lost(FrameKind::Fprd, &both) && is_lost(FrameKind::Lrd, &both));
    assert!(!is_lost(FrameKind::Mailbox, &of(Command::Aprd, 0x0805)), "a terminal has no mailbox");
}

#[test]
fn working_counters_are_lowered_in_all_datagrams_or_in_those_of_the_unit() {
    let counters = |disturbance: Disturbance| {
        let mut bench = Bench::with(disturbance);
        let at = |position: u16| (Command::Aprd, position.wrapping_neg());
        let frame = [at(0), at(1), (Command::Brd, 0)]
            .into_iter()
            .fold(FrameBuilder::new(), |frame, (command, address)| {
                frame.physical(command, address, 0x0130, &[0; 2])
            });
        bench.send_frame(1, frame.finish());
        datagrams(&bench.log.last_answer).map(|datagram| datagram.working_counter).collect::<Vec<_>>()
    };
    assert_eq!(counters(all(FrameFault::LowerWorkingCounter)), [0, 0, 2]);
    assert_eq!(counters(all(FrameFault::LowerWorkingCounterBy { by: 2 })), [0, 0, 1]);
    let of_unit_2 = Frames::of(Choice::All).of_unit(UnitNumber::at(1));
    assert_eq!(counters(Disturbance::new(FrameFault::LowerWorkingCounter, of_unit_2)), [1, 0, 2]);
}

#[test]
fn a_cut_frame_is_accepted_by_no_unit_and_a_cut_answer_arrives_short() {
    let fault = FrameFault::Cut { length_bytes: 20 };
    let mut bench = Bench::with(all(fault));
    bench.send_frame(1, address_all(7));
    assert_eq!((bench.answered(), bench.station_address(0)), (vec![], 0));
    let mut bench = Bench::with(all(fault).towards(Direction::Back));
    bench.send_frame(1, address_all(7));
    assert_eq!((bench.answered(), bench.station_address(0)), (vec![1], 7));
    assert_eq!(bench.log.last_answer.len(), 20);
}

#[test]
fn a_fault_ends_after_its_time_by_its_name_or_when_it_has_met_its_frames() {
    let mut bench = Bench::with(all(FrameFault::Lose).lasting(MS * 5));
    let at_work = |bench: &Bench| bench.faults.active(bench.now).count();
    bench.send(1..=4);
    assert_eq!(at_work(&bench), 1);
    bench.send([5]);
    assert_eq!(at_work(&bench), 0);
    bench.send(6..=10);
    assert_eq!(bench.answered(), [6, 7, 8, 9, 10]);

    let mut bench = Bench::with(all(FrameFault::Lose).called(name("storm")));
    let twice = Disturbance::new(FrameFault::Duplicate, Frames::of(Choice::Next(3))).called(name("echo"));
    assert_eq!(bench.order(&LineOrder::Disturb(twice.clone())), Ok(()));
    assert_eq!(bench.order(&LineOrder::Disturb(twice)), Err(LineRefusal::NameInUse(name("echo"))));
    bench.send([1]);
    let active: Vec<_> = bench.faults.active(bench.now).collect();
    assert_eq!(active.len(), 2);
    assert_eq!(active[1].disturbance.name, Some(name("echo")));
    assert_eq!((active[1].frames_seen, active[1].frames_met, active[1].until), (1, 1, Instant::NEVER));
    assert_eq!(bench.order(&LineOrder::End { name: name("storm") }), Ok(()));
    assert_eq!(
        bench.order(&LineOrder::End { name: name("storm") }),
        Err(LineRefusal::NoFault(name("storm")))
    );
    bench.send(2..=4);
    assert_eq!(bench.answered(), [2, 2, 3, 3, 4]);
    assert!(bench.faults.is_quiet());
}

#[test]
fn an_order_that_cannot_be_carried_out_changes_nothing() {
    let mut bench = Bench::of(3);
    let refused = [
        (LineOrder::Unplug { cable: cable(4) }, LineRefusal::NotThere(3)),
        (LineOrder::Disturb(all(FrameFault::Corrupt { cable: cable(4) })), LineRefusal::NotThere(3)),
        (LineOrder::Disturb(all(FrameFault::Lose).on_cable(cable(4))), LineRefusal::NotThere(3)),
        (
            LineOrder::Disturb(Disturbance::new(
                FrameFault::Lose,
                Frames::of(Choice::All).of_unit(UnitNumber::at(3)),
            )),
            LineRefusal::NotThere(3),
        ),
        (
            LineOrder::Disturb(Disturbance::new(FrameFault::Lose, Frames::of(Choice::PerMille(1_001)))),
            LineRefusal::WithoutEffect,
        ),
        (LineOrder::Disturb(all(FrameFault::Duplicate).on_cable(cable(1))), LineRefusal::WithoutEffect),
        (
            LineOrder::Disturb(all(FrameFault::LoseAnswer).towards(Direction::Back)),
            LineRefusal::WithoutEffect,
        ),
        (LineOrder::End { name: name("storm") }, LineRefusal::NoFault(name("storm"))),
    ];
    for (order, refusal) in refused {
        assert_eq!(bench.order(&order), Err(refusal), "{order:?}");
        assert!(bench.faults.is_quiet());
    }
}

#[test]
fn only_some_frames_wait_and_those_beyond_are_lost_and_counted() {
    let by = Delay::Always(Duration::from_secs(60));
    let mut bench = Bench::with(all(FrameFault::Delay { by }));
    bench.send(0..KEPT_FRAMES_MAX as u32 + 10);
    assert_eq!((bench.faults.waiting(), bench.faults.lost_for_room()), (KEPT_FRAMES_MAX, 10));
    assert_eq!(bench.log.lost.len(), 10);
    bench.run_to(bench.now + Duration::from_secs(60));
    assert_eq!((bench.faults.waiting(), bench.log.answered.len()), (0, KEPT_FRAMES_MAX));
}
