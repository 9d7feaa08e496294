//! An EtherCAT master without I/O: time and frames are arguments.
//!
//! A [`Master`] finds the slaves of a line, sets them up according to their SII or ESI, transfers SDOs and
//! exchanges process data. The caller gets frames from [`Master::transmit`], passes the answers to
//! [`Master::receive`], and calls again at [`Master::deadline`].
//!
//! All communication of a master with a slave is a [`Dialogue`]: one access at a time, without a clock. Each
//! dialogue can be used separately, also for sequences that a correct master never uses: by [`DirectAccess`] in virtual
//! time.
//!
//! A master of another kind is made of the same parts: a [`Runner`] for the dialogues of a slave, [`Load`] and [`Flights`]
//! for the frames, [`ProcessData`] for the cycle, [`Habits`] for what masters do differently.

mod access;
mod arrival;
mod channels;
mod connected;
mod direct_access;
mod event;
mod flight;
mod habits;
mod information;
mod job;
mod load;
mod mailbox;
mod master;
mod part;
mod process_data;
mod queue;
mod reaction;
mod register;
pub mod registers;
mod runner;
mod sdo;
mod sdo_information;
mod search;
mod sender;
mod service;
mod settings;
mod sii;
mod slave;
mod state;
mod walk;

pub use access::{Access, Address, Answer, Dialogue, Patience, Progress, Wait};
pub use arrival::Arrival;
pub use channels::{FmmuSettings, SyncManagerSettings};
pub use connected::{Connected, Line};
pub use direct_access::DirectAccess;
pub use event::{Event, Failure, Outcome, RequestId};
pub use flight::{Flights, Ticket};
pub use habits::{Addressing, Habits, Indexes, TimeOuts};
pub use information::{DlStatus, EscFeatures, EscInformation};
pub use load::Load;
pub use mailbox::{Counter, LostRead, MailboxConduct, MailboxDialogue, Reading};
pub use master::Master;
pub use part::Part;
pub use process_data::{Commands, CycleReport, Exchange, Grouping, ProcessData, StatusRead};
pub use reaction::ServiceFailure;
pub use register::{RegisterRead, RegisterWrite};
pub use runner::{Pace, Runner};
pub use sdo::SdoTransfer;
pub use sdo_information::SdoInformation;
pub use search::Search;
pub use service::{Message, RawMessage, Reply, Service};
pub use settings::{
    DeviceIdSource, Direction, MailboxSettings, ProcessDataArea, RegisterSetting, SlaveSettings, StartUpSdo,
};
pub use sii::{SiiFailure, SiiReader};
pub use slave::Slave;
pub use state::{AlReport, DeviceIdRequest, StateRequest};
