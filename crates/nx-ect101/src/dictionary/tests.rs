//! Every object over SDO, as a master uses it: the values read, and the refusals.

mod information;

use mailbox::{AbortProfile, Mailbox, MailboxSizes};
use objects::AccessRights;

use super::*;

const UNSUPPORTED: SdoAbort = SdoAbort::UNSUPPORTED_ACCESS;

/// The objects of a unit with a mailbox, and the master's side of it.
struct Bench {
    objects: UnitObjects,
    mailbox: Mailbox,
}

impl Bench {
    fn with_switch(switch: u8) -> Self {
        let identification = Identification::at_power_on(switch, 0);
        let objects = UnitObjects::start(7, identification, Duration::from_millis(1), Diagnosis::default());
        let sizes = MailboxSizes { receive_bytes: 400, send_bytes: 400 };
        let mailbox = Mailbox::new(sizes, AbortProfile::COARSE, objects.table());
        Self { objects, mailbox }.in_state(AlState::PreOp)
    }

    fn in_pre_op() -> Self {
        Self::with_switch(0)
    }

    fn in_state(mut self, state: AlState) -> Self {
        self.objects.state = state;
        self
    }

    /// The SDO response: command, then the bytes after index and subindex.
    fn exchange(&mut self, command: u8, index: u16, sub: u8, tail: &[u8]) -> Result<(u8, Vec<u8>), SdoAbort> {
        let mut request = vec![10 + tail.len() as u8 - 4, 0, 0, 0, 0, 0x03, 0x00, 0x20, command];
        request.extend(index.to_le_bytes());
        request.push(sub);
        request.extend(tail);
        let mut reply = [0; 400];
        let state = self.objects.state;
        let length_bytes =
            self.mailbox.request(&request, state, &mut self.objects, &mut reply).expect("a reply");
        let tail = reply[12..length_bytes].to_vec();
        match reply[8] {
            0x80 => Err(SdoAbort(little_endian(&tail))),
            command => Ok((command, tail)),
        }
    }

    fn upload(&mut self, index: u16, sub: u8) -> Result<Vec<u8>, SdoAbort> {
        self.upload_by(0x40, index, sub)
    }

    fn upload_complete(&mut self, index: u16) -> Result<Vec<u8>, SdoAbort> {
        self.upload_by(0x50, index, 0)
    }

    fn upload_by(&mut self, command: u8, index: u16, sub: u8) -> Result<Vec<u8>, SdoAbort> {
        let (command, tail) = self.exchange(command, index, sub, &[0; 4])?;
        let expedited = command & 0x02 != 0;
        Ok(if expedited { tail[..4 - usize::from(command >> 2 & 3)].to_vec() } else { tail[4..].to_vec() })
    }

    fn download(&mut self, index: u16, sub: u8, value: &[u8]) -> Result<(), SdoAbort> {
        self.download_by(0x21, index, sub, value)
    }

    fn download_complete(&mut self, index: u16, value: &[u8]) -> Result<(), SdoAbort> {
        self.download_by(0x31, index, 0, value)
    }

    fn download_by(&mut self, command: u8, index: u16, sub: u8, value: &[u8]) -> Result<(), SdoAbort> {
        let mut tail = (value.len() as u32).to_le_bytes().to_vec();
        tail.extend(value);
        self.exchange(command, index, sub, &tail).map(drop)
    }
}

fn little_endian(octets: &[u8]) -> u32 {
    u32::from_le_bytes(octets[..4].try_into().expect("four octets"))
}

/// Every entry of the table, as index and subindex.
fn entries() -> impl Iterator<Item = (u16, objects::Entry)> {
    let all: Vec<_> = object_table()
        .iter()
        .flat_map(|object| object.entries.iter().map(|entry| (object.index.0, entry.clone())))
        .collect();
    all.into_iter()
}

#[test]
fn every_object_reads_its_default_in_pre_op_or_not_at_all() {
    let mut bench = Bench::in_pre_op();
    for (index, entry) in entries() {
        let expected = match (index, entry.sub.0) {
            (0x1018, 4) => Ok(vec![7, 0, 0, 0]),
            _ if index >= 0x6000 => Err(SdoAbort::DEVICE_STATE),
            _ => Ok(entry.default),
        };
        assert_eq!(bench.upload(index, entry.sub.0), expected, "{index:04X}:{}", entry.sub);
    }
}

