//! A unit model: its name, its words, its tables.

use std::sync::LazyLock;

use variables::VariableTable;

use crate::event::{EventCode, EventInfo, EventLog};
use crate::stored_log::{MemoryDamage, StoredLogs};
use crate::tables::ModelTables;

/// A unit model. Lists are in the order in which they are shown.
pub trait Model: Sync {
    /// The name that unit files use: `model = "…"`.
    fn name(&self) -> &'static str;

    /// The event with this code; none if the model has no such event.
    fn event(&self, _code: EventCode) -> Option<EventInfo> {
        None
    }

    /// The names of the faults that can be injected into a unit.
    fn faults(&self) -> &'static [&'static str] {
        &[]
    }

    /// Whether a fault occurs only in a unit that has power, such as a failure of its software. The causes of the others
    /// also appear without power, and are found at the next start.
    fn is_fault_of_operation(&self, _fault: &str) -> bool {
        false
    }

    /// Whether a fault is a single occurrence, such as a lost message: it can occur again at any time, and its cause does
    /// not persist.
    fn is_single_fault(&self, _fault: &str) -> bool {
        false
    }

    /// The most records that a log of a unit holds; none for a model without a limit.
    fn records_max(&self, _log: EventLog) -> Option<usize> {
        None
    }

    /// The names of the indicators.
    fn indicators(&self) -> &'static [&'static str] {
        &[]
    }

    /// The names of the switches that can be set by hand.
    fn switches(&self) -> &'static [&'static str] {
        &[]
    }

    /// Its tables, for lists, explanations and pages.
    fn tables(&self) -> &'static ModelTables {
        static NONE: LazyLock<ModelTables> = LazyLock::new(ModelTables::default);
        &NONE
    }

    /// The event logs in a stored non-volatile memory.
    ///
    /// # Errors
    /// The bytes are not the memory of a unit of this model.
    fn stored_logs(&self, _memory: &[u8]) -> Result<StoredLogs, MemoryDamage> {
        Err(MemoryDamage::NoMemory)
    }

    /// Tables of variables that together have each variable of the model, for units with its usual name.
    fn every_variable(&self) -> Vec<VariableTable> {
        Vec::new()
    }
}
