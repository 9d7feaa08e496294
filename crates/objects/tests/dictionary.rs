//! Tables, flat values, and the layout of complete access.

use std::sync::Arc;

use objects::{
    AccessRights, Dictionary, Entry, Object, ObjectCode, ObjectServer, ObjectTable, SdoAbort, complete,
};
use wire::{AlState, DataType, ObjectIndex, SdoInfoList, SubIndex};

const RECORD: ObjectIndex = ObjectIndex(0x2000);
const TEXT: ObjectIndex = ObjectIndex(0x1008);
const RW: AccessRights = AccessRights::READ.union(AccessRights::WRITE);

fn entry(sub: u8, data_type: DataType, bit_length: u16, default: &[u8]) -> Entry {
    Entry {
        sub: SubIndex(sub),
        name: String::new(),
        data_type,
        bit_length,
        access: RW,
        default: default.to_vec(),
        limits: Vec::new(),
    }
}

fn object(index: ObjectIndex, code: ObjectCode, entries: Vec<Entry>) -> Object {
    let data_type = DataType::UNSIGNED8;
    Object { index, name: String::new(), code, data_type, complete_access: true, entries }
}

fn table() -> Arc<ObjectTable> {
    let mut status = entry(3, DataType::BOOLEAN, 1, &[1]);
    status.access = AccessRights::READ | AccessRights::TX_PDO;
    Arc::new(ObjectTable::new(vec![
        object(
            RECORD,
            ObjectCode::Record,
            vec![
                entry(0, DataType::UNSIGNED8, 8, &[4]),
                entry(1, DataType::UNSIGNED16, 16, &[0x34, 0x12]),
                entry(2, DataType::BOOLEAN, 1, &[0]),
                status,
                entry(4, DataType::UNSIGNED32, 32, &[1, 2, 3, 4]),
            ],
        ),
        object(TEXT, ObjectCode::Variable, vec![entry(0, DataType::VISIBLE_STRING, 48, b"NX-1")]),
    ]))
}

#[test]
fn a_dictionary_begins_with_its_defaults_and_returns_to_them() {
    let mut dictionary = Dictionary::new(table());
    assert_eq!(dictionary.value(TEXT, SubIndex(0)), Some(&b"NX-1\0\0"[..]));
    assert_eq!(dictionary.unsigned(RECORD, SubIndex(4)), Some(0x0403_0201));
    assert!(dictionary.set_unsigned(RECORD, SubIndex(4), 7));
    dictionary.value_mut(TEXT, SubIndex(0)).unwrap().fill(b'x');
    dictionary.restore_defaults();
    assert_eq!(dictionary.value(TEXT, SubIndex(0)), Some(&b"NX-1\0\0"[..]));
    assert_eq!(dictionary.unsigned(RECORD, SubIndex(4)), Some(0x0403_0201));
}

#[test]
fn what_does_not_exist_or_fit_is_refused() {
    let mut dictionary = Dictionary::new(table());
    assert_eq!(dictionary.value(RECORD, SubIndex(9)), None);
    assert!(!dictionary.set_unsigned(RECORD, SubIndex(9), 0));
    assert_eq!(dictionary.write(RECORD, SubIndex(1), &[0]), Err(SdoAbort::LENGTH_MISMATCH));
    assert_eq!(dictionary.read(RECORD, SubIndex(9), &mut [0]), Err(SdoAbort::SUBINDEX_DOES_NOT_EXIST));
}

#[test]
fn values_lie_side_by_side() {
    let table = table();
    let ranges: Vec<_> = table
        .iter()
        .flat_map(|object| object.entries.iter().map(|entry| (object.index, entry.sub)))
        .map(|(index, sub)| table.value_range(index, sub).unwrap())
        .collect();
    assert!(ranges.windows(2).all(|pair| pair[0].end == pair[1].start));
    assert_eq!(ranges.last().unwrap().end, table.values_length_bytes());
    assert_eq!(table.longest_transfer_bytes(), 9);
}

