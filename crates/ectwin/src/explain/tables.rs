//! The unit model whose tables are explained, and searches in them.

use unit_model::tables::{EventRow, NxObject};
use unit_model::{EventCode, ModelTables};
use wire::{AlStatusCode, ObjectIndex};

/// The tables of the default model.
pub(super) fn tables() -> &'static ModelTables {
    plant::default_model().tables()
}

/// The event with this code.
pub(super) fn event(code: EventCode) -> Option<&'static EventRow> {
    tables().events.iter().find(|event| event.code == code)
}

/// The events with this AL status code.
pub(super) fn events_of_al_status(code: AlStatusCode) -> impl Iterator<Item = &'static EventRow> {
    tables().events.iter().filter(move |event| event.al_status_code == Some(code))
}

/// The events with this emergency error code.
pub(super) fn events_of_emergency(code: u16) -> impl Iterator<Item = &'static EventRow> {
    tables().events.iter().filter(move |event| event.emergency.is_some_and(|known| known.code == code))
}

/// The NX object at `index`.
pub(super) fn nx_object(index: ObjectIndex) -> Option<&'static NxObject> {
    tables().nx_objects.iter().find(|object| object.index == index)
}

/// The heading over what is particular about the model.
pub(super) fn in_the_model() -> String {
    format!("In the {}", tables().device)
}
