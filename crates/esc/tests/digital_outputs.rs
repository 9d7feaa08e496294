//! Digital output data, 0x0F00 to 0x0F03: registers that hold process data (reference 2.15).

mod bench;

use bench::{Bench, OUTPUTS};
use esc::{Access, SmIndex};

const FMMU_OUTPUTS: [u8; 13] = [0, 0, 0, 0, 1, 0, 0, 7, 0x00, 0x0F, 0, 2, 1];

fn with_outputs(sync_manager: u16, start: u16, length_bytes: u16) -> Bench {
    let mut bench = Bench::new();
    bench.set_sync_manager(sync_manager, start, length_bytes, OUTPUTS);
    bench
}

#[test]
fn a_sync_manager_of_one_byte_hands_over_its_outputs() {
    let mut bench = with_outputs(0, 0x0F00, 1);
    assert!(!bench.esc.pdi().outputs_received(SmIndex(0)));
    assert!(bench.write(0x0F00, &[0xA5]));
    assert!(bench.esc.pdi().outputs_received(SmIndex(0)));
    assert_eq!(bench.esc.pdi().read_buffer(SmIndex(0)), (&[0xA5][..], true));
    assert_eq!(bench.read(0x0F00, 2), Some(vec![0xA5, 0]), "a register shows its value");
}

#[test]
fn neighbours_have_sync_managers_of_their_own() {
    let mut bench = with_outputs(0, 0x0F00, 1);
    bench.set_sync_manager(1, 0x0F01, 1, OUTPUTS);
    assert!(bench.write(0x0F00, &[1, 2]), "one datagram for both");
    let mut pdi = bench.esc.pdi();
    assert_eq!([0, 1].map(|n| pdi.read_buffer(SmIndex(n)).0.to_vec()), [[1], [2]]);
}

/// There is no room for three buffers there.
#[test]
fn a_sync_manager_that_leaves_them_does_not_answer() {
    for (start, length_bytes) in [(0x0F00, 2), (0x0F03, 2), (0x0F04, 1), (0x0EFF, 1)] {
        let mut bench = with_outputs(0, start, length_bytes);
        bench.write(start, &[1, 2]);
        assert!(!bench.esc.pdi().outputs_received(SmIndex(0)), "{start:#06X}, {length_bytes}");
    }
}

#[test]
fn logical_writes_reach_them_byte_by_byte_and_bit_by_bit() {
    let mut bench = with_outputs(0, 0x0F00, 1);
    bench.set_fmmu(0, &FMMU_OUTPUTS);
    let mut data = [0x3C];
    let access = bench.esc.logical_read_write(0, &mut data, bench.now);
    bench.end();
    assert_eq!((access, data), (Access { read: false, written: true }, [0x3C]));
    assert_eq!(bench.esc.pdi().read_buffer(SmIndex(0)).0, [0x3C]);
    let bits_4_to_7 = [0, 0, 0, 0, 1, 0, 4, 7, 0x00, 0x0F, 0, 2, 1];
    bench.set_fmmu(0, &bits_4_to_7);
    assert!(bench.esc.logical_write(0, &[0x90], bench.now));
    bench.end();
    assert_eq!(bench.esc.pdi().read_buffer(SmIndex(0)).0, [0x39], "bits 0 to 3 are mapped");
}

/// Without a SyncManager they are bytes that a master reads and writes.
#[test]
fn they_keep_what_is_written() {
    let mut bench = Bench::new();
    assert!(bench.write(0x0F00, &[1, 2, 3, 4]));
    assert_eq!(bench.read(0x0F00, 4), Some(vec![1, 2, 3, 4]));
    assert!(bench.write(0x0EFE, &[9; 4]), "beginning in front of them");
    assert_eq!(bench.read(0x0F00, 4), Some(vec![9, 9, 3, 4]));
}

/// A long write of registers does not change what a SyncManager covers.
#[test]
fn a_long_write_leaves_the_outputs() {
    let mut bench = with_outputs(0, 0x0F00, 1);
    bench.write(0x0F00, &[0x55]);
    bench.write(0x0EFE, &[0xFF; 6]);
    assert_eq!(bench.esc.pdi().read_buffer(SmIndex(0)).0, [0x55]);
    assert_eq!(bench.read(0x0F01, 3), Some(vec![0xFF; 3]));
}

/// C019: they are registers.
#[test]
fn write_protection_covers_them() {
    let mut bench = with_outputs(0, 0x0F00, 1);
    bench.write(0x0021, &[1]);
    assert!(!bench.write(0x0F00, &[1]));
    assert!(bench.esc.write(0x0020, &[1], bench.now) && bench.esc.write(0x0F00, &[1], bench.now));
    bench.end();
    assert_eq!(bench.esc.pdi().read_buffer(SmIndex(0)).0, [1]);
}
