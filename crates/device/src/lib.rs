//! The slave stack: state machine, mailbox and objects on an ESC; the trait that a unit implements.
//!
//! Nothing here knows which unit it carries. A [`Unit`] gives the objects and the process data.

mod unit;

pub use unit::{Exchange, ProcessDataAreas, Unit};
