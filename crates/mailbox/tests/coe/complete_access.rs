//! Complete access.

use std::sync::Arc;

use mailbox::AbortProfile;
use objects::{Dictionary, ObjectServer, ObjectTable};
use wire::{AlState, ObjectIndex, SdoAbort, SdoTarget, SubIndex};

use crate::bench::{Bench, LONG_BYTES};

/// C098
#[test]
fn subindex_0_takes_two_octets() {
    let mut bench = Bench::in_pre_op();
    let identity = bench.upload(SdoTarget::complete(0x1018, 0)).unwrap();
    let expected = [0x0000_0083_u32, 0x17C, 0x10000, 1].map(u32::to_le_bytes).concat();
    assert_eq!((&identity[..2], &identity[2..]), (&[4, 0][..], &expected[..]));
    assert_eq!(bench.upload(SdoTarget::complete(0x1018, 1)), Ok(expected));
}

/// C098, C105: what SOEM reads to determine the SyncManager types.
#[test]
fn sync_manager_types_come_as_soem_expects_them() {
    let mut bench = Bench::in_pre_op();
    assert_eq!(bench.upload(SdoTarget::complete(0x1C00, 0)), Ok(vec![4, 0, 1, 2, 3, 4]));
}

/// C099
#[test]
fn a_beginning_above_subindex_1_is_refused() {
    let mut bench = Bench::in_pre_op();
    let beyond = SdoAbort::SUBINDEX_DOES_NOT_EXIST;
    let rows = [2, 3, 4].map(|first| (first, SdoAbort::UNSUPPORTED_ACCESS));
    for (first, abort) in rows.into_iter().chain([(5, beyond), (255, beyond)]) {
        let target = SdoTarget::complete(0x1018, first);
        assert_eq!(bench.upload(target), Err(abort), "from subindex {first}");
        assert_eq!(bench.download(target, &[0; 4]), Err(abort), "from subindex {first}");
    }
}

#[test]
fn an_object_without_complete_access_says_so() {
    let mut bench = Bench::in_pre_op();
    let target = SdoTarget::complete(0x1000, 0);
    assert_eq!(bench.upload(target), Err(SdoAbort::COMPLETE_ACCESS_UNSUPPORTED));
    assert_eq!(bench.download(target, &[0; 4]), Err(SdoAbort::COMPLETE_ACCESS_UNSUPPORTED));
    assert_eq!(bench.upload(SdoTarget::complete(0x9999, 0)), Err(SdoAbort::OBJECT_DOES_NOT_EXIST));
    let from_1 = SdoTarget::complete(0x1000, 1);
    assert_eq!(bench.upload(from_1), Err(SdoAbort::SUBINDEX_DOES_NOT_EXIST));
    assert_eq!(bench.download(from_1, &[0; 4]), Err(SdoAbort::SUBINDEX_DOES_NOT_EXIST));
}

#[test]
fn a_variable_is_its_value_alone() {
    let mut bench = Bench::in_pre_op();
    assert_eq!(bench.upload(SdoTarget::complete(0x2003, 0)), Ok(vec![9, 0, 0, 0]));
    assert_eq!(bench.download(SdoTarget::complete(0x2003, 0), &[1, 2, 3, 4]), Ok(()));
    assert_eq!(bench.upload(SdoTarget::entry(0x2003, 0)), Ok(vec![1, 2, 3, 4]));
    assert_eq!(bench.upload(SdoTarget::complete(0x2003, 1)), Err(SdoAbort::SUBINDEX_DOES_NOT_EXIST));
}

#[test]
fn bits_share_an_octet_gaps_take_none_and_write_only_entries_are_0() {
    let mut bench = Bench::in_pre_op();
    let record = bench.upload(SdoTarget::complete(0x2000, 0)).unwrap();
    assert_eq!(record, [7, 0, 0x34, 0x12, 0b11, 7, 0, 0, 0, 0, 0x77]);
}

