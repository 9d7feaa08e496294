//! Units of any model: the registry of models and their words, unit files of any model, units that get power.
//!
//! [`UnitFile`] reads a unit file and [`UnitFile::power_on`] makes a unit with its CPU Unit of it. This is the one
//! composition for twins, real lines and scenarios.

mod powered;
mod registry;
mod unit_file;
mod words;

pub use powered::{PowerConditions, Powered};
pub use registry::{ErrorLog, Indicators, error_log, indicators, models};
pub use unit_file::UnitFile;
pub use words::{event, has_fault};
