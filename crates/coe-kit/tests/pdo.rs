//! PDO objects of a small table, written right and wrong, and the settings that follow them.

use coe_kit::pdo::{PdoEntry, PdoObjects, PdoSettings};
use objects::{AccessRights, Entry, Object, ObjectCode, ObjectTable, SdoAbort};
use wire::{DataType, ObjectIndex, SubIndex};

const OUTPUTS: ObjectIndex = ObjectIndex(0x1C12);
const INPUTS: ObjectIndex = ObjectIndex(0x1C13);
const RX: ObjectIndex = ObjectIndex(0x1600);
const TX: ObjectIndex = ObjectIndex(0x1A00);

fn entry(sub: u8, data_type: DataType, bit_length: u16, default: u32) -> Entry {
    let access = AccessRights::READ | AccessRights::WRITE;
    let default = default.to_le_bytes()[..usize::from(bit_length.div_ceil(8))].to_vec();
    Entry {
        sub: SubIndex(sub),
        name: String::new(),
        data_type,
        bit_length,
        access,
        default,
        limits: Vec::new(),
    }
}

/// An object of a count and elements.
fn list(
    index: ObjectIndex,
    data_type: DataType,
    element_bits: u16,
    (count, elements): (u32, &[u32]),
) -> Object {
    let elements = (1..).zip(elements).map(|(sub, &element)| entry(sub, data_type, element_bits, element));
    let entries = core::iter::once(entry(0, DataType::UNSIGNED8, 8, count)).chain(elements).collect();
    Object { index, name: String::new(), code: ObjectCode::Array, data_type, complete_access: true, entries }
}

/// An output of 8 bits and one of 1 bit, an input of 16 bits, and a number that cannot be mapped.
fn table() -> ObjectTable {
    let data = |index, bits, access| {
        let entry = Entry { access, ..entry(0, DataType::UNSIGNED16, bits, 0) };
        let code = ObjectCode::Variable;
        let (name, data_type, entries) = (String::new(), entry.data_type, vec![entry]);
        Object { index: ObjectIndex(index), name, code, data_type, complete_access: false, entries }
    };
    ObjectTable::new(vec![
        list(RX, DataType::PDO_MAPPING, 32, (2, &[0x7000_0008, 0x7001_0001, 0])),
        list(TX, DataType::PDO_MAPPING, 32, (1, &[0x6000_0010])),
        list(ObjectIndex(0x1C10), DataType::UNSIGNED16, 16, (0, &[])),
        list(OUTPUTS, DataType::UNSIGNED16, 16, (1, &[0x1600, 0])),
        list(INPUTS, DataType::UNSIGNED16, 16, (1, &[0x1A00])),
        data(0x2000, 16, AccessRights::READ),
        data(0x6000, 16, AccessRights::READ | AccessRights::TX_PDO),
        data(0x7000, 8, AccessRights::READ | AccessRights::RX_PDO),
        data(0x7001, 1, AccessRights::READ | AccessRights::RX_PDO),
    ])
}

fn objects() -> PdoObjects {
    PdoObjects::of_table(&table())
}

fn write(objects: &mut PdoObjects, index: ObjectIndex, sub: u8, number: u32) -> Result<(), SdoAbort> {
    objects.write(&table(), index, SubIndex(sub), &number.to_le_bytes())
}

/// As masters do it without complete access.
fn set(objects: &mut PdoObjects, index: ObjectIndex, elements: &[u32]) -> Result<(), SdoAbort> {
    write(objects, index, 0, 0)?;
    for (sub, &element) in (1..).zip(elements) {
        write(objects, index, sub, element)?;
    }
    write(objects, index, 0, elements.len() as u32)
}

fn sizes(objects: &PdoObjects) -> (usize, usize) {
    (objects.size_bytes(OUTPUTS), objects.size_bytes(INPUTS))
}

#[test]
fn the_objects_are_those_of_the_table_and_no_others() {
    let known = objects();
    let has = |index: u16| known.has(ObjectIndex(index));
    assert!(has(0x1600) && has(0x1A00) && has(0x1C12) && has(0x1C13));
    assert!(!has(0x1C10), "the SyncManager of a mailbox has no PDOs");
    assert!(!has(0x2000) && !has(0x7000));
    assert_eq!(sizes(&known), (2, 2), "9 bits, 16 bits");
}

#[test]
fn elements_are_written_between_the_two_counts_only() {
    let mut objects = objects();
    assert_eq!(write(&mut objects, RX, 1, 0x7001_0001), Err(SdoAbort::SUBINDEX_ZERO_NOT_CLEARED));
    set(&mut objects, RX, &[0x7001_0001, 0x7000_0008, 0x7000_0008]).expect("room for three");
    assert_eq!(sizes(&objects), (3, 2), "17 bits");
    assert_eq!(write(&mut objects, RX, 0, 4), Err(SdoAbort::PDO_LENGTH_EXCEEDED));
    assert_eq!(write(&mut objects, RX, 0, 256), Err(SdoAbort::PDO_LENGTH_EXCEEDED));
    objects.restore_defaults(&table());
    assert_eq!(sizes(&objects), (2, 2));
}