#[test]
fn what_is_read_only_refuses_every_write_in_every_state() {
    for state in [AlState::PreOp, AlState::SafeOp, AlState::Op] {
        let mut bench = Bench::in_pre_op().in_state(state);
        for (index, entry) in entries().filter(|(_, entry)| !entry.access.intersects(AccessRights::WRITE)) {
            let refused = bench.download(index, entry.sub.0, &entry.default);
            assert_eq!(refused, Err(SdoAbort::READ_ONLY), "{state} {index:04X}:{}", entry.sub);
        }
    }
}

#[test]
fn a_value_of_another_length_is_refused() {
    let mut bench = Bench::in_pre_op();
    for (index, entry) in entries().filter(|(_, entry)| entry.access.contains(AccessRights::WRITE_PRE_OP)) {
        let mut value = entry.default.clone();
        value.push(0);
        for value in [&value[..], &value[2..]] {
            let refused = bench.download(index, entry.sub.0, value);
            assert_eq!(refused, Err(SdoAbort::LENGTH_MISMATCH), "{index:04X}:{}", entry.sub);
        }
    }
}

#[test]
fn what_does_not_exist_is_refused() {
    let mut bench = Bench::in_pre_op();
    for index in [0x1001, 0x1600, 0x1604, 0x1A04, 0x1C14, 0x2001, 0x6004, 0x7003] {
        assert_eq!(bench.upload(index, 0), Err(SdoAbort::OBJECT_DOES_NOT_EXIST), "{index:04X}");
    }
    for (index, sub) in [(0x10E0, 2), (0x1C32, 3), (0x1C33, 3), (0x1018, 5), (0x1000, 1), (0x1601, 41)] {
        assert_eq!(bench.upload(index, sub), Err(SdoAbort::SUBINDEX_DOES_NOT_EXIST), "{index:04X}:{sub}");
    }
}

#[test]
fn complete_access_is_for_those_objects_that_have_it() {
    let mut bench = Bench::in_pre_op();
    for object in object_table().iter() {
        let answer = bench.upload_complete(object.index.0);
        match object.complete_access {
            true => assert!(answer.is_ok(), "{}: {answer:?}", object.index),
            false => assert_eq!(answer, Err(UNSUPPORTED), "{}", object.index),
        }
    }
    assert_eq!(bench.upload_complete(0x1C00), Ok(vec![4, 0, 1, 2, 3, 4]));
}

#[test]
fn mapping_is_written_in_pre_op_only() {
    for state in [AlState::SafeOp, AlState::Op] {
        let mut bench = Bench::in_pre_op().in_state(state);
        for index in [0x1601, 0x1602, 0x1603, 0x1A01, 0x1A02, 0x1A03, 0x1C12, 0x1C13] {
            assert_eq!(bench.download(index, 0, &[0]), Err(SdoAbort::DEVICE_STATE), "{state} {index:04X}");
        }
    }
}

#[test]
fn complete_access_sets_an_assignment_at_once() {
    let mut bench = Bench::in_pre_op();
    bench.download_complete(0x1C12, &[2, 0, 0x01, 0x16, 0x03, 0x16]).expect("both exist");
    assert_eq!(bench.upload_complete(0x1C12), Ok(vec![2, 0, 0x01, 0x16, 0x03, 0x16]));
}

#[test]
fn a_refused_complete_access_changes_nothing() {
    let mut bench = Bench::in_pre_op();
    let no_pdo = [2, 0, 0x02, 0x16, 0x18, 0x10];
    assert_eq!(bench.download_complete(0x1C12, &no_pdo), Err(SdoAbort::NOT_MAPPABLE));
    assert_eq!(bench.upload_complete(0x1C12), Ok(vec![1, 0, 0x01, 0x16]));
    assert_eq!(bench.upload(0x1C12, 2), Ok(vec![0, 0]));
}

#[test]
fn a_fixed_mapping_refuses_complete_access() {
    let mut bench = Bench::in_pre_op();
    for index in [0x1A00, 0x1BFE, 0x1BFF] {
        assert_eq!(bench.download_complete(index, &[0, 0]), Err(SdoAbort::READ_ONLY), "{index:04X}");
    }
}

#[test]
fn values_outside_their_range_are_refused() {
    let mut bench = Bench::in_pre_op();
    let cases: [(u16, u8, &[u8]); 7] = [
        (0x1C32, 1, &[1, 0]),
        (0x1C33, 1, &[0x22, 0]),
        (0x2002, 2, &[0]),
        (0x2002, 2, &[2]),
        (0x2100, 0, b"clel"),
        (0x10F3, 3, &[6]),
        (0x10F3, 5, &[2, 0]),
    ];
    for (index, sub, value) in cases {
        assert_eq!(bench.download(index, sub, value), Err(SdoAbort::VALUE_OUT_OF_RANGE), "{index:04X}:{sub}");
    }
}

