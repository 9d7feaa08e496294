//! The slave stack: state machine, mailbox and objects on an ESC; the trait that a unit implements.
//!
//! Nothing here knows which unit it carries. A [`Unit`] gives the objects and the process data, a
//! [`DeviceConfig`] the layout; a [`Network`] is a line of such slaves that frames pass.

mod checks;
mod conduct;
mod config;
mod device;
mod mailbox_service;
mod network;
mod power;
mod state_machine;
mod unit;

pub use conduct::{Conduct, Refusals, TransitionTimes};
pub use config::{Area, DeviceConfig, MailboxConfig, OutputsBeforeOp, RefusedInOp, StartUp, WatchdogCheck};
pub use device::Device;
pub use esc::{EscConfig, SiiTiming, SyncManagerWrites};
pub use mailbox::AbortProfile;
pub use network::Network;
pub use segment::FrameFate;
pub use state_machine::{Check, TRANSITIONS, Transition, refusal, transition};
pub use unit::{Exchange, PortLinks, ProcessDataAreas, RefreshCause, Start, Unit};
