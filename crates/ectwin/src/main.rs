//! The `ectwin` command.
fn main() {}
