//! SDO uploads and downloads of single entries.

use mailbox::AbortProfile;
use wire::{AlState, CoeService, ObjectIndex, SdoAbort, SdoRequest, SdoTarget, SubIndex};

use crate::bench::{Bench, LONG_BYTES, TEXT_BYTES};

/// C091
#[test]
fn device_type_and_identity_are_readable_in_pre_op() {
    let mut bench = Bench::in_pre_op();
    assert_eq!(bench.upload(SdoTarget::entry(0x1000, 0)), Ok(vec![0x89, 0x13, 0, 0]));
    assert_eq!(bench.upload(SdoTarget::entry(0x1018, 0)), Ok(vec![4]));
    let identity: Vec<_> = (1..=4).map(|sub| bench.upload(SdoTarget::entry(0x1018, sub))).collect();
    let expected = [0x83_u32, 0x17C, 0x10000, 1].map(|value| Ok(value.to_le_bytes().to_vec()));
    assert_eq!(identity, expected);
}

/// C091
#[test]
fn four_octets_and_fewer_are_expedited() {
    let mut bench = Bench::in_pre_op();
    let upload = |index, sub| SdoRequest::Upload { target: SdoTarget::entry(index, sub) };
    let (service, reply) = bench.sdo(&upload(0x1000, 0)).unwrap();
    assert_eq!((service, reply), (CoeService::SdoResponse, vec![0x43, 0x00, 0x10, 0, 0x89, 0x13, 0, 0]));
    let (_, reply) = bench.sdo(&upload(0x2000, 1)).unwrap();
    assert_eq!(reply, [0x4B, 0x00, 0x20, 1, 0x34, 0x12, 0, 0]);
    let (_, reply) = bench.sdo(&upload(0x1018, 0)).unwrap();
    assert_eq!(reply, [0x4F, 0x18, 0x10, 0, 4, 0, 0, 0]);
}

/// C092
#[test]
fn unknown_indexes_and_subindexes_have_their_codes() {
    let mut bench = Bench::in_pre_op();
    assert_eq!(bench.upload(SdoTarget::entry(0x9999, 0)), Err(SdoAbort::OBJECT_DOES_NOT_EXIST));
    assert_eq!(bench.download(SdoTarget::entry(0x9999, 0), &[0]), Err(SdoAbort::OBJECT_DOES_NOT_EXIST));
    assert_eq!(bench.upload(SdoTarget::entry(0x1018, 5)), Err(SdoAbort::SUBINDEX_DOES_NOT_EXIST));
    assert_eq!(bench.upload(SdoTarget::entry(0x2000, 4)), Err(SdoAbort::SUBINDEX_DOES_NOT_EXIST));
    assert_eq!(bench.upload(SdoTarget::entry(0x1000, 1)), Err(SdoAbort::SUBINDEX_DOES_NOT_EXIST));
}

/// C092
#[test]
fn an_abort_names_index_and_subindex_in_a_request_frame() {
    let mut bench = Bench::in_pre_op();
    let target = SdoTarget::complete(0x9999, 1);
    let download = SdoRequest::DownloadExpedited { target, field: [1; 4], length_bytes: Some(4) };
    let (service, reply) = bench.sdo(&download).unwrap();
    assert_eq!(service, CoeService::SdoRequest);
    assert_eq!(reply, [0x80, 0x99, 0x99, 1, 0x00, 0x00, 0x02, 0x06]);
}

/// C093
#[test]
fn a_read_only_entry_refuses_a_download() {
    let mut bench = Bench::in_pre_op();
    assert_eq!(bench.download(SdoTarget::entry(0x1000, 0), &[0; 4]), Err(SdoAbort::READ_ONLY));
    // The right is checked before the length.
    assert_eq!(bench.download(SdoTarget::entry(0x1000, 0), &[0; 2]), Err(SdoAbort::READ_ONLY));
}

