//! The table, its places and its texts.

mod table;
mod text;
