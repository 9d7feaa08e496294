//! SyncManagers: the mailbox handshake, and three buffers that are never torn.

mod bench;

use bench::{Bench, INPUTS, MAILBOX_RECEIVE, MAILBOX_SEND, OUTPUTS};
use esc::{EscConfig, SmIndex, SyncManagerWrites};
use proptest::prelude::*;

const START: u16 = 0x1100;

fn with_sync_manager(n: u16, length_bytes: u16, control: u8) -> Bench {
    let mut bench = Bench::new();
    bench.set_sync_manager(n, START, length_bytes, control);
    bench
}

fn full(bench: &mut Bench, n: u16) -> bool {
    bench.byte(0x0805 + 8 * n) & 8 != 0
}

/// C076, C079: a full mailbox refuses the next message until the PDI has read it.
#[test]
fn a_full_mailbox_refuses_and_keeps_its_message() {
    let mut bench = with_sync_manager(0, 4, MAILBOX_RECEIVE);
    assert!(bench.write(START, &[1, 2, 3, 4]) && full(&mut bench, 0));
    assert!(!bench.write(START, &[9, 9, 9, 9]));
    assert_eq!(bench.esc.pdi().mailbox(SmIndex(0)), Some(&[1, 2, 3, 4][..]));
    bench.esc.pdi().release_mailbox(SmIndex(0));
    assert!(!full(&mut bench, 0) && bench.write(START, &[5, 6, 7, 8]));
}

/// C078, and the order that TwinCAT uses: the content first, the last byte alone in another datagram.
#[test]
fn a_mailbox_is_full_with_its_last_byte_only() {
    let mut bench = with_sync_manager(0, 16, MAILBOX_RECEIVE);
    assert!(bench.write(START, &[1, 2, 3]) && !full(&mut bench, 0));
    assert!(bench.write(START + 15, &[0]) && full(&mut bench, 0));
}

#[test]
fn the_last_byte_alone_opens_nothing() {
    let mut bench = with_sync_manager(0, 16, MAILBOX_RECEIVE);
    assert!(!bench.write(START + 15, &[0]) && !full(&mut bench, 0));
}

/// C077, C079: an empty mailbox refuses a read; reading to the last byte empties it.
#[test]
fn an_empty_mailbox_refuses_reads() {
    let mut bench = with_sync_manager(1, 4, MAILBOX_SEND);
    assert_eq!(bench.read(START, 4), None);
    assert!(bench.esc.pdi().fill_mailbox(SmIndex(1), &[1, 2]));
    assert!(!bench.esc.pdi().fill_mailbox(SmIndex(1), &[3]));
    assert_eq!(bench.read(START, 2), Some(vec![1, 2]), "a partial read");
    assert!(full(&mut bench, 1));
    assert_eq!(bench.read(START + 3, 1), Some(vec![0]));
    assert!(!full(&mut bench, 1));
    assert_eq!(bench.read(START, 4), None);
}

#[test]
fn the_wrong_direction_is_refused() {
    let mut bench = with_sync_manager(0, 4, MAILBOX_RECEIVE);
    assert_eq!(bench.read(START, 4), None);
    bench.set_sync_manager(3, START + 64, 4, INPUTS);
    assert!(!bench.write(START + 64, &[1, 2, 3, 4]));
}

#[test]
fn repeat_request_and_acknowledge_follow_each_other() {
    let mut bench = with_sync_manager(1, 4, MAILBOX_SEND);
    bench.esc.pdi().fill_mailbox(SmIndex(1), &[1]);
    bench.write(0x080E, &[3]);
    assert!(bench.esc.pdi().repeat_requested(SmIndex(1)));
    assert!(full(&mut bench, 1), "a toggle throws nothing away");
    bench.esc.pdi().acknowledge_repeat(SmIndex(1));
    assert_eq!(bench.byte(0x080F), 2);
    assert!(!bench.esc.pdi().repeat_requested(SmIndex(1)));
}

/// C080: settings are writable only while the SyncManager is disabled.
#[test]
fn an_enabled_sync_manager_keeps_its_settings() {
    let mut bench = with_sync_manager(2, 4, OUTPUTS);
    bench.write(0x0810, &[0x00, 0x12]);
    assert_eq!(bench.word(0x0810), START);
    bench.write(0x0810, &[0x00, 0x12, 8, 0, OUTPUTS, 0, 1, 0]);
    assert_eq!(bench.word(0x0810), START);
    bench.write(0x0810, &[0x00, 0x12, 8, 0, OUTPUTS, 0, 0, 0]);
    assert_eq!(bench.word(0x0810), 0x1200, "a write that disables it sets it too");
}

#[test]
fn a_lenient_controller_takes_settings_at_any_time() {
    let lenient = EscConfig { sync_manager_writes: SyncManagerWrites::Always, ..EscConfig::default() };
    let mut bench = Bench::with(lenient);
    bench.set_sync_manager(2, START, 4, OUTPUTS);
    bench.set_sync_manager(2, START, 8, OUTPUTS);
    assert_eq!(bench.word(0x0812), 8);
}

#[test]
fn status_tells_the_last_written_buffer() {
    let mut bench = with_sync_manager(2, 2, OUTPUTS);
    assert_eq!(bench.byte(0x0815) & 0x30, 0x30);
    bench.write(START, &[1, 2]);
    assert_eq!(bench.byte(0x0815) & 0x31, 0x01);
}

#[test]
fn outputs_without_their_last_byte_are_not_handed_over() {
    let mut bench = with_sync_manager(2, 4, OUTPUTS);
    bench.write(START, &[1, 2, 3, 4]);
    bench.write(START, &[9, 9, 9]);
    assert_eq!(bench.esc.pdi().read_buffer(SmIndex(2)), (&[1, 2, 3, 4][..], true));
}

