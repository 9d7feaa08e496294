//! SDOs, SDO information, emergencies, and mailboxes that are handled incorrectly.

use master::{
    Connected, Event, Failure, Master, Message, Reading, Reply, SdoTransfer, Service, ServiceFailure,
};
use nx_ect101::{NxEct101, layout, object_table};
use time::Duration;
use wire::{
    AlState, Emergency, EntryDescription, MailboxErrorCode, MailboxType, ObjectDescription, ObjectIndex,
    SdoAbort, SdoInfoList, SdoInfoRequest, SdoTarget, SubIndex, ValueInfo,
};

use crate::bench::{Slaves, connected, connected_with};

/// The smallest mailbox of a unit.
const SMALL_BYTES: u16 = 34;

type Bench = Connected<Slaves<NxEct101>>;

fn in_pre_op(mut bench: Bench) -> Bench {
    bench.search().expect("slaves");
    bench.take_all_to(AlState::PreOp).expect("PRE-OP");
    bench
}

/// One unit with mailboxes of this length.
fn with_mailbox_bytes(length_bytes: u16) -> Bench {
    let mut bench = connected_with(Master::default(), 1, |_, config| {
        let mailbox = config.mailbox.as_mut().expect("a mailbox");
        mailbox.standard.receive.length_bytes = length_bytes;
        mailbox.standard.send.length_bytes = length_bytes;
    });
    bench.search().expect("one slave");
    let mailbox = bench.master.settings_mut(0).expect("a slave").mailbox.as_mut().expect("a mailbox");
    (mailbox.out.length_bytes, mailbox.inward.length_bytes) = (length_bytes, length_bytes);
    bench.take_to(0, AlState::PreOp).expect("PRE-OP");
    bench
}

fn failed<T>(failure: ServiceFailure) -> Result<T, Failure> {
    Err(Failure::Mailbox(failure))
}

const DEVICE_NAME: SdoTarget = SdoTarget::entry(0x1008, 0);
const IDENTITY: SdoTarget = SdoTarget::complete(0x1018, 0);
/// Subindex 0 and six entries of four bytes.
const MAPPING: SdoTarget = SdoTarget::complete(0x1601, 0);
const MAPPING_BYTES: usize = 2 + 6 * 4;

#[test]
fn values_are_read_expedited_normal_and_in_segments() {
    for length_bytes in [SMALL_BYTES, 40, layout::MAILBOX_BYTES] {
        let mut bench = with_mailbox_bytes(length_bytes);
        assert_eq!(bench.upload(0, SdoTarget::entry(0x1018, 1)), Ok(vec![0x83, 0, 0, 0]));
        assert_eq!(bench.upload(0, SdoTarget::entry(0x1018, 0)), Ok(vec![4]));
        let name = bench.upload(0, DEVICE_NAME).expect("a name");
        assert!(name.starts_with(b"NX-ECT101"), "{name:?}");
        let identity = bench.upload(0, IDENTITY).expect("an identity");
        assert_eq!(identity[..10], [4, 0, 0x83, 0, 0, 0, 0x7C, 0x01, 0, 0]);
        assert_eq!(identity.len(), 18);
        let mapping = bench.upload(0, MAPPING).expect("a mapping");
        assert_eq!((mapping[0], mapping.len()), (6, MAPPING_BYTES));
        assert_eq!(mapping[2..6], [0xF0, 1, 0x00, 0x70], "7000:01, 240 bits");
    }
}

#[test]
fn values_are_written_expedited_normal_and_in_segments() {
    for length_bytes in [SMALL_BYTES, 40, layout::MAILBOX_BYTES] {
        let mut bench = with_mailbox_bytes(length_bytes);
        let flags = SdoTarget::entry(0x10F3, 5);
        assert_eq!(bench.download(0, flags, &[1, 0]), Ok(()));
        assert_eq!(bench.upload(0, flags), Ok(vec![1, 0]));
        let normal = Service::Sdo(SdoTransfer::download_normal(flags, &[0, 0]));
        assert_eq!(bench.service(0, normal), Ok(Vec::new()));
        assert_eq!(bench.upload(0, flags), Ok(vec![0, 0]));
        let mut mapping = bench.upload(0, MAPPING).expect("a mapping");
        mapping.copy_within(6..10, 2);
        mapping.truncate(2 + 5 * 4);
        mapping[0] = 5;
        assert_eq!(bench.download(0, MAPPING, &mapping), Ok(()));
        assert_eq!(bench.upload(0, MAPPING).map(|value| value[..mapping.len()].to_vec()), Ok(mapping));
    }
}

