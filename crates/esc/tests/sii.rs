//! The SII interface, with all the access patterns of masters.

mod bench;

use bench::{Bench, sii_image};
use esc::{EscConfig, SiiTiming};
use time::Duration;

const WRITE_ENABLE_ERROR: u16 = 1 << 14;
const COMMAND_ERROR: u16 = 1 << 13;
const BUSY: u16 = 1 << 15;
const COMMAND: u16 = 0x0700;
const CHECKSUM_ERROR: u16 = 1 << 11;

fn words_8_to_11() -> Bench {
    let mut image = sii_image();
    image[16..24].copy_from_slice(&[1, 2, 3, 4, 5, 6, 7, 8]);
    Bench::with_sii(EscConfig::default(), image)
}

#[test]
fn six_bytes_at_once_read_four_or_eight() {
    let mut bench = words_8_to_11();
    assert!(bench.write(0x0502, &[0, 1, 8, 0, 0, 0]));
    assert_eq!(bench.word(0x0502), 0x0040);
    assert_eq!(bench.read(0x0508, 4), Some(vec![1, 2, 3, 4]));
    assert_eq!(bench.read(0x0508, 8), Some(vec![1, 2, 3, 4, 5, 6, 7, 8]));
}

#[test]
fn address_and_command_may_come_apart() {
    let mut bench = words_8_to_11();
    bench.write(0x0504, &[10, 0, 0, 0]);
    bench.write(0x0502, &[0, 1]);
    assert_eq!(bench.read(0x0508, 4), Some(vec![5, 6, 7, 8]));
}

/// GatorCAT writes two bytes and four bytes, both at 0x0502; IgH writes 0x80 into read-only bits.
#[test]
fn four_bytes_at_the_command_are_a_short_address() {
    let mut bench = words_8_to_11();
    bench.write(0x0502, &[0x80, 1, 10, 0]);
    assert_eq!(bench.read(0x0508, 4), Some(vec![5, 6, 7, 8]));
}

/// C031: any word is readable; words beyond the end read as erased.
#[test]
fn every_word_reads_and_the_end_is_erased() {
    let mut bench = Bench::new();
    for (address, expected) in [(1023u32, vec![0, 0, 0xFF, 0xFF]), (70_000, vec![0xFF; 4])] {
        let mut request = vec![0, 1];
        request.extend(address.to_le_bytes());
        bench.write(0x0502, &request);
        assert_eq!(bench.word(0x0502) & (BUSY | COMMAND_ERROR), 0);
        assert_eq!(bench.read(0x0508, 4), Some(expected));
    }
}

/// C032: a write requires the enable bit in the same write.
#[test]
fn a_write_without_enable_is_an_error_and_changes_nothing() {
    let mut bench = Bench::new();
    bench.write(0x0508, &[0xCD, 0xAB]);
    bench.write(0x0502, &[0, 2, 4, 0, 0, 0]);
    assert_eq!(bench.word(0x0502) & WRITE_ENABLE_ERROR, WRITE_ENABLE_ERROR);
    bench.write(0x0502, &[0, 1, 4, 0, 0, 0]);
    assert_eq!(bench.read(0x0508, 2), Some(vec![0x34, 0x12]));
    bench.write(0x0508, &[0xCD, 0xAB]);
    bench.write(0x0502, &[1, 2, 4, 0, 0, 0]);
    assert_eq!(bench.word(0x0502) & WRITE_ENABLE_ERROR, 0);
    bench.write(0x0502, &[0, 1, 4, 0, 0, 0]);
    assert_eq!(bench.read(0x0508, 2), Some(vec![0xCD, 0xAB]));
}

#[test]
fn an_unknown_command_is_an_error_that_a_nop_clears() {
    let mut bench = Bench::new();
    bench.write(0x0502, &[0, 7]);
    assert_eq!(bench.word(0x0502) & COMMAND_ERROR, COMMAND_ERROR);
    bench.write(0x0502, &[0, 0]);
    assert_eq!(bench.word(0x0502) & COMMAND_ERROR, 0);
}

/// C033, C034: the PDI owns it until the master forces it back.
#[test]
fn ownership_decides_who_may_command() {
    let mut bench = words_8_to_11();
    bench.write(0x0500, &[1]);
    assert!(!bench.write(0x0502, &[0, 1, 8, 0, 0, 0]));
    assert!(bench.esc.pdi().take_sii(true));
    assert!(bench.esc.pdi().write_sii_word(8, 0xBEEF));
    bench.write(0x0500, &[0]);
    assert!(!bench.write(0x0502, &[0, 1, 8, 0, 0, 0]), "the PDI still has it");
    bench.write(0x0500, &[2]);
    bench.write(0x0500, &[0]);
    assert!(bench.write(0x0502, &[0, 1, 8, 0, 0, 0]));
    assert_eq!(bench.read(0x0508, 2), Some(vec![0xEF, 0xBE]));
}

const WAIT: Duration = Duration::from_micros(300);

