//! A mailbox with a small dictionary, and the master's side of every service.

use std::sync::Arc;

use mailbox::{AbortProfile, Mailbox, MailboxSizes};
use objects::{AccessRights, Dictionary, Entry, Object, ObjectCode, ObjectServer, ObjectTable};
use wire::{
    AlState, CoeHeader, CoeService, DataType, MailboxErrorCode, MailboxErrorReply, MailboxHeader,
    MailboxType, ObjectIndex, SdoAbort, SdoInfoHeader, SdoInfoOpcode, SdoInfoRequest, SdoRequest,
    SdoResponse, SdoTarget, SubIndex,
};

pub(crate) const RO: AccessRights = AccessRights::READ;
pub(crate) const RW: AccessRights = AccessRights::READ.union(AccessRights::WRITE);
pub(crate) const RW_PRE_OP: AccessRights = AccessRights::READ.union(AccessRights::WRITE_PRE_OP);

/// Bytes of the long text 0x1008 and of the long entry 0x3001:01.
pub(crate) const TEXT_BYTES: usize = 100;
pub(crate) const LONG_BYTES: usize = 2000;

/// A slave's mailbox, its objects, its state, and the counter of the master's next message.
pub(crate) struct Bench<S = Dictionary> {
    pub(crate) mailbox: Mailbox,
    pub(crate) objects: S,
    pub(crate) state: AlState,
    pub(crate) counter: u8,
}

impl Bench {
    pub(crate) fn in_pre_op() -> Self {
        Self::with_mailbox(400, AbortProfile::CIA_301)
    }

    pub(crate) fn with_mailbox(mailbox_bytes: u16, aborts: AbortProfile) -> Self {
        Self::with_objects(Dictionary::new(Arc::new(small_table())), mailbox_bytes, aborts)
    }
}

impl<S: ObjectServer> Bench<S> {
    pub(crate) fn with_objects(objects: S, mailbox_bytes: u16, aborts: AbortProfile) -> Self {
        let sizes = MailboxSizes { receive_bytes: mailbox_bytes, send_bytes: mailbox_bytes };
        let mailbox = Mailbox::new(sizes, aborts, objects.table());
        Self { mailbox, objects, state: AlState::PreOp, counter: 0 }
    }

    /// Sends whole bytes and returns the whole reply.
    pub(crate) fn raw(&mut self, request: &[u8]) -> Option<Vec<u8>> {
        let mut reply = vec![0xEE; usize::from(self.mailbox.sizes().send_bytes)];
        let length_bytes = self.mailbox.request(request, self.state, &mut self.objects, &mut reply)?;
        self.mailbox.confirm_read();
        reply.truncate(length_bytes);
        Some(reply)
    }

    /// The bytes of a CoE request, counted unless the bench's counter is 0.
    pub(crate) fn pack_request(&self, service: CoeService, data: &[u8]) -> Vec<u8> {
        let header = MailboxHeader {
            length_bytes: (CoeHeader::LENGTH_BYTES + data.len()) as u16,
            address: 0,
            channel: 0,
            priority: 0,
            mailbox_type: MailboxType::Coe,
            counter: self.counter,
            reserved: false,
        };
        [&header.pack()[..], &CoeHeader::new(service).pack(), data].concat()
    }

    /// Service and data of the CoE reply to a CoE request.
    pub(crate) fn coe(&mut self, service: CoeService, data: &[u8]) -> Option<(CoeService, Vec<u8>)> {
        let reply = self.raw(&self.pack_request(service, data))?;
        Some(coe_message(&reply))
    }

    /// The reply to one SDO.
    pub(crate) fn sdo(&mut self, request: &SdoRequest<'_>) -> Option<(CoeService, Vec<u8>)> {
        let mut bytes = [0; 1500];
        let length_bytes = request.pack(&mut bytes).unwrap();
        self.coe(CoeService::SdoRequest, &bytes[..length_bytes])
    }

    /// Uploads in as many segments as necessary.
    pub(crate) fn upload(&mut self, target: SdoTarget) -> Result<Vec<u8>, SdoAbort> {
        let (_, reply) = self.sdo(&SdoRequest::Upload { target }).unwrap();
        let (size_bytes, mut value) = match SdoResponse::parse(&reply).unwrap() {
            SdoResponse::UploadExpedited { target: echo, field, length_bytes } => {
                assert_eq!(echo, target);
                return Ok(field[..usize::from(length_bytes)].to_vec());
            }
            SdoResponse::UploadNormal { target: echo, size_bytes, data } => {
                assert_eq!(echo, target);
                (size_bytes as usize, data.to_vec())
            }
            SdoResponse::Abort { code, .. } => return Err(code),
            other => panic!("no answer to an upload: {other:?}"),
        };
        let mut toggle = false;
        while value.len() < size_bytes {
            let (_, reply) = self.sdo(&SdoRequest::UploadSegment { toggle }).unwrap();
            let SdoResponse::UploadSegment { toggle: echo, last, data } = SdoResponse::parse(&reply).unwrap()
            else {
                panic!("no segment: {reply:02X?}");
            };
            value.extend_from_slice(data);
            assert_eq!((echo, last), (toggle, value.len() == size_bytes));
            toggle = !toggle;
        }
        Ok(value)
    }

