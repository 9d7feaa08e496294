//! The language of steps: the orders of each addressee. Each table is also the reference of its sentences.

mod act;
mod condition;
mod cpu;
mod line;
mod master;
mod quantity;
mod unit;

pub use act::ACTS;
pub use condition::CONDITIONS;
pub use cpu::CPU;
pub use line::LINE;
pub use master::MASTER;
pub use quantity::QUANTITIES;
pub use unit::UNIT;
