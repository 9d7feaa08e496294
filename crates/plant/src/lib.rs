//! Units of any model: the registry of models and their words, unit files of any model, units that get power.
//!
//! [`UnitFile`] reads a unit file and [`UnitFile::power_on`] makes a unit with its CPU Unit of it. This is the one
//! composition for twins, real lines and scenarios.

mod file;
mod powered;
mod registry;
mod words;

pub use file::UnitFile;
pub use powered::{PowerConditions, Powered};
pub use registry::{
    ErrorLog, Fault, Indicators, Lights, LogRecord, default_model, error_log, indicators, models, unit_file,
};
pub use words::{event, has_fault};