    /// Downloads expedited up to four bytes, else normally, in as many segments as necessary.
    pub(crate) fn download(&mut self, target: SdoTarget, value: &[u8]) -> Result<(), SdoAbort> {
        if (1..=4).contains(&value.len()) {
            let mut field = [0; 4];
            field[..value.len()].copy_from_slice(value);
            let length_bytes = Some(value.len() as u8);
            return self.take(&SdoRequest::DownloadExpedited { target, field, length_bytes });
        }
        let sizes = self.mailbox.sizes();
        let (first, mut rest) = value.split_at(value.len().min(usize::from(sizes.receive_bytes) - 16));
        self.take(&SdoRequest::DownloadNormal { target, size_bytes: value.len() as u32, data: first })?;
        let mut toggle = false;
        while !rest.is_empty() {
            let (data, after) = rest.split_at(rest.len().min(usize::from(sizes.receive_bytes) - 9));
            self.take(&SdoRequest::DownloadSegment { toggle, last: after.is_empty(), data })?;
            toggle = !toggle;
            rest = after;
        }
        Ok(())
    }

    fn take(&mut self, request: &SdoRequest<'_>) -> Result<(), SdoAbort> {
        let (_, reply) = self.sdo(request).unwrap();
        match (SdoResponse::parse(&reply).unwrap(), *request) {
            (SdoResponse::Download { target: echo }, SdoRequest::DownloadExpedited { target, .. })
            | (SdoResponse::Download { target: echo }, SdoRequest::DownloadNormal { target, .. }) => {
                assert_eq!(echo, target);
                Ok(())
            }
            (SdoResponse::DownloadSegment { toggle: echo }, SdoRequest::DownloadSegment { toggle, .. }) => {
                assert_eq!(echo, toggle);
                Ok(())
            }
            (SdoResponse::Abort { code, .. }, _) => Err(code),
            (other, _) => panic!("no answer to a download: {other:?}"),
        }
    }

    /// Requests SDO information; returns opcode and data of the response, of all its fragments together.
    pub(crate) fn information(&mut self, request: SdoInfoRequest) -> (SdoInfoOpcode, Vec<u8>) {
        let mut bytes = [0; 16];
        let length_bytes = request.pack(&mut bytes).unwrap();
        let (service, reply) = self.coe(CoeService::SdoInformation, &bytes[..length_bytes]).unwrap();
        assert_eq!(service, CoeService::SdoInformation);
        let (header, data) = SdoInfoHeader::parse(&reply).unwrap();
        let mut all = data.to_vec();
        for left in (0..header.fragments_left).rev() {
            let fragment = self.unsolicited().unwrap();
            let (_, body) = coe_message(&fragment);
            let (header, data) = SdoInfoHeader::parse(&body).unwrap();
            assert_eq!((header.fragments_left, header.incomplete), (left, left != 0));
            all.extend_from_slice(data);
        }
        assert_eq!(self.unsolicited(), None);
        (header.opcode, all)
    }

    /// The messages that the slave sends without a request.
    pub(crate) fn unsolicited(&mut self) -> Option<Vec<u8>> {
        let mut message = vec![0xEE; usize::from(self.mailbox.sizes().send_bytes)];
        assert!(self.mailbox.next_unsolicited(&mut []).is_none());
        let length_bytes = self.mailbox.next_unsolicited(&mut message)?;
        self.mailbox.confirm_read();
        message.truncate(length_bytes);
        Some(message)
    }
}

/// Service and data of a CoE message, whose header must be correct.
pub(crate) fn coe_message(message: &[u8]) -> (CoeService, Vec<u8>) {
    let header = MailboxHeader::parse(message).unwrap();
    assert_eq!(header.mailbox_type, MailboxType::Coe, "{message:02X?}");
    assert_eq!(usize::from(header.length_bytes) + MailboxHeader::LENGTH_BYTES, message.len());
    let (coe, data) = CoeHeader::parse(&message[MailboxHeader::LENGTH_BYTES..]).unwrap();
    (coe.service, data.to_vec())
}

/// The detail of an error reply.
pub(crate) fn mailbox_error(message: &[u8]) -> MailboxErrorCode {
    let header = MailboxHeader::parse(message).unwrap();
    assert_eq!((header.mailbox_type, header.length_bytes), (MailboxType::Error, 4));
    MailboxErrorReply::parse(&message[MailboxHeader::LENGTH_BYTES..]).unwrap().detail
}

