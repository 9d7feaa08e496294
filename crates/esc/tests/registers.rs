//! Registers as in the data sheet: reset values, write access, side effects, then every address.

mod bench;

use bench::Bench;
use esc::{EcatAccess, EscConfig, Port, REGISTERS};
use proptest::prelude::*;
use time::Duration;
use wire::{AlState, AlStatus, AlStatusCode};

/// C012, C013: the values after power-on.
#[test]
fn power_on_values_tell_the_build() {
    let mut bench = Bench::new();
    assert_eq!(bench.read(0x0000, 10), Some(vec![0x11, 0, 3, 0, 8, 8, 8, 0x0F, 0xCC, 0]));
    assert_eq!(bench.read(0x0130, 6), Some(vec![1, 0, 0, 0, 0, 0]));
    assert_eq!(bench.word(0x0120), 1);
    assert_eq!(bench.read(0x0100, 4), Some(vec![1, 0, 7, 0]));
    assert_eq!((bench.word(0x0400), bench.word(0x0420)), (0x09C2, 0x03E8));
    assert_eq!(bench.word(0x0440), 1);
}

/// C018: the alias comes from the SII, and the ECAT side does not change it.
#[test]
fn the_alias_is_word_4_and_read_only() {
    let mut bench = Bench::new();
    assert_eq!(bench.word(0x0012), 0x1234);
    assert!(!bench.write(0x0012, &[1, 0]));
    assert_eq!(bench.word(0x0012), 0x1234);
}

/// C005: the slave answers to the alias only if DL control bit 24 is set.
#[test]
fn the_alias_answers_when_it_is_switched_on() {
    let mut bench = Bench::new();
    bench.write(0x0010, &[0xE9, 0x03]);
    assert!(bench.esc.answers_to(0x03E9) && !bench.esc.answers_to(0x1234));
    bench.write(0x0103, &[1]);
    assert!(bench.esc.answers_to(0x03E9) && bench.esc.answers_to(0x1234));
}

#[test]
fn a_register_write_takes_effect_at_the_end_of_its_frame() {
    let mut bench = Bench::new();
    assert!(bench.esc.write(0x0010, &[7, 0], bench.now));
    let mut within = [0; 2];
    bench.esc.read(0x0010, &mut within, bench.now);
    assert_eq!(within, [0, 0]);
    bench.end();
    assert_eq!(bench.word(0x0010), 7);
}

/// AL control accepts one request at a time.
#[test]
fn al_control_waits_for_the_pdi() {
    let mut bench = Bench::new();
    assert!(bench.write(0x0120, &[2, 0]));
    assert!(!bench.write(0x0120, &[1, 0]));
    let control = bench.esc.pdi().al_control();
    assert_eq!(control.map(|control| control.state), Some(AlState::PreOp));
    assert!(!bench.write(0x0120, &[1, 0]), "looking at it does not take it");
    bench.esc.pdi().take_al_control();
    assert_eq!(bench.esc.pdi().al_control(), None);
    assert!(bench.write(0x0120, &[1, 0]));
}

#[test]
fn al_status_raises_an_event_that_reading_it_clears() {
    let mut bench = Bench::new();
    bench.write(0x0200, &[0x0C, 0]);
    bench.word(0x0110);
    bench.word(0x0130);
    assert_eq!(bench.esc.masked_events(), 0);
    let status = AlStatus { state: AlState::PreOp, error: true, device_id_loaded: false };
    bench.esc.pdi().set_al_status(status, AlStatusCode(0x11));
    assert_eq!(bench.esc.masked_events(), 1 << 3);
    assert_eq!(bench.read(0x0130, 6), Some(vec![0x12, 0, 0, 0, 0x11, 0]));
    assert_eq!(bench.esc.masked_events(), 0);
}

