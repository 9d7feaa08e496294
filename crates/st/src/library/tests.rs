//! The table, and what the functions and blocks of the library do.

mod blocks;
