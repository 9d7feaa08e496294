use ectwin::link::{FramePort, memory};
use ectwin::plant::line::{Choice, Disturbance, FrameFault, FrameKind, Frames, LineOrder};
use ectwin::scenario::words::Spoken;
use ectwin::wire::{Command, FrameBuilder};
use ectwin::{Duration, Setup, Twin};

#[test]
fn the_master_sees_a_lost_frame_and_a_low_working_counter() {
    let (mut ours, units) = memory::pair();
    let live = Twin::power_on([Setup::from_toml("model = \"nx-ect101\"").unwrap()]).serve(units).unwrap();
    let frame = FrameBuilder::new().physical(Command::Brd, 0, 0x0130, &[0; 2]).finish();

    // As a sentence, the same as in a scenario.
    let lose = LineOrder::from_sentence("lose every 2nd of the BRD frames called storm").unwrap();
    live.line_order(&lose).unwrap();
    ours.send(&frame).unwrap();
    ours.send(&frame).unwrap();
    let mut answer = [0; 1518];
    assert!(ours.receive(&mut answer, Duration::from_secs(5)).unwrap().is_some());
    assert!(ours.receive(&mut answer, Duration::from_millis(50)).unwrap().is_none(), "the second is lost");
    assert_eq!(live.faults()[0].frames_met, 1);
    live.end_fault(&"storm".parse().unwrap()).unwrap();

    // As a typed value.
    let frames = Frames::of(Choice::Next(1)).with_kind(FrameKind::Brd);
    live.disturb(Disturbance::new(FrameFault::LowerWorkingCounter, frames)).unwrap();
    ours.send(&frame).unwrap();
    let length = ours.receive(&mut answer, Duration::from_secs(5)).unwrap().unwrap();
    assert_eq!(ectwin::wire::returned_datagrams(&answer[..length])[0].working_counter, 0);
}