/// C015, C016: any write clears all counters of its group, and no others.
#[test]
fn counters_are_cleared_by_writing() {
    let mut bench = Bench::new();
    bench.esc.count_invalid_frame(Port::In);
    bench.esc.count_forwarded_error(Port::Out);
    bench.esc.count_processing_unit_error();
    bench.esc.set_link(Port::In, true);
    bench.esc.set_link(Port::In, false);
    assert_eq!(bench.read(0x0300, 20).map(|all| all.iter().map(|n| u32::from(*n)).sum::<u32>()), Some(4));
    bench.write(0x0303, &[0]);
    assert_eq!(bench.read(0x0300, 12), Some(vec![0; 12]));
    assert_eq!((bench.byte(0x030C), bench.byte(0x0310)), (1, 1));
    bench.write(0x0300, &[0; 20]);
    assert_eq!(bench.read(0x0300, 20), Some(vec![0; 20]));
}

/// C015
#[test]
fn counters_stay_at_255() {
    let mut bench = Bench::new();
    (0..300).for_each(|_| bench.esc.count_processing_unit_error());
    assert_eq!(bench.byte(0x030C), 255);
}

/// C019: protected registers need the enable register in the same frame.
#[test]
fn write_protection_asks_for_the_enable_register_in_the_same_frame() {
    let mut bench = Bench::new();
    bench.write(0x0021, &[1]);
    assert!(!bench.write(0x0010, &[5, 0]));
    assert!(bench.esc.write(0x0020, &[1], bench.now));
    assert!(bench.esc.write(0x0010, &[5, 0], bench.now));
    bench.end();
    assert_eq!(bench.word(0x0010), 5);
    assert!(!bench.write(0x0010, &[6, 0]));
    assert!(bench.write(0x1000, &[1]), "RAM is not protected by the register protection");
    assert!(bench.esc.write(0x0030, &[1], bench.now));
    assert!(!bench.esc.write(0x0021, &[0], bench.now));
    bench.end();
}

#[test]
fn esc_write_protection_covers_ram_too() {
    let mut bench = Bench::new();
    bench.write(0x0031, &[1]);
    assert!(!bench.write(0x1000, &[1]));
    assert!(bench.esc.write(0x0030, &[1], bench.now));
    assert!(bench.esc.write(0x1000, &[9], bench.now));
    bench.end();
    assert_eq!(bench.byte(0x1000), 9);
}

#[test]
fn res_in_three_frames_asks_for_a_reset() {
    let mut bench = Bench::new();
    let readback: Vec<u8> = b"RES"
        .iter()
        .map(|byte| {
            bench.write(0x0040, &[*byte]);
            bench.byte(0x0040)
        })
        .collect();
    assert_eq!(readback, [1, 2, 0]);
    assert!(bench.esc.pdi().take_reset_request());
    b"RAS".iter().for_each(|byte| {
        bench.write(0x0040, &[*byte]);
    });
    assert!(!bench.esc.pdi().take_reset_request());
}

#[test]
fn without_distributed_clocks_nothing_answers_there() {
    let mut bench = Bench::with(EscConfig { distributed_clocks: false, ..EscConfig::default() });
    assert_eq!(bench.read(0x0910, 8), None);
    assert!(!bench.write(0x0900, &[0; 4]));
    assert_eq!(bench.word(0x0008) & 0x000C, 0);
}

/// C029: two bits for each port. A port without a cable is closed, whether it exists or not.
#[test]
fn the_port_descriptor_says_what_is_behind_each_port() {
    use esc::PortKind::{Ebus, Mii, Missing, NotConfigured};
    for (ports, descriptor) in [
        ([Mii, Mii, Missing, Missing], 0x0F),
        ([Mii, Ebus, Mii, Missing], 0x3B),
        ([Mii, Mii, Mii, Mii], 0xFF),
        ([Ebus, Ebus, NotConfigured, Missing], 0x1A),
    ] {
        let mut bench = Bench::with(EscConfig { ports, ..EscConfig::default() });
        assert_eq!((bench.byte(0x0007), bench.word(0x0110) >> 12), (descriptor, 0x5));
    }
}

