//! Round trips of the bytes, damage of every kind, and the effect of a start on a memory.

use arrayvec::ArrayVec;
use coe_kit::history::DiagnosisHistory;
use proptest::collection::vec;
use proptest::prelude::*;

use super::*;
use crate::events::{Event, EventCode, EventLevel, EventLog};

fn encoded(memory: &NonVolatileMemory) -> Vec<u8> {
    let mut bytes = Vec::new();
    memory.encode_into(&mut bytes);
    bytes
}

/// A record of an event that belongs in this log.
fn record(goes_there: fn(&Event) -> bool) -> impl Strategy<Value = LogRecord> {
    let events: Vec<_> =
        Event::all().iter().filter(|event| goes_there(event)).map(|event| event.code).collect();
    let level = prop_oneof![
        Just(EventLevel::MinorFault),
        Just(EventLevel::Observation),
        Just(EventLevel::Information)
    ];
    (prop::sample::select(events), level, any::<u64>(), vec(any::<u32>(), 0..=DETAILS_MAX)).prop_map(
        |(event, level, time_ns, details)| LogRecord {
            event,
            level,
            time_ns,
            details: details.into_iter().collect(),
        },
    )
}

fn log() -> impl Strategy<Value = ErrorLog> {
    let system = vec(record(|event| event.logged), 0..=SYSTEM_RECORDS_MAX);
    let access = vec(record(|event| event.event_log == EventLog::Access), 0..=ACCESS_RECORDS_MAX);
    ((system, access), any::<u8>(), any::<bool>()).prop_map(|((system, access), newest, acknowledged)| {
        let newest = match system.len() {
            0 => 0,
            SYSTEM_RECORDS_MAX => 6 + newest % SYSTEM_RECORDS_MAX as u8,
            count => 5 + count as u8,
        };
        let (system, access) = (ArrayVec::from_iter(system), ArrayVec::from_iter(access));
        ErrorLog { system: DiagnosisHistory { records: system, newest, acknowledged }, access }
    })
}

fn memory() -> impl Strategy<Value = NonVolatileMemory> {
    (any::<u32>(), any::<u16>(), vec(any::<u8>(), 0..2100), log()).prop_map(
        |(file_serial, software_id, sii_image, error_log)| NonVolatileMemory {
            file_serial,
            software_id,
            sii_image,
            error_log,
        },
    )
}

proptest! {
    #[test]
    fn what_is_written_can_be_read(memory in memory()) {
        prop_assert_eq!(NonVolatileMemory::decode(&encoded(&memory)), Ok(memory));
    }

    #[test]
    fn one_wrong_bit_is_found(memory in memory(), at in any::<prop::sample::Index>(), bit in 0..8u8) {
        let mut bytes = encoded(&memory);
        let at = at.index(bytes.len());
        bytes[at] ^= 1u8 << bit;
        prop_assert!(NonVolatileMemory::decode(&bytes).is_err());
    }

    #[test]
    fn an_end_that_is_missing_or_too_much_is_found(memory in memory(), at in any::<prop::sample::Index>()) {
        let mut bytes = encoded(&memory);
        prop_assert!(NonVolatileMemory::decode(&bytes[..at.index(bytes.len())]).is_err());
        bytes.push(0);
        prop_assert!(NonVolatileMemory::decode(&bytes).is_err());
    }

    #[test]
    fn any_bytes_are_no_panic(bytes in vec(any::<u8>(), 0..300)) {
        prop_assert!(NonVolatileMemory::decode(&bytes).is_err());
    }
}

fn record_of(event: u32) -> LogRecord {
    LogRecord { event: EventCode(event), level: EventLevel::MinorFault, time_ns: 0, details: ArrayVec::new() }
}

/// A memory with this log, written and read.
fn after_storage(system: &[u32], newest: u8, access: &[u32]) -> Result<(), Damage> {
    let records = |codes: &[u32]| codes.iter().copied().map(record_of).collect::<Vec<_>>();
    let mut memory = NonVolatileMemory::factory(&UnitSettings::default());
    memory.error_log.system.extend(records(system));
    memory.error_log.access.extend(records(access));
    memory.error_log.system.newest = newest;
    NonVolatileMemory::decode(&encoded(&memory)).map(drop)
}

