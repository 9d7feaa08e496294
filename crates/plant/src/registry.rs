//! The models of the house. No other file above the models names one.

use unit_model::Model;

/// All models, in the order in which they are shown.
const MODELS: &[&dyn Model] = &[&nx_ect101::MODEL, &digital::MODEL];

/// All models.
#[must_use]
pub const fn models() -> &'static [&'static dyn Model] {
    MODELS
}