#[test]
fn beyond_the_ram_nothing_answers() {
    let mut bench = Bench::new();
    assert_eq!(bench.read(0x3000, 4), None);
    assert!(!bench.write(0x3000, &[1]));
    assert!(bench.read(0x2FFE, 4).is_some(), "one byte inside is enough to count");
    assert!(bench.read(0xFFFF, 4).is_none());
}

/// Masters clear whole areas by block writes of 256 bytes; the writable bytes in them increment the working counter.
#[test]
fn block_writes_over_register_areas_are_taken() {
    let mut bench = Bench::new();
    bench.set_sync_manager(2, 0x1100, 10, bench::OUTPUTS);
    bench.set_fmmu(0, &[0, 0, 0, 0, 10, 0, 0, 7, 0, 0x11, 0, 2, 1]);
    assert!(bench.write(0x0600, &[0; 256]));
    assert!(bench.write(0x0800, &[0; 256]));
    assert_eq!(bench.read(0x0600, 128), Some(vec![0; 128]));
    assert_eq!(bench.read(0x0810, 5), Some(vec![0; 5]));
}

/// An FMMU or SyncManager that is not built in does not answer.
#[test]
fn banks_end_where_the_build_ends() {
    let mut bench = Bench::new();
    assert!(!bench.write(0x0680, &[1; 16]));
    assert!(!bench.write(0x0840, &[1; 8]));
    assert_eq!(bench.read(0x0680, 16), Some(vec![0; 16]));
}

/// C066, C068, C069: the watchdog runs from the first complete write on.
#[test]
fn the_process_data_watchdog_expires_after_its_time() {
    let mut bench = Bench::new();
    bench.set_sync_manager(2, 0x1100, 2, bench::OUTPUTS);
    bench.now += Duration::from_secs(1);
    bench.esc.advance(bench.now);
    assert_eq!(bench.word(0x0440), 1, "nothing has been triggered yet");
    bench.write(0x1100, &[1, 2]);
    let due = bench.now + Duration::from_millis(100);
    assert_eq!(bench.esc.deadline(), due);
    bench.now = due;
    bench.esc.advance(bench.now);
    assert_eq!((bench.word(0x0440), bench.byte(0x0442)), (0, 1));
    assert!(bench.esc.pdi().take_watchdog_event());
    bench.write(0x1100, &[1, 2]);
    assert_eq!(bench.word(0x0440), 1);
    bench.write(0x0420, &[0, 0]);
    assert_eq!(bench.esc.deadline(), time::Instant::NEVER);
    bench.write(0x0442, &[0]);
    assert_eq!(bench.byte(0x0442), 0);
}

/// C068: time 0 is off; a watchdog that had something to monitor continues when its time is set again.
#[test]
fn a_watchdog_without_time_starts_again_with_one() {
    let mut bench = Bench::new();
    bench.set_sync_manager(2, 0x1100, 2, bench::OUTPUTS);
    bench.write(0x0420, &[0, 0]);
    bench.write(0x0420, &[10, 0]);
    assert_eq!(bench.esc.deadline(), time::Instant::NEVER, "nothing has been triggered yet");
    bench.write(0x1100, &[1, 2]);
    bench.write(0x0420, &[0, 0]);
    bench.write(0x0420, &[10, 0]);
    assert_eq!(bench.esc.deadline(), bench.now + Duration::from_millis(1));
}

