//! The mailbox under test, with its known state.

use std::collections::VecDeque;

use allocation_counter::measure;
use mailbox::{AbortProfile, Mailbox, MailboxSizes};
use wire::{
    AlState, CoeHeader, CoeService, Emergency, MailboxErrorReply, MailboxHeader, MailboxType, SdoInfoHeader,
    SdoRequest, SdoResponse, SdoTarget,
};

use super::objects::Objects;
use super::step::{Model, Step};
use crate::examine::without_panic;

/// Maximum number of waiting emergencies.
const EMERGENCIES_MAX: usize = 16;

/// A mailbox and its master.
pub(super) struct Service {
    mailbox: Mailbox,
    objects: Objects,
    /// The values of all objects after the last request.
    values: Vec<u8>,
    sizes: MailboxSizes,
    state: AlState,
    /// Counter of the last counted message received, and of the last one sent; 0 for none.
    received_counter: u8,
    sent_counter: u8,
    outbox: Outbox,
    emergencies: VecDeque<Emergency>,
    /// Number of fragments of a list that have not been sent yet; none: no list was requested.
    fragments_left: Option<u16>,
    /// Number of accepted SDOs.
    taken: usize,
}

/// The messages that the master may request again.
#[derive(Default)]
struct Outbox {
    newest: Vec<u8>,
    read: Vec<u8>,
    in_mailbox: InMailbox,
    newest_waits: bool,
}

#[derive(Clone, Copy, Default, PartialEq, Eq)]
enum InMailbox {
    #[default]
    Nothing,
    Newest,
    Repeated,
}

type Rules = Result<(), String>;

impl Service {
    pub(super) fn of(model: Model, receive_bytes: u16, send_bytes: u16) -> Self {
        let sizes = MailboxSizes { receive_bytes, send_bytes };
        let aborts = match model {
            Model::Nx => AbortProfile::COARSE,
            Model::Small => AbortProfile::CIA_301,
        };
        let mut objects = Objects::of(model);
        let empty = ::objects::ObjectTable::default();
        let table = objects.server().map_or(&empty, |server| server.table());
        let mailbox = Mailbox::new(sizes, aborts, table);
        Self {
            mailbox,
            values: objects.values(),
            objects,
            sizes,
            state: AlState::PreOp,
            received_counter: 0,
            sent_counter: 0,
            outbox: Outbox::default(),
            emergencies: VecDeque::new(),
            fragments_left: None,
            taken: 0,
        }
    }

