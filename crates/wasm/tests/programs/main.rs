//! Programs in WebAssembly on a CPU Unit: what they see, what stops them, and what is refused.

mod bench;
mod faults;
mod page;
mod variables;
mod wrong_modules;