fn slow() -> Bench {
    Bench::with(EscConfig { sii: SiiTiming::Busy(WAIT), ..EscConfig::default() })
}

/// C031: the read ends with busy 0; a write in between does not count and changes nothing (reference 2.10, 2.16).
#[test]
fn a_slow_eeprom_takes_nothing_until_it_is_done() {
    let mut bench = slow();
    bench.write(0x0502, &[0, 1, 4, 0, 0, 0]);
    for (offset, data) in
        [(0x0502, &[0, 1, 8, 0, 0, 0][..]), (0x0502, &[0, 0]), (0x0504, &[8]), (0x0508, &[7; 8])]
    {
        assert!(!bench.write(offset, data), "0x{offset:04X} while busy");
    }
    assert_eq!(bench.word(0x0502) & BUSY, BUSY);
    bench.now += WAIT;
    assert_eq!(bench.word(0x0502) & (BUSY | COMMAND_ERROR), 0);
    assert_eq!(bench.word(0x0504), 4, "an address in between is not taken");
    assert_eq!(bench.read(0x0508, 2), Some(vec![0x34, 0x12]), "a command in between is not taken");
    assert!(bench.write(0x0502, &[0, 1, 8, 0, 0, 0]));
}

/// A write that also covers the owner register counts for that byte alone.
#[test]
fn a_busy_interface_does_not_keep_the_owner_from_being_set() {
    let mut bench = slow();
    bench.write(0x0502, &[0, 1, 4, 0, 0, 0]);
    assert!(bench.write(0x0500, &[1, 0, 0, 1, 8, 0, 0, 0]));
    assert_eq!((bench.byte(0x0500), bench.word(0x0504)), (1, 4));
}

/// Bits 8 to 10 are the running command, and 0 if the interface is busy without one (reference 2.10).
#[test]
fn the_running_command_shows_until_it_is_done() {
    let mut bench = slow();
    for control in [[0, 1], [1, 2], [0, 4]] {
        bench.write(0x0502, &control);
        let running = u16::from(control[1]) << 8;
        assert_eq!(bench.word(0x0502) & (BUSY | COMMAND), BUSY | running);
        bench.now += WAIT;
        assert_eq!(bench.word(0x0502) & (BUSY | COMMAND), 0);
    }
    bench.write(0x0502, &[0, 0]);
    assert_eq!(bench.word(0x0502) & (BUSY | COMMAND), 0, "nothing runs");
    bench.esc.keep_sii_busy(bench.now, bench.now + WAIT);
    assert_eq!(bench.word(0x0502) & (BUSY | COMMAND), BUSY);
    bench.now += WAIT;
    bench.write(0x0502, &[0, 1]);
    bench.esc.keep_sii_busy(bench.now, bench.now + WAIT + WAIT);
    bench.now += WAIT;
    assert_eq!(bench.word(0x0502) & (BUSY | COMMAND), BUSY | 0x0100, "kept busy while a command runs");
}

/// Three datagrams of one frame: data, address and command arrive separately.
#[test]
fn data_of_the_same_frame_is_in_place_wherever_it_comes() {
    let mut bench = slow();
    for (offset, data) in [(0x0502, &[1, 2][..]), (0x0504, &[5, 0]), (0x0508, &[0xCD, 0xAB])] {
        assert!(bench.esc.write(offset, data, bench.now));
    }
    bench.end();
    assert_eq!(bench.esc.sii_image()[10..12], [0xCD, 0xAB]);
}

/// A wrong checksum: the configuration is not loaded, the controller still answers.
#[test]
fn a_wrong_checksum_shows_and_keeps_the_configuration_out() {
    let mut image = sii_image();
    image[14] ^= 1;
    let mut bench = Bench::with_sii(EscConfig::default(), image);
    assert_eq!(bench.word(0x0502) & CHECKSUM_ERROR, CHECKSUM_ERROR);
    assert_eq!((bench.word(0x0012), bench.byte(0x0140), bench.word(0x0110) & 1), (0, 0, 0));
}

#[test]
fn an_empty_eeprom_is_not_loaded() {
    let mut bench = Bench::with_sii(EscConfig::default(), Vec::new());
    assert_eq!(bench.word(0x0502) & (1 << 12), 1 << 12);
    bench.write(0x0502, &[1, 2, 4, 0, 0, 0]);
    bench.write(0x0502, &[0, 1, 4, 0, 0, 0]);
    assert_eq!(bench.read(0x0508, 2), Some(vec![0xFF, 0xFF]));
}

/// C018: a reload loads the configuration, never the alias.
#[test]
fn a_reload_leaves_the_alias() {
    let mut bench = Bench::new();
    bench.write(0x0508, &[1, 0]);
    bench.write(0x0502, &[1, 2, 4, 0, 0, 0]);
    bench.write(0x0502, &[0, 4]);
    assert_eq!(bench.word(0x0012), 0x1234);
    assert_eq!(bench.word(0x0502) & CHECKSUM_ERROR, CHECKSUM_ERROR);
}
