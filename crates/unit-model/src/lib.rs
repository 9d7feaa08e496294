//! The interface of a unit model: its name, its words and its tables ([`Model`], [`ModelTables`]), the keys of every unit
//! file ([`keys`]), and a view of its units that is independent of the model ([`ModelUnit`]).
//!
//! Code that runs a line holds `Box<dyn ModelUnit>`: faults, events, indicators and switches are looked up by their names
//! and codes, and [`Model`] lists them. A model without one of these does not implement the method.

mod event;
pub mod keys;
mod model;
mod section;
mod settings_check;
mod slave_view;
mod stored_log;
pub mod tables;
mod unit;
mod unit_files;

pub use event::{
    AttachedInformation, CurrentError, EventCode, EventInfo, EventLevel, EventLog, LevelNotChangeable,
    RecordedEvent,
};
pub use model::Model;
pub use section::{MemoryAtPowerOn, PowerOn, PoweredUnit, ProcessDataBytes, UnitSection};
pub use settings_check::{DirectionSizes, ExchangedData, FilePlace, SettingsCheck, SettingsFinding};
pub use slave_view::SlaveView;
pub use stored_log::{MemoryDamage, StoredLogs, StoredRecord};
pub use tables::ModelTables;
pub use unit::{DataValid, ModelUnit, NotThere};
pub use unit_files::UnitFiles;
