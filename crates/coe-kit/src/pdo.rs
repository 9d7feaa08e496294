//! PDO mapping and PDO assignment: the objects that masters write, and the settings that they hold.
//!
//! An assignment object, 1C10 to 1C2F, lists the PDOs of one SyncManager; a PDO mapping object lists the entries of one
//! PDO. Which of them a unit has, and how many elements each has room for, is in its object table.

mod assignment;
mod entry;
mod objects;
mod settings;

pub use assignment::assignment_object;
pub use entry::PdoEntry;
pub use objects::PdoObjects;
pub use settings::{PdoSettings, PlacedEntry};