#[test]
fn a_write_only_entry_refuses_an_upload() {
    let mut bench = Bench::in_pre_op();
    assert_eq!(bench.upload(SdoTarget::entry(0x2002, 0)), Err(SdoAbort::WRITE_ONLY));
    assert_eq!(bench.upload(SdoTarget::entry(0x2000, 6)), Err(SdoAbort::WRITE_ONLY));
    assert_eq!(bench.download(SdoTarget::entry(0x2002, 0), &[1; 4]), Ok(()));
}

/// C094, C104
#[test]
fn a_right_of_another_state_is_refused_by_state() {
    let mut bench = Bench::in_pre_op();
    let target = SdoTarget::entry(0x7000, 0);
    for (state, outcome) in [
        (AlState::PreOp, Err(SdoAbort::DEVICE_STATE)),
        (AlState::SafeOp, Err(SdoAbort::DEVICE_STATE)),
        (AlState::Op, Ok(())),
    ] {
        bench.state = state;
        assert_eq!(bench.download(target, &[1, 2]), outcome, "{state}");
        assert_eq!(bench.upload(target).map(drop), outcome, "{state}");
    }
}

/// C095
#[test]
fn a_wrong_length_is_too_high_or_too_low() {
    let mut bench = Bench::in_pre_op();
    let target = SdoTarget::entry(0x2001, 0);
    assert_eq!(bench.download(target, &[1]), Err(SdoAbort::LENGTH_TOO_LOW));
    assert_eq!(bench.download(target, &[1, 0, 0]), Err(SdoAbort::LENGTH_TOO_HIGH));
    assert_eq!(bench.download(target, &[1; 8]), Err(SdoAbort::LENGTH_TOO_HIGH));
    assert_eq!(bench.download(target, &[]), Err(SdoAbort::LENGTH_TOO_LOW));
    assert_eq!(bench.upload(target), Ok(vec![5, 0]));
}

/// C095
#[test]
fn a_unit_with_fewer_codes_has_one_for_every_length() {
    let mut bench = Bench::with_mailbox(400, AbortProfile::COARSE);
    let target = SdoTarget::entry(0x2001, 0);
    assert_eq!(bench.download(target, &[1]), Err(SdoAbort::LENGTH_MISMATCH));
    assert_eq!(bench.download(target, &[1; 3]), Err(SdoAbort::LENGTH_MISMATCH));
    assert_eq!(bench.upload(SdoTarget::complete(0x2001, 0)), Err(SdoAbort::UNSUPPORTED_ACCESS));
}

/// C095
#[test]
fn more_data_than_the_size_says_is_too_long() {
    let mut bench = Bench::in_pre_op();
    let target = SdoTarget::entry(0x2001, 0);
    let request = SdoRequest::DownloadNormal { target, size_bytes: 2, data: &[1, 2, 3] };
    let (_, reply) = bench.sdo(&request).unwrap();
    assert_eq!(reply[4..], SdoAbort::LENGTH_TOO_HIGH.0.to_le_bytes());
}

#[test]
fn a_value_outside_the_limits_is_refused_and_changes_nothing() {
    let mut bench = Bench::in_pre_op();
    let target = SdoTarget::entry(0x2001, 0);
    for (value, outcome) in [
        (9, Ok(())),
        (10, Err(SdoAbort::VALUE_OUT_OF_RANGE)),
        (20, Ok(())),
        (30, Err(SdoAbort::VALUE_OUT_OF_RANGE)),
    ] {
        assert_eq!(bench.download(target, &[value, 0]), outcome);
    }
    assert_eq!(bench.upload(target), Ok(vec![20, 0]));
}

#[test]
fn an_expedited_download_without_size_has_the_entrys_length() {
    let mut bench = Bench::in_pre_op();
    let target = SdoTarget::entry(0x2001, 0);
    let request = SdoRequest::DownloadExpedited { target, field: [7, 0, 9, 9], length_bytes: None };
    assert_eq!(bench.sdo(&request).unwrap().1[0], 0x60);
    assert_eq!(bench.upload(target), Ok(vec![7, 0]));
}