/// The application starts it before the first write; an expiry remains visible until a write is received.
#[test]
fn the_application_starts_the_watchdog_of_a_trigger() {
    let mut bench = Bench::new();
    bench.set_sync_manager(2, 0x1100, 2, bench::OUTPUTS & !0x40);
    let outputs = esc::SmIndex::OUTPUTS;
    bench.esc.pdi().start_watchdog(outputs, bench.now);
    assert_eq!(bench.esc.deadline(), time::Instant::NEVER, "there is no trigger");
    bench.write(0x0816, &[0]);
    bench.set_sync_manager(2, 0x1100, 2, bench::OUTPUTS);
    for expired in 1..=2 {
        bench.esc.pdi().start_watchdog(outputs, bench.now);
        bench.now += Duration::from_millis(50);
        bench.esc.pdi().start_watchdog(outputs, bench.now);
        bench.now += Duration::from_millis(50);
        bench.esc.advance(bench.now);
        assert_eq!((bench.word(0x0440), bench.byte(0x0442)), (0, expired));
    }
    bench.write(0x1100, &[1, 2]);
    assert_eq!(bench.word(0x0440), 1);
}

/// C118: the system time advances and includes offset and delay.
#[test]
fn system_time_is_local_time_with_offset_less_delay() {
    let mut bench = Bench::new();
    bench.now = time::Instant::from_nanos(5_000);
    bench.write(0x0920, &1_000_000u64.to_le_bytes());
    bench.write(0x0928, &300u32.to_le_bytes());
    let time = bench.read(0x0910, 8).map(|bytes| u64::from_le_bytes(bytes.try_into().expect("eight bytes")));
    assert_eq!(time, Some(1_000_000 + 5_000 - 300));
}

/// A slave whose delay is set correctly agrees with the reference clock.
#[test]
fn the_control_loop_brings_the_difference_to_nothing() {
    let mut bench = Bench::new();
    let mut difference = u32::MAX;
    for cycle in 1..=2_000u64 {
        bench.now = time::Instant::from_nanos(cycle * 1_000_000);
        let reference = (cycle * 1_000_000 + 40_000) as u32;
        bench.write(0x0910, &reference.to_le_bytes());
        let bytes = bench.read(0x092C, 4).expect("DC is there");
        difference = u32::from_le_bytes(bytes.try_into().expect("four bytes")) & 0x7FFF_FFFF;
    }
    assert!(difference < 10, "{difference} ns");
}

/// C019: a long write that begins at the enable register unlocks nothing after it.
#[test]
fn write_protection_looks_at_every_byte() {
    let mut bench = Bench::new();
    bench.write(0x0021, &[1]);
    let mut long = [0; 0x102];
    long[0x100] = 2;
    bench.write(0x0020, &long);
    assert_eq!(bench.word(0x0120), 1);
    assert!(bench.esc.pdi().al_control().is_none());
}

/// "RES" needs three frames, without other writes in between.
#[test]
fn res_in_one_frame_or_interrupted_resets_nothing() {
    let mut bench = Bench::new();
    for byte in b"RES" {
        bench.esc.write(0x0040, &[*byte], bench.now);
    }
    bench.end();
    assert!(!bench.esc.pdi().take_reset_request());
    for (byte, between) in b"RES".iter().zip([true, false, false]) {
        bench.write(0x0040, &[*byte]);
        if between {
            bench.write(0x0010, &[1, 0]);
        }
    }
    assert!(!bench.esc.pdi().take_reset_request());
}

/// There is room for every write of a frame, however many FMMUs map registers.
#[test]
fn a_frame_may_write_registers_many_times() {
    let mut bench = Bench::new();
    for n in 0..8 {
        let physical: u16 = if n == 7 { 0x0010 } else { 0x0900 };
        let [low, high] = physical.to_le_bytes();
        bench.set_fmmu(n, &[0, 0, 0, 0, 248, 0, 0, 7, low, high, 0, 2, 1]);
    }
    assert!(bench.esc.logical_write(0, &[0x77; 248], bench.now));
    bench.end();
    assert_eq!(bench.word(0x0010), 0x7777);
}

/// Reference 2.11: no PHY is connected to the MII interface, so it is never busy and has no error.
#[test]
fn mii_management_is_never_busy() {
    let mut bench = Bench::new();
    bench.write(0x0510, &[0xFF, 0xFF]);
    assert_eq!(bench.word(0x0510), 0x0001);
}

