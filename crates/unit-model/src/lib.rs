//! What a unit model gives to the house: its name and its words ([`Model`]), and a view of its units that knows no
//! model ([`ModelUnit`]).
//!
//! Whoever runs a line holds `Box<dyn ModelUnit>`: faults, events, indicators and switches are looked up by their names
//! and codes, and [`Model`] lists them. A model that has none of something leaves the method out.

mod event;
mod model;
mod section;
mod slave_view;
mod unit;
mod unit_files;

pub use event::{CurrentError, EventCode, EventInfo, EventLevel, EventLog, LevelNotChangeable};
pub use model::Model;
pub use section::{MemoryAtPowerOn, MemoryDamage, PowerOn, PoweredUnit, UnitSection};
pub use slave_view::SlaveView;
pub use unit::{DataValid, ModelUnit, NotThere};
pub use unit_files::UnitFiles;
