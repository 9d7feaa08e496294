//! SDO information.

use mailbox::AbortProfile;
use objects::{AccessRights, Entry, ObjectServer};
use wire::{
    AlState, CoeService, DataType, EntryDescription, MailboxErrorCode, ObjectDescription, ObjectIndex,
    SdoAbort, SdoInfoList, SdoInfoOpcode, SdoInfoRequest, SdoTarget, SubIndex, ValueInfo,
};

use crate::bench::{Bench, mailbox_error};

fn list(bench: &mut Bench, list: SdoInfoList) -> Vec<u16> {
    let (opcode, data) = bench.information(SdoInfoRequest::List(list));
    assert_eq!(opcode, SdoInfoOpcode::ListResponse);
    let words: Vec<u16> = data.chunks(2).map(|word| u16::from_le_bytes(word.try_into().unwrap())).collect();
    assert_eq!(words[0], list.bits());
    words[1..].to_vec()
}

/// C101
#[test]
fn list_lengths_are_the_lengths_of_the_lists() {
    for mailbox_bytes in [34, 400] {
        let mut bench = Bench::with_mailbox(mailbox_bytes, AbortProfile::CIA_301);
        let lengths = list(&mut bench, SdoInfoList::Lengths);
        let counted = SdoInfoList::LISTS.map(|kind| list(&mut bench, kind).len() as u16);
        assert_eq!(lengths, counted);
        assert_eq!(lengths, [13, 1, 1, 1, 1]);
    }
}

#[test]
fn lists_hold_what_their_access_words_say() {
    let mut bench = Bench::in_pre_op();
    let all = list(&mut bench, SdoInfoList::All);
    assert_eq!(all[..4], [0x1000, 0x1008, 0x1018, 0x1601]);
    assert_eq!(list(&mut bench, SdoInfoList::RxPdo), [0x7000]);
    assert_eq!(list(&mut bench, SdoInfoList::TxPdo), [0x2001]);
    assert_eq!(list(&mut bench, SdoInfoList::Backup), [0x2000]);
}

/// C102, C103
#[test]
fn every_listed_object_describes_itself_and_reads_with_its_size() {
    let mut bench = Bench::in_pre_op();
    bench.state = AlState::Op;
    for index in list(&mut bench, SdoInfoList::All).into_iter().map(ObjectIndex) {
        let (opcode, data) = bench.information(SdoInfoRequest::Object(index));
        assert_eq!(opcode, SdoInfoOpcode::ObjectResponse);
        let described = ObjectDescription::parse(&data).unwrap();
        let object = bench.objects.table().object(index).unwrap().clone();
        assert_eq!((described.object_code, described.data_type), (object.code.code(), object.data_type));
        assert_eq!((described.max_sub, described.name), (object.max_sub(), object.name.as_bytes()));
        for entry in &object.entries {
            describe_and_read(&mut bench, index, entry);
        }
    }
}

fn describe_and_read(bench: &mut Bench, index: ObjectIndex, entry: &Entry) {
    let request =
        SdoInfoRequest::Entry { index, sub: entry.sub, value_info: ValueInfo::from_bits_retain(0x07) };
    let (opcode, data) = bench.information(request);
    assert_eq!(opcode, SdoInfoOpcode::EntryResponse);
    let described = EntryDescription::parse(&data).unwrap();
    assert_eq!((described.index, described.sub), (index, entry.sub));
    assert_eq!((described.data_type, described.bit_length), (entry.data_type, entry.bit_length));
    assert_eq!((described.access, described.name), (entry.access.bits(), entry.name.as_bytes()));
    assert_eq!((described.value_info.bits(), described.values), (0x07, &[][..]));
    if entry.access.contains(AccessRights::READ_OP) {
        let value = bench.upload(SdoTarget::entry(index.0, entry.sub.0)).unwrap();
        assert_eq!(value.len(), usize::from(described.bit_length).div_ceil(8));
    }
}

/// Masters request every subindex up to the highest: one without an entry has no type, no bits, no access, no name.
#[test]
fn every_subindex_up_to_the_highest_has_a_description() {
    let mut bench = Bench::in_pre_op();
    let mut gaps = 0;
    let objects: Vec<_> = bench.objects.table().iter().cloned().collect();
    for object in &objects {
        let mut bits = 0;
        for sub in 0..=object.max_sub().0 {
            let request = SdoInfoRequest::Entry {
                index: object.index,
                sub: SubIndex(sub),
                value_info: ValueInfo::all(),
            };
            let (opcode, data) = bench.information(request);
            assert_eq!(opcode, SdoInfoOpcode::EntryResponse, "{}:{sub}", object.index);
            let described = EntryDescription::parse(&data).unwrap();
            assert_eq!((described.index, described.sub.0), (object.index, sub));
            let slot = object.layout(SubIndex(0)).find(|slot| slot.sub.0 == sub);
            if let Some(slot) = slot {
                assert!(slot.bit_offset >= bits, "complete access puts it behind what is described before");
                bits = slot.bit_offset + usize::from(described.bit_length);
            } else {
                let nothing = (DataType(0), 0, 0, &[][..], &[][..]);
                let EntryDescription { data_type, bit_length, access, values, name, .. } = described;
                assert_eq!((data_type, bit_length, access, values, name), nothing);
                assert_eq!(described.value_info.bits(), 0x07);
                let upload = bench.upload(SdoTarget::entry(object.index.0, sub));
                assert_eq!(upload, Err(SdoAbort::SUBINDEX_DOES_NOT_EXIST));
                gaps += 1;
            }
        }
        let beyond = SubIndex(object.max_sub().0 + 1);
        let request =
            SdoInfoRequest::Entry { index: object.index, sub: beyond, value_info: ValueInfo::all() };
        let (opcode, data) = bench.information(request);
        assert_eq!(
            (opcode, data),
            (SdoInfoOpcode::Error, SdoAbort::SUBINDEX_DOES_NOT_EXIST.0.to_le_bytes().to_vec())
        );
    }
    assert!(gaps > 0, "the dictionary of the bench has gaps");
}