/// What each writable register reads after ones were written to all its bits, at the time of power-on
/// (reference 2.3 to 2.14). For a bank this is its first register.
const AFTER_ONES: &[(u16, &[u8])] = &[
    (0x0010, &[0xFF; 2]),
    (0x0020, &[0x01]),
    (0x0021, &[0x01]),
    (0x0030, &[0x01]),
    (0x0031, &[0x01]),
    (0x0040, &[0]),
    (0x0100, &[0x03, 0xFF, 0x4F, 0x01]),
    (0x0108, &[0xFF; 2]),
    (0x0120, &[0x3F, 0x00]),
    (0x0138, &[0x1F]),
    (0x0139, &[0x1F]),
    (0x0200, &[0xFF; 2]),
    (0x0300, &[0; 2]),
    (0x0308, &[0]),
    (0x030C, &[0]),
    (0x030D, &[0]),
    (0x0310, &[0]),
    (0x0400, &[0xFF; 2]),
    (0x0410, &[0xFF; 2]),
    (0x0420, &[0xFF; 2]),
    (0x0442, &[0]),
    (0x0443, &[0]),
    (0x0500, &[0x03]),
    // A command that does not exist: an error.
    (0x0502, &[0x40, 0x20]),
    (0x0504, &[0xFF; 4]),
    (0x0508, &[0xFF; 8]),
    (0x0510, &[0x01, 0x00]),
    (0x0512, &[0x1F]),
    (0x0513, &[0x1F]),
    (0x0514, &[0xFF; 2]),
    (0x0516, &[0x01]),
    (0x0600, &[0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0x07, 0x07, 0xFF, 0xFF, 0x07, 0x03, 0x01, 0, 0, 0]),
    (0x0800, &[0xFF, 0xFF, 0xFF, 0xFF, 0x7F, 0x30, 0xC3, 0x00]),
    // 0 ns since power-on.
    (0x0900, &[0; 4]),
    (0x0910, &[0; 8]),
    (0x0920, &[0xFF; 8]),
    (0x0928, &[0xFF; 4]),
    (0x0930, &[0xFF, 0x7F]),
    (0x0934, &[0x0F]),
    (0x0935, &[0x0F]),
    (0x0936, &[0x01]),
    (0x0980, &[0x31]),
    (0x0981, &[0xFF]),
    (0x0990, &[0xFF; 8]),
    (0x09A0, &[0xFF; 4]),
    (0x09A8, &[0x03]),
    (0x0F00, &[0xFF; 4]),
    (0x0F10, &[0xFF; 8]),
    (0x0F80, &[0xFF; 128]),
];

#[test]
fn reserved_bits_are_not_stored() {
    let writable: Vec<_> = REGISTERS.iter().filter(|row| row.ecat == EcatAccess::ReadWrite).collect();
    assert_eq!(
        AFTER_ONES.iter().map(|row| row.0).collect::<Vec<_>>(),
        writable.iter().map(|row| row.offset).collect::<Vec<_>>()
    );
    for (register, (_, expected)) in writable.into_iter().zip(AFTER_ONES) {
        // Eight FMMUs and SyncManagers are built in.
        for n in 0..register.count.min(8) {
            let mut bench = Bench::new();
            let offset = register.offset + n * register.stride_bytes;
            assert!(bench.write(offset, &vec![0xFF; expected.len()]), "{}", register.name);
            assert_eq!(bench.read(offset, expected.len()).as_deref(), Some(*expected), "{}", register.name);
        }
    }
}

/// Reference 2.14: a write to 0x0900 latches; a write after it does nothing and does not count.
#[test]
fn only_the_first_receive_time_latches() {
    let mut bench = Bench::new();
    bench.now = time::Instant::from_nanos(5_000);
    for offset in 0x0904..0x0910 {
        assert!(!bench.write(offset, &[0]), "{offset:04X}");
    }
    assert!(!bench.write(0x0904, &[0; 12]));
    assert_eq!(bench.read(0x0900, 16), Some(vec![0; 16]));
    assert!(bench.write(0x0900, &[0]));
    let times = bench.read(0x0900, 16).expect("DC is there");
    assert!(times.chunks(4).all(|time| time == 5_000_u32.to_le_bytes()), "{times:?}");
}

