//! All functions.

use super::{Function, Pin, ResultType, Takes};
use crate::elementary::{Class, Elementary};

/// Group after group.
pub(super) fn all() -> impl Iterator<Item = &'static Function> {
    BITS.iter()
}

/// Bits of bit strings.
#[rustfmt::skip]
static BITS: &[Function] = &[
    Function { name: "TestABit", pins: &[
        Pin { name: "In", alias: "", takes: Takes::Generic(&[Class::BitString]), default: None },
        Pin { name: "Pos", alias: "", takes: Takes::Fixed(Elementary::Uint), default: None }],
        variadic: false, result: ResultType::Fixed(Elementary::Bool), does: "whether a bit is set",
        run: |call| Ok(call.arguments[0] >> (call.arguments[1] & 63) & 1) },
];
