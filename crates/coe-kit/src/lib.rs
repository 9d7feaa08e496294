//! Parts shared by unit models, each driven by the tables of the model.

pub mod exchange;
pub mod indicators;
pub mod pdo;
