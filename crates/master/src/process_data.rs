//! Process data of all slaves: where they lie in the logical address space, and what they hold.

mod cycle;
mod image;
mod layout;

pub(crate) use cycle::Cycle;
pub use cycle::{Commands, CycleReport, Exchange, StatusRead};
pub(crate) use image::Image;
pub(crate) use layout::Layout;
