//! Comparisons as functions: IEC 61131-3, table 33, and the manufacturer's additional ones for texts.

use super::call::Call;
use super::function::{Function, Pin, ResultType, Takes};
use super::notation::{EVERY, pin, row, row_of_many};
use crate::elementary::Elementary;
use crate::fault::Fault;
use crate::operators::{Binary, binary, compare};

const VALUES: &[Pin] = &[pin("In1", Takes::Generic(EVERY)), pin("In2", Takes::Generic(EVERY))];
const TEXTS: &[Pin] = &[pin("In1", Takes::Text), pin("In2", Takes::Text)];
const BOOL: ResultType = ResultType::Fixed(Elementary::Bool);

#[rustfmt::skip]
pub(super) const FUNCTIONS: &[Function] = &[
    row_of_many("EQ", VALUES, BOOL, "In1 = In2 = In3 …", |call| chain(call, Binary::Equal)),
    row_of_many("GT", VALUES, BOOL, "In1 > In2 > In3 …", |call| chain(call, Binary::Greater)),
    row_of_many("GE", VALUES, BOOL, "In1 >= In2 >= In3 …", |call| chain(call, Binary::GreaterOrEqual)),
    row_of_many("LT", VALUES, BOOL, "In1 < In2 < In3 …", |call| chain(call, Binary::Less)),
    row_of_many("LE", VALUES, BOOL, "In1 <= In2 <= In3 …", |call| chain(call, Binary::LessOrEqual)),
    row("NE", VALUES, BOOL, "In1 <> In2", |call| chain(call, Binary::NotEqual)),
    row_of_many("EQascii", TEXTS, BOOL, "texts: In1 = In2 = In3 …", |call| chain_of_texts(call, Binary::Equal)),
    row_of_many("GTascii", TEXTS, BOOL, "texts: In1 > In2 > In3 …, by their characters' codes", |call| chain_of_texts(call, Binary::Greater)),
    row_of_many("GEascii", TEXTS, BOOL, "texts: In1 >= In2 >= In3 …", |call| chain_of_texts(call, Binary::GreaterOrEqual)),
    row_of_many("LTascii", TEXTS, BOOL, "texts: In1 < In2 < In3 …", |call| chain_of_texts(call, Binary::Less)),
    row_of_many("LEascii", TEXTS, BOOL, "texts: In1 <= In2 <= In3 …", |call| chain_of_texts(call, Binary::LessOrEqual)),
    row("NEascii", TEXTS, BOOL, "texts: In1 <> In2", |call| chain_of_texts(call, Binary::NotEqual)),
];

/// Whether the comparison is true between each argument and the next.
fn chain(call: &mut Call<'_, '_>, operator: Binary) -> Result<u64, Fault> {
    for pair in call.arguments.windows(2) {
        if binary(operator, call.elementary, pair[0], pair[1])? == 0 {
            return Ok(0);
        }
    }
    Ok(1)
}

fn chain_of_texts(call: &mut Call<'_, '_>, operator: Binary) -> Result<u64, Fault> {
    let mut left = call.text(0)?;
    for place in 1..call.arguments.len() {
        let right = call.text(place)?;
        if !compare(operator, Some(left.cmp(&right))) {
            return Ok(0);
        }
        left = right;
    }
    Ok(1)
}
