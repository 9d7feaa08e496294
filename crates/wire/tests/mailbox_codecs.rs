//! Mailbox, CoE, SDO and emergency bytes: known messages, and codecs that lose no information.
#![expect(clippy::unwrap_used, reason = "a panic here is a failed test")]

use proptest::prelude::*;
use wire::{
    CoeHeader, CoeService, DataType, Emergency, EntryDescription, MailboxErrorCode, MailboxErrorReply,
    MailboxHeader, MailboxType, ObjectDescription, ObjectIndex, SdoAbort, SdoAccess, SdoInfoHeader,
    SdoInfoList, SdoInfoOpcode, SdoInfoRequest, SdoInfoSyntaxError, SdoRequest, SdoResponse, SdoSyntaxError,
    SdoTarget, SubIndex, ValueInfo, pack_sdo_info_error,
};

fn packed(pack: impl FnOnce(&mut [u8]) -> Option<usize>) -> Vec<u8> {
    let mut bytes = [0xEE; 2048];
    let written_bytes = pack(&mut bytes).unwrap();
    bytes[..written_bytes].to_vec()
}

#[test]
fn a_header_of_a_counted_coe_message() {
    let bytes = [0x0A, 0x00, 0x00, 0x00, 0x00, 0x23];
    let header = MailboxHeader::parse(&bytes).unwrap();
    assert_eq!((header.length_bytes, header.mailbox_type, header.counter), (10, MailboxType::Coe, 2));
    assert_eq!(header.pack(), bytes);
    assert_eq!(MailboxHeader::parse(&bytes[..5]), None);
}

#[test]
fn an_error_reply_tells_its_detail() {
    let reply = MailboxErrorReply { detail: MailboxErrorCode::UNSUPPORTED_PROTOCOL };
    let bytes = packed(|bytes| reply.pack(bytes));
    assert_eq!(bytes, [0x01, 0x00, 0x02, 0x00]);
    assert_eq!(MailboxErrorReply::parse(&bytes), Some(reply));
    assert_eq!(MailboxErrorCode(6).to_string(), "0x0006 (size too short)");
    assert_eq!(reply.pack(&mut [0; 3]), None);
}

#[test]
fn an_expedited_download_of_two_octets() {
    let bytes = [0x2B, 0x12, 0x1C, 0x01, 0x01, 0x16, 0x00, 0x00];
    let target = SdoTarget::entry(0x1C12, 1);
    let expected = SdoRequest::DownloadExpedited { target, field: [1, 0x16, 0, 0], length_bytes: Some(2) };
    assert_eq!(SdoRequest::parse(&bytes), Ok(expected));
    assert_eq!(packed(|bytes| expected.pack(bytes)), bytes);
}

#[test]
fn an_expedited_download_longer_than_its_header_is_of_invalid_size() {
    assert_eq!(SdoRequest::parse(&[0x2F, 0, 0x60, 0, 1, 0, 0, 0, 0]), Err(SdoSyntaxError::InvalidSize));
}

#[test]
fn a_segment_shorter_than_seven_octets_is_padded() {
    let segment = SdoResponse::UploadSegment { toggle: true, last: true, data: &[0xAA, 0xBB] };
    let bytes = packed(|bytes| segment.pack(bytes));
    assert_eq!(bytes, [0x1B, 0xAA, 0xBB, 0, 0, 0, 0, 0]);
    assert_eq!(SdoResponse::parse(&bytes), Ok(segment));
}

#[test]
fn an_upload_segment_request_may_be_its_command_alone() {
    assert_eq!(SdoRequest::parse(&[0x70]), Ok(SdoRequest::UploadSegment { toggle: true }));
}

#[test]
fn an_abort_is_command_80_and_an_sdo_request() {
    let abort = SdoResponse::Abort {
        index: ObjectIndex(0x9999),
        sub: SubIndex(0),
        code: SdoAbort::OBJECT_DOES_NOT_EXIST,
    };
    assert_eq!(abort.service(), CoeService::SdoRequest);
    assert_eq!(packed(|bytes| abort.pack(bytes)), [0x80, 0x99, 0x99, 0, 0, 0, 0x02, 0x06]);
}

#[test]
fn abort_codes_print_as_published_and_stand_in_order() {
    assert_eq!(SdoAbort::OBJECT_DOES_NOT_EXIST.to_string(), "0x06020000 (object does not exist)");
    assert_eq!(SdoAbort(0x1234).to_string(), "0x00001234 (reserved)");
    assert_eq!(SdoAbort::TABLE.len(), 36);
    assert!(SdoAbort::TABLE.windows(2).all(|pair| pair[0].code < pair[1].code));
}

#[test]
fn an_sdo_information_error_carries_the_abort_code() {
    let bytes = packed(|bytes| pack_sdo_info_error(SdoAbort::SUBINDEX_DOES_NOT_EXIST, bytes));
    assert_eq!(bytes, [0x07, 0, 0, 0, 0x11, 0x00, 0x09, 0x06]);
    assert_eq!(SdoInfoRequest::parse(&bytes), Err(SdoInfoSyntaxError::NoRequest(SdoInfoOpcode::Error)),);
    assert_eq!(SdoInfoRequest::parse(&[1, 0, 0, 0, 1]), Err(SdoInfoSyntaxError::TooShort));
}

