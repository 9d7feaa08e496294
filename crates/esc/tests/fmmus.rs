//! FMMU mapping against a model that handles only bits.

mod bench;

use bench::Bench;
use proptest::prelude::*;

/// A mapping as in its registers.
#[derive(Clone, Copy, Debug)]
struct Mapping {
    logical_start: u32,
    length_bytes: u16,
    start_bit: u8,
    stop_bit: u8,
    physical_start: u16,
    physical_bit: u8,
    kind: u8,
}

impl Mapping {
    fn registers(&self) -> [u8; 13] {
        let l = self.logical_start.to_le_bytes();
        let n = self.length_bytes.to_le_bytes();
        let p = self.physical_start.to_le_bytes();
        [
            l[0],
            l[1],
            l[2],
            l[3],
            n[0],
            n[1],
            self.start_bit,
            self.stop_bit,
            p[0],
            p[1],
            self.physical_bit,
            self.kind,
            1,
        ]
    }

    /// Pairs of logical and physical bit, counted from bit 0 of byte 0.
    fn bits(&self) -> Vec<(u64, u64)> {
        let first = u64::from(self.logical_start) * 8 + u64::from(self.start_bit);
        let last =
            (u64::from(self.logical_start) + u64::from(self.length_bytes) - 1) * 8 + u64::from(self.stop_bit);
        let physical = u64::from(self.physical_start) * 8 + u64::from(self.physical_bit);
        (first..=last).map(|logical| (logical, physical + logical - first)).collect()
    }
}

fn mapping(kind: u8) -> impl Strategy<Value = Mapping> {
    (0x0001_0000u32..0x0001_0020, 1u16..12, 0u8..8, 0u8..8, 0x1000u16..0x1020, 0u8..8).prop_map(
        move |(logical_start, length_bytes, start_bit, stop_bit, physical_start, physical_bit)| Mapping {
            logical_start,
            length_bytes,
            start_bit,
            stop_bit,
            physical_start,
            physical_bit,
            kind,
        },
    )
}

fn get(bytes: &[u8], bit: u64) -> bool {
    bytes[(bit / 8) as usize] >> (bit % 8) & 1 != 0
}

fn set(bytes: &mut [u8], bit: u64, value: bool) {
    let byte = &mut bytes[(bit / 8) as usize];
    *byte = *byte & !(1 << (bit % 8)) | u8::from(value) << (bit % 8);
}

/// The example of reference 3.6: length 3, start bit 3, stop bit 0, physical bit 1 maps 14 bits.
#[test]
fn the_example_of_the_standard_maps_fourteen_bits() {
    let mut bench = Bench::new();
    bench.set_fmmu(0, &[0x47, 0, 1, 0, 3, 0, 3, 0, 0x00, 0x10, 1, 1, 1]);
    bench.write(0x1000, &[0xFF, 0xFF]);
    let mut data = [0; 3];
    let now = bench.now;
    assert!(bench.esc.logical_read(0x0001_0047, &mut data, now));
    assert_eq!(data, [0b1111_1000, 0xFF, 0b0000_0001]);
}

/// C084, C085: an inactive FMMU maps nothing; the mailbox status bit can be mapped.
#[test]
fn the_mailbox_status_bit_can_be_mapped() {
    let mut bench = Bench::new();
    bench.set_sync_manager(1, 0x1200, 4, bench::MAILBOX_SEND);
    bench.set_fmmu(2, &[0, 0, 0, 0, 1, 0, 0, 0, 0x0D, 0x08, 3, 1, 1]);
    let now = bench.now;
    let mut data = [0xFE];
    assert!(bench.esc.logical_read(0, &mut data, now));
    assert_eq!(data, [0xFE]);
    bench.esc.pdi().fill_mailbox(esc::SmIndex(1), &[1]);
    assert!(bench.esc.logical_read(0, &mut data, now));
    assert_eq!(data, [0xFF]);
    bench.write(0x062C, &[0]);
    assert!(!bench.esc.logical_read(0, &mut data, now));
}

