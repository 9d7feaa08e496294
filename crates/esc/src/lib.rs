//! One EtherCAT slave controller of the ET1100 class, with two faces: the wire and the PDI.
//!
//! The wire reads and writes memory through datagrams ([`Esc::read`], [`Esc::write`], the logical
//! commands) and closes each frame by [`Esc::end_of_frame`]; the application works through [`Pdi`]. The
//! controller never knows what a mailbox says or what the process data mean, and it asks nobody what time
//! it is.

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
pub use esc::Esc;
pub use events::{AlEvents, EcatEvents};
pub use fmmu::Fmmu;
pub use passage::Passage;
pub use pdi::Pdi;
pub use ports::{LoopState, Port, PortStatus};
pub use registers::{EcatAccess, Effect, PdiAccess, REGISTERS, Register};
pub use sync_manager::{SmDirection, SmIndex, SmMode, SyncManager, SyncManagerSettings};
