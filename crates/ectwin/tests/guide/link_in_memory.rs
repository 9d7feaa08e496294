use ectwin::link::{FRAME_BUFFER_BYTES, FramePort, memory};
use ectwin::wire::{Command, FrameBuilder, returned_datagrams};
use ectwin::{Duration, Setup, Twin};

#[test]
fn three_units_answer_a_broadcast() {
    let setups = (0..3).map(|_| Setup::from_toml("model = \"nx-ect101\"").unwrap());
    let (mut ours, units) = memory::pair();
    let live = Twin::power_on(setups).serve(units).unwrap();

    // BRD of AL status. Any master that sends and receives whole Ethernet frames can be used here.
    ours.send(&FrameBuilder::new().physical(Command::Brd, 0, 0x0130, &[0; 2]).finish()).unwrap();

    let mut answer = [0; FRAME_BUFFER_BYTES];
    let length = loop {
        if let Some(length) = ours.receive(&mut answer, Duration::from_secs(5)).unwrap() {
            break length;
        }
    };
    assert_eq!(returned_datagrams(&answer[..length])[0].working_counter, 3, "three units have answered");
    assert_eq!(live.stop().unwrap().frames, 1);
}
