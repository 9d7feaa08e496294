//! A unit for the crates above, independent of its model.

use core::any::Any;
use core::fmt::{self, Debug};

use coe_kit::indicators::Pattern;
use device::Unit;

use crate::event::{CurrentError, EventCode, EventLevel, EventLog, LevelNotChangeable, RecordedEvent};
use crate::model::Model;
use crate::slave_view::SlaveView;

/// A unit with power. The slave stack uses [`Unit`]; this is the internal side, which is not visible to masters.
pub trait ModelUnit: Unit + Any + Debug + Send {
    /// The model, with its words.
    fn model(&self) -> &'static dyn Model;

    /// Whether the process data of each direction can be used.
    fn data_valid(&self) -> DataValid;

    /// Takes the oldest event that has not been taken yet. A unit keeps a bounded number of them.
    fn take_event(&mut self) -> Option<RecordedEvent> {
        None
    }

    /// The faults whose causes are injected at present: bit `n` is the one at this place of [`Model::faults`].
    fn injected_faults(&self) -> u32 {
        0
    }

    /// The current errors of a level, the oldest first.
    fn current_errors(&self, _level: EventLevel) -> &[CurrentError] {
        &[]
    }

    /// The error status that the unit shows to masters; 0: no error.
    fn error_status(&self) -> u8 {
        0
    }

    /// Whether the diagnosis history has messages that have not been acknowledged.
    fn has_new_messages(&self) -> bool {
        false
    }

    /// A user resets the errors. An error whose cause persists occurs again.
    fn reset_errors(&mut self) {}

    /// A user changes the level of an event, in force from the next start of the unit on.
    ///
    /// # Errors
    /// [`LevelNotChangeable`].
    fn set_event_level(&mut self, _code: EventCode, _level: EventLevel) -> Result<(), LevelNotChangeable> {
        Err(LevelNotChangeable)
    }

    /// A user clears a log.
    fn clear_event_log(&mut self, _log: EventLog) {}

    /// The events in a log, the oldest first.
    fn logged(&self, _log: EventLog) -> Vec<EventCode> {
        Vec::new()
    }

    /// The event of a message of the diagnosis history 10F3, by its number from 1, which is subindex 0x06; none if there
    /// is no such message.
    fn diagnosis_message(&self, _number: u8) -> Option<EventCode> {
        None
    }

    /// The number of the newest message of the diagnosis history; none if it is empty.
    fn newest_diagnosis_message(&self) -> Option<u8> {
        None
    }

    /// The cause of a fault appears.
    ///
    /// # Errors
    /// The model has no fault with this name.
    fn inject(&mut self, _fault: &str) -> Result<(), NotThere> {
        Err(NotThere)
    }

    /// The cause of a fault disappears.
    ///
    /// # Errors
    /// The model has no fault with this name.
    fn remove(&mut self, _fault: &str) -> Result<(), NotThere> {
        Err(NotThere)
    }

    /// Sets a switch.
    ///
    /// # Errors
    /// The model has no switch with this name, or the switch has no such position.
    fn set_switch(&mut self, _switch: &str, _position: u16) -> Result<(), NotThere> {
        Err(NotThere)
    }

    /// The pattern of an indicator while the unit has power; none if the model has no indicator with this name.
    fn indicator(&self, _name: &str, _slave: &SlaveView) -> Option<Pattern> {
        None
    }

    /// Copies the changes of the EEPROM, to which the master has written `sii_words_written` words since
    /// power-on. Returns whether the non-volatile memory must be stored now.
    fn take_memory_change(&mut self, _sii_image: &[u8], _sii_words_written: u32) -> bool {
        false
    }

    /// Writes the non-volatile memory to `bytes`, replacing their contents.
    fn encode_memory(&self, bytes: &mut Vec<u8>) {
        bytes.clear();
    }
}

impl dyn ModelUnit {
    /// The unit as its model's type, for code that knows the model.
    #[must_use]
    pub fn as_model<M: ModelUnit>(&self) -> Option<&M> {
        (self as &dyn Any).downcast_ref()
    }

    /// The same, for changes.
    pub fn as_model_mut<M: ModelUnit>(&mut self) -> Option<&mut M> {
        (self as &mut dyn Any).downcast_mut()
    }
}

/// Whether the process data of each direction can be used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DataValid {
    /// From the master.
    pub outputs: bool,
    /// To the master.
    pub inputs: bool,
}

/// The model has no item with this name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotThere;

impl fmt::Display for NotThere {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("the model of the unit has nothing of this name")
    }
}

impl core::error::Error for NotThere {}
