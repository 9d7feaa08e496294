//! Behaviours: what variables of a unit do by themselves, as sensors and actuators at its terminals would.
//!
//! They are an outside program of the CPU Unit: they run in every task period, in RUN and in PROGRAM mode, before the
//! user program, which can write the same variables again. A forced value stays.

mod course;
mod keys;
mod named_variables;
mod player;
mod read;
mod section;
mod signal;
mod table;

pub use course::{CSV_BYTES_MAX, Course, CsvProblem};
pub use player::Behaviours;
pub use read::BEHAVIOUR_KEYS;
pub use section::{Behaviour, BehaviourSection, CsvKeys, Does, Loop};
pub use signal::Signal;
pub use table::{BEHAVIOURS, BehaviourKey, BehaviourRow, LeftOut};