    pub(super) const fn outcome(&self) -> &'static str {
        if self.taken > 0 { "an SDO was taken" } else { "no SDO was taken" }
    }

    pub(super) fn step(&mut self, step: &Step) -> Rules {
        match step {
            // A second unit is ignored.
            Step::Unit { .. } => Ok(()),
            Step::State(state) => {
                self.state = *state;
                Ok(())
            }
            Step::Send(request) => {
                self.make_room()?;
                self.send(request)
            }
            Step::Fetch => self.fetch(),
            Step::Read => {
                self.read();
                Ok(())
            }
            Step::Repeat => self.repeat(),
            Step::Emergency => self.emergency(),
            Step::Reset => {
                self.mailbox.reset();
                (self.received_counter, self.sent_counter, self.fragments_left) = (0, 0, None);
                self.outbox = Outbox::default();
                self.emergencies.clear();
                Ok(())
            }
        }
    }

    /// A request is served only while the master's mailbox is free.
    fn make_room(&mut self) -> Rules {
        self.read();
        if self.outbox.newest_waits {
            self.fetch()?;
            self.read();
        }
        Ok(())
    }

    fn read(&mut self) {
        self.mailbox.confirm_read();
        if self.outbox.in_mailbox == InMailbox::Newest {
            self.outbox.read = self.outbox.newest.clone();
        }
        self.outbox.in_mailbox = InMailbox::Nothing;
    }

    fn send(&mut self, request: &[u8]) -> Rules {
        let header = MailboxHeader::parse(request);
        let has_mailbox = self.state != AlState::Init;
        let is_again = has_mailbox
            && header.is_some_and(|header| header.counter != 0 && header.counter == self.received_counter);
        if has_mailbox && let Some(header) = header.filter(|header| header.counter != 0) {
            self.received_counter = header.counter;
        }
        let reply = self.reply_to(request)?;
        let after = self.objects.values();
        let changed = self.values != after;
        self.values = after;
        let Some(reply) = reply else {
            return if changed { Err("a value has changed without a reply".into()) } else { Ok(()) };
        };
        if !has_mailbox || is_again {
            return Err(format!("a reply in {} to a message that came twice: {is_again}", self.state));
        }
        let own = self.well_formed(&reply, true)?;
        if own.address != header.map_or(0, |header| header.address) {
            return Err(format!("the reply has address {:04X}", own.address));
        }
        self.outbox.sent(&reply);
        let body = request.get(MailboxHeader::LENGTH_BYTES + CoeHeader::LENGTH_BYTES..).unwrap_or_default();
        let body = body.get(..body_bytes(header).min(body.len())).unwrap_or_default();
        self.reply(own, &reply[MailboxHeader::LENGTH_BYTES..], body, changed)
    }

    /// The reply to a request; serving it allocates nothing and stays within the reply's mailbox.
    fn reply_to(&mut self, request: &[u8]) -> Result<Option<Vec<u8>>, String> {
        let mut reply = vec![0xEE; usize::from(self.sizes.send_bytes)];
        let Some(server) = self.objects.server() else { return Ok(None) };
        let (mailbox, state) = (&mut self.mailbox, self.state);
        let mut length = Ok(None);
        let allocated = measure(|| {
            length = without_panic(|| Ok(mailbox.request(request, state, server, &mut reply)));
        });
        let length = length?;
        if allocated.count_total > 0 {
            return Err(format!("a request allocates {} times", allocated.count_total));
        }
        let reply = length.map(|length: usize| reply.get(..length).map(<[u8]>::to_vec));
        reply.map(|reply| reply.ok_or("the reply is longer than the mailbox".to_owned())).transpose()
    }

    /// The header of a message: its length, its kind, the next counter.
    fn well_formed(&mut self, message: &[u8], is_counted: bool) -> Result<MailboxHeader, String> {
        let header = MailboxHeader::parse(message).ok_or("a message without a header")?;
        if usize::from(header.length_bytes) + MailboxHeader::LENGTH_BYTES != message.len() {
            return Err(format!("{} bytes with the length {}", message.len(), header.length_bytes));
        }
        if is_counted {
            self.sent_counter = self.sent_counter % 7 + 1;
        }
        if header.counter != self.sent_counter {
            return Err(format!("counter {}, expected {}", header.counter, self.sent_counter));
        }
        if !matches!(header.mailbox_type, MailboxType::Coe | MailboxType::Error) {
            return Err(format!("a message of {:?}", header.mailbox_type));
        }
        Ok(header)
    }

    /// The contents of the reply match the request, and values change only if a download is accepted.
    fn reply(&mut self, header: MailboxHeader, body: &[u8], request: &[u8], changed: bool) -> Rules {
        if header.mailbox_type == MailboxType::Error {
            MailboxErrorReply::parse(body).ok_or("an error reply that is none")?;
            return if changed { Err("a value has changed with an error reply".into()) } else { Ok(()) };
        }
        let (coe, data) = CoeHeader::parse(body).ok_or("a CoE message without a header")?;
        if coe.service == CoeService::SdoInformation {
            let (information, _) = SdoInfoHeader::parse(data).ok_or("SDO information without a header")?;
            if information.incomplete != (information.fragments_left > 0) {
                return Err(format!("fragments: {information:?}"));
            }
            self.fragments_left = Some(information.fragments_left);
            return if changed { Err("SDO information has changed a value".into()) } else { Ok(()) };
        }
        let response = SdoResponse::parse(data).map_err(|error| format!("{error:?} in a response"))?;
        if response.service() != coe.service {
            return Err(format!("{response:?} by {:?}", coe.service));
        }
        let request = SdoRequest::parse(request).ok();
        self.sdo(request, response, changed)
    }

    fn sdo(&mut self, request: Option<SdoRequest<'_>>, response: SdoResponse<'_>, changed: bool) -> Rules {
        let refused = matches!(response, SdoResponse::Abort { .. });
        self.taken += usize::from(!refused);
        let fits = match (request, response) {
            (_, SdoResponse::Abort { .. }) => true,
            (Some(SdoRequest::Upload { target }), SdoResponse::UploadNormal { target: echo, .. })
            | (Some(SdoRequest::Upload { target }), SdoResponse::UploadExpedited { target: echo, .. })
            | (Some(SdoRequest::DownloadExpedited { target, .. }), SdoResponse::Download { target: echo })
            | (Some(SdoRequest::DownloadNormal { target, .. }), SdoResponse::Download { target: echo }) => {
                target == echo
            }
            (Some(SdoRequest::UploadSegment { toggle }), SdoResponse::UploadSegment { toggle: echo, .. })
            | (
                Some(SdoRequest::DownloadSegment { toggle, .. }),
                SdoResponse::DownloadSegment { toggle: echo },
            ) => toggle == echo,
            _ => false,
        };
        if !fits {
            return Err(format!("{response:?} answers {request:?}"));
        }
        let may_change = match request {
            Some(SdoRequest::DownloadExpedited { .. }) => true,
            Some(SdoRequest::DownloadNormal { size_bytes, data, .. }) => size_bytes as usize == data.len(),
            Some(SdoRequest::DownloadSegment { last, .. }) => last,
            _ => false,
        };
        if changed && (refused || !may_change) {
            return Err(format!("a value has changed with {response:?} to {request:?}"));
        }
        if refused || !self.objects.keep_what_is_written() { Ok(()) } else { self.is_kept(request, response) }
    }

    /// A written value can be read, and the value read is the stored one.
    fn is_kept(&mut self, request: Option<SdoRequest<'_>>, response: SdoResponse<'_>) -> Rules {
        let (target, value) = match (request, response) {
            (Some(SdoRequest::DownloadExpedited { target, field, length_bytes: Some(length) }), _)
            | (_, SdoResponse::UploadExpedited { target, field, length_bytes: length }) => {
                (target, field[..usize::from(length).min(field.len())].to_vec())
            }
            (Some(SdoRequest::DownloadNormal { target, size_bytes, data }), _)
            | (_, SdoResponse::UploadNormal { target, size_bytes, data })
                if data.len() == size_bytes as usize =>
            {
                (target, data.to_vec())
            }
            _ => return Ok(()),
        };
        if target != SdoTarget::entry(target.index.0, target.sub.0) {
            return Ok(());
        }
        let Some(server) = self.objects.server() else { return Ok(()) };
        let size_bytes =
            server.table().entry(target.index, target.sub).map_or(0, ::objects::Entry::size_bytes);
        let mut kept = vec![0; size_bytes];
        server
            .read(target.index, target.sub, &mut kept)
            .map_err(|code| format!("{code:?} from {target:?}"))?;
        if kept == value { Ok(()) } else { Err(format!("{target:?} is {kept:02X?} and not {value:02X?}")) }
    }

    /// Messages to the master without a further request.
    fn fetch(&mut self) -> Rules {
        if !matches!(self.state, AlState::PreOp | AlState::SafeOp | AlState::Op) {
            return Ok(());
        }
        let announced = self.mailbox.has_unsolicited();
        let mut message = vec![0xEE; usize::from(self.sizes.send_bytes)];
        let length = self.mailbox.next_unsolicited(&mut message);
        if announced != length.is_some() {
            return Err(format!("something to fetch: {announced}, fetched: {length:?} bytes"));
        }
        let Some(length) = length else { return Ok(()) };
        let message = message.get(..length).ok_or("the message is longer than the mailbox")?;
        if self.outbox.newest_waits {
            self.outbox.newest_waits = false;
            self.outbox.in_mailbox = InMailbox::Newest;
            return if message == self.outbox.newest { Ok(()) } else { Err("another message waited".into()) };
        }
        self.well_formed(message, true)?;
        self.outbox.sent(message);
        let (coe, data) =
            CoeHeader::parse(&message[MailboxHeader::LENGTH_BYTES..]).ok_or("no CoE message")?;
        if coe.service == CoeService::SdoInformation {
            let (header, _) = SdoInfoHeader::parse(data).ok_or("SDO information without a header")?;
            let expected = self.fragments_left.and_then(|left| left.checked_sub(1));
            self.fragments_left = Some(header.fragments_left);
            return if expected == Some(header.fragments_left) {
                Ok(())
            } else {
                Err(format!("{} fragments left, expected {expected:?}", header.fragments_left))
            };
        }
        let expected = self.emergencies.pop_front();
        let found = Emergency::parse(data).filter(|_| coe.service == CoeService::Emergency);
        if found == expected { Ok(()) } else { Err(format!("{found:?}, expected {expected:?}")) }
    }

    fn repeat(&mut self) -> Rules {
        let mut message = vec![0xEE; usize::from(self.sizes.send_bytes)];
        let length = self.mailbox.repeat(&mut message);
        let message = length.and_then(|length| message.get(..length)).unwrap_or_default();
        if message != self.outbox.read {
            return Err(format!("repeated {message:02X?}, read was {:02X?}", self.outbox.read));
        }
        if length.is_some() {
            self.outbox.newest_waits |= self.outbox.in_mailbox == InMailbox::Newest;
            self.outbox.in_mailbox = InMailbox::Repeated;
        }
        Ok(())
    }

    fn emergency(&mut self) -> Rules {
        let code = 0xFF00 + self.emergencies.len() as u16;
        let emergency = Emergency { code, error_register: 0x81, manufacturer: [1, 2, 3, 4, 5] };
        let has_room = self.emergencies.len() < EMERGENCIES_MAX;
        if self.mailbox.queue_emergency(emergency).is_ok() != has_room {
            return Err(format!(
                "with {} emergencies room for another: {}",
                self.emergencies.len(),
                !has_room
            ));
        }
        if has_room {
            self.emergencies.push_back(emergency);
        }
        Ok(())
    }
}

impl Outbox {
    fn sent(&mut self, message: &[u8]) {
        self.newest = message.to_vec();
        self.in_mailbox = InMailbox::Newest;
        self.newest_waits = false;
    }
}

/// Bytes after the CoE header.
fn body_bytes(header: Option<MailboxHeader>) -> usize {
    header.map_or(0, |header| usize::from(header.length_bytes)).saturating_sub(CoeHeader::LENGTH_BYTES)
}