#[test]
fn a_refusal_comes_back_as_its_abort_code() {
    let mut bench = in_pre_op(connected(1));
    for (target, code) in [
        (SdoTarget::entry(0x4711, 0), SdoAbort::OBJECT_DOES_NOT_EXIST),
        (SdoTarget::entry(0x1018, 9), SdoAbort::SUBINDEX_DOES_NOT_EXIST),
    ] {
        assert_eq!(bench.upload(0, target), failed(ServiceFailure::Abort(code)));
    }
    let written = bench.download(0, SdoTarget::entry(0x1018, 1), &[1, 2, 3, 4]);
    assert_eq!(written, failed(ServiceFailure::Abort(SdoAbort::READ_ONLY)));
    assert_eq!(bench.upload(0, SdoTarget::entry(0x1018, 0)), Ok(vec![4]), "the next one works");
}

#[test]
fn the_whole_dictionary_is_described() {
    for length_bytes in [SMALL_BYTES + 40, layout::MAILBOX_BYTES] {
        let mut bench = with_mailbox_bytes(length_bytes);
        let table = object_table();
        let list = bench.information(0, SdoInfoRequest::List(SdoInfoList::All)).expect("a list");
        let indexes: Vec<u16> =
            list.chunks_exact(2).map(|word| u16::from_le_bytes([word[0], word[1]])).collect();
        assert_eq!(indexes, table.iter().map(|object| object.index.0).collect::<Vec<_>>());
        for object in table.iter() {
            let bytes = bench.information(0, SdoInfoRequest::Object(object.index)).expect("a description");
            let description = ObjectDescription::parse(&bytes).expect("well formed");
            assert_eq!((description.index, description.max_sub), (object.index, object.max_sub()));
            let value_info = ValueInfo::empty();
            let question = SdoInfoRequest::Entry { index: object.index, sub: SubIndex::ZERO, value_info };
            let bytes = bench.information(0, question).expect("a description");
            let description = EntryDescription::parse(&bytes).expect("well formed");
            let entry = object.entry(SubIndex::ZERO).expect("subindex 0");
            assert_eq!((description.data_type, description.bit_length), (entry.data_type, entry.bit_length));
        }
    }
    let mut bench = in_pre_op(connected(1));
    let refused = bench.information(0, SdoInfoRequest::Object(ObjectIndex(0x4711)));
    assert_eq!(refused, failed(ServiceFailure::Abort(SdoAbort::OBJECT_DOES_NOT_EXIST)));
}

/// The lists 1 to 5 and their lengths (list 0), in frames; list 5 has the setting parameters of the manual.
#[test]
fn each_list_of_objects_comes_over_the_wire() {
    let mut bench = in_pre_op(connected(1));
    let mut list = |kind| {
        let bytes = bench.information(0, SdoInfoRequest::List(kind)).expect("a list");
        bytes.chunks_exact(2).map(|word| u16::from_le_bytes([word[0], word[1]])).collect::<Vec<_>>()
    };
    let lists = SdoInfoList::LISTS.map(&mut list);
    assert_eq!(list(SdoInfoList::Lengths), lists.each_ref().map(|list| list.len() as u16));
    for (kind, indexes) in SdoInfoList::LISTS.into_iter().zip(&lists) {
        let table = object_table();
        let of_table = table.list(kind).expect("a list of indexes").map(|object| object.index.0);
        assert_eq!(*indexes, of_table.collect::<Vec<_>>(), "{kind:?}");
    }
    assert_eq!(list(SdoInfoList::Settings), [0x10F3], "10F3:05 is the only one");
}

#[test]
fn several_slaves_answer_at_the_same_time() {
    let mut bench = in_pre_op(connected(20));
    let before = bench.now();
    let requests: Vec<_> =
        (0..20).map(|slave| bench.master.upload(before, slave, SdoTarget::entry(0x1018, 2))).collect();
    for request in requests {
        let results = bench.complete(request);
        assert!(matches!(&results[..], [(_, Ok(master::Outcome::Data(data)))] if data[..2] == [0x7C, 0x01]));
    }
    assert!(bench.now().saturating_since(before) < Duration::from_millis(4), "each of them takes 2 ms");
}

