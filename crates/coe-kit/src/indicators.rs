//! Indicators of ETG.1300: patterns of light over time, and the states of RUN, ERR and L/A (reference 9).
//!
//! A model adds its own indicators, and its own rows if its documents differ from the standard.

mod pattern;
mod standard;

pub use pattern::Pattern;
pub use standard::{PortCondition, err, run};
