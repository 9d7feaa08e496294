//! The NX-ECT101 as a unit model: objects, allocation, refresh, files.

mod allocation;
mod config;
mod data_sets;
mod description;
mod dictionary;
mod exchange;
mod identification;
pub mod layout;
mod mapping;
pub mod nx_bus;
mod status;
mod tables;
mod timing;
mod unit;
pub mod unit_file;

pub use allocation::{ImageLayout, IoAllocation, IoEntry, SLAVE_STATUS_BYTES};
pub use config::device_config;
pub use data_sets::{Assignment, DataSet, DataSetKind, Direction, Limits, StatusPdo};
pub use description::description;
pub use status::{NxUnitStatus, SlaveStatus};
pub use tables::object_table;
pub use timing::Timing;
pub use unit::{NxEct101, UnitSettings};
