//! What sources say, what is told of broken ones, and that no source is too much.

mod accepted;
mod broken;
mod declared;
mod literals;
mod manual;
mod printed;
mod properties;
mod spans;

use super::{ast::File, parse};
use crate::problem::Problems;

/// The problems of a source, a line for each.
fn told(source: &str) -> String {
    let (_, problems) = parse(source);
    Problems::new(source, problems).to_string()
}

/// The tree of a source in which nothing is wrong.
#[track_caller]
fn read(source: &str) -> File {
    let (file, problems) = parse(source);
    assert!(problems.is_empty(), "{source}\n{}", Problems::new(source, problems));
    file
}
