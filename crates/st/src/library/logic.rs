//! Logic as functions: IEC 61131-3, table 30. Unlike an operator, a function evaluates all its arguments.

use super::call::Call;
use super::function::{Function, Pin, ResultType, Takes};
use super::notation::{LOGICAL, pin, row, row_of_many};
use crate::fault::Fault;
use crate::operators::{Binary, Unary, binary, unary};

const MANY: &[Pin] = &[pin("In1", Takes::Generic(LOGICAL)), pin("In2", Takes::Generic(LOGICAL))];

#[rustfmt::skip]
pub(super) const FUNCTIONS: &[Function] = &[
    row_of_many("AND", MANY, ResultType::Generic, "the conjunction, bit by bit", |call| fold(call, Binary::And)),
    row_of_many("OR", MANY, ResultType::Generic, "the disjunction, bit by bit", |call| fold(call, Binary::Or)),
    row_of_many("XOR", MANY, ResultType::Generic, "the exclusive disjunction, bit by bit: of BOOLs, whether an odd number is TRUE",
        |call| fold(call, Binary::Xor)),
    row("NOT", &[pin("In", Takes::Generic(LOGICAL))], ResultType::Generic, "the complement, bit by bit",
        |call| Ok(unary(Unary::Not, call.elementary, call.bits(0)))),
];

fn fold(call: &mut Call<'_, '_>, operator: Binary) -> Result<u64, Fault> {
    let (first, others) = (call.bits(0), &call.arguments[1..]);
    others.iter().try_fold(first, |so_far, next| binary(operator, call.elementary, so_far, *next))
}