#[test]
fn a_log_that_no_unit_can_have_is_damage() {
    const WATCHDOG: u32 = 0x8500_0000;
    const RESTART: u32 = 0x94B8_0000;
    for (newest, is_right) in [(0, false), (5, false), (6, false), (7, true), (8, false), (0x25, false)] {
        let expected = if is_right { Ok(()) } else { Err(Damage::Contents) };
        assert_eq!(after_storage(&[WATCHDOG; 2], newest, &[RESTART]), expected, "{newest:02X}");
    }
    for newest in 0..=0xFF {
        let expected = if (6..=0x25).contains(&newest) { Ok(()) } else { Err(Damage::Contents) };
        assert_eq!(after_storage(&[WATCHDOG; 32], newest, &[]), expected, "{newest:02X}");
    }
    assert_eq!(after_storage(&[], 0, &[]), Ok(()));
    assert_eq!(after_storage(&[], 6, &[]), Err(Damage::Contents));
    for not_logged in [0x0020_0000, RESTART, 0xDEAD_0000] {
        assert_eq!(after_storage(&[not_logged], 6, &[]), Err(Damage::Contents), "{not_logged:08X}");
    }
    for no_access in [WATCHDOG, 0x0020_0000, 0xDEAD_0000] {
        assert_eq!(after_storage(&[], 0, &[no_access]), Err(Damage::Contents), "{no_access:08X}");
    }
}

proptest! {
    #[test]
    fn no_memory_is_longer_than_the_room_for_it(memory in memory()) {
        prop_assert!(encoded(&memory).len() <= memory.encoded_bytes_max());
    }
}

#[test]
fn the_room_is_that_of_full_logs_with_all_details() {
    let mut memory = NonVolatileMemory::factory(&UnitSettings::default());
    let full = LogRecord { details: [0; DETAILS_MAX].into(), ..record_of(0x8500_0000) };
    memory.error_log.system.extend(core::iter::repeat_n(full.clone(), SYSTEM_RECORDS_MAX));
    memory.error_log.access.extend(core::iter::repeat_n(full, ACCESS_RECORDS_MAX));
    assert_eq!(encoded(&memory).len(), memory.encoded_bytes_max());
}

#[test]
fn each_kind_of_damage_has_its_name() {
    let bytes = encoded(&NonVolatileMemory::factory(&UnitSettings::default()));
    let changed = |at: usize, to: u8| {
        let mut bytes = bytes.clone();
        bytes[at] = to;
        NonVolatileMemory::decode(&bytes)
    };
    assert_eq!(changed(0, b'x'), Err(Damage::NoMemory));
    assert_eq!(changed(8, 9), Err(Damage::Version { version: 9 }));
    assert_eq!(changed(100, 0x5A), Err(Damage::Checksum));
    for foreign in [&b""[..], b"rubbish", b"model = \"nx-ect101\"\n", &bytes[..7]] {
        assert_eq!(NonVolatileMemory::decode(foreign), Err(Damage::NoMemory));
    }
    assert_eq!(NonVolatileMemory::decode(&bytes[..8]), Err(Damage::Length { length_bytes: 8 }));
    assert_eq!(NonVolatileMemory::decode(&bytes[..50]), Err(Damage::Length { length_bytes: 50 }));
}

#[test]
fn the_factory_memory_is_that_of_the_settings() {
    let settings = UnitSettings { serial: 77, id_switch: 0x21, ..UnitSettings::default() };
    let memory = NonVolatileMemory::factory(&settings);
    assert_eq!((memory.serial(), memory.software_id()), (77, 0));
    assert_eq!(alias(memory.sii_image()), Some(0x21));
    assert!(esi::sii::lint(memory.sii_image()).is_empty());
}

#[test]
fn the_id_goes_into_the_alias_with_the_right_checksum() {
    let settings = UnitSettings::default();
    let mut memory = NonVolatileMemory::factory(&settings);
    memory.start(&settings, 0x0301);
    assert_eq!(alias(memory.sii_image()), Some(0x0301));
    assert!(esi::sii::lint(memory.sii_image()).is_empty());
}

#[test]
fn a_new_serial_number_in_the_unit_file_wins_and_an_old_one_does_not() {
    let mut memory = NonVolatileMemory::factory(&UnitSettings::default());
    let mut of_master = memory.sii_image().to_vec();
    of_master[SERIAL].copy_from_slice(&500_u32.to_le_bytes());
    memory.follow_sii(&of_master);
    memory.start(&UnitSettings::default(), 1);
    assert_eq!(memory.serial(), 500);
    memory.start(&UnitSettings { serial: 9, ..UnitSettings::default() }, 1);
    assert_eq!(memory.serial(), 9);
}

#[test]
fn a_sii_that_a_master_has_broken_stays_broken() {
    let mut memory = NonVolatileMemory::factory(&UnitSettings::default());
    let mut broken = memory.sii_image().to_vec();
    broken[0] ^= 0xFF;
    assert_eq!(memory.follow_sii(&broken), None);
    memory.start(&UnitSettings::default(), 0x44);
    assert_eq!(memory.sii_image(), broken);
}
