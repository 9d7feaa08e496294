//! Our own checks: cargo xtask ci.
fn main() {}
