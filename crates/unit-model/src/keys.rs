//! The keys of a unit file that every model has: `name`, `serial`, `alias`, `timing`, `start_up`, `refresh_phase`,
//! `outputs_before_op`, `blank_sii`, `[times]`, `[refuse]`.
//!
//! A model reads them with [`CommonKeys::read`] together with its own; [`KEYS`] is their list.

mod common;
mod slave;
mod times;
mod timing;

pub use common::{CommonKeys, KEYS};
pub use slave::{
    AL_STATUS_CODES, AL_STATUS_CODES_WORDS, OutputsRule, Shape, SlaveKeys, refuse_keys, times_keys,
    transition_keys,
};
pub use times::{TIMES, TIMES_WORDS};
pub use timing::Timing;

#[cfg(test)]
mod tests;