#[test]
fn a_download_passes_over_read_only_entries() {
    let mut bench = Bench::in_pre_op();
    let record = [9, 9, 0x78, 0x56, 0b00, 8, 0, 0, 0, 0x66, 0x99];
    assert_eq!(bench.download(SdoTarget::complete(0x2000, 0), &record), Ok(()));
    let record = bench.upload(SdoTarget::complete(0x2000, 0)).unwrap();
    assert_eq!(record, [7, 0, 0x78, 0x56, 0b10, 8, 0, 0, 0, 0, 0x99]);
    assert_eq!(bench.download(SdoTarget::complete(0x1018, 0), &[4, 0]), Err(SdoAbort::READ_ONLY));
}

/// C100
#[test]
fn a_shorter_download_leaves_the_rest_as_it_was() {
    let mut bench = Bench::in_pre_op();
    assert_eq!(bench.download(SdoTarget::complete(0x2000, 1), &[0x78, 0x56]), Ok(()));
    let record = bench.upload(SdoTarget::complete(0x2000, 1)).unwrap();
    assert_eq!(record, [0x78, 0x56, 0b11, 7, 0, 0, 0, 0, 0x77]);
}

/// C095
#[test]
fn a_longer_download_or_one_that_cuts_an_entry_is_refused() {
    let mut bench = Bench::in_pre_op();
    let target = SdoTarget::complete(0x2000, 1);
    assert_eq!(bench.download(target, &[0; 10]), Err(SdoAbort::LENGTH_TOO_HIGH));
    assert_eq!(bench.download(target, &[0; 5]), Err(SdoAbort::LENGTH_TOO_LOW));
    assert_eq!(bench.upload(target).unwrap()[0], 0x34);
}

#[test]
fn a_value_outside_the_limits_refuses_all_of_it() {
    let mut bench = Bench::in_pre_op();
    let target = SdoTarget::complete(0x2000, 1);
    let before = bench.upload(target);
    assert_eq!(bench.download(target, &[0, 0, 0, 101, 0, 0, 0]), Err(SdoAbort::VALUE_OUT_OF_RANGE));
    assert_eq!(bench.upload(target), before);
}

#[test]
fn an_object_longer_than_the_mailbox_comes_in_segments() {
    for mailbox_bytes in [34, 35, 128, 400, 1486] {
        let mut bench = Bench::with_mailbox(mailbox_bytes, AbortProfile::CIA_301);
        let octets: Vec<u8> = (0..LONG_BYTES + 2).map(|at| at as u8).collect();
        assert_eq!(bench.download(SdoTarget::complete(0x3001, 0), &octets), Ok(()));
        let read = bench.upload(SdoTarget::complete(0x3001, 0)).unwrap();
        assert_eq!((&read[..2], &read[2..]), (&[1, 0][..], &octets[2..]));
    }
}

/// C107: what TwinCAT sends to assign three TxPDOs.
#[test]
fn an_assignment_is_as_long_as_its_subindex_0() {
    let mut bench = Bench::in_pre_op();
    let target = SdoTarget::complete(0x1C13, 0);
    let assigned = [0x03, 0x00, 0x00, 0x1A, 0x01, 0x1A, 0xFE, 0x1B];
    assert_eq!(bench.upload(target), Ok(assigned.to_vec()));
    assert_eq!(bench.download(target, &[2, 0, 0x00, 0x1A, 0x02, 0x1A]), Ok(()));
    assert_eq!(bench.upload(target), Ok(vec![2, 0, 0x00, 0x1A, 0x02, 0x1A]));
    assert_eq!(bench.upload(SdoTarget::complete(0x1C13, 1)), Ok(vec![0x00, 0x1A, 0x02, 0x1A]));
    assert_eq!(bench.download(target, &assigned), Ok(()));
    assert_eq!(bench.upload(target), Ok(assigned.to_vec()));
}

