//! The NX-ECT101 as a unit model: objects, allocation, refresh, files.

mod allocation;
mod amounts;
mod config;
mod data_sets;
mod description;
mod diagnosis;
mod dictionary;
mod events;
mod exchange;
mod fault;
mod finding;
mod identification;
mod indicators;
pub mod layout;
mod memory;
mod messages;
mod model;
mod model_tables;
mod named_bits;
mod nx_objects;
mod nx_server;
mod outage;
pub mod pdo_settings;
pub mod performance;
mod rule;
mod rule_kind;
mod rules;
mod settings;
mod settings_check;
mod status;
mod tables;
mod timing;
mod unit;
pub mod unit_file;
mod unit_information;
mod variables;
mod verdict;

pub use allocation::{ImageLayout, IoAllocation, IoEntry, SLAVE_STATUS_BYTES};
pub use config::{device_config, device_config_with};
pub use data_sets::{Assignment, DataSet, DataSetKind, Direction, Limits, StatusPdo};
pub use description::description;
pub use diagnosis::{CURRENT_ERRORS_MAX, DIAGNOSIS_MESSAGE_BYTES, OCCURRED_MAX, current_error_bytes};
pub use events::{
    AttachedInformation, Cause, DetectionTiming, EcatEffect, Event, EventCode, EventLevel, EventLog,
    IndicatorStatus, IoRefreshEffect, Notified, Recovery,
};
pub use exchange::ExchangePlan;
pub use fault::Fault;
pub use finding::{Amount, Fact, Finding};
pub use indicators::{Colour, Indicator, IndicatorCauses, IndicatorMeaning, Indicators, Lights, NxCondition};
pub use memory::{
    ACCESS_RECORDS_MAX, DETAILS_MAX, Damage, ErrorLog, LogRecord, MemoryAtPowerOn, NonVolatileMemory,
    SYSTEM_RECORDS_MAX,
};
pub use messages::MESSAGE_BYTES;
pub use model::MODEL;
pub use nx_bus::SlaveStatus;
pub use nx_objects::{NxAccess, NxEntry, NxObject, nx_object, nx_objects};
pub use outage::Outage;
pub use rule::Rule;
pub use rule_kind::{Moment, RuleEvents, RuleId, Side};
pub use rules::RULES;
pub use settings::{EventLevels, LevelNotChangeable, NewestAcknowledged, UnitSettings};
pub use status::{MINOR_FAULT_BIT, NxUnitStatus, OBSERVATION_BIT, SLAVE_STATUS_BITS, StatusBit};
pub use tables::object_table;
pub use timing::slave_period;
pub use unit::NxEct101;
pub use unit_information::{UnitInformation, UnitVersion, VersionText};
pub use unit_model::CurrentError;
pub use unit_model::keys::{OutputsRule, SlaveKeys, Timing};
pub use variables::variable_table;
pub use verdict::{Configuration, ExchangedDataSet, Verdict};
pub use wire::{ObjectIndex, SubIndex};