#[test]
fn what_cannot_be_mapped_or_assigned_is_refused() {
    let mut objects = objects();
    write(&mut objects, RX, 0, 0).expect("cleared");
    for element in [0x7000_0010, 0x7000_0108, 0x2000_0010, 0x1600_0008, 0x0000_0008] {
        assert_eq!(write(&mut objects, RX, 1, element), Err(SdoAbort::NOT_MAPPABLE), "{element:08X}");
    }
    write(&mut objects, RX, 1, 0x6000_0010).expect("the model judges the direction");
    write(&mut objects, OUTPUTS, 0, 0).expect("cleared");
    for element in [0x1601, 0x7000, 0x1C13, 0x1600_0000] {
        assert_eq!(write(&mut objects, OUTPUTS, 1, element), Err(SdoAbort::NOT_MAPPABLE), "{element:04X}");
    }
    write(&mut objects, OUTPUTS, 1, 0x1A00).expect("the model judges the direction");
    assert_eq!(write(&mut objects, ObjectIndex(0x2000), 0, 0), Err(SdoAbort::OBJECT_DOES_NOT_EXIST));
}

#[test]
fn values_read_back_beyond_the_count_too() {
    let mut objects = objects();
    set(&mut objects, RX, &[0x7001_0001]).expect("an entry");
    let read = |sub| {
        let mut value = [0; 4];
        objects.read(RX, SubIndex(sub), &mut value).map(|()| u32::from_le_bytes(value))
    };
    assert_eq!((read(0), read(1), read(2)), (Ok(1), Ok(0x7001_0001), Ok(0x7001_0001)));
    assert_eq!(read(4), Err(SdoAbort::SUBINDEX_DOES_NOT_EXIST));
}

#[test]
fn an_entry_is_mapped_while_its_pdo_is_assigned_and_counts_it() {
    let mut objects = objects();
    let mapped = |objects: &PdoObjects, index| objects.is_mapped(ObjectIndex(index), SubIndex::ZERO);
    assert!(mapped(&objects, 0x7000) && mapped(&objects, 0x6000) && !mapped(&objects, 0x2000));
    set(&mut objects, OUTPUTS, &[0]).expect("an element without PDO");
    assert!(!mapped(&objects, 0x7000));
    set(&mut objects, INPUTS, &[0x1600]).expect("a PDO");
    assert!(mapped(&objects, 0x7000) && !mapped(&objects, 0x6000));
}

#[test]
fn settings_follow_the_objects_into_memory_that_they_have() {
    let mut objects = objects();
    let mut settings = PdoSettings::of_objects(&objects);
    let rooms =
        |settings: &PdoSettings| (settings.entries(RX).as_ptr(), settings.assignment(OUTPUTS).as_ptr());
    let before = rooms(&settings);
    set(&mut objects, RX, &[0x7001_0001, 0x7000_0008, 0x7001_0001]).expect("room for three");
    set(&mut objects, OUTPUTS, &[0, 0x1600]).expect("room for two");
    settings.follow(&objects);
    assert_eq!(rooms(&settings), before);
    assert_eq!(settings.assignment(OUTPUTS), [ObjectIndex(0), RX]);
    assert_eq!(settings.assigned(OUTPUTS).collect::<Vec<_>>(), [RX]);
    let placed: Vec<_> =
        settings.placed(OUTPUTS).map(|placed| (placed.entry.element(), placed.bits)).collect();
    assert_eq!(placed, [(0x7001_0001, 0..1), (0x7000_0008, 1..9), (0x7001_0001, 9..10)]);
    assert_eq!(settings.size_bytes(OUTPUTS, |_| true), 2);
    assert_eq!(settings.size_bytes(OUTPUTS, |pdo| pdo == TX), 0, "only those that count");
}

#[test]
fn settings_can_be_wrong_but_not_of_objects_that_do_not_exist() {
    let mut settings = PdoSettings::of_objects(&objects());
    let wide = PdoEntry { index: ObjectIndex(0x7777), sub: SubIndex(9), bit_length: 240 };
    settings.map(RX, [wide; 5]);
    settings.assign(INPUTS, [RX]);
    assert_eq!(settings.size_bytes(INPUTS, |_| true), 150);
    let before = settings.clone();
    settings.map(ObjectIndex(0x1601), [wide]);
    settings.assign(ObjectIndex(0x1C10), [RX]);
    assert_eq!(settings, before);
}