/// C107
#[test]
fn an_assignment_may_be_emptied_or_sent_with_its_unused_entries() {
    let mut bench = Bench::in_pre_op();
    let target = SdoTarget::complete(0x1C12, 0);
    assert_eq!(bench.download(target, &[0]), Ok(()));
    assert_eq!(bench.upload(target), Ok(vec![0, 0]));
    assert_eq!(bench.upload(SdoTarget::complete(0x1C12, 1)), Ok(vec![]));
    assert_eq!(bench.download(target, &[1, 0, 0x02, 0x16, 0, 0, 0, 0]), Ok(()));
    assert_eq!(bench.upload(target), Ok(vec![1, 0, 0x02, 0x16]));
    assert_eq!(bench.download(target, &[2, 0, 0x02, 0x16]), Err(SdoAbort::LENGTH_TOO_LOW));
    assert_eq!(bench.upload(target), Ok(vec![1, 0, 0x02, 0x16]));
}

/// C107
#[test]
fn a_download_from_subindex_1_keeps_the_number_of_entries() {
    let mut bench = Bench::in_pre_op();
    assert_eq!(bench.download(SdoTarget::complete(0x1C13, 1), &[0x00, 0x1A, 0x02, 0x1A]), Ok(()));
    let expected = vec![0x03, 0x00, 0x00, 0x1A, 0x02, 0x1A, 0xFE, 0x1B];
    assert_eq!(bench.upload(SdoTarget::complete(0x1C13, 0)), Ok(expected));
}

/// C107
#[test]
fn outside_pre_op_an_assignment_is_readable_only() {
    let mut bench = Bench::in_pre_op();
    bench.state = AlState::Op;
    let target = SdoTarget::complete(0x1C13, 0);
    let before = bench.upload(target).unwrap();
    assert_eq!(bench.download(target, &before), Err(SdoAbort::DEVICE_STATE));
}

/// A dictionary that refuses one value, whichever entry is written, and entries while subindex 0 is not 0.
struct Choosy {
    dictionary: Dictionary,
    refused: Vec<u8>,
}

impl ObjectServer for Choosy {
    fn table(&self) -> &ObjectTable {
        self.dictionary.table()
    }

    fn read(&mut self, index: ObjectIndex, sub: SubIndex, value: &mut [u8]) -> Result<(), SdoAbort> {
        self.dictionary.read(index, sub, value)
    }

    fn write(&mut self, index: ObjectIndex, sub: SubIndex, value: &[u8]) -> Result<(), SdoAbort> {
        let counted = self.dictionary.shared_table().object(index).unwrap().is_counted_by_master();
        if counted && sub > SubIndex::ZERO && self.dictionary.unsigned(index, SubIndex::ZERO) != Some(0) {
            return Err(SdoAbort::SUBINDEX_ZERO_NOT_CLEARED);
        }
        if value == self.refused {
            return Err(SdoAbort::NOT_MAPPABLE);
        }
        self.dictionary.write(index, sub, value)
    }
}

fn choosy(refused: &[u8]) -> Bench<Choosy> {
    let table = Arc::clone(Bench::in_pre_op().objects.shared_table());
    let objects = Choosy { dictionary: Dictionary::new(table), refused: refused.to_vec() };
    Bench::with_objects(objects, 400, AbortProfile::CIA_301)
}

#[test]
fn a_refused_entry_leaves_everything_as_it_was() {
    let target = SdoTarget::complete(0x1C13, 0);
    let download = [2, 0, 0x02, 0x1A, 0x34, 0x12];
    // Refused are the second entry and the new number of entries.
    for refused in [&[0x34, 0x12][..], &[2]] {
        let mut bench = choosy(refused);
        let before = bench.upload(target).unwrap();
        assert_eq!(bench.download(target, &download), Err(SdoAbort::NOT_MAPPABLE));
        assert_eq!(bench.upload(target), Ok(before));
    }
}

#[test]
fn a_refused_entry_of_a_record_leaves_its_bits_too() {
    let target = SdoTarget::complete(0x2000, 1);
    let mut bench = choosy(&[0x55]);
    let before = bench.upload(target).unwrap();
    assert_eq!(bench.download(target, &[1, 2, 0, 9, 0, 0, 0, 0, 0x55]), Err(SdoAbort::NOT_MAPPABLE));
    assert_eq!(bench.upload(target), Ok(before));
}
