//! The structure of sources, the problems reported for broken ones, and that any source is handled.

mod accepted;
mod broken;
mod declared;
mod literals;
mod manual;
mod printed;
mod properties;
mod spans;

use super::{ast::File, parse};
use crate::problems::Problems;

/// The problems of a source, one line each.
fn told(source: &str) -> String {
    let (_, problems) = parse(source);
    Problems::new(source, problems).to_string()
}

/// The tree of a source without problems.
#[track_caller]
fn read(source: &str) -> File {
    let (file, problems) = parse(source);
    assert!(problems.is_empty(), "{source}\n{}", Problems::new(source, problems));
    file
}
