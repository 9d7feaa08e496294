//! Parts that unit models share, each driven by the tables of the model.

pub mod exchange;
pub mod indicators;
pub mod pdo;
