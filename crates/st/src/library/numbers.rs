//! Numbers: arithmetic, roots, logarithms, angles, rounding.
//!
//! REAL is calculated as LREAL and rounded once. Outside their range the functions return NaN or an infinity,
//! as in IEEE 754, without a fault. Their results do not depend on the machine: the functions that IEEE 754
//! does not define come from `libm`, not from the system.

use super::call::Call;
use super::function::{Function, Pin, ResultType, Takes};
use super::notation::{INTEGERS, MAGNITUDES, NUMBERS, REALS, pin, pin_or, row, row_of_many};
use crate::convert::convert;
use crate::elementary::{Class, Elementary};
use crate::fault::Fault;
use crate::operators::{Binary, Unary, binary, unary};
use crate::value::wrap;

const ANGLE: &[Pin] = &[pin("In", Takes::Generic(REALS))];
const TWO_REALS: &[Pin] = &[pin("In1", Takes::Generic(REALS)), pin("In2", Takes::Generic(REALS))];
const MANY_MAGNITUDES: &[Pin] =
    &[pin("In1", Takes::Generic(MAGNITUDES)), pin("In2", Takes::Generic(MAGNITUDES))];
const MANY_NUMBERS: &[Pin] = &[pin("In1", Takes::Generic(NUMBERS)), pin("In2", Takes::Generic(NUMBERS))];
const TWO_INTEGERS: &[Pin] = &[pin("In1", Takes::Generic(INTEGERS)), pin("In2", Takes::Generic(INTEGERS))];
const COUNTER: &[Pin] = &[pin("InOut", Takes::Variable(INTEGERS))];
const DONE: ResultType = ResultType::Fixed(Elementary::Bool);

#[rustfmt::skip]
pub(super) const FUNCTIONS: &[Function] = &[
    row("ABS", &[pin("In", Takes::Generic(NUMBERS))], ResultType::Generic,
        "the absolute value; that of the smallest signed integer overflows to itself", absolute),
    row("Neg", &[pin("In", Takes::Generic(&[Class::Signed, Class::Real]))], ResultType::Generic,
        "the value with the opposite sign; that of the smallest signed integer overflows to itself",
        |call| Ok(unary(Unary::Negate, call.elementary, call.bits(0)))),
    row("SQRT", ANGLE, ResultType::Generic, "the square root", |call| of_real(call, libm::sqrt)),
    row("LN", ANGLE, ResultType::Generic, "the natural logarithm", |call| of_real(call, libm::log)),
    row("LOG", ANGLE, ResultType::Generic, "the logarithm to base 10", |call| of_real(call, libm::log10)),
    row("EXP", ANGLE, ResultType::Generic, "e to the power In", |call| of_real(call, libm::exp)),
    row("EXPT", &[pin_or("In", "In1", Takes::Generic(REALS)), pin_or("Pwr", "In2", Takes::Generic(REALS))],
        ResultType::Generic, "In to the power Pwr", |call| of_two_reals(call, libm::pow)),
    row("SIN", ANGLE, ResultType::Generic, "the sine of an angle in radians", |call| of_real(call, libm::sin)),
    row("COS", ANGLE, ResultType::Generic, "the cosine of an angle in radians", |call| of_real(call, libm::cos)),
    row("TAN", ANGLE, ResultType::Generic, "the tangent of an angle in radians", |call| of_real(call, libm::tan)),
    row("ASIN", ANGLE, ResultType::Generic, "the angle in radians, -π/2 to π/2, with this sine", |call| of_real(call, libm::asin)),
    row("ACOS", ANGLE, ResultType::Generic, "the angle in radians, 0 to π, with this cosine", |call| of_real(call, libm::acos)),
    row("ATAN", ANGLE, ResultType::Generic, "the angle in radians, -π/2 to π/2, with this tangent", |call| of_real(call, libm::atan)),
    row("ATAN2", &[pin("Y", Takes::Generic(REALS)), pin("X", Takes::Generic(REALS))],
        ResultType::Generic, "the angle in radians, -π to π, of the point X, Y", |call| of_two_reals(call, libm::atan2)),
    row("RadToDeg", ANGLE, ResultType::Generic, "radians as degrees", |call| of_real(call, f64::to_degrees)),
    row("DegToRad", ANGLE, ResultType::Generic, "degrees as radians", |call| of_real(call, f64::to_radians)),
    row("TRUNC", ANGLE, ResultType::Whole,
        "the integer towards zero, DINT of a REAL and LINT of an LREAL; beyond their range the limit", truncate),
    row("Round", ANGLE, ResultType::Whole,
        "the nearest integer, halves to the even one, DINT of a REAL and LINT of an LREAL; beyond their range the limit", round),
    row("RoundUp", ANGLE, ResultType::Whole,
        "the next integer away from zero, DINT of a REAL and LINT of an LREAL; beyond their range the limit", round_up),
    row("Fraction", ANGLE, ResultType::Generic, "the part after the decimal point, with the sign of In", |call| of_real(call, f64::fract)),
    row("ModReal", TWO_REALS, ResultType::Generic, "the remainder of In1 / In2, with the sign of In1",
        |call| of_two_reals(call, libm::fmod)),
    row_of_many("ADD", MANY_MAGNITUDES, ResultType::Generic, "the sum; overflow wraps", |call| fold(call, Binary::Add)),
    row_of_many("MUL", MANY_NUMBERS, ResultType::Generic, "the product; overflow wraps", |call| fold(call, Binary::Multiply)),
    row("SUB", MANY_MAGNITUDES, ResultType::Generic, "In1 minus In2; overflow wraps", |call| fold(call, Binary::Subtract)),
    row("DIV", MANY_NUMBERS, ResultType::Generic, "In1 divided by In2; integers truncate towards zero; an integer divided by zero is a fault",
        |call| fold(call, Binary::Divide)),
    row("MOD", TWO_INTEGERS, ResultType::Generic, "the remainder of In1 / In2, with the sign of In1; In2 = 0 is a fault",
        |call| fold(call, Binary::Modulo)),
    row("Inc", COUNTER, DONE, "adds 1 to a variable; overflow wraps; returns TRUE", |call| step(call, 1)),
    row("Dec", COUNTER, DONE, "subtracts 1 from a variable; overflow wraps; returns TRUE", |call| step(call, -1)),
];

