//! The elementary types of IEC 61131-3: their names, their sizes, the values of dates.
//!
//! Variables of a CPU Unit and programs in Structured Text share these types.

pub mod calendar;
pub mod elementary;

pub use elementary::{Class, Elementary};
