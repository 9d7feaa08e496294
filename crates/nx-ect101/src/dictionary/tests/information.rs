//! SDO information over the whole dictionary.

use mailbox::{AbortProfile, Mailbox, MailboxSizes};
use wire::{EntryDescription, SdoInfoOpcode};

use super::*;

/// Default, minimum, maximum, and the bits of the access word.
const EVERYTHING: u8 = 0x77;

struct Bench {
    objects: UnitObjects,
    mailbox: Mailbox,
}

impl Bench {
    fn new() -> Self {
        let identification = Identification::at_power_on(1, 0);
        let objects = UnitObjects::start(7, identification, Duration::from_millis(1), Diagnosis::default());
        let sizes = MailboxSizes { receive_bytes: 400, send_bytes: 400 };
        let mailbox = Mailbox::new(sizes, AbortProfile::COARSE, objects.table());
        Self { objects, mailbox }
    }

    /// Opcode and data of the answer to an entry description request.
    fn describe(&mut self, index: ObjectIndex, sub: u8) -> (u8, Vec<u8>) {
        let [low, high] = index.0.to_le_bytes();
        let request = [10, 0, 0, 0, 0, 0x03, 0x00, 0x80, 5, 0, 0, 0, low, high, sub, EVERYTHING];
        let mut reply = [0; 400];
        let length_bytes =
            self.mailbox.request(&request, AlState::PreOp, &mut self.objects, &mut reply).expect("an answer");
        (reply[8] & 0x7F, reply[12..length_bytes].to_vec())
    }
}

#[test]
fn every_subindex_up_to_the_highest_describes_itself_and_none_beyond() {
    let mut bench = Bench::new();
    let table = crate::tables::object_table();
    let mut gaps = Vec::new();
    for object in table.iter() {
        for sub in 0..=object.max_sub().0 {
            let (opcode, data) = bench.describe(object.index, sub);
            assert_eq!(opcode, SdoInfoOpcode::EntryResponse.bits(), "{}:{sub:02X}", object.index);
            let described = EntryDescription::parse(&data).expect("a description");
            if object.entry(SubIndex(sub)).is_none() {
                assert_eq!((described.data_type.0, described.bit_length, described.access), (0, 0, 0));
                assert_eq!((described.values, described.name), (&[][..], &[][..]));
                gaps.push((object.index.0, sub));
            }
        }
        let (opcode, data) = bench.describe(object.index, object.max_sub().0 + 1);
        assert_eq!((opcode, data), (SdoInfoOpcode::Error.bits(), 0x0609_0011_u32.to_le_bytes().to_vec()));
    }
    assert_eq!(gaps, [(0x10E0, 2), (0x1C32, 3), (0x1C33, 3)]);
}

/// Masters show a default outside the limits as a fault of the device.
#[test]
fn no_default_is_outside_its_own_limits() {
    let mut bench = Bench::new();
    let table = crate::tables::object_table();
    for (object, entry) in
        table.iter().flat_map(|object| object.entries.iter().map(move |entry| (object, entry)))
    {
        let (_, data) = bench.describe(object.index, entry.sub.0);
        let described = EntryDescription::parse(&data).expect("a description");
        let limits = described.value_info.bits() & 0x60;
        if limits == 0 {
            continue;
        }
        assert_eq!(
            (limits, described.value_info.bits() & 0x10),
            (0x60, 0x10),
            "{}:{}",
            object.index,
            entry.sub
        );
        let numbers = described.values.chunks(entry.size_bytes()).map(|value| {
            let mut octets = [0; 8];
            octets[..value.len()].copy_from_slice(value);
            u64::from_le_bytes(octets)
        });
        let [default, minimum, maximum] = numbers.collect::<Vec<_>>()[..] else { panic!("three values") };
        assert!((minimum..=maximum).contains(&default), "{}:{}", object.index, entry.sub);
    }
}
