//! Scenarios as plain values: steps, orders and conditions. No parsing, and nothing of the world that they are about.

mod condition;
mod cpu;
mod line;
mod master;
mod spelling;
mod step;
mod unit;
mod units;

pub use condition::{Condition, IndicatorName};
pub use cpu::CpuOrder;
pub use line::{Choice, Disturbance, FrameFault, FrameKind, LineOrder};
pub use master::MasterOrder;
pub(crate) use spelling::{StateName, hex};
pub use step::{Expectation, Mode, Order, Trigger};
pub use unit::{ConductOrder, UnitOrder};
pub use units::{Controller, UnitSet};
