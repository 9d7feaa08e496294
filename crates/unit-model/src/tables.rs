//! The tables of a model for people and programs: what lists show, and what explanations and pages are made of.
//!
//! A model gives typed rows; it explains its own events, because only it knows their channels. Code above the models
//! shows them, and names no model.

mod al_status;
mod event;
mod facts;
mod indicator;
mod nx_object;
mod record;
mod rule;

use std::sync::Arc;

use coe_kit::indicators::Pattern;
use esi::NamedBit;
use objects::ObjectTable;

pub use al_status::{AlStatusNote, VendorAlStatusCode};
pub use event::{EmergencyCode, EventRow};
pub use facts::{Advice, EntryFact, Fact, Section};
pub use indicator::{Colour, IndicatorRow, StatusRow};
pub use nx_object::{NxAccess, NxEntry, NxObject};
pub use record::Record;
pub use rule::{RuleEvent, RuleRow};

/// The tables of a model. A part that a model does not have is empty. Rows are in the order in which they are shown.
#[derive(Debug, Default)]
pub struct ModelTables {
    /// The device in the words of its maker, such as an order code.
    pub device: &'static str,
    /// The CoE object dictionary, if it is the same for all units of the model.
    pub objects: Arc<ObjectTable>,
    /// Bits of its entries that have names of their own in the tools of the maker.
    pub named_bits: &'static [NamedBit],
    /// Further facts about entries of the dictionary.
    pub entry_facts: Vec<EntryFact>,
    /// The NX objects, ascending by index.
    pub nx_objects: &'static [NxObject],
    /// Further facts about their entries.
    pub nx_entry_facts: Vec<EntryFact>,
    /// The events.
    pub events: Vec<EventRow>,
    /// When an emergency message is sent for an event that can have one.
    pub emergencies_are_sent: &'static str,
    /// AL status codes that are in no standard.
    pub al_status_codes: &'static [VendorAlStatusCode],
    /// What the model adds to the advice for AL status codes of the standard.
    pub al_status_notes: &'static [AlStatusNote],
    /// The indicators, in their order on the front.
    pub indicators: Vec<IndicatorRow>,
    /// The document with the times of each pattern that is in no standard.
    pub pattern_sources: Vec<(Pattern, &'static str)>,
    /// The setting rules, in the order in which they are checked.
    pub rules: Vec<RuleRow>,
    /// All keys and sections of its unit files, as paths with dots. Of `cpu` there is only the section.
    pub keys: Vec<String>,
}

impl ModelTables {
    /// The document with the times of a pattern: the standard, or one of the maker; none for a steady pattern.
    #[must_use]
    pub fn pattern_source(&self, pattern: Pattern) -> Option<&'static str> {
        let of_model = || self.pattern_sources.iter().find(|(known, _)| *known == pattern);
        pattern.standard().or_else(|| of_model().map(|(_, source)| *source))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_of_the_standard_come_before_those_of_a_maker() {
        let pattern_sources = vec![(Pattern::Blinking, "manual"), (Pattern::Flashing1s, "manual")];
        let tables = ModelTables { pattern_sources, ..ModelTables::default() };
        assert_eq!(tables.pattern_source(Pattern::Blinking), Some("ETG.1300"));
        assert_eq!(tables.pattern_source(Pattern::Flashing1s), Some("manual"));
        assert_eq!(tables.pattern_source(Pattern::Flashing2s), None);
    }
}
