//! A master's side of SDO, with the mailbox that checks a request before the unit sees it.

use mailbox::{AbortProfile, Mailbox, MailboxSizes};
use nx_ect101::object_table;
use objects::ObjectServer;
use wire::AlState;

const SIZES: MailboxSizes = MailboxSizes { receive_bytes: 128, send_bytes: 128 };
/// Initiate download with size indicated, and initiate upload.
const DOWNLOAD: u8 = 0x21;
const UPLOAD: u8 = 0x40;
const ABORT: u8 = 0x80;

/// SDO requests, one by one.
#[derive(Debug)]
pub(crate) struct Sdo(Mailbox);

impl Sdo {
    pub(crate) fn new() -> Self {
        Self(Mailbox::new(SIZES, AbortProfile::COARSE, &object_table()))
    }

    pub(crate) fn download(
        &mut self,
        objects: &mut dyn ObjectServer,
        index: u16,
        sub: u8,
        value: &[u8],
    ) -> Result<(), u32> {
        let mut tail = (value.len() as u32).to_le_bytes().to_vec();
        tail.extend(value);
        self.exchange(objects, DOWNLOAD, index, sub, &tail).map(drop)
    }

    pub(crate) fn upload(
        &mut self,
        objects: &mut dyn ObjectServer,
        index: u16,
        sub: u8,
    ) -> Result<Vec<u8>, u32> {
        let (command, tail) = self.exchange(objects, UPLOAD, index, sub, &[0; 4])?;
        let is_expedited = command & 0x02 != 0;
        let unused = usize::from(command >> 2 & 3);
        Ok(if is_expedited { tail[..4 - unused].to_vec() } else { tail[4..].to_vec() })
    }

    /// The SDO response: command, then the bytes after index and subindex; or the abort code.
    fn exchange(
        &mut self,
        objects: &mut dyn ObjectServer,
        command: u8,
        index: u16,
        sub: u8,
        tail: &[u8],
    ) -> Result<(u8, Vec<u8>), u32> {
        let [low, high] = index.to_le_bytes();
        let mut request = vec![6 + tail.len() as u8, 0, 0, 0, 0, 0x03, 0x00, 0x20, command, low, high, sub];
        request.extend(tail);
        let mut reply = [0; SIZES.send_bytes as usize];
        let length_bytes =
            self.0.request(&request, AlState::PreOp, objects, &mut reply).expect("a reply to a new request");
        let tail = reply[12..length_bytes].to_vec();
        match reply[8] {
            ABORT => Err(u32::from_le_bytes(tail.try_into().expect("an abort code"))),
            command => Ok((command, tail)),
        }
    }
}
