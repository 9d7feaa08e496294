//! The table, and the behaviour of the functions and blocks of the library.

mod arguments;
mod bench;
mod bits;
mod blocks;
mod memory;
mod numbers;
mod nx_blocks;
mod system;
mod table;
mod texts;
mod timers;
mod value_text;
