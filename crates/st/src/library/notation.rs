//! The notation of the rows of functions.

use super::call::Call;
use super::function::{Function, Pin, ResultType, Takes};
use crate::elementary::Class;
use crate::fault::Fault;

/// Integers.
pub(super) const INTEGERS: &[Class] = &[Class::Signed, Class::Unsigned];
/// ANY_NUM of the standard.
pub(super) const NUMBERS: &[Class] = &[Class::Signed, Class::Unsigned, Class::Real];
/// ANY_MAGNITUDE of the standard.
pub(super) const MAGNITUDES: &[Class] = &[Class::Signed, Class::Unsigned, Class::Real, Class::Time];
/// REAL and LREAL.
pub(super) const REALS: &[Class] = &[Class::Real];
/// BYTE to LWORD.
pub(super) const BIT_STRINGS: &[Class] = &[Class::BitString];
/// BOOL and BYTE to LWORD.
pub(super) const LOGICAL: &[Class] = &[Class::Bool, Class::BitString];
/// Every elementary type.
pub(super) const EVERY: &[Class] =
    &[Class::Bool, Class::BitString, Class::Signed, Class::Unsigned, Class::Real, Class::Time, Class::Date];

type Run = fn(&mut Call<'_, '_>) -> Result<u64, Fault>;

/// A function with exactly these pins.
pub(super) const fn row(
    name: &'static str,
    pins: &'static [Pin],
    result: ResultType,
    does: &'static str,
    run: Run,
) -> Function {
    Function { name, pins, variadic: false, result, does, run }
}

/// A function that accepts more values of the type of its last pin.
pub(super) const fn row_of_many(
    name: &'static str,
    pins: &'static [Pin],
    result: ResultType,
    does: &'static str,
    run: Run,
) -> Function {
    Function { name, pins, variadic: true, result, does, run }
}

/// A pin with the same name in the standard and in the manufacturer's manual.
pub(super) const fn pin(name: &'static str, takes: Takes) -> Pin {
    Pin { name, alias: "", takes, default: None }
}

/// A pin that the manufacturer calls `name` and the standard calls `alias`.
pub(super) const fn pin_or(name: &'static str, alias: &'static str, takes: Takes) -> Pin {
    Pin { name, alias, takes, default: None }
}

/// A pin that a call may omit.
pub(super) const fn optional(name: &'static str, takes: Takes, default: u64) -> Pin {
    Pin { name, alias: "", takes, default: Some(default) }
}