/// C096
#[test]
fn a_text_longer_than_the_mailbox_comes_in_segments() {
    let mut bench = Bench::with_mailbox(34, AbortProfile::CIA_301);
    let target = SdoTarget::entry(0x1008, 0);
    let (_, first) = bench.sdo(&SdoRequest::Upload { target }).unwrap();
    assert_eq!(first[..8], [0x41, 0x08, 0x10, 0, TEXT_BYTES as u8, 0, 0, 0]);
    assert_eq!(first.len(), 34 - 8, "18 octets of the text come along");
    let text = bench.upload(target).unwrap();
    assert_eq!((text.len(), &text[24..28]), (TEXT_BYTES, &b"YZAB"[..]));
}

/// C097
#[test]
fn a_wrong_toggle_aborts_and_the_next_initiate_works() {
    let mut bench = Bench::with_mailbox(34, AbortProfile::CIA_301);
    let target = SdoTarget::entry(0x1008, 0);
    bench.sdo(&SdoRequest::Upload { target }).unwrap();
    let (_, reply) = bench.sdo(&SdoRequest::UploadSegment { toggle: true }).unwrap();
    assert_eq!(reply, [0x80, 0x08, 0x10, 0, 0x00, 0x00, 0x03, 0x05]);
    let (_, reply) = bench.sdo(&SdoRequest::UploadSegment { toggle: false }).unwrap();
    assert_eq!(reply[4..], SdoAbort::COMMAND_SPECIFIER_UNKNOWN.0.to_le_bytes());
    assert_eq!(bench.upload(target).unwrap().len(), TEXT_BYTES);
}

/// C097
#[test]
fn a_wrong_toggle_ends_a_download_which_then_has_changed_nothing() {
    let mut bench = Bench::in_pre_op();
    let target = SdoTarget::entry(0x3001, 1);
    let begin = SdoRequest::DownloadNormal { target, size_bytes: LONG_BYTES as u32, data: &[1; 384] };
    bench.sdo(&begin).unwrap();
    let data = &[2; 391][..];
    bench.sdo(&SdoRequest::DownloadSegment { toggle: false, last: false, data }).unwrap();
    let (_, reply) = bench.sdo(&SdoRequest::DownloadSegment { toggle: false, last: false, data }).unwrap();
    assert_eq!(reply, [0x80, 0x01, 0x30, 1, 0x00, 0x00, 0x03, 0x05]);
    assert_eq!(bench.upload(target), Ok(vec![0; LONG_BYTES]));
    assert_eq!(bench.download(target, &[3; LONG_BYTES]), Ok(()));
    assert_eq!(bench.upload(target), Ok(vec![3; LONG_BYTES]));
}

#[test]
fn segments_must_add_up_to_the_size() {
    let mut bench = Bench::in_pre_op();
    let target = SdoTarget::entry(0x3001, 1);
    let begin = SdoRequest::DownloadNormal { target, size_bytes: LONG_BYTES as u32, data: &[1; 384] };
    bench.sdo(&begin).unwrap();
    let (_, reply) =
        bench.sdo(&SdoRequest::DownloadSegment { toggle: false, last: true, data: &[1; 9] }).unwrap();
    assert_eq!(reply[4..], SdoAbort::LENGTH_TOO_LOW.0.to_le_bytes());
    bench.sdo(&begin).unwrap();
    let mut toggle = false;
    let refused = (0..5).find_map(|_| {
        let (_, reply) = bench.sdo(&SdoRequest::DownloadSegment { toggle, last: false, data: &[1; 391] })?;
        toggle = !toggle;
        (reply[0] == 0x80).then(|| reply[4..].to_vec())
    });
    assert_eq!(refused, Some(SdoAbort::LENGTH_TOO_HIGH.0.to_le_bytes().to_vec()));
}