#[test]
fn default_minimum_and_maximum_come_when_asked_for_and_known() {
    let mut bench = Bench::in_pre_op();
    let entry = |index, sub| SdoInfoRequest::Entry {
        index: ObjectIndex(index),
        sub: SubIndex(sub),
        value_info: ValueInfo::all(),
    };
    let (_, data) = bench.information(entry(0x2001, 0));
    let described = EntryDescription::parse(&data).unwrap();
    assert_eq!(described.value_info.bits(), 0x77, "no unit type");
    assert_eq!(described.values, [5, 0, 0, 0, 29, 0]);
    let (_, data) = bench.information(entry(0x1000, 0));
    let described = EntryDescription::parse(&data).unwrap();
    assert_eq!(described.value_info.bits(), 0x17, "no limits");
    assert_eq!(described.values, [0x89, 0x13, 0, 0]);
}

#[test]
fn a_description_is_cut_to_one_mailbox() {
    let mut bench = Bench::with_mailbox(34, AbortProfile::CIA_301);
    let value_info = ValueInfo::all();
    let request = SdoInfoRequest::Entry { index: ObjectIndex(0x1008), sub: SubIndex(0), value_info };
    let (_, data) = bench.information(request);
    let described = EntryDescription::parse(&data).unwrap();
    assert_eq!(
        (described.values, described.name),
        (&[][..], &b"SubIndex 000"[..]),
        "the default is too long"
    );
    let request = SdoInfoRequest::Entry { index: ObjectIndex(0x2001), sub: SubIndex(0), value_info };
    let (_, data) = bench.information(request);
    assert_eq!(EntryDescription::parse(&data).unwrap().name, b"SubInd");
}

#[test]
fn what_does_not_exist_is_refused_by_an_information_error() {
    let mut bench = Bench::in_pre_op();
    let value_info = ValueInfo::empty();
    for (request, code) in [
        (SdoInfoRequest::Object(ObjectIndex(0x9999)), SdoAbort::OBJECT_DOES_NOT_EXIST),
        (
            SdoInfoRequest::Entry { index: ObjectIndex(0x9999), sub: SubIndex(0), value_info },
            SdoAbort::OBJECT_DOES_NOT_EXIST,
        ),
        (
            SdoInfoRequest::Entry { index: ObjectIndex(0x1018), sub: SubIndex(5), value_info },
            SdoAbort::SUBINDEX_DOES_NOT_EXIST,
        ),
        (SdoInfoRequest::List(SdoInfoList::Other(6)), SdoAbort::UNSUPPORTED_ACCESS),
    ] {
        let (opcode, data) = bench.information(request);
        assert_eq!(opcode, SdoInfoOpcode::Error);
        assert_eq!(data, code.0.to_le_bytes());
    }
}

#[test]
fn an_unknown_opcode_is_refused_and_a_short_request_gets_error_6() {
    let mut bench = Bench::in_pre_op();
    let (_, data) = bench.coe(CoeService::SdoInformation, &[9, 0, 0, 0]).unwrap();
    assert_eq!(data, [7, 0, 0, 0, 0x00, 0x00, 0x01, 0x06]);
    let request = bench.pack_request(CoeService::SdoInformation, &[3, 0, 0, 0, 0]);
    assert_eq!(mailbox_error(&bench.raw(&request).unwrap()), MailboxErrorCode::SIZE_TOO_SHORT);
}

#[test]
fn an_sdo_between_two_fragments_is_answered_and_the_list_goes_on() {
    let mut bench = Bench::with_mailbox(34, AbortProfile::CIA_301);
    let (_, first) = bench.coe(CoeService::SdoInformation, &[1, 0, 0, 0, 1, 0]).unwrap();
    assert_eq!(first[..4], [0x82, 0, 1, 0], "a list of 13 takes two mailboxes of 34");
    assert!(bench.mailbox.has_unsolicited());
    assert!(bench.upload(SdoTarget::entry(0x1000, 0)).is_ok());
    assert!(bench.unsolicited().is_some());
    assert!(!bench.mailbox.has_unsolicited());
}
