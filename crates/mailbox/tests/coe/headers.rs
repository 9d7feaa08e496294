//! Mailbox header, counters, error replies.

use wire::{AlState, CoeService, MailboxErrorCode, MailboxHeader, SdoRequest, SdoTarget};

use crate::bench::{Bench, mailbox_error};

const UPLOAD_1000: [u8; 16] = [10, 0, 0, 0, 0, 0x03, 0x00, 0x20, 0x40, 0x00, 0x10, 0x00, 0, 0, 0, 0];

fn counted(counter: u8) -> [u8; 16] {
    let mut request = UPLOAD_1000;
    request[5] |= counter << 4;
    request
}

/// C086
#[test]
fn the_same_counter_twice_is_answered_once() {
    let mut bench = Bench::in_pre_op();
    assert!(bench.raw(&counted(3)).is_some());
    assert_eq!(bench.raw(&counted(3)), None);
    assert!(bench.raw(&counted(4)).is_some());
    assert!(bench.raw(&counted(3)).is_some());
    bench.mailbox.reset();
    assert!(bench.raw(&counted(3)).is_some());
}

/// C087
#[test]
fn counter_0_is_always_answered() {
    let mut bench = Bench::in_pre_op();
    assert!((0..5).all(|_| bench.raw(&counted(0)).is_some()));
    assert!(bench.raw(&counted(2)).is_some());
    assert!(bench.raw(&counted(0)).is_some());
    assert_eq!(bench.raw(&counted(2)), None);
}

/// C088
#[test]
fn the_slaves_counter_runs_from_1_to_7() {
    let mut bench = Bench::in_pre_op();
    let mut sent = || MailboxHeader::parse(&bench.raw(&UPLOAD_1000).unwrap()).unwrap().counter;
    let counters: Vec<u8> = (0..9).map(|_| sent()).collect();
    assert_eq!(counters, [1, 2, 3, 4, 5, 6, 7, 1, 2]);
    bench.mailbox.reset();
    assert_eq!(MailboxHeader::parse(&bench.raw(&UPLOAD_1000).unwrap()).unwrap().counter, 1);
}

/// C090
#[test]
fn an_unsupported_protocol_gets_error_2() {
    let mut bench = Bench::in_pre_op();
    for protocol in (0..=15).filter(|&protocol| protocol != 3) {
        let mut request = UPLOAD_1000;
        request[5] = protocol;
        assert_eq!(
            mailbox_error(&bench.raw(&request).unwrap()),
            MailboxErrorCode::UNSUPPORTED_PROTOCOL,
            "{protocol}"
        );
    }
}

/// C090
#[test]
fn what_is_too_short_for_its_headers_gets_error_6() {
    let mut bench = Bench::in_pre_op();
    for length_bytes in [0, 1, 2, 3, 9] {
        let mut request = UPLOAD_1000;
        request[0] = length_bytes;
        assert_eq!(mailbox_error(&bench.raw(&request).unwrap()), MailboxErrorCode::SIZE_TOO_SHORT);
    }
    assert_eq!(mailbox_error(&bench.raw(&UPLOAD_1000[..5]).unwrap()), MailboxErrorCode::SIZE_TOO_SHORT);
}

/// C090
#[test]
fn what_is_longer_than_the_mailbox_gets_error_8() {
    let mut bench = Bench::in_pre_op();
    let mut request = [0; 400];
    request[..16].copy_from_slice(&UPLOAD_1000);
    request[..2].copy_from_slice(&394_u16.to_le_bytes());
    assert_eq!(bench.raw(&request).unwrap().len(), 16, "the longest message is still served");
    request[..2].copy_from_slice(&395_u16.to_le_bytes());
    assert_eq!(mailbox_error(&bench.raw(&request).unwrap()), MailboxErrorCode::INVALID_SIZE);
    let mut cut = UPLOAD_1000;
    cut[0] = 11;
    assert_eq!(mailbox_error(&bench.raw(&cut).unwrap()), MailboxErrorCode::INVALID_SIZE);
}

/// C090
#[test]
fn an_expedited_download_of_another_length_gets_error_8() {
    let mut bench = Bench::in_pre_op();
    let request = bench.pack_request(CoeService::SdoRequest, &[0x2B, 0x01, 0x20, 0, 1, 0, 0, 0, 0]);
    assert_eq!(mailbox_error(&bench.raw(&request).unwrap()), MailboxErrorCode::INVALID_SIZE);
}

#[test]
fn an_unknown_coe_service_gets_error_4() {
    let mut bench = Bench::in_pre_op();
    for service in (0..=15).filter(|service| ![2, 8].contains(service)) {
        let request = bench.pack_request(CoeService::from_bits(service), &[0; 8]);
        assert_eq!(mailbox_error(&bench.raw(&request).unwrap()), MailboxErrorCode::SERVICE_NOT_SUPPORTED);
    }
}

/// C115
#[test]
fn in_boot_coe_is_unsupported_and_in_init_nothing_answers() {
    let mut bench = Bench::in_pre_op();
    bench.state = AlState::Boot;
    assert_eq!(mailbox_error(&bench.raw(&UPLOAD_1000).unwrap()), MailboxErrorCode::UNSUPPORTED_PROTOCOL);
    bench.state = AlState::Init;
    assert_eq!(bench.raw(&UPLOAD_1000), None);
}

#[test]
fn a_reply_carries_the_address_of_its_request() {
    let mut bench = Bench::in_pre_op();
    let mut request = UPLOAD_1000;
    request[2..4].copy_from_slice(&0x1003_u16.to_le_bytes());
    assert_eq!(MailboxHeader::parse(&bench.raw(&request).unwrap()).unwrap().address, 0x1003);
    assert_eq!(MailboxHeader::parse(&bench.raw(&UPLOAD_1000).unwrap()).unwrap().address, 0);
}

#[test]
fn an_abort_of_the_master_ends_the_transfer_without_an_answer() {
    let mut bench = Bench::with_mailbox(34, mailbox::AbortProfile::CIA_301);
    let target = SdoTarget::entry(0x1008, 0);
    assert!(bench.sdo(&SdoRequest::Upload { target }).is_some());
    let code = wire::SdoAbort::TIMEOUT;
    assert_eq!(bench.sdo(&SdoRequest::Abort { index: target.index, sub: target.sub, code }), None);
    let (service, reply) = bench.sdo(&SdoRequest::UploadSegment { toggle: false }).unwrap();
    assert_eq!(service, CoeService::SdoRequest);
    assert_eq!(reply, [0x80, 0, 0, 0, 0x01, 0x00, 0x04, 0x05]);
}