fn of_real(call: &mut Call<'_, '_>, function: fn(f64) -> f64) -> Result<u64, Fault> {
    Ok(call.give_real(function(call.real(0))))
}

fn of_two_reals(call: &mut Call<'_, '_>, function: fn(f64, f64) -> f64) -> Result<u64, Fault> {
    Ok(call.give_real(function(call.real(0), call.real(1))))
}

fn absolute(call: &mut Call<'_, '_>) -> Result<u64, Fault> {
    let bits = call.bits(0);
    Ok(match call.elementary.class() {
        Class::Real => call.give_real(call.real(0).abs()),
        Class::Signed if (bits as i64) < 0 => unary(Unary::Negate, call.elementary, bits),
        _ => bits,
    })
}

fn truncate(call: &mut Call<'_, '_>) -> Result<u64, Fault> {
    Ok(whole(call.elementary, libm::trunc(call.real(0))))
}

fn round(call: &mut Call<'_, '_>) -> Result<u64, Fault> {
    Ok(whole(call.elementary, call.real(0)))
}

fn round_up(call: &mut Call<'_, '_>) -> Result<u64, Fault> {
    let number = call.real(0);
    Ok(whole(call.elementary, libm::copysign(libm::ceil(number.abs()), number)))
}

fn whole(generic: Elementary, number: f64) -> u64 {
    let to = ResultType::Whole.elementary(generic).unwrap_or(Elementary::Lint);
    convert(Elementary::Lreal, to, number.to_bits())
}

fn fold(call: &mut Call<'_, '_>, operator: Binary) -> Result<u64, Fault> {
    let (first, others) = (call.bits(0), &call.arguments[1..]);
    others.iter().try_fold(first, |so_far, next| binary(operator, call.elementary, so_far, *next))
}

fn step(call: &mut Call<'_, '_>, by: i64) -> Result<u64, Fault> {
    let (slot, elementary) = (call.slot(0), call.elementary);
    let next = call.scan.memory.get(slot).wrapping_add_signed(by);
    call.scan.memory.set(slot, wrap(elementary, next));
    Ok(1)
}