#[test]
fn commands_are_taken_and_read_0() {
    let mut bench = Bench::in_pre_op();
    assert_eq!(bench.download(0x2002, 2, &[1]), Ok(()));
    assert_eq!(bench.download(0x2100, 0, b"elcl"), Ok(()));
    assert_eq!(bench.download(0x10F3, 3, &[0]), Ok(()));
    assert_eq!(bench.upload(0x2002, 2), Ok(vec![0]));
    assert_eq!(bench.upload(0x2100, 0), Ok(vec![0; 4]));
}

#[test]
fn settings_are_kept() {
    let mut bench = Bench::in_pre_op();
    bench.download(0x10F3, 5, &[1, 0]).expect("in range");
    bench.download(0x3001, 1, &[0x5A; 200]).expect("200 bytes");
    assert_eq!(bench.upload(0x10F3, 5), Ok(vec![1, 0]));
    assert_eq!(bench.upload(0x3001, 1), Ok(vec![0x5A; 200]));
}

#[test]
fn the_device_id_follows_switch_and_software() {
    let mut by_software = Bench::with_switch(0);
    assert_eq!(by_software.download(0x10E0, 1, &[0x2C, 0x01]), Ok(()));
    assert_eq!(by_software.upload(0x10E0, 1), Ok(vec![0x2C, 0x01]));
    assert_eq!(by_software.download(0x10E0, 3, &[0, 0]), Err(SdoAbort::LOCAL_CONTROL));
    assert_eq!(by_software.objects.identification.station_alias(), Some(300));

    let mut by_switch = Bench::with_switch(0x21);
    assert_eq!(by_switch.download(0x10E0, 1, &[0x2C, 0x01]), Err(SdoAbort::LOCAL_CONTROL));
    assert_eq!(by_switch.upload(0x10E0, 1), Ok(vec![0x21, 0]));
    assert_eq!(by_switch.download(0x10E0, 3, &[0, 0]), Ok(()));
    assert_eq!(by_switch.upload(0x10E0, 3), Ok(vec![0x21, 0]));
}

#[test]
fn process_data_is_read_by_sdo_when_no_pdo_carries_it() {
    let mut bench = Bench::in_pre_op().in_state(AlState::SafeOp);
    for (index, sub) in [(0x6000, 1), (0x6000, 6), (0x7000, 6), (0x6003, 5)] {
        assert_eq!(bench.upload(index, sub), Err(SdoAbort::LOCAL_CONTROL), "{index:04X}:{sub}");
    }
    assert_eq!(bench.upload(0x6000, 7), Ok(vec![0; 30]));
    assert_eq!(bench.upload(0x6001, 1), Ok(vec![0; 10]));
    assert_eq!(bench.upload(0x7000, 0), Ok(vec![0x28]), "subindex 0 is never mapped");
    assert_eq!(bench.upload(0x6003, 0), Ok(vec![5]));
}

#[test]
fn outputs_are_written_by_sdo_in_op_when_no_pdo_carries_them() {
    let mut bench = Bench::in_pre_op();
    assert_eq!(bench.download(0x7000, 7, &[1; 30]), Err(SdoAbort::DEVICE_STATE));
    bench.objects.state = AlState::SafeOp;
    assert_eq!(bench.download(0x7000, 7, &[1; 30]), Err(SdoAbort::DEVICE_STATE));
    bench.objects.state = AlState::Op;
    assert_eq!(bench.download(0x7000, 7, &[1; 30]), Ok(()));
    assert_eq!(bench.upload(0x7000, 7), Ok(vec![1; 30]));
    assert_eq!(bench.download(0x7000, 6, &[1; 30]), Err(SdoAbort::LOCAL_CONTROL));
}

#[test]
fn the_cycle_time_is_told_while_the_timer_runs() {
    let mut bench = Bench::in_pre_op();
    assert_eq!(bench.upload(0x1C32, 2), Ok(vec![0; 4]));
    bench.objects.state = AlState::SafeOp;
    assert_eq!(bench.upload(0x1C32, 2), Ok(1_000_000_u32.to_le_bytes().to_vec()));
    assert_eq!(bench.upload(0x1C33, 2), Ok(1_000_000_u32.to_le_bytes().to_vec()));
}
