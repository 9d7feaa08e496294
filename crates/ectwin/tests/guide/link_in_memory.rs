use ectwin::link::{FRAME_BUFFER_BYTES, FramePort, memory};
use ectwin::{Duration, Setup, Twin};

#[test]
fn three_units_answer_a_broadcast() {
    let setups = (0..3).map(|_| Setup::from_toml("model = \"nx-ect101\"").unwrap());
    let (mut ours, units) = memory::pair();
    let live = Twin::power_on(setups).serve(units).unwrap();

    // BRD of AL status. Any master that sends and receives whole Ethernet frames can be used here.
    let mut frame = [0u8; 60];
    frame[..6].fill(0xFF);
    frame[12..16].copy_from_slice(&[0x88, 0xA4, 0x0E, 0x10]);
    frame[16..26].copy_from_slice(&[7, 0, 0, 0, 0x30, 0x01, 2, 0, 0, 0]);
    ours.send(&frame).unwrap();

    let mut answer = [0; FRAME_BUFFER_BYTES];
    let length = loop {
        if let Some(length) = ours.receive(&mut answer, Duration::from_secs(5)).unwrap() {
            break length;
        }
    };
    assert_eq!(length, 60);
    assert_eq!(answer[16 + 12..16 + 14], [3, 0], "three units have answered");
    assert_eq!(live.stop().unwrap().frames, 1);
}
