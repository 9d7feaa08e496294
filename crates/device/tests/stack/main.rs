//! The slave stack around small units, by hand-made frames.

mod actions;
mod bench;
mod boot;
mod bytes;
mod conduct;
mod descriptions;
mod faults;
mod one_direction;
mod outputs_before_op;
mod polling;
mod process_data;
mod states;
