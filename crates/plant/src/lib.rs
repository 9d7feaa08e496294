//! Units of any model: the registry of models and their words, unit files of any model, units that get power; and the line
//! to them: cables, and faults of frames.
//!
//! [`UnitFile`] reads a unit file and [`UnitFile::power_on`] makes a unit with its CPU Unit of it. This is the one
//! composition for twins, real lines and scenarios.

mod dice;
mod file;
mod happening;
pub mod line;
pub mod notation;
mod observer;
mod powered;
mod registry;
mod words;

pub use dice::Dice;
pub use file::UnitFile;
pub use happening::{Happening, HappeningKind, Mapping};
pub use observer::{MASTER_GONE_AFTER, Observer, mappings, of_line, port_condition};
pub use powered::{PowerConditions, Powered};
pub use registry::{
    ErrorLog, Fault, Indicators, Lights, LogRecord, default_model, error_log, indicators, models, unit_file,
};
pub use words::{event, has_fault, stored_logs};
