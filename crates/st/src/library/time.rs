//! Durations, and the present moment for the blocks.

use super::table::{pin, row};
use super::{Call, Function, Pin, ResultType, Takes};
use crate::elementary::Elementary;
use crate::fault::Fault;
use crate::operators::{Binary, binary};

const TIME: ResultType = ResultType::Fixed(Elementary::Time);
const LINT: ResultType = ResultType::Fixed(Elementary::Lint);
const ONE_TIME: &[Pin] = &[pin("In", Takes::Fixed(Elementary::Time))];
const ONE_NUMBER: &[Pin] = &[pin("In", Takes::Fixed(Elementary::Lint))];
const TWO_TIMES: &[Pin] =
    &[pin("In1", Takes::Fixed(Elementary::Time)), pin("In2", Takes::Fixed(Elementary::Time))];
const TIME_AND_NUMBER: &[Pin] =
    &[pin("In1", Takes::Fixed(Elementary::Time)), pin("In2", Takes::Fixed(Elementary::Lreal))];
const NS_PER_S: i64 = 1_000_000_000;

#[rustfmt::skip]
pub(super) const FUNCTIONS: &[Function] = &[
    row("TimeToSec", ONE_TIME, LINT, "a duration in whole seconds, the rest cut off",
        |call| Ok((call.bits(0) as i64 / NS_PER_S) as u64)),
    row("TimeToNanoSec", ONE_TIME, LINT, "a duration in nanoseconds", |call| Ok(call.bits(0))),
    row("SecToTime", ONE_NUMBER, TIME, "seconds as a duration; more than a TIME holds is a fault", seconds_to_time),
    row("NanoSecToTime", ONE_NUMBER, TIME, "nanoseconds as a duration", |call| Ok(call.bits(0))),
    row("ADD_TIME", TWO_TIMES, TIME, "the sum of two durations; overflow wraps", |call| of_two(call, Binary::Add)),
    row("SUB_TIME", TWO_TIMES, TIME, "In1 less In2; overflow wraps", |call| of_two(call, Binary::Subtract)),
    row("MULTIME", TIME_AND_NUMBER, TIME, "a duration multiplied, to the nanosecond", |call| of_two(call, Binary::MultiplyTime)),
    row("DIVTIME", TIME_AND_NUMBER, TIME, "a duration divided, to the nanosecond; by zero is a fault",
        |call| of_two(call, Binary::DivideTime)),
    row("_Now", &[], TIME, "the present moment, the same in the whole scan", |call| Ok(call.machine.now_ns)),
];

fn of_two(call: &mut Call<'_, '_>, operator: Binary) -> Result<u64, Fault> {
    binary(operator, Elementary::Time, call.bits(0), call.bits(1))
}

fn seconds_to_time(call: &mut Call<'_, '_>) -> Result<u64, Fault> {
    let value = call.bits(0) as i64;
    let (lower, upper) = (i64::MIN / NS_PER_S, i64::MAX / NS_PER_S);
    match value.checked_mul(NS_PER_S) {
        Some(duration_ns) => Ok(duration_ns as u64),
        None => Err(Fault::ArgumentOutOfRange { value, lower, upper }),
    }
}
