//! Types and function blocks of the library, which are written in Structured Text.

use std::sync::LazyLock;

use crate::elementary::Elementary;
use crate::problems::Problems;
use crate::syntax::ast::File;
use crate::syntax::parse;

const BLOCKS: &str = include_str!("../prelude.st");
const COUNTERS: &str = include_str!("../counters.st");

/// The types of PV and CV for which there are counters, and the endings of the names of these counters (W502,
/// counter instructions).
pub(super) const COUNTER_TYPES: [(&str, Elementary); 5] = [
    ("", Elementary::Int),
    ("_DINT", Elementary::Dint),
    ("_LINT", Elementary::Lint),
    ("_UDINT", Elementary::Udint),
    ("_ULINT", Elementary::Ulint),
];

/// The tree of all of them; read once.
pub(crate) static PRELUDE: LazyLock<File> = LazyLock::new(|| {
    let text = text();
    let (file, wrong) = parse(&text);
    assert!(wrong.is_empty(), "the library's own blocks: {}", Problems::new(&text, wrong));
    file
});

fn text() -> String {
    let counters = COUNTER_TYPES.iter().map(|(ending, elementary)| {
        COUNTERS.replace("_SUFFIX", ending).replace(" TYPE;", &format!(" {elementary};"))
    });
    core::iter::once(BLOCKS.to_owned()).chain(counters).collect()
}
