//! One EtherCAT slave controller of the ET1100 class, with its ECAT side and its PDI side.
//!
//! The ECAT side reads and writes memory through datagrams ([`Esc::read`], [`Esc::write`], the logical
//! commands) and closes each frame with [`Esc::end_of_frame`]; the application uses [`Pdi`]. The controller
//! does not interpret mailbox messages or process data, and it never reads a clock.

mod commit;
mod config;
mod dc;
mod ecat;
mod esc;
mod events;
mod fmmu;
mod live;
mod logical;
mod memory;
mod passage;
mod pdi;
mod ports;
mod registers;
mod shadow;
mod sii;
mod sync_manager;
mod watchdog;

pub use config::{EscConfig, PortKind, SiiTiming, SyncManagerWrites};
pub use ecat::Access;
pub use esc::{Changes, Esc};
pub use events::{AlEvents, EcatEvents};
pub use fmmu::Fmmu;
pub use passage::Passage;
pub use pdi::Pdi;
pub use ports::{LoopState, Port, PortStatus};
pub use registers::{EcatAccess, Effect, PdiAccess, REGISTERS, Register};
pub use sync_manager::{SmDirection, SmIndex, SmMode, SyncManager, SyncManagerSettings};