#[test]
fn inputs_can_be_read_before_they_were_written() {
    let mut bench = with_sync_manager(3, 4, INPUTS);
    assert_eq!(bench.read(START, 4), Some(vec![0; 4]));
}

/// C063: access to an area that the application has closed does not count, until it is opened again.
#[test]
fn a_sync_manager_that_the_pdi_closed_refuses() {
    let mut bench = with_sync_manager(2, 2, OUTPUTS);
    bench.esc.pdi().set_deactivated(SmIndex(2), true);
    assert_eq!(bench.byte(0x0817) & 1, 1);
    assert!(!bench.write(START, &[1, 2]));
    bench.esc.pdi().set_deactivated(SmIndex(2), false);
    assert!(bench.write(START, &[1, 2]));
}

#[test]
fn a_disabled_area_is_plain_ram() {
    let mut bench = with_sync_manager(0, 4, MAILBOX_RECEIVE);
    bench.write(0x0806, &[0]);
    assert!(bench.write(START, &[1, 2, 3, 4]));
    assert_eq!(bench.read(START, 4), Some(vec![1, 2, 3, 4]));
}

#[derive(Clone, Copy, Debug)]
enum Step {
    WireWritesWhole,
    WireWritesFirstHalf,
    WireWritesLastHalf,
    PdiReads,
}

#[derive(Clone, Copy, Debug)]
enum InputStep {
    PdiPublishes,
    WireReadsFirstHalf,
    WireReadsLastHalf,
}

const LENGTH: usize = 8;
const HALF: usize = LENGTH / 2;

/// Reference 1.6: if an area, with all its buffers, exceeds the RAM, nothing is exchanged.
#[test]
fn an_area_beyond_the_ram_does_not_answer() {
    let mut bench = Bench::new();
    bench.set_sync_manager(0, 0x2FF0, 64, MAILBOX_RECEIVE);
    assert!(!bench.write(0x2FF0, &[1; 64]));
    assert!(!full(&mut bench, 0));
    bench.set_sync_manager(3, 0x2F00, 100, INPUTS);
    assert_eq!(bench.read(0x2F00, 100), None, "the third buffer has no room");
}

/// Reference 2.7: the PDI's event ends when the PDI has read it, and is not set again without a new access.
#[test]
fn an_event_ends_when_the_pdi_has_looked() {
    let mut bench = with_sync_manager(1, 4, MAILBOX_SEND);
    bench.esc.pdi().fill_mailbox(SmIndex(1), &[1]);
    bench.esc.pdi().take_activation_event();
    assert!(!bench.esc.interrupts_pdi(), "its own message is no event");
    bench.read(START, 4);
    assert!(bench.esc.interrupts_pdi());
    bench.esc.pdi().take_event(SmIndex(1));
    assert!(!bench.esc.interrupts_pdi());
}

proptest! {
    /// C081: for any interleaving the PDI gets only complete images, and always the newest complete one.
    #[test]
    fn outputs_are_never_torn(steps in prop::collection::vec(
        prop_oneof![
            Just(Step::WireWritesWhole), Just(Step::WireWritesFirstHalf),
            Just(Step::WireWritesLastHalf), Just(Step::PdiReads)
        ], 1..200,
    )) {
        let mut bench = with_sync_manager(2, LENGTH as u16, OUTPUTS);
        let mut newest = vec![0; LENGTH];
        let (mut begun, mut image) = (None, 0u8);
        for step in steps {
            match step {
                Step::WireWritesWhole => {
                    image = image.wrapping_add(1);
                    prop_assert!(bench.write(START, &[image; LENGTH]));
                    newest = vec![image; LENGTH];
                    begun = None;
                }
                Step::WireWritesFirstHalf => {
                    image = image.wrapping_add(1);
                    prop_assert!(bench.write(START, &[image; HALF]));
                    begun = Some(image);
                }
                Step::WireWritesLastHalf => {
                    let tail = begun.unwrap_or(image);
                    prop_assert!(bench.write(START + HALF as u16, &[tail; HALF]));
                    if let Some(whole) = begun.take() {
                        newest = vec![whole; LENGTH];
                    }
                }
                Step::PdiReads => {
                    let read = bench.esc.pdi().read_buffer(SmIndex(2)).0.to_vec();
                    prop_assert_eq!(&read, &newest);
                }
            }
        }
    }

    /// C081: for any interleaving ECAT gets complete images, even when it reads them in two datagrams.
    #[test]
    fn inputs_are_never_torn(steps in prop::collection::vec(
        prop_oneof![
            Just(InputStep::PdiPublishes), Just(InputStep::WireReadsFirstHalf),
            Just(InputStep::WireReadsLastHalf)
        ], 1..200,
    )) {
        let mut bench = with_sync_manager(3, LENGTH as u16, INPUTS);
        let (mut image, mut reading) = (0u8, 0u8);
        for step in steps {
            match step {
                InputStep::PdiPublishes => {
                    image = image.wrapping_add(1);
                    bench.esc.pdi().exchange(Some(SmIndex(2)), Some(SmIndex(3)), |_, inputs| inputs.fill(image));
                }
                InputStep::WireReadsFirstHalf => {
                    reading = image;
                    prop_assert_eq!(bench.read(START, HALF), Some(vec![image; HALF]));
                }
                InputStep::WireReadsLastHalf => {
                    prop_assert_eq!(bench.read(START + HALF as u16, HALF), Some(vec![reading; HALF]));
                }
            }
        }
    }
}
