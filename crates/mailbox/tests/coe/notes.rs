//! What an observer of a mailbox is told: each message, each SDO with its end, each emergency.

use mailbox::{MailboxNote, MessageContent, SdoDirection, SdoEnd, SdoNote};
use wire::{CoeService, Emergency, MailboxErrorCode, SdoAbort, SdoRequest, SdoTarget, SubIndex};

use crate::bench::{Bench, LONG_BYTES, TEXT_BYTES};

const LONG: SdoTarget = SdoTarget::entry(0x3001, 1);

fn notes(bench: &mut Bench) -> Vec<MailboxNote> {
    core::iter::from_fn(|| bench.mailbox.take_note()).collect()
}

/// Direction, object, length, first bytes, end.
type Sdo = (Option<SdoDirection>, SdoTarget, u32, Vec<u8>, SdoEnd);

/// The SDOs among them.
fn sdos(bench: &mut Bench) -> Vec<Sdo> {
    let sdo = |note| match note {
        MailboxNote::Sdo(SdoNote { direction, target, value, end }) => {
            Some((direction, target, value.length_bytes, value.head().to_vec(), end))
        }
        _ => None,
    };
    notes(bench).into_iter().filter_map(sdo).collect()
}

#[test]
fn an_sdo_is_one_note_however_many_messages_it_has() {
    let mut bench = Bench::with_mailbox(64, mailbox::AbortProfile::CIA_301);
    let value: Vec<u8> = (0..LONG_BYTES).map(|at| at as u8).collect();
    let mut seen = Vec::new();
    bench.download(LONG, &value[..10]).unwrap_err();
    seen.extend(sdos(&mut bench));
    bench.sdo(&SdoRequest::DownloadNormal {
        target: LONG,
        size_bytes: LONG_BYTES as u32,
        data: &value[..40],
    });
    for (number, part) in value[40..].chunks(49).enumerate() {
        assert_eq!(sdos(&mut bench), [], "it has not ended");
        let last = 40 + (number + 1) * 49 >= LONG_BYTES;
        bench.sdo(&SdoRequest::DownloadSegment { toggle: number % 2 == 1, last, data: part });
    }
    seen.extend(sdos(&mut bench));
    let text = SdoTarget::entry(0x1008, 0);
    bench.upload(text).unwrap();
    let uploaded = notes(&mut bench);
    assert_eq!(uploaded.iter().filter(|note| matches!(note, MailboxNote::Sdo(_))).count(), 1);
    let Some(MailboxNote::Sdo(note)) = uploaded.iter().find(|note| matches!(note, MailboxNote::Sdo(_)))
    else {
        panic!("{uploaded:?}")
    };
    assert_eq!((note.direction, note.value.length_bytes), (Some(SdoDirection::Upload), TEXT_BYTES as u32));
    let download = Some(SdoDirection::Download);
    let too_short = SdoEnd::Refused(bench_length_too_low());
    assert_eq!(
        seen,
        [
            (download, LONG, 0, vec![], too_short),
            (download, LONG, LONG_BYTES as u32, vec![0, 1, 2, 3, 4, 5, 6, 7], SdoEnd::Done),
        ]
    );
}

const fn bench_length_too_low() -> SdoAbort {
    mailbox::AbortProfile::CIA_301.length_too_low
}

#[test]
fn a_refused_sdo_and_one_that_the_master_aborts_have_their_codes() {
    let mut bench = Bench::in_pre_op();
    let missing = SdoTarget::complete(0x9999, 0);
    bench.sdo(&SdoRequest::Upload { target: missing });
    bench.sdo(&SdoRequest::DownloadNormal { target: LONG, size_bytes: LONG_BYTES as u32, data: &[1; 300] });
    let code = SdoAbort::GENERAL;
    bench.sdo(&SdoRequest::Abort { index: LONG.index, sub: SubIndex(1), code });
    let refused = SdoEnd::Refused(SdoAbort::OBJECT_DOES_NOT_EXIST);
    assert_eq!(
        sdos(&mut bench),
        [
            (Some(SdoDirection::Upload), missing, 0, vec![], refused),
            (Some(SdoDirection::Download), LONG, 0, vec![], SdoEnd::AbortedByMaster(code)),
        ]
    );
}

#[test]
fn each_message_is_a_note_also_a_repeated_one_and_an_emergency() {
    let mut bench = Bench::in_pre_op();
    bench.counter = 3;
    let request = bench.pack_request(CoeService::SdoRequest, &[0x40, 0x18, 0x10, 1, 0, 0, 0, 0]);
    assert!(bench.raw(&request).is_some());
    assert!(bench.raw(&request).is_none(), "it has been served");
    assert!(bench.raw(&[0; 3]).is_some(), "an error reply");
    let emergency = Emergency { code: 0xFF20, error_register: 0, manufacturer: [0, 0, 0, 0x20, 0x80] };
    bench.mailbox.queue_emergency(emergency).unwrap();
    bench.mailbox.next_unsolicited(&mut [0; 400]).unwrap();
    bench.mailbox.confirm_read();
    bench.mailbox.repeat(&mut [0; 400]).unwrap();
    let seen: Vec<_> = notes(&mut bench)
        .into_iter()
        .map(|note| match note {
            MailboxNote::Received(message) => {
                ("from master", Some(message.content), message.counter, message.again)
            }
            MailboxNote::Sent(message) => {
                ("to master", Some(message.content), message.counter, message.again)
            }
            MailboxNote::Emergency(sent) => {
                assert_eq!(sent, emergency);
                ("emergency", None, 0, false)
            }
            MailboxNote::Sdo(_) => ("SDO", None, 0, false),
        })
        .collect();
    let coe = |service| Some(MessageContent::Coe(service));
    assert_eq!(
        seen,
        [
            ("from master", coe(CoeService::SdoRequest), 3, false),
            ("SDO", None, 0, false),
            ("to master", coe(CoeService::SdoResponse), 1, false),
            ("from master", coe(CoeService::SdoRequest), 3, true),
            ("from master", Some(MessageContent::Other(wire::MailboxType::Other(0))), 0, false),
            ("to master", Some(MessageContent::Error(MailboxErrorCode::SIZE_TOO_SHORT)), 2, false),
            ("emergency", None, 0, false),
            ("to master", coe(CoeService::Emergency), 3, false),
            ("to master", coe(CoeService::Emergency), 3, true),
        ]
    );
}