/// Gets all registers without a frame, and by reading them.
fn looked_at_and_read(bench: &mut Bench) -> (Vec<u8>, Option<Vec<u8>>) {
    let mut seen = vec![0xEE; 0x1000];
    bench.esc.look(0, &mut seen, bench.now);
    (seen, bench.read(0, 0x1000))
}

#[test]
fn a_look_sees_what_a_read_would_give() {
    type Change = fn(&mut Bench);
    let changes: [(&str, Change); 6] = [
        ("power-on", |_| {}),
        ("time", |bench| bench.now += Duration::from_millis(3)),
        ("clock", |bench| {
            bench.write(0x0920, &[7; 8]);
        }),
        ("SyncManagers", |bench| {
            bench.set_sync_manager(0, 0x1000, 4, bench::MAILBOX_RECEIVE);
            bench.set_sync_manager(2, 0x1100, 2, bench::OUTPUTS);
            bench.write(0x1000, &[1; 4]);
            bench.write(0x1100, &[1; 2]);
        }),
        ("watchdog", |bench| {
            bench.now += Duration::from_secs(1);
            bench.esc.advance(bench.now);
        }),
        ("SII", |bench| {
            bench.esc.keep_sii_busy(bench.now, bench.now + Duration::from_millis(1));
        }),
    ];
    let mut bench = Bench::new();
    for (name, change) in changes {
        change(&mut bench);
        let (seen, read) = looked_at_and_read(&mut bench);
        assert_eq!(Some(seen), read, "{name}");
    }
    let mut bench = Bench::with(EscConfig { distributed_clocks: false, ..EscConfig::default() });
    bench.now += Duration::from_millis(3);
    let (seen, _) = looked_at_and_read(&mut bench);
    assert_eq!(seen[0x0910..0x0918], [0; 8], "there is no clock");
}

/// Before the first frame: interface of the SII, status of SyncManagers, system time.
#[test]
fn a_look_at_power_on_sees_what_is_worked_out() {
    let bench = Bench::new();
    let look = |offset, bytes: &mut [u8]| bench.esc.look(offset, bytes, time::Instant::from_nanos(0x1234));
    let mut bytes = [0; 2];
    look(0x0502, &mut bytes);
    assert_eq!(bytes, [0x40, 0x00]);
    look(0x0805, &mut bytes[..1]);
    look(0x083D, &mut bytes[1..]);
    assert_eq!(bytes, [0x30, 0x30]);
    look(0x0911, &mut bytes);
    assert_eq!(bytes, [0x12, 0x00], "from any byte on");
}

proptest! {
    /// C014: any write to any address leaves read-only registers unchanged, and nothing panics.
    #[test]
    fn read_only_registers_stay(
        writes in prop::collection::vec((0u16..0x1200, prop::collection::vec(any::<u8>(), 1..64)), 1..40),
    ) {
        let mut bench = Bench::new();
        let constants = |bench: &mut Bench| (bench.read(0x0000, 10), bench.word(0x0012), bench.read(0x0130, 6));
        let before = constants(&mut bench);
        for (offset, data) in writes {
            bench.write(offset, &data);
        }
        bench.write(0x0031, &[0]);
        prop_assert_eq!(constants(&mut bench), before);
    }

    /// C014: a write increments the working counter at every register that the table makes writable, and at no other.
    #[test]
    fn a_write_counts_where_the_table_says_so(row in 0..REGISTERS.len()) {
        let register = REGISTERS[row];
        let mut bench = Bench::new();
        let counts = bench.write(register.offset, &vec![0; usize::from(register.size_bytes)]);
        prop_assert_eq!(counts, register.ecat == EcatAccess::ReadWrite, "{}", register.name);
    }
}
