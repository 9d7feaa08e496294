//! Round trips of the bytes, damage of every kind, and what a start makes of a memory.

use arrayvec::ArrayVec;
use proptest::collection::vec;
use proptest::prelude::*;

use super::*;
use crate::events::{EventCode, EventLevel};

fn encoded(memory: &NonVolatileMemory) -> Vec<u8> {
    let mut bytes = Vec::new();
    memory.encode_into(&mut bytes);
    bytes
}

fn record() -> impl Strategy<Value = LogRecord> {
    let level = prop_oneof![
        Just(EventLevel::MinorFault),
        Just(EventLevel::Observation),
        Just(EventLevel::Information)
    ];
    (any::<u32>(), level, any::<u64>(), vec(any::<u32>(), 0..=DETAILS_MAX)).prop_map(
        |(event, level, time_ns, details)| LogRecord {
            event: EventCode(event),
            level,
            time_ns,
            details: details.into_iter().collect(),
        },
    )
}

fn log() -> impl Strategy<Value = ErrorLog> {
    let records = (vec(record(), 0..=SYSTEM_RECORDS_MAX), vec(record(), 0..=ACCESS_RECORDS_MAX));
    (records, any::<u8>(), any::<bool>()).prop_map(|((system, access), newest, acknowledged)| {
        let newest = if system.is_empty() { 0 } else { 6 + newest % system.len() as u8 };
        let (system, access) = (ArrayVec::from_iter(system), ArrayVec::from_iter(access));
        ErrorLog { system, newest, acknowledged, access }
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
    assert_eq!(NonVolatileMemory::decode(&[]), Err(Damage::Length { length_bytes: 0 }));
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