#[test]
fn lists_follow_the_access_words() {
    let table = table();
    assert_eq!(table.list_lengths(), [2, 0, 1, 0, 0]);
    let mapped: Vec<_> = table.list(SdoInfoList::TxPdo).unwrap().map(|object| object.index).collect();
    assert_eq!(mapped, [RECORD]);
    assert!(table.list(SdoInfoList::Lengths).is_none());
    assert!(table.list(SdoInfoList::Other(6)).is_none());
}

#[test]
fn limits_are_several_ranges() {
    let mut limited = entry(0, DataType::UNSIGNED16, 16, &[]);
    limited.limits = vec![0..=0, 0x1601..=0x1603];
    let allowed = [0_u16, 1, 0x1601, 0x1603, 0x1604].map(|value| limited.allows(&value.to_le_bytes()));
    assert_eq!(allowed, [true, false, true, true, false]);
}

#[test]
fn a_layout_pads_the_count_and_packs_bits() {
    let table = table();
    let record = table.object(RECORD).unwrap();
    let offsets: Vec<_> = record.layout(SubIndex(0)).map(|slot| slot.bit_offset).collect();
    assert_eq!(offsets, [0, 16, 32, 33, 40]);
    let offsets: Vec<_> = record.layout(SubIndex(1)).map(|slot| slot.bit_offset).collect();
    assert_eq!(offsets, [0, 16, 17, 24]);
    assert_eq!(record.layout(SubIndex(0)).length_bytes_to(SubIndex(2)), 5);
    assert_eq!(record.layout(SubIndex(0)).length_bytes_to(SubIndex(0)), 2);
}

#[test]
fn complete_access_reads_what_the_state_lets_it() {
    let mut dictionary = Dictionary::new(table());
    let mut octets = [0xEE; 9];
    let read = complete::read(&mut dictionary, RECORD, SubIndex(0), AlState::Op, &mut octets);
    assert_eq!((read, octets), (Ok(9), [4, 0, 0x34, 0x12, 0b10, 1, 2, 3, 4]));
    let read = complete::read(&mut dictionary, RECORD, SubIndex(0), AlState::Init, &mut octets);
    assert_eq!((read, octets), (Ok(9), [0; 9]));
    let read = complete::read(&mut dictionary, RECORD, SubIndex(0), AlState::Op, &mut [0; 8]);
    assert_eq!(read, Err(SdoAbort::OUT_OF_MEMORY));
}

#[test]
fn complete_access_writes_only_with_room_to_undo_it() {
    let mut dictionary = Dictionary::new(table());
    let refused = complete::write(&mut dictionary, RECORD, SubIndex(1), &[1, 0], &mut [0; 6]);
    assert_eq!(refused, Err(SdoAbort::OUT_OF_MEMORY));
    assert_eq!(complete::write(&mut dictionary, RECORD, SubIndex(1), &[1, 0, 0b01], &mut [0; 7]), Ok(()));
    let values = [1, 2, 3].map(|sub| dictionary.unsigned(RECORD, SubIndex(sub)));
    assert_eq!(values, [Some(1), Some(1), Some(1)], "the read-only bit is passed over");
}

#[test]
fn only_pdo_objects_with_a_writable_count_are_counted_by_the_master() {
    let counted = |index, code, access| {
        let mut count = entry(0, DataType::UNSIGNED8, 8, &[0]);
        count.access = access;
        object(ObjectIndex(index), code, vec![count]).is_counted_by_master()
    };
    assert!(counted(0x1C12, ObjectCode::Array, RW));
    assert!(counted(0x1A01, ObjectCode::Record, AccessRights::READ | AccessRights::WRITE_PRE_OP));
    assert!(!counted(0x1A00, ObjectCode::Record, AccessRights::READ));
    assert!(!counted(0x1C32, ObjectCode::Record, RW));
    assert!(!counted(0x2000, ObjectCode::Array, RW));
}
