//! The pool of random steps: sentences with marks for what is drawn, in groups.
//!
//! [`GROUPS`] and [`MARKS`] are also the reference of the pool.

mod groups;
mod known;
mod marks;
mod rows;

pub use groups::{GROUPS, Group};
pub use marks::{MARKS, Mark};
pub use rows::{EVERYDAY, PoolRow, ROWS};

pub(crate) use known::KnownUnit;
pub(crate) use marks::Drawing;