#[test]
fn a_protocol_that_a_slave_does_not_speak_is_a_mailbox_error() {
    let mut bench = in_pre_op(connected(1));
    let message = Message::new(MailboxType::Foe, vec![1, 0, 0, 0, 0, 0, b'f'], Reply::Awaited);
    let refused = bench.service(0, Service::Message(message));
    assert_eq!(refused, failed(ServiceFailure::Mailbox(MailboxErrorCode::UNSUPPORTED_PROTOCOL)));
    // A CoE message with any content: an SDO upload, byte by byte.
    let upload = vec![0x00, 0x20, 0x40, 0x18, 0x10, 1, 0, 0, 0, 0];
    let reply = bench.service(0, Service::Message(Message::new(MailboxType::Coe, upload, Reply::Awaited)));
    assert_eq!(reply, Ok(vec![0x00, 0x30, 0x43, 0x18, 0x10, 1, 0x83, 0, 0, 0]));
}

fn emergency(code: u16) -> Emergency {
    Emergency { code, error_register: 1, manufacturer: [1, 2, 3, 4, 5] }
}

fn send_emergency(bench: &mut Bench, code: u16) {
    assert!(bench.line.network.device_mut(0).expect("a unit").queue_emergency(emergency(code)));
}

fn emergencies(bench: &mut Bench) -> Vec<Emergency> {
    let of = |event| match event {
        Event::Emergency { slave: 0, emergency } => Some(emergency),
        Event::Emergency { .. } | Event::Finished { .. } => None,
    };
    bench.take_events().into_iter().filter_map(of).collect()
}

#[test]
fn emergencies_come_between_request_and_response_and_unasked() {
    let mut bench = in_pre_op(connected(1));
    for code in [0xFF01, 0xFF02] {
        send_emergency(&mut bench, code);
    }
    assert_eq!(bench.upload(0, SdoTarget::entry(0x1018, 0)), Ok(vec![4]));
    bench.run_for(Duration::from_millis(50));
    send_emergency(&mut bench, 0xFF03);
    bench.run_for(Duration::from_millis(20));
    assert_eq!(emergencies(&mut bench), [0xFF01, 0xFF02, 0xFF03].map(emergency));
}

#[test]
fn a_master_that_reads_no_mailbox_gets_no_reply_until_it_does() {
    let mut bench = in_pre_op(connected(1));
    bench.master.change_mailbox(0, |conduct| conduct.reading = Reading::Never);
    assert_eq!(bench.upload(0, DEVICE_NAME), failed(ServiceFailure::NoReply));
    // The reply to the first one blocks the second one.
    bench.master.change_mailbox(0, |conduct| conduct.reading = Reading::Always);
    assert_eq!(bench.upload(0, SdoTarget::entry(0x1018, 0)), Ok(vec![4]));
}

/// C086, C087: a message with the counter of the one before it is the same message, one with counter 0 never is.
#[test]
fn a_counter_that_stands_still_loses_every_second_message() {
    let mut bench = in_pre_op(connected(1));
    bench.master.change_mailbox(0, |conduct| conduct.counter.fixed = Some(3));
    assert_eq!(bench.upload(0, SdoTarget::entry(0x1018, 0)), Ok(vec![4]));
    assert_eq!(bench.upload(0, SdoTarget::entry(0x1018, 0)), failed(ServiceFailure::NoReply));
    bench.master.change_mailbox(0, |conduct| conduct.counter.fixed = Some(0));
    for _ in 0..3 {
        assert_eq!(bench.upload(0, SdoTarget::entry(0x1018, 0)), Ok(vec![4]));
    }
}

#[test]
fn a_late_response_is_not_taken_for_that_of_the_next_request() {
    let mut bench = in_pre_op(connected(1));
    let answer_after = |bench: &mut Bench, ms| {
        bench.line.network.device_mut(0).expect("a unit").set_response_time(Duration::from_millis(ms));
    };
    answer_after(&mut bench, 2_050);
    assert_eq!(bench.upload(0, SdoTarget::entry(0x1018, 2)), failed(ServiceFailure::NoReply));
    answer_after(&mut bench, 2);
    assert_eq!(bench.upload(0, SdoTarget::entry(0x1018, 1)), Ok(vec![0x83, 0, 0, 0]));
    answer_after(&mut bench, 5_000);
    assert_eq!(bench.upload(0, SdoTarget::entry(0x1018, 2)), failed(ServiceFailure::NoReply));
    assert_eq!(bench.upload(0, SdoTarget::entry(0x1018, 1)), failed(ServiceFailure::NotTaken));
}
