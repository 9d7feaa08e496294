//! The language of steps: who may be told what. Each table is also the reference of its sentences.

mod cpu;
mod expect;
mod line;
mod master;
mod unit;

pub use cpu::CPU;
pub use expect::CONDITIONS;
pub use line::LINE;
pub use master::MASTER;
pub use unit::UNIT;
