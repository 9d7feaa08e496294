//! Properties of any bytes, any length, any mailbox, any object.

use std::sync::Arc;

use mailbox::AbortProfile;
use objects::{Dictionary, Entry, Object, ObjectCode, ObjectTable};
use proptest::prelude::*;
use wire::{AlState, DataType, MailboxHeader, MailboxType, SdoTarget};

use crate::bench::{Bench, LONG_BYTES, RO, RW, entry, object};

fn states() -> impl Strategy<Value = AlState> {
    prop::sample::select(vec![AlState::Init, AlState::PreOp, AlState::Boot, AlState::SafeOp, AlState::Op])
}

/// Bytes similar enough to a request to reach every branch.
fn requests() -> impl Strategy<Value = Vec<u8>> {
    let indexes = vec![0x1000_u16, 0x1008, 0x1018, 0x1601, 0x1C12, 0x1C13, 0x2000, 0x2003, 0x3001, 0x9999];
    let near = (
        prop::sample::select(vec![0x20_u8, 0x80, 0x30]),
        any::<u8>(),
        prop::sample::select(indexes),
        prop_oneof![0_u8..8, any::<u8>()],
        prop::collection::vec(any::<u8>(), 0..60),
        any::<u8>(),
    );
    let near = near.prop_map(|(service, command, index, sub, data, kind)| {
        let [index_0, index_1] = index.to_le_bytes();
        let body = [&[0, service, command, index_0, index_1, sub][..], &data].concat();
        [&[body.len() as u8, 0, 0, 0, 0, kind & 0x70 | 3][..], &body].concat()
    });
    prop_oneof![3 => near, 1 => prop::collection::vec(any::<u8>(), 0..420)]
}

fn assert_well_formed(message: &[u8], mailbox_bytes: u16) {
    let header = MailboxHeader::parse(message).unwrap();
    assert!(message.len() <= usize::from(mailbox_bytes));
    assert_eq!(usize::from(header.length_bytes) + MailboxHeader::LENGTH_BYTES, message.len());
    assert!((1..=7).contains(&header.counter));
    assert!(matches!(header.mailbox_type, MailboxType::Coe | MailboxType::Error));
}

proptest! {
    #[test]
    fn any_octets_get_a_well_formed_reply_or_none(
        requests in prop::collection::vec((states(), requests()), 1..40),
        mailbox_bytes in 34_u16..=1486,
    ) {
        let mut bench = Bench::with_mailbox(mailbox_bytes, AbortProfile::CIA_301);
        for (state, request) in requests {
            bench.state = state;
            if let Some(reply) = bench.raw(&request) {
                assert_well_formed(&reply, mailbox_bytes);
            }
            if let Some(message) = bench.unsolicited() {
                assert_well_formed(&message, mailbox_bytes);
            }
        }
        bench.state = AlState::PreOp;
        prop_assert_eq!(bench.upload(SdoTarget::entry(0x1018, 1)), Ok(vec![0x83, 0, 0, 0]));
    }

    #[test]
    fn values_of_any_length_round_trip_through_any_mailbox(
        value in prop::collection::vec(any::<u8>(), 1..LONG_BYTES),
        mailbox_bytes in 34_u16..=1486,
    ) {
        let mut kept = entry(0, DataType::OCTET_STRING, (value.len() * 8) as u16, RW, 0);
        kept.default = vec![0; value.len()];
        let table = ObjectTable::new(vec![object(0x3000, ObjectCode::Variable, true, vec![kept])]);
        let objects = Dictionary::new(Arc::new(table));
        let mut bench = Bench::with_objects(objects, mailbox_bytes, AbortProfile::CIA_301);
        for target in [SdoTarget::entry(0x3000, 0), SdoTarget::complete(0x3000, 0)] {
            prop_assert_eq!(bench.download(target, &value), Ok(()));
            prop_assert_eq!(bench.upload(target), Ok(value.clone()));
        }
    }

    #[test]
    fn complete_access_equals_the_concatenation_of_the_entries(
        object in records(), first in 0_u8..=1, mailbox_bytes in 34_u16..=400,
    ) {
        let expected = concatenation(&object, first);
        let objects = Dictionary::new(Arc::new(ObjectTable::new(vec![object])));
        let mut bench = Bench::with_objects(objects, mailbox_bytes, AbortProfile::CIA_301);
        prop_assert_eq!(bench.upload(SdoTarget::complete(0x2000, first)), Ok(expected));
    }

    #[test]
    fn a_complete_download_reads_back(object in records(), seed: u64) {
        let mut value = concatenation(&object, 0);
        for (at, octet) in value.iter_mut().enumerate().skip(2) {
            *octet = (seed >> (at % 57)) as u8;
        }
        let objects = Dictionary::new(Arc::new(ObjectTable::new(vec![object.clone()])));
        let mut bench = Bench::with_objects(objects, 400, AbortProfile::CIA_301);
        prop_assert_eq!(bench.download(SdoTarget::complete(0x2000, 0), &value), Ok(()));
        let again = bench.upload(SdoTarget::complete(0x2000, 0)).unwrap();
        for entry in object.entries.iter().skip(1) {
            let single = bench.upload(SdoTarget::entry(0x2000, entry.sub.0)).unwrap();
            prop_assert_eq!(single.len(), entry.size_bytes());
        }
        // A second round changes nothing more: only padding may have been lost.
        prop_assert_eq!(bench.download(SdoTarget::complete(0x2000, 0), &again), Ok(()));
        prop_assert_eq!(bench.upload(SdoTarget::complete(0x2000, 0)), Ok(again));
    }
}

/// Records of bits and bytes in any order, with gaps.
fn records() -> impl Strategy<Value = Object> {
    let kinds = vec![
        (DataType::BOOLEAN, 1_u16),
        (DataType(0x0031), 2),
        (DataType(0x0037), 8),
        (DataType::UNSIGNED8, 8),
        (DataType::UNSIGNED16, 16),
        (DataType::UNSIGNED64, 64),
        (DataType::OCTET_STRING, 96),
    ];
    let entries = prop::collection::btree_map(1_u8..40, (prop::sample::select(kinds), any::<u64>()), 1..20);
    entries.prop_map(|entries| {
        let mut all = vec![entry(0, DataType::UNSIGNED8, 8, RO, 40)];
        all.extend(entries.into_iter().map(|(sub, ((data_type, bits), value))| {
            let value = if bits < 64 { value % (1 << bits) } else { value };
            entry(sub, data_type, bits, RW, value)
        }));
        object(0x2000, ObjectCode::Record, true, all)
    })
}

/// The model: one bit after the other, and whole bytes for a type that is not a bit type.
fn concatenation(object: &Object, first: u8) -> Vec<u8> {
    let bits_of = |entry: &Entry| {
        let octets = entry.default.iter();
        let bits = octets.flat_map(|octet| (0..8).map(move |bit| octet >> bit & 1 == 1));
        bits.take(usize::from(entry.bit_length)).collect::<Vec<bool>>()
    };
    let mut bits = Vec::new();
    for entry in object.entries.iter().filter(|entry| entry.sub.0 >= first) {
        let bit_type = [1, 0x31, 0x37].contains(&entry.data_type.0);
        while !bit_type && bits.len() % 8 != 0 {
            bits.push(false);
        }
        bits.extend(bits_of(entry));
        if entry.sub.0 == 0 {
            bits.extend([false; 8]);
        }
    }
    let octet = |bits: &[bool]| bits.iter().rev().fold(0, |octet, &bit| octet << 1 | u8::from(bit));
    bits.chunks(8).map(octet).collect()
}