/// C008: overlapping inputs and outputs in one LRW: the old contents are read, the received data are written.
#[test]
fn lrw_reads_inputs_and_writes_outputs_in_the_same_place() {
    let mut bench = Bench::new();
    bench.set_sync_manager(2, 0x1100, 2, bench::OUTPUTS);
    bench.set_sync_manager(3, 0x1200, 2, bench::INPUTS);
    bench.set_fmmu(0, &[0, 0, 0, 0, 2, 0, 0, 7, 0x00, 0x11, 0, 2, 1]);
    bench.set_fmmu(1, &[0, 0, 0, 0, 2, 0, 0, 7, 0x00, 0x12, 0, 1, 1]);
    let now = bench.now;
    bench
        .esc
        .pdi()
        .exchange(Some(esc::SmIndex(2)), Some(esc::SmIndex(3)), |_, inputs| inputs.copy_from_slice(&[7, 8]));
    let mut data = [1, 2];
    let access = bench.esc.logical_read_write(0, &mut data, now);
    bench.end();
    assert!(access.read && access.written);
    assert_eq!(data, [7, 8]);
    assert_eq!(bench.esc.pdi().read_buffer(esc::SmIndex(2)).0, [1, 2]);
}

/// A mapping for both directions over the same RAM returns the old contents and stores the new ones.
#[test]
fn lrw_over_shared_ram_exchanges() {
    let mut bench = Bench::new();
    bench.write(0x1000, &[1, 2]);
    bench.set_fmmu(0, &[0, 0, 0, 0, 2, 0, 0, 7, 0x00, 0x10, 0, 3, 1]);
    let now = bench.now;
    let mut data = [8, 9];
    bench.esc.logical_read_write(0, &mut data, now);
    assert_eq!(data, [1, 2]);
    assert_eq!(bench.read(0x1000, 2), Some(vec![8, 9]));
}

const DATAGRAM: std::ops::Range<u32> = 0x0000_FFF8..0x0001_0030;

/// A mapping that exceeds the address space maps nothing there; it does not wrap to 0.
#[test]
fn a_mapping_does_not_wrap() {
    let mut bench = Bench::new();
    bench.set_fmmu(0, &[0, 0, 0, 0, 0x40, 0, 0, 7, 0xFE, 0xFF, 0, 3, 1]);
    let now = bench.now;
    assert!(!bench.esc.logical_read(2, &mut [0; 8], now));
    assert!(!bench.esc.logical_write(2, &[0xFF; 32], bench.now));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2_000))]

    /// C007, C083: logical reads equal the bit model, unmapped bits are unchanged, lower FMMUs have priority.
    #[test]
    fn logical_reads_equal_the_bit_model(
        first in mapping(1), second in mapping(1), ram: [u8; 64], sent: [u8; 40],
        start in DATAGRAM, length in 1usize..40,
    ) {
        let mut bench = Bench::new();
        bench.write(0x1000, &ram);
        bench.set_fmmu(0, &first.registers());
        bench.set_fmmu(1, &second.registers());
        let sent = &sent[..length];
        let mut expected = sent.to_vec();
        let window = u64::from(start) * 8..(u64::from(start) + length as u64) * 8;
        let mut hit = false;
        for mapping in [second, first] {
            for (logical, physical) in mapping.bits() {
                if window.contains(&logical) {
                    hit = true;
                    set(&mut expected, logical - window.start, get(&ram, physical - 0x1000 * 8));
                }
            }
        }
        let mut data = sent.to_vec();
        let now = bench.now;
        prop_assert_eq!(bench.esc.logical_read(start, &mut data, now), hit);
        prop_assert_eq!(data, expected);
    }

    /// Logical writes equal the bit model, and change no other bit of the memory.
    #[test]
    fn logical_writes_equal_the_bit_model(
        mapping in mapping(2), ram: [u8; 64], sent: [u8; 40], start in DATAGRAM, length in 1usize..40,
    ) {
        let mut bench = Bench::new();
        bench.write(0x1000, &ram);
        bench.set_fmmu(0, &mapping.registers());
        let sent = &sent[..length];
        let mut expected = ram.to_vec();
        let window = u64::from(start) * 8..(u64::from(start) + length as u64) * 8;
        let mut hit = false;
        for (logical, physical) in mapping.bits() {
            if window.contains(&logical) {
                hit = true;
                set(&mut expected, physical - 0x1000 * 8, get(sent, logical - window.start));
            }
        }
        prop_assert_eq!(bench.esc.logical_write(start, sent, bench.now), hit);
        prop_assert_eq!(bench.read(0x1000, 64), Some(expected));
    }
}
