//! Copies of the last messages, for a master that did not receive one (ETG.1000.4, mailbox repeat).

/// Which message is in the master's mailbox.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum InMailbox {
    Nothing,
    Newest,
    Repeated,
}

/// The message that the master read last, and the newest one.
#[derive(Debug)]
pub(crate) struct Outbox {
    read: Vec<u8>,
    newest: Vec<u8>,
    in_mailbox: InMailbox,
    /// The newest message was replaced by a repeated one.
    newest_waits: bool,
}

impl Outbox {
    pub(crate) fn new(capacity_bytes: usize) -> Self {
        Self {
            read: Vec::with_capacity(capacity_bytes),
            newest: Vec::with_capacity(capacity_bytes),
            in_mailbox: InMailbox::Nothing,
            newest_waits: false,
        }
    }

    pub(crate) fn clear(&mut self) {
        self.read.clear();
        self.newest.clear();
        self.in_mailbox = InMailbox::Nothing;
        self.newest_waits = false;
    }

    /// `message` is put into the mailbox.
    pub(crate) fn sent(&mut self, message: &[u8]) {
        self.newest.clear();
        self.newest.extend_from_slice(message);
        self.in_mailbox = InMailbox::Newest;
        self.newest_waits = false;
    }

    /// The master has read the mailbox.
    pub(crate) fn confirm_read(&mut self) {
        if self.in_mailbox == InMailbox::Newest {
            core::mem::swap(&mut self.read, &mut self.newest);
        }
        self.in_mailbox = InMailbox::Nothing;
    }

    /// The message that the master read last, again; none if it has read none.
    pub(crate) fn repeat(&mut self, message: &mut [u8]) -> Option<usize> {
        let length_bytes = copy(&self.read, message)?;
        self.newest_waits |= self.in_mailbox == InMailbox::Newest;
        self.in_mailbox = InMailbox::Repeated;
        Some(length_bytes)
    }

    /// The newest message, if it was replaced by a repeated one.
    pub(crate) fn take_waiting(&mut self, message: &mut [u8]) -> Option<usize> {
        if !self.newest_waits {
            return None;
        }
        self.newest_waits = false;
        self.in_mailbox = InMailbox::Newest;
        copy(&self.newest, message)
    }

    pub(crate) fn is_waiting(&self) -> bool {
        self.newest_waits
    }
}

fn copy(kept: &[u8], message: &mut [u8]) -> Option<usize> {
    if kept.is_empty() {
        return None;
    }
    message.get_mut(..kept.len())?.copy_from_slice(kept);
    Some(kept.len())
}
