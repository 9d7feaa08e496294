//! Words with a meaning in at least one model.

use unit_model::{EventCode, EventInfo, MemoryDamage, Model, StoredLogs};

use crate::registry::models;

/// The event with this code, from the first model that has it.
#[must_use]
pub fn event(code: EventCode) -> Option<EventInfo> {
    models().iter().find_map(|model| model.event(code))
}

/// Whether a model has a fault with this name.
#[must_use]
pub fn has_fault(name: &str) -> bool {
    models().iter().any(|model| model.faults().contains(&name))
}

/// The event logs in a stored non-volatile memory, and the model of its unit.
///
/// # Errors
/// The bytes are not the memory of a unit, or it is damaged.
pub fn stored_logs(memory: &[u8]) -> Result<(&'static dyn Model, StoredLogs), MemoryDamage> {
    for model in models() {
        match model.stored_logs(memory) {
            Err(MemoryDamage::NoMemory) => {}
            read => return read.map(|logs| (*model as &dyn Model, logs)),
        }
    }
    Err(MemoryDamage::NoMemory)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_models_are_different() {
        let names: std::collections::BTreeSet<_> = models().iter().map(|model| model.name()).collect();
        assert_eq!(names.len(), models().len());
    }

    #[test]
    fn words_of_a_model_are_known_and_others_are_not() {
        let event = event(EventCode(0x8500_0000)).map(|event| event.name);
        assert_eq!(event, Some("Process Data WDT Error"));
        assert_eq!(super::event(EventCode(1)), None);
        assert!(has_fault("Processing") && !has_fault("processing"));
    }
}
