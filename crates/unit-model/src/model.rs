//! A unit model: its name, and its words.

use crate::event::{EventCode, EventInfo};

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

    /// The names of the indicators.
    fn indicators(&self) -> &'static [&'static str] {
        &[]
    }

    /// The names of the switches that can be set by hand.
    fn switches(&self) -> &'static [&'static str] {
        &[]
    }
}