#[test]
fn a_new_initiate_ends_the_transfer_before_it() {
    let mut bench = Bench::with_mailbox(34, AbortProfile::CIA_301);
    bench.sdo(&SdoRequest::Upload { target: SdoTarget::entry(0x1008, 0) }).unwrap();
    bench.upload(SdoTarget::entry(0x1000, 0)).unwrap();
    let (_, reply) = bench.sdo(&SdoRequest::UploadSegment { toggle: false }).unwrap();
    assert_eq!(reply[0], 0x80);
}

#[test]
fn a_download_that_began_in_pre_op_is_judged_by_the_state_at_its_end() {
    let mut bench = Bench::with_mailbox(34, AbortProfile::CIA_301);
    let target = SdoTarget::complete(0x1601, 0);
    let begin = SdoRequest::DownloadNormal { target, size_bytes: 18, data: &[4, 0, 1] };
    assert_eq!(bench.sdo(&begin).unwrap().1[0], 0x70);
    bench.state = AlState::SafeOp;
    let (_, reply) =
        bench.sdo(&SdoRequest::DownloadSegment { toggle: false, last: true, data: &[0; 15] }).unwrap();
    assert_eq!(reply[4..], SdoAbort::DEVICE_STATE.0.to_le_bytes());
}

#[test]
fn an_unknown_command_is_aborted_with_its_index() {
    let mut bench = Bench::in_pre_op();
    let (service, reply) = bench.coe(CoeService::SdoRequest, &[0xA0, 0x18, 0x10, 2, 0, 0, 0, 0]).unwrap();
    assert_eq!(service, CoeService::SdoRequest);
    assert_eq!(reply, [0x80, 0x18, 0x10, 2, 0x01, 0x00, 0x04, 0x05]);
}

/// C105
#[test]
fn sync_manager_types_are_listed() {
    let mut bench = Bench::in_pre_op();
    let types: Vec<u8> =
        (0..=4).flat_map(|sub| bench.upload(SdoTarget::entry(0x1C00, sub)).unwrap()).collect();
    assert_eq!(types, [4, 1, 2, 3, 4]);
}

/// C107
#[test]
fn an_assignment_is_writable_in_pre_op_and_only_behind_a_zero_subindex_0() {
    let mut bench = Bench::in_pre_op();
    let [count, first] = [0, 1].map(|sub| SdoTarget::entry(0x1C12, sub));
    assert_eq!(bench.download(first, &[0x02, 0x16]), Err(SdoAbort::SUBINDEX_ZERO_NOT_CLEARED));
    assert_eq!(bench.download(count, &[0]), Ok(()));
    assert_eq!(bench.download(first, &[0x02, 0x16]), Ok(()));
    assert_eq!(bench.download(count, &[1]), Ok(()));
    assert_eq!(bench.upload(first), Ok(vec![0x02, 0x16]));
    for state in [AlState::SafeOp, AlState::Op] {
        bench.state = state;
        assert_eq!(bench.download(count, &[0]), Err(SdoAbort::DEVICE_STATE));
        assert_eq!(bench.download(SdoTarget::complete(0x1C12, 0), &[0, 0]), Err(SdoAbort::DEVICE_STATE));
    }
}

/// C107
#[test]
fn a_mapping_entry_waits_for_a_zero_subindex_0_too() {
    let mut bench = Bench::in_pre_op();
    let entry = SdoTarget::entry(0x1601, 3);
    assert_eq!(bench.download(entry, &[0; 4]), Err(SdoAbort::SUBINDEX_ZERO_NOT_CLEARED));
    assert_eq!(bench.download(SdoTarget::entry(0x1601, 0), &[0]), Ok(()));
    assert_eq!(bench.download(entry, &0x7000_03F0_u32.to_le_bytes()), Ok(()));
    let value = bench.objects.unsigned(ObjectIndex(0x1601), SubIndex(3));
    assert_eq!(value, Some(0x7000_03F0));
}