pub(crate) fn entry(
    sub: u8,
    data_type: DataType,
    bit_length: u16,
    access: AccessRights,
    value: u64,
) -> Entry {
    let default = value.to_le_bytes().into_iter().chain(std::iter::repeat(0));
    Entry {
        sub: SubIndex(sub),
        name: format!("SubIndex {sub:03}"),
        data_type,
        bit_length,
        access,
        default: default.take(usize::from(bit_length).div_ceil(8)).collect(),
        limits: Vec::new(),
    }
}

pub(crate) fn object(index: u16, code: ObjectCode, complete_access: bool, entries: Vec<Entry>) -> Object {
    let data_type = entries.last().map_or(DataType::UNSIGNED8, |entry| entry.data_type);
    Object {
        index: ObjectIndex(index),
        name: format!("Object {index:04X}"),
        code,
        data_type,
        complete_access,
        entries,
    }
}

fn counted(
    index: u16,
    code: ObjectCode,
    access: AccessRights,
    bits: u16,
    values: &[u64],
    set: u64,
) -> Object {
    let data_type = match bits {
        8 => DataType::UNSIGNED8,
        16 => DataType::UNSIGNED16,
        _ => DataType::UNSIGNED32,
    };
    let mut entries = vec![entry(0, DataType::UNSIGNED8, 8, access, set)];
    let values = (1_u8..).zip(values);
    entries.extend(values.map(|(sub, &value)| entry(sub, data_type, bits, access, value)));
    object(index, code, true, entries)
}

/// Mixed rights, bits, a gap, limits.
fn settings() -> Object {
    let mut limited = entry(5, DataType::UNSIGNED32, 32, RW, 7);
    limited.limits = vec![0..=100];
    let write_only = AccessRights::WRITE;
    let entries = vec![
        entry(0, DataType::UNSIGNED8, 8, RO, 7),
        entry(1, DataType::UNSIGNED16, 16, RW, 0x1234),
        entry(2, DataType::BOOLEAN, 1, RW, 1),
        entry(3, DataType::BOOLEAN, 1, RO, 1),
        limited,
        entry(6, DataType::UNSIGNED8, 8, write_only, 0x66),
        entry(7, DataType::UNSIGNED8, 8, RW | AccessRights::BACKUP | AccessRights::SETTING, 0x77),
    ];
    object(0x2000, ObjectCode::Record, true, entries)
}

fn small_table() -> ObjectTable {
    let variable = |index, entry| object(index, ObjectCode::Variable, false, vec![entry]);
    let text: Vec<u8> = (0..TEXT_BYTES).map(|at| b'A' + (at % 26) as u8).collect();
    let mut name = entry(0, DataType::VISIBLE_STRING, (TEXT_BYTES * 8) as u16, RO, 0);
    name.default = text;
    let long = entry(1, DataType::OCTET_STRING, (LONG_BYTES * 8) as u16, RW, 0);
    let mut in_op = entry(0, DataType::UNSIGNED16, 16, AccessRights::WRITE_OP | AccessRights::READ_OP, 0);
    in_op.access |= AccessRights::RX_PDO;
    let mut range = entry(0, DataType::UNSIGNED16, 16, RW | AccessRights::TX_PDO, 5);
    range.limits = vec![0..=9, 20..=29];
    ObjectTable::new(vec![
        variable(0x1000, entry(0, DataType::UNSIGNED32, 32, RO, 0x0000_1389)),
        variable(0x1008, name),
        counted(0x1018, ObjectCode::Record, RO, 32, &[0x83, 0x17C, 0x10000, 1], 4),
        counted(0x1601, ObjectCode::Record, RW_PRE_OP, 32, &[0x7000_01F0, 0x7000_02F0, 0, 0], 2),
        counted(0x1C00, ObjectCode::Array, RO, 8, &[1, 2, 3, 4], 4),
        counted(0x1C12, ObjectCode::Array, RW_PRE_OP, 16, &[0x1601, 0, 0], 1),
        counted(0x1C13, ObjectCode::Array, RW_PRE_OP, 16, &[0x1A00, 0x1A01, 0x1BFE, 0, 0, 0], 3),
        settings(),
        variable(0x2001, range),
        variable(0x2002, entry(0, DataType::UNSIGNED32, 32, AccessRights::WRITE, 0)),
        object(0x2003, ObjectCode::Variable, true, vec![entry(0, DataType::UNSIGNED32, 32, RW, 9)]),
        object(0x3001, ObjectCode::Record, true, vec![entry(0, DataType::UNSIGNED8, 8, RO, 1), long]),
        variable(0x7000, in_op),
    ])
}
