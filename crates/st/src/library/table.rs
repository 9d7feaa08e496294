//! All functions, group by group.

use super::function::Function;
use super::{bits, comparisons, logic, memory, numbers, nx, selection, system, texts, time};

/// Every group with its name in the documents.
pub(super) const GROUPS: [(&str, &[Function]); 10] = [
    ("numbers", numbers::FUNCTIONS),
    ("logic", logic::FUNCTIONS),
    ("comparison", comparisons::FUNCTIONS),
    ("selection", selection::FUNCTIONS),
    ("bit strings", bits::FUNCTIONS),
    ("texts", texts::FUNCTIONS),
    ("memory", memory::FUNCTIONS),
    ("time", time::FUNCTIONS),
    ("errors", system::FUNCTIONS),
    ("NX objects", nx::FUNCTIONS),
];

/// Group by group.
pub(super) fn all() -> impl Iterator<Item = &'static Function> {
    GROUPS.into_iter().flat_map(|(_, functions)| functions)
}
