//! SyncManagers 0 and 1 for the mailbox: when a request is served, when a message may be sent, repeats.

use esc::{Pdi, SmIndex};
use mailbox::{Mailbox, MailboxNote, MailboxSizes};
use objects::{ObjectServer, ObjectTable};
use time::{Duration, Instant};
use wire::AlState;

use crate::sync_managers::{MailboxAreas, MailboxConfig};

/// The mailbox of a running device.
#[derive(Debug)]
pub(crate) struct MailboxService {
    config: MailboxConfig,
    mailbox: Mailbox,
    request: Box<[u8]>,
    reply: Box<[u8]>,
    /// The time at which the request in SyncManager 0 is answered.
    due: Option<Instant>,
    /// A message to the master is in SyncManager 1.
    sent: bool,
}

impl MailboxService {
    pub(crate) fn new(config: MailboxConfig, table: &ObjectTable) -> Self {
        let buffer = |length_bytes: u16| vec![0; usize::from(length_bytes)].into_boxed_slice();
        let MailboxAreas { receive, send } = config.standard;
        let in_boot = config.bootstrap.unwrap_or(config.standard);
        let sizes = MailboxSizes { receive_bytes: receive.length_bytes, send_bytes: send.length_bytes };
        Self {
            mailbox: Mailbox::new(sizes, config.aborts, table),
            request: buffer(receive.length_bytes.max(in_boot.receive.length_bytes)),
            reply: buffer(send.length_bytes.max(in_boot.send.length_bytes)),
            due: None,
            sent: false,
            config,
        }
    }

    pub(crate) fn mailbox(&mut self) -> &mut Mailbox {
        &mut self.mailbox
    }

    /// Takes the oldest note of what has happened.
    #[inline]
    pub(crate) fn take_note(&mut self) -> Option<MailboxNote> {
        self.mailbox.take_note()
    }

    /// A request that is already waiting keeps its time.
    pub(crate) const fn set_response_time(&mut self, response_time: Duration) {
        self.config.response_time = response_time;
    }

    /// Resets the mailbox, as at INIT to PRE-OP.
    pub(crate) fn reset(&mut self) {
        self.mailbox.reset();
        self.due = None;
        self.sent = false;
    }

    /// The time at which a request is to be answered. While the send mailbox is full, the next step is the
    /// master's read, not a point in time.
    pub(crate) fn deadline(&self) -> Instant {
        if self.sent { Instant::NEVER } else { self.due.unwrap_or(Instant::NEVER) }
    }

    /// Serves both SyncManagers. Returns whether a request was served, which may have changed the unit.
    pub(crate) fn poll(
        &mut self,
        now: Instant,
        state: AlState,
        pdi: &mut Pdi<'_>,
        objects: &mut dyn ObjectServer,
    ) -> bool {
        pdi.take_event(SmIndex::MAILBOX_SEND);
        if self.sent && !pdi.mailbox_full(SmIndex::MAILBOX_SEND) {
            self.sent = false;
            self.mailbox.confirm_read();
        }
        if pdi.repeat_requested(SmIndex::MAILBOX_SEND) {
            self.repeat(pdi);
        }
        // Waiting messages are sent before an answer: a message that was replaced by a repeated one comes next.
        self.send_unsolicited(pdi);
        let served = self.serve(now, state, pdi, objects);
        self.send_unsolicited(pdi);
        served
    }

    fn send_unsolicited(&mut self, pdi: &mut Pdi<'_>) {
        if !self.sent && self.mailbox.has_unsolicited() {
            let length_bytes = self.mailbox.next_unsolicited(&mut self.reply);
            self.send(length_bytes, pdi);
        }
    }

    /// The lost message is put into the mailbox again; an unread message there follows it later.
    fn repeat(&mut self, pdi: &mut Pdi<'_>) {
        if let Some(length_bytes) = self.mailbox.repeat(&mut self.reply) {
            pdi.empty_mailbox(SmIndex::MAILBOX_SEND);
            self.send(Some(length_bytes), pdi);
        }
        pdi.acknowledge_repeat(SmIndex::MAILBOX_SEND);
    }

    /// A request remains in its mailbox, which refuses the next one, until its response can be sent.
    fn serve(
        &mut self,
        now: Instant,
        state: AlState,
        pdi: &mut Pdi<'_>,
        objects: &mut dyn ObjectServer,
    ) -> bool {
        let Some(message) = pdi.mailbox(SmIndex::MAILBOX_RECEIVE) else {
            self.due = None;
            return false;
        };
        let due = *self.due.get_or_insert(now + self.config.response_time);
        if now < due || self.sent {
            return false;
        }
        let length_bytes = message.len().min(self.request.len());
        self.request[..length_bytes].copy_from_slice(&message[..length_bytes]);
        pdi.release_mailbox(SmIndex::MAILBOX_RECEIVE);
        self.due = None;
        let reply = self.mailbox.request(&self.request[..length_bytes], state, objects, &mut self.reply);
        self.send(reply, pdi);
        true
    }

    fn send(&mut self, length_bytes: Option<usize>, pdi: &mut Pdi<'_>) {
        if let Some(message) = length_bytes.and_then(|length| self.reply.get(..length)) {
            self.sent = pdi.fill_mailbox(SmIndex::MAILBOX_SEND, message);
        }
    }
}
