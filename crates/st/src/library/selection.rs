//! Selection: IEC 61131-3, table 32.

use super::call::Call;
use super::function::{Function, Pin, ResultType, Takes};
use super::notation::{EVERY, INTEGERS, MAGNITUDES, pin, row, row_of_many};
use crate::elementary::Elementary;
use crate::fault::Fault;
use crate::operators::{Binary, binary};

const MANY: &[Pin] = &[pin("In1", Takes::Generic(MAGNITUDES)), pin("In2", Takes::Generic(MAGNITUDES))];

#[rustfmt::skip]
pub(super) const FUNCTIONS: &[Function] = &[
    row("MOVE", &[pin("In", Takes::GenericOrText(EVERY))], ResultType::Generic, "the value of In", |call| Ok(call.bits(0))),
    row("SEL", &[
        pin("G", Takes::Fixed(Elementary::Bool)),
        pin("In0", Takes::GenericOrText(EVERY)),
        pin("In1", Takes::GenericOrText(EVERY))],
        ResultType::Generic, "In1 if G is TRUE, otherwise In0",
        |call| Ok(if call.bits(0) == 0 { call.bits(1) } else { call.bits(2) })),
    row_of_many("MUX", &[
        pin("K", Takes::Any(INTEGERS)),
        pin("In0", Takes::GenericOrText(EVERY)),
        pin("In1", Takes::GenericOrText(EVERY))],
        ResultType::Generic, "the value with the number K, from 0; a K without a value is a fault", multiplex),
    row_of_many("MAX", MANY, ResultType::Generic, "the greatest value", |call| best(call, Binary::Greater)),
    row_of_many("MIN", MANY, ResultType::Generic, "the smallest value", |call| best(call, Binary::Less)),
    row("LIMIT", &[
        pin("MN", Takes::Generic(MAGNITUDES)),
        pin("In", Takes::Generic(MAGNITUDES)),
        pin("MX", Takes::Generic(MAGNITUDES))],
        ResultType::Generic, "In, at least MN, and then at most MX", limit),
];

fn multiplex(call: &mut Call<'_, '_>) -> Result<u64, Fault> {
    let last = call.arguments.len() as i64 - 2;
    let number = call.number(0, 0, last)?;
    Ok(call.bits(1 + number as usize))
}

/// The argument that is first in the order of the operator.
fn best(call: &mut Call<'_, '_>, operator: Binary) -> Result<u64, Fault> {
    let mut best = call.bits(0);
    for next in &call.arguments[1..] {
        best = better(call.elementary, operator, best, *next)?;
    }
    Ok(best)
}

fn limit(call: &mut Call<'_, '_>) -> Result<u64, Fault> {
    let raised = better(call.elementary, Binary::Greater, call.bits(1), call.bits(0))?;
    better(call.elementary, Binary::Less, raised, call.bits(2))
}

fn better(elementary: Elementary, operator: Binary, present: u64, next: u64) -> Result<u64, Fault> {
    Ok(if binary(operator, elementary, next, present)? != 0 { next } else { present })
}
