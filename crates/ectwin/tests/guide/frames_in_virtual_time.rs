use ectwin::wire::{Command, FrameBuilder, returned_datagrams};
use ectwin::{AlState, Duration, FrameFate, Twin};

#[test]
fn a_frame_of_another_master() {
    let mut twin = Twin::from_toml("model = \"nx-ect101\"").unwrap();

    // Your master makes this frame. Here it is BRD of AL status.
    let mut frame = FrameBuilder::new().physical(Command::Brd, 0, 0x0130, &[0; 2]).finish();
    assert_eq!(twin.frame(&mut frame), FrameFate::Returned);

    // Your master reads the answer: INIT, from one unit.
    let answer = &returned_datagrams(&frame)[0];
    assert_eq!((&answer.data[..], answer.working_counter), (&[0x01, 0][..], 1));
    assert_eq!(twin.unit(0).state(), AlState::Init);

    // Advance the time by one hour.
    let before = twin.now();
    twin.run_for(Duration::from_secs(3600));
    assert_eq!(twin.now(), before + Duration::from_secs(3600));
}
