//! Mailbox services: request bytes in, reply bytes or abort code out.
//!
//! [`Mailbox`] answers what a master has put into SyncManager 0, and hands out what goes into the other
//! one. It knows neither the slave controller nor the unit: values come from an [`objects::ObjectServer`].
//! After construction it allocates nothing.

mod abort_profile;
mod checks;
mod emergencies;
mod info;
mod mailbox;
mod outbox;
mod sdo;

pub use abort_profile::AbortProfile;
pub use emergencies::EmergencyLost;
pub use mailbox::{Mailbox, MailboxSizes};
