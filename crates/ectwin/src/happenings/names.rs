//! The units of a line by their names.

use unit_model::{Model, UnitSection};

/// Name and model of a unit.
#[derive(Clone)]
pub(crate) struct UnitName {
    pub(crate) name: String,
    pub(crate) model: &'static dyn Model,
}

impl UnitName {
    pub(crate) fn of(section: &dyn UnitSection) -> Self {
        Self { name: section.name().to_owned(), model: section.model() }
    }
}

impl std::fmt::Debug for UnitName {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "{} ({})", self.name, self.model.name())
    }
}
