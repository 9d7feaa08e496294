//! Durations, and the present time for the blocks.

use super::call::Call;
use super::function::{Function, Pin, ResultType, Takes};
use super::notation::{pin, row};
use crate::calendar;
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
const TOD: ResultType = ResultType::Fixed(Elementary::TimeOfDay);
const DT: ResultType = ResultType::Fixed(Elementary::DateAndTime);
const TOD_TIME: &[Pin] = &two(Elementary::TimeOfDay, Elementary::Time);
const DT_TIME: &[Pin] = &two(Elementary::DateAndTime, Elementary::Time);
const NS_PER_S: i64 = 1_000_000_000;

#[rustfmt::skip]
pub(super) const FUNCTIONS: &[Function] = &[
    row("TimeToSec", ONE_TIME, LINT, "a duration in whole seconds; the fraction is cut",
        |call| Ok((call.bits(0) as i64 / NS_PER_S) as u64)),
    row("TimeToNanoSec", ONE_TIME, LINT, "a duration in nanoseconds", |call| Ok(call.bits(0))),
    row("SecToTime", ONE_NUMBER, TIME, "seconds as a duration; a value outside the range of TIME is a fault", seconds_to_time),
    row("NanoSecToTime", ONE_NUMBER, TIME, "nanoseconds as a duration", |call| Ok(call.bits(0))),
    row("ADD_TIME", TWO_TIMES, TIME, "the sum of two durations; overflow wraps", |call| of_two(call, Binary::Add)),
    row("SUB_TIME", TWO_TIMES, TIME, "In1 minus In2; overflow wraps", |call| of_two(call, Binary::Subtract)),
    row("MULTIME", TIME_AND_NUMBER, TIME, "a duration multiplied, to the nanosecond", |call| of_two(call, Binary::MultiplyTime)),
    row("DIVTIME", TIME_AND_NUMBER, TIME, "a duration divided, to the nanosecond; by zero is a fault",
        |call| of_two(call, Binary::DivideTime)),
    row("ADD_TOD_TIME", TOD_TIME, TOD, "In1 plus In2; wraps at midnight",
        |call| binary(Binary::Add, Elementary::TimeOfDay, call.bits(0), call.bits(1))),
    row("SUB_TOD_TIME", TOD_TIME, TOD, "In1 minus In2; wraps at midnight",
        |call| binary(Binary::Subtract, Elementary::TimeOfDay, call.bits(0), call.bits(1))),
    row("SUB_TOD_TOD", &two(Elementary::TimeOfDay, Elementary::TimeOfDay), TIME, "the duration from In2 to In1", |call| of_two(call, Binary::Subtract)),
    row("ADD_DT_TIME", DT_TIME, DT, "In1 plus In2; wraps from the last value to the first",
        |call| binary(Binary::Add, Elementary::DateAndTime, call.bits(0), call.bits(1))),
    row("SUB_DT_TIME", DT_TIME, DT, "In1 minus In2; wraps from the first value to the last",
        |call| binary(Binary::Subtract, Elementary::DateAndTime, call.bits(0), call.bits(1))),
    row("SUB_DT_DT", &two(Elementary::DateAndTime, Elementary::DateAndTime), TIME, "the duration from In2 to In1", |call| of_two(call, Binary::Subtract)),
    row("SUB_DATE_DATE", &two(Elementary::Date, Elementary::Date), TIME, "the duration from In2 to In1", |call| of_two(call, Binary::Subtract)),
    row("CONCAT_DATE_TOD", &two(Elementary::Date, Elementary::TimeOfDay), DT, "the time of day In2 on the date In1",
        |call| Ok(calendar::later(Elementary::DateAndTime, call.bits(0), call.bits(1).into()))),
    row("DateToSec", &[pin("In", Takes::Fixed(Elementary::Date))], LINT, "the seconds since 1970-01-01", seconds),
    row("TodToSec", &[pin("In", Takes::Fixed(Elementary::TimeOfDay))], LINT, "the seconds since midnight; the fraction is cut", seconds),
    row("DtToSec", &[pin("In", Takes::Fixed(Elementary::DateAndTime))], LINT, "the seconds since 1970-01-01; the fraction is cut", seconds),
    row("SecToDate", ONE_NUMBER, ResultType::Fixed(Elementary::Date), "the date of In seconds since 1970-01-01; \
        a value outside the range of DATE is a fault",
        |call| moment(call, Elementary::DateAndTime).map(|moment| calendar::part(Elementary::Date, moment))),
    row("SecToTod", ONE_NUMBER, TOD, "seconds since midnight as a time of day; a value outside the day is a fault", |call| moment(call, Elementary::TimeOfDay)),
    row("SecToDt", ONE_NUMBER, DT, "seconds since 1970-01-01 as a DATE_AND_TIME; a value outside its range is a fault", |call| moment(call, Elementary::DateAndTime)),
    row("_Now", &[], TIME, "the present moment, the same in the whole scan", |call| Ok(call.scan.now_ns)),
];

const fn two(first: Elementary, second: Elementary) -> [Pin; 2] {
    [pin("In1", Takes::Fixed(first)), pin("In2", Takes::Fixed(second))]
}

fn of_two(call: &mut Call<'_, '_>, operator: Binary) -> Result<u64, Fault> {
    binary(operator, Elementary::Time, call.bits(0), call.bits(1))
}

fn seconds_to_time(call: &mut Call<'_, '_>) -> Result<u64, Fault> {
    let value = call.bits(0) as i64;
    let (lower, upper) = (i64::MIN / NS_PER_S, i64::MAX / NS_PER_S);
    match value.checked_mul(NS_PER_S) {
        Some(duration_ns) => Ok(duration_ns as u64),
        None => Err(Fault::ArgumentOutOfRange { value: value.into(), lower, upper }),
    }
}

fn seconds(call: &mut Call<'_, '_>) -> Result<u64, Fault> {
    Ok(call.bits(0) / NS_PER_S.unsigned_abs())
}

/// Seconds as a time of day, or on a day.
fn moment(call: &mut Call<'_, '_>, elementary: Elementary) -> Result<u64, Fault> {
    let (value, upper) = (call.bits(0) as i64, calendar::last(elementary) as i64 / NS_PER_S);
    if (0..=upper).contains(&value) {
        return Ok(value.unsigned_abs() * NS_PER_S.unsigned_abs());
    }
    Err(Fault::ArgumentOutOfRange { value: value.into(), lower: 0, upper })
}
