//! Faults of frames on a line in real time, and on a twin in virtual time.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

use ectwin::link::memory::{MemoryPort, pair};
use ectwin::link::{FRAME_BUFFER_BYTES, FramePort};
use ectwin::master::Master;
use ectwin::plant::line::{
    CableNumber, Choice, Delay, Direction, Disturbance, FrameFault, Frames, LineOrder, LineRefusal,
};
use ectwin::scenario::words::Spoken;
use ectwin::{AlState, Duration, FrameFate, Live, Setup, Twin};
use wire::{Command, FrameBuilder, datagrams};

const UNIT: &str = "model = \"nx-ect101\"";
/// A link is silent if nothing comes in this time.
const SILENCE: Duration = Duration::from_millis(150);
const PATIENCE: Duration = Duration::from_secs(5);

fn twin() -> Twin {
    Twin::power_on([Setup::from_toml(UNIT).unwrap()])
}

fn served() -> (Live, MemoryPort) {
    let (ours, units) = pair();
    (twin().serve(units).unwrap(), ours)
}

/// A frame with this number, which no unit changes.
fn numbered(number: u8) -> Vec<u8> {
    FrameBuilder::new().physical(Command::Aprd, 1, 0x0130, &[number, 0]).finish()
}

fn send(port: &mut MemoryPort, numbers: impl IntoIterator<Item = u8>) {
    numbers.into_iter().for_each(|number| port.send(&numbered(number)).unwrap());
}

/// The number of the next answer; none if none comes in this time.
fn receive(port: &mut MemoryPort, wait: Duration) -> Option<u8> {
    let mut buffer = [0; FRAME_BUFFER_BYTES];
    let length_bytes = port.receive(&mut buffer, wait).unwrap()?;
    let number = datagrams(&buffer[..length_bytes]).next().unwrap().data[0];
    Some(number)
}

fn receive_all(port: &mut MemoryPort, count: usize) -> Vec<u8> {
    let answers = (0..count).map(|_| receive(port, PATIENCE).unwrap()).collect();
    assert_eq!(receive(port, SILENCE), None);
    answers
}

fn next(fault: FrameFault, count: u64) -> Disturbance {
    Disturbance::new(fault, Frames::of(Choice::Next(count)))
}

#[test]
fn frames_of_a_link_are_lost_late_doubled_and_swapped() {
    let late = FrameFault::Delay { by: Delay::Always(Duration::from_millis(30)) };
    let cases = [
        (next(FrameFault::Lose, 2), vec![3, 4], 0),
        (next(FrameFault::LoseAnswer, 1), vec![2, 3, 4], 0),
        (next(late, 1), vec![2, 3, 4, 1], 1),
        (next(late, 1).towards(Direction::Back), vec![2, 3, 4, 1], 1),
        (next(FrameFault::Duplicate, 1), vec![1, 1, 2, 3, 4], 1),
        (next(FrameFault::Duplicate, 2).towards(Direction::Back), vec![1, 1, 2, 2, 3, 4], 2),
        (next(FrameFault::Swap, 2), vec![2, 1, 4, 3], 2),
        (next(FrameFault::Swap, 1).towards(Direction::Back), vec![2, 1, 3, 4], 1),
    ];
    for (disturbance, answers, late_answers) in cases {
        let (live, mut ours) = served();
        live.disturb(disturbance.clone()).unwrap();
        send(&mut ours, 1..=4);
        assert_eq!(receive_all(&mut ours, answers.len()), answers, "{disturbance:?}");
        assert_eq!(live.faults(), [], "all frames have met it");
        let statistics = live.stop().unwrap();
        assert_eq!((statistics.frames, statistics.late_answers), (4, late_answers), "{disturbance:?}");
    }
}

