//! What a scenario needs before it can run: its units and programs, and steps that name what is there.

mod files;
mod master;
mod nodes;
mod reach;
mod resolve;
mod units;

pub use files::Files;
pub(crate) use files::Texts;
pub(crate) use reach::{line_of, unit_of_cpu, unit_of_master, unit_of_unit};
