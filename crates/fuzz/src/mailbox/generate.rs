//! Generating inputs: conversations of a correct master, and damaged messages.

use std::fmt::Write;
use std::sync::LazyLock;

use nx_ect101::object_table;
use wire::{
    CoeHeader, CoeService, MailboxHeader, MailboxType, ObjectIndex, SdoAbort, SdoAccess, SdoInfoList,
    SdoInfoRequest, SdoRequest, SdoTarget, SubIndex, ValueInfo,
};

use super::step::{Model, STATES, Step};
use crate::bytes;
use crate::random::Random;

/// Objects of the small table.
const SMALL: [u16; 11] =
    [0x1000, 0x1008, 0x1018, 0x1601, 0x1C12, 0x2000, 0x2001, 0x2002, 0x2003, 0x3000, 0x3001];

static NX: LazyLock<Vec<u16>> =
    LazyLock::new(|| object_table().iter().map(|object| object.index.0).collect());

/// The state of a generated master of one unit.
struct Master<'a> {
    random: &'a mut Random,
    model: Model,
    counter: u8,
    toggle: bool,
    receive_bytes: usize,
}

pub(super) fn text(random: &mut Random) -> String {
    let model = if random.once_in(2) { Model::Nx } else { Model::Small };
    let mut bytes = || *random.one_of(&[34, 48, 128, 128, 400, 400, 1486]);
    let (receive_bytes, send_bytes) = (bytes(), bytes());
    let mut text = format!("{}\n", Step::Unit { model, receive_bytes, send_bytes });
    let mut master = Master { random, model, counter: 0, toggle: false, receive_bytes: receive_bytes.into() };
    for _ in 0..master.random.between(1, 30) {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{}", master.step());
    }
    text
}

impl Master<'_> {
    fn step(&mut self) -> Step {
        match self.random.below(20) {
            0 => Step::State(self.random.one_of(&STATES).1),
            1 | 2 => Step::Fetch,
            3 | 4 => Step::Read,
            5 => Step::Repeat,
            6 if self.random.once_in(2) => Step::Emergency,
            7 if self.random.once_in(8) => Step::Reset,
            _ => Step::Send(self.message()),
        }
    }

    fn message(&mut self) -> Vec<u8> {
        let (service, body) = match self.random.below(8) {
            0 | 1 => (CoeService::SdoInformation, self.information()),
            2 if self.random.once_in(4) => {
                let length = self.random.length(64);
                (CoeService::from_bits(self.random.byte() & 0x0F), self.random.bytes(length))
            }
            _ => (CoeService::SdoRequest, self.sdo()),
        };
        let body = [&CoeHeader::new(service).pack()[..], &body].concat();
        if !self.random.once_in(12) {
            self.counter = self.counter % 7 + 1;
        }
        let header = MailboxHeader {
            length_bytes: body.len() as u16,
            address: if self.random.once_in(8) { self.random.word() } else { 0 },
            channel: 0,
            priority: 0,
            mailbox_type: if self.random.once_in(20) {
                MailboxType::from_bits(self.random.byte())
            } else {
                MailboxType::Coe
            },
            counter: if self.random.once_in(8) { 0 } else { self.counter },
            reserved: false,
        };
        let mut message = [&header.pack()[..], &body].concat();
        if self.random.once_in(2) {
            // With the length of the SyncManager.
            message.resize(message.len().max(self.receive_bytes), 0);
        }
        if self.random.once_in(5) {
            bytes::damage(&mut message, self.random);
        }
        message.truncate(2_000);
        message
    }

    fn target(&mut self) -> SdoTarget {
        let index = match self.model {
            _ if self.random.once_in(10) => self.random.word(),
            Model::Small => *self.random.one_of(&SMALL),
            Model::Nx => *self.random.one_of(&NX),
        };
        let sub = *self.random.one_of(&[0, 0, 1, 1, 2, 3, 4, 5, 7, 8, 60]);
        let sub = if self.random.once_in(10) { self.random.byte() } else { sub };
        let access = if self.random.once_in(3) { SdoAccess::Complete } else { SdoAccess::Entry };
        SdoTarget { index: ObjectIndex(index), sub: SubIndex(sub), access }
    }

    /// Up to the length of an entry of this kind.
    fn value(&mut self) -> Vec<u8> {
        let length = *self.random.one_of(&[0, 1, 1, 2, 2, 4, 4, 8, 12, 18, 26, 30, 100, 482, 700, 701]);
        if self.random.once_in(2) {
            let small = self.random.below(6) as u8;
            let mut value = vec![0; length];
            value.iter_mut().take(1).for_each(|first| *first = small);
            return value;
        }
        self.random.bytes(length)
    }

    fn sdo(&mut self) -> Vec<u8> {
        let target = self.target();
        let value = self.value();
        let first = self.random.below(value.len() + 1);
        let request = match self.random.below(12) {
            0..=3 => {
                self.toggle = false;
                SdoRequest::Upload { target }
            }
            4 => {
                self.toggle = !self.toggle;
                SdoRequest::UploadSegment { toggle: self.toggle ^ !self.random.once_in(8) }
            }
            5 | 6 => {
                let mut field = [0; 4];
                field.iter_mut().zip(&value).for_each(|(byte, value)| *byte = *value);
                let length = value.len().clamp(1, 4) as u8;
                let length_bytes = if self.random.once_in(6) { None } else { Some(length) };
                SdoRequest::DownloadExpedited { target, field, length_bytes }
            }
            7 | 8 => {
                self.toggle = false;
                let data = if self.random.once_in(2) { &value[..] } else { &value[..first] };
                let size = if self.random.once_in(10) { self.random.number() as usize } else { value.len() };
                SdoRequest::DownloadNormal { target, size_bytes: size as u32, data }
            }
            9 | 10 => {
                self.toggle = !self.toggle;
                let toggle = self.toggle ^ !self.random.once_in(8);
                SdoRequest::DownloadSegment { toggle, last: self.random.once_in(3), data: &value }
            }
            _ => SdoRequest::Abort { index: target.index, sub: target.sub, code: SdoAbort(0x0504_0000) },
        };
        let mut bytes = [0; 1_500];
        let length = request.pack(&mut bytes).unwrap_or_default();
        bytes[..length].to_vec()
    }

    fn information(&mut self) -> Vec<u8> {
        let target = self.target();
        let request = match self.random.below(4) {
            0 | 1 => SdoInfoRequest::List(SdoInfoList::from_bits(self.random.below(7) as u16)),
            2 => SdoInfoRequest::Object(target.index),
            _ => SdoInfoRequest::Entry {
                index: target.index,
                sub: target.sub,
                value_info: ValueInfo::from_bits_retain(self.random.byte()),
            },
        };
        let mut bytes = [0; 16];
        let length = request.pack(&mut bytes).unwrap_or_default();
        bytes[..length].to_vec()
    }
}
