//! Programs in WebAssembly on a CPU Unit: what they see, what ends them, and what is refused.

mod bench;
mod faults;
mod page;
mod variables;
mod wrong_modules;