#[test]
fn orders_of_a_live_line_are_those_of_scenarios() {
    let (live, mut ours) = served();
    let order = |sentence: &str| live.line_order(&LineOrder::from_sentence(sentence).unwrap());
    order("lose every 2nd of the frames called storm").unwrap();
    order("lower the working counter of 1 ‰ of the BRD frames for 60s called drops").unwrap();
    send(&mut ours, 1..=4);
    assert_eq!(receive_all(&mut ours, 2), [1, 3]);
    let faults = live.faults();
    assert_eq!(faults[0].sentence, "lose every 2nd of the frames called storm");
    assert_eq!((faults[0].frames_seen, faults[0].frames_met), (4, 2));
    assert_eq!(faults[1].sentence, "lower the working counter of 1 ‰ of the BRD frames for 60s called drops");
    assert_eq!((faults[1].frames_seen, faults[1].frames_met), (0, 0));

    let storm = "storm".parse().unwrap();
    assert_eq!(
        order("duplicate all frames called storm"),
        Err(LineRefusal::NameInUse("storm".parse().unwrap()))
    );
    live.end_fault(&storm).unwrap();
    assert_eq!(live.end_fault(&storm), Err(LineRefusal::NoFault(storm.clone())));
    assert_eq!(live.faults().len(), 1);
    live.be_quiet();
    assert_eq!(live.faults(), []);

    order("unplug cable 1").unwrap();
    send(&mut ours, [5]);
    assert_eq!(receive_all(&mut ours, 0), [0_u8; 0]);
    order("plug cable 1").unwrap();
    send(&mut ours, [6, 7]);
    assert_eq!(receive_all(&mut ours, 2), [6, 7]);
    assert_eq!(order("unplug cable 2"), Err(LineRefusal::NotThere(1)));
}

#[test]
fn a_twin_in_virtual_time_has_late_answers() {
    let mut twin = twin();
    let by = Delay::Always(Duration::from_millis(5));
    twin.disturb(next(FrameFault::Delay { by }, 1)).unwrap();
    let mut frame = numbered(1);
    assert_eq!(twin.frame(&mut frame), FrameFate::Destroyed);
    twin.run_for(Duration::from_millis(4));
    assert_eq!(twin.take_late_answer(), None);
    twin.run_for(Duration::from_millis(1));
    let answer = twin.take_late_answer().unwrap();
    assert_eq!(datagrams(&answer).next().unwrap().data[0], 1);
    assert_eq!(twin.frame(&mut frame), FrameFate::Returned, "the next one is in time");

    twin.disturb(next(FrameFault::Duplicate, 1)).unwrap();
    assert_eq!(twin.frame(&mut numbered(2)), FrameFate::Returned);
    assert_eq!(datagrams(&twin.take_late_answer().unwrap()).next().unwrap().data[0], 2);
    assert_eq!(twin.take_late_answer(), None);
}

#[test]
fn a_master_in_virtual_time_takes_a_unit_to_op_although_frames_are_lost() {
    let lost = |seed| {
        let mut bench = twin().connect(Master::default());
        bench.line.seed_faults(seed);
        let lose = Disturbance::new(FrameFault::Lose, Frames::of(Choice::Percent(2)));
        bench.line.disturb(lose.clone()).unwrap();
        bench.line.disturb(Disturbance { fault: FrameFault::LoseAnswer, ..lose }).unwrap();
        assert_eq!(bench.search(), Ok(1));
        bench.take_to(0, AlState::Op).unwrap();
        bench.run_for(Duration::from_millis(200));
        assert_eq!(bench.line.unit(0).state(), AlState::Op);
        bench.line.faults().iter().map(|fault| fault.frames_met).sum::<u64>()
    };
    assert!(lost(1) > 0);
    assert_eq!(lost(1), lost(1), "the same seed loses the same frames");
}

#[test]
fn a_bit_error_on_a_cable_of_a_live_line_is_counted_by_its_unit() {
    let (live, mut ours) = served();
    let corrupt = FrameFault::Corrupt { cable: CableNumber::new(1).unwrap() };
    live.disturb(next(corrupt, 3)).unwrap();
    send(&mut ours, 1..=4);
    assert_eq!(receive_all(&mut ours, 1), [4]);
    ours.send(&FrameBuilder::new().physical(Command::Aprd, 0, 0x0300, &[0; 2]).finish()).unwrap();
    assert_eq!(receive(&mut ours, PATIENCE), Some(3), "invalid frames at port 0");
}
