//! The slave stack: state machine, mailbox and objects on an ESC; the trait that a unit implements.
//!
//! This crate is independent of the unit model. A [`Unit`] provides the objects and the process data, a
//! [`DeviceConfig`] the layout; a [`Network`] is a line of such slaves that frames pass.

mod action;
mod agenda;
mod conditions;
mod conduct;
mod config;
mod device;
mod machine;
mod mailbox_service;
mod network;
mod power;
mod process_image;
mod settings;
mod state_machine;
mod sync_managers;
mod sync_mode;
mod unit;

pub use action::Action;
pub use conditions::{Condition, PROCESS_DATA, Requirement, WATCHED_PROCESS_DATA, condition};
pub use conduct::{Conduct, Refusals, TransitionTimes};
pub use config::{ConfigError, DeviceConfig, OutputsBeforeOp, RefusedInOp, StartUp};
pub use device::Device;
pub use esc::{EscConfig, PortKind, SiiTiming, SmIndex, SyncManagerWrites};
pub use mailbox::AbortProfile;
pub use network::Network;
pub use segment::FrameFate;
pub use state_machine::{Check, TRANSITIONS, Transition, refusal, transition};
pub use sync_managers::{
    Area, Buffers, DataDirection, DataLength, MailboxAreas, MailboxConfig, ProcessDataConfig, ProcessDataList,
};
pub use sync_mode::SyncMode;
pub use unit::{Exchange, PortLinks, RefreshCause, Start, Unit};
