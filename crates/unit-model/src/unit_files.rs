//! The unit files of a model.

use std::sync::Arc;

use user_file::{Reader, Section};

use crate::model::Model;
use crate::section::UnitSection;

/// A model that reads unit files.
pub trait UnitFiles: Model {
    /// The keys at the top of its unit files.
    fn keys(&self) -> Vec<&'static str>;

    /// Reads a unit file of this model. None if nothing can be read; what is wrong is refused by `reader`.
    fn read(&self, reader: &mut Reader<'_>, file: &Section<'_, '_>) -> Option<Arc<dyn UnitSection>>;
}
