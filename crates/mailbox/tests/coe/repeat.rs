//! The repeat of a message that was lost on its way to the master.

use wire::{Emergency, SdoTarget};

use crate::bench::Bench;

fn repeated(bench: &mut Bench) -> Option<Vec<u8>> {
    let mut message = [0; 400];
    let length_bytes = bench.mailbox.repeat(&mut message)?;
    Some(message[..length_bytes].to_vec())
}

const UPLOAD_1000: [u8; 16] = [10, 0, 0, 0, 0, 0x03, 0x00, 0x20, 0x40, 0x00, 0x10, 0x00, 0, 0, 0, 0];

/// C089
#[test]
fn a_repeat_has_the_same_octets_as_often_as_it_is_asked_for() {
    let mut bench = Bench::in_pre_op();
    assert_eq!(repeated(&mut bench), None, "nothing was read yet");
    bench.upload(SdoTarget::entry(0x1018, 1)).unwrap();
    let reply = bench.raw(&UPLOAD_1000).unwrap();
    for _ in 0..3 {
        assert_eq!(repeated(&mut bench), Some(reply.clone()));
        bench.mailbox.confirm_read();
    }
    bench.mailbox.reset();
    assert_eq!(repeated(&mut bench), None);
}

/// C089
#[test]
fn a_newer_message_makes_room_and_follows_unchanged() {
    let mut bench = Bench::in_pre_op();
    let lost = bench.raw(&UPLOAD_1000).unwrap();
    bench.mailbox.queue_emergency(Emergency::default()).unwrap();
    let mut newer = [0; 400];
    let length_bytes = bench.mailbox.next_unsolicited(&mut newer).unwrap();
    assert_eq!(repeated(&mut bench), Some(lost));
    bench.mailbox.confirm_read();
    assert!(bench.mailbox.has_unsolicited());
    assert_eq!(bench.unsolicited(), Some(newer[..length_bytes].to_vec()));
    assert_eq!(repeated(&mut bench), Some(newer[..length_bytes].to_vec()));
}
