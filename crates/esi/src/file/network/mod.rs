//! Network files (ENI, ETG.2100): the slaves of a network, as a configuration tool has written them for a master.

mod commands;
mod network_file;
mod process_data;
mod slave;
mod slave_mailbox;

pub use commands::{CoeCommand, RegisterCommand, Target};
pub use network_file::{Attachment, NetworkFile};
pub use process_data::NetworkSyncManager;
pub use slave::{ExplicitIdentification, NetworkClock, NetworkSlave, PreviousPort};
pub use slave_mailbox::{MailboxBuffer, NetworkMailbox};
