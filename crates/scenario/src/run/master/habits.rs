//! How the scripted master treats mailboxes, right or wrong.

/// How it treats mailboxes.
#[derive(Debug, Default)]
pub(crate) struct MailboxHabits {
    pub(super) counter: u8,
    pub(super) stuck_counter: Option<u8>,
    pub(super) reads_nothing: bool,
}

impl MailboxHabits {
    pub(super) fn next_counter(&mut self) -> u8 {
        self.counter = self.counter % 7 + 1;
        self.stuck_counter.unwrap_or(self.counter) & 7
    }

    pub(crate) const fn reads_nothing(&self) -> bool {
        self.reads_nothing
    }
}