fn target() -> impl Strategy<Value = SdoTarget> {
    (any::<u16>(), any::<u8>(), any::<bool>()).prop_map(|(index, sub, complete)| SdoTarget {
        index: ObjectIndex(index),
        sub: SubIndex(sub),
        access: if complete { SdoAccess::Complete } else { SdoAccess::Entry },
    })
}

fn data() -> impl Strategy<Value = Vec<u8>> {
    prop::collection::vec(any::<u8>(), 0..1480)
}

proptest! {
    #[test]
    fn mailbox_headers_round_trip(bytes: [u8; 6]) {
        prop_assert_eq!(MailboxHeader::parse(&bytes).unwrap().pack(), bytes);
    }

    #[test]
    fn coe_headers_round_trip(bytes: [u8; 2]) {
        let (header, rest) = CoeHeader::parse(&bytes).unwrap();
        prop_assert!(rest.is_empty());
        prop_assert_eq!(header.pack(), bytes);
    }

    #[test]
    fn emergencies_round_trip(bytes: [u8; 8]) {
        prop_assert_eq!(Emergency::parse(&bytes).unwrap().pack(), bytes);
    }

    #[test]
    fn any_octets_parse_or_are_refused(bytes in prop::collection::vec(any::<u8>(), 0..40)) {
        let mut out = [0; 64];
        if let Ok(request) = SdoRequest::parse(&bytes) {
            let written_bytes = request.pack(&mut out).unwrap();
            prop_assert_eq!(SdoRequest::parse(&out[..written_bytes]), Ok(request));
        }
        if let Ok(response) = SdoResponse::parse(&bytes) {
            let written_bytes = response.pack(&mut out).unwrap();
            let again = SdoResponse::parse(&out[..written_bytes]);
            prop_assert_eq!(again, Ok(response));
        }
        if let Ok(request) = SdoInfoRequest::parse(&bytes) {
            let written_bytes = request.pack(&mut out).unwrap();
            prop_assert_eq!(SdoInfoRequest::parse(&out[..written_bytes]), Ok(request));
        }
    }

    #[test]
    fn transfers_round_trip(target in target(), data in data(), toggle: bool, last: bool, size_bytes: u32) {
        let requests = [
            SdoRequest::DownloadNormal { target, size_bytes, data: &data },
            SdoRequest::DownloadSegment { toggle, last, data: &data },
            SdoRequest::Upload { target },
            SdoRequest::UploadSegment { toggle },
        ];
        for request in requests {
            let bytes = packed(|bytes| request.pack(bytes));
            prop_assert_eq!(SdoRequest::parse(&bytes), Ok(request));
        }
        let responses = [
            SdoResponse::UploadNormal { target, size_bytes, data: &data },
            SdoResponse::UploadSegment { toggle, last, data: &data },
            SdoResponse::Download { target },
            SdoResponse::DownloadSegment { toggle },
        ];
        for response in responses {
            let bytes = packed(|bytes| response.pack(bytes));
            prop_assert_eq!(SdoResponse::parse(&bytes), Ok(response));
        }
    }

    #[test]
    fn nothing_is_written_past_the_end(target in target(), data in data(), room_bytes in 0_usize..1500) {
        let request = SdoRequest::DownloadNormal { target, size_bytes: 0, data: &data };
        let mut bytes = vec![0; room_bytes];
        let written_bytes = request.pack(&mut bytes);
        prop_assert_eq!(written_bytes.is_some(), 8 + data.len() <= room_bytes);
    }

    #[test]
    fn information_headers_round_trip(opcode in 0_u8..0x80, fragments_left: u16, list: u16) {
        let header = SdoInfoHeader::new(SdoInfoOpcode::from_bits(opcode), fragments_left);
        let bytes = header.pack();
        prop_assert_eq!(SdoInfoHeader::parse(&bytes), Some((header, &[][..])));
        prop_assert_eq!(SdoInfoList::from_bits(list).bits(), list);
    }

    #[test]
    fn object_descriptions_round_trip(fixed: [u8; 6], name in prop::collection::vec(any::<u8>(), 0..50)) {
        let bytes = [&fixed[..], &name].concat();
        let description = ObjectDescription::parse(&bytes).unwrap();
        prop_assert_eq!(packed(|out| description.pack(out)), bytes);
    }

    #[test]
    fn entry_descriptions_round_trip(
        info: u8, bit_length in 1_u16..=64, access: u16, values in prop::collection::vec(any::<u8>(), 28),
        name in prop::collection::vec(any::<u8>(), 0..50),
    ) {
        let value_info = ValueInfo::from_bits_retain(info);
        let of_the_entry = (info & 0x70).count_ones() as usize * usize::from(bit_length.div_ceil(8));
        let length_bytes = of_the_entry + if info & 8 == 0 { 0 } else { 4 };
        let description = EntryDescription {
            index: ObjectIndex(0x6000), sub: SubIndex(1), value_info, data_type: DataType::UNSIGNED16, bit_length,
            access, values: &values[..length_bytes], name: &name,
        };
        let bytes = packed(|out| description.pack(out));
        prop_assert_eq!(EntryDescription::parse(&bytes), Some(description));
    }
}
