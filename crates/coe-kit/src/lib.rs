//! Parts shared by unit models, each driven by the tables of the model.

pub mod exchange;
pub mod history;
pub mod indicators;
pub mod object_rows;
pub mod pdo;
