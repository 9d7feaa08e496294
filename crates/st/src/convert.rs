//! Conversions between elementary types: which are implicit, and what they do.

use crate::calendar;
use crate::elementary::Class;
use crate::elementary::Elementary::{self, *};
use crate::value::{integer, range, real, real_bits, wrap};

/// Converts a value. Integers and bit strings are cut to the width of the target (overflow wraps); to BOOL
/// every value except zero is TRUE. A floating point number is rounded to the nearest integer, halves to the
/// even one. Beyond the target's range it is the target's limit, and NaN is zero. A bit string takes the
/// integer as a pattern, so that negative numbers are possible too (W502, real number-to-bit string conversion
/// group).
pub(crate) fn convert(from: Elementary, to: Elementary, bits: u64) -> u64 {
    match (from.class(), to.class()) {
        _ if from == to => bits,
        (Class::Date, Class::Date) => calendar::part(to, bits),
        (Class::Real, Class::Real) => real_bits(to, real(from, bits)),
        (Class::Real, _) => from_real(to, real(from, bits)),
        (_, Class::Real) => from_integer(to, integer(from, bits)),
        (_, Class::Bool) => u64::from(bits != 0),
        _ => wrap(to, bits),
    }
}

fn from_real(to: Elementary, number: f64) -> u64 {
    if to == Bool {
        return u64::from(number != 0.0);
    }
    let (least, greatest) = match (to.class(), range(to)) {
        (Class::BitString, (_, greatest)) => (-(greatest / 2) - 1, greatest),
        (_, limits) => limits,
    };
    // `as` saturates and converts NaN to zero.
    let rounded = (number.round_ties_even() as i128).clamp(least, greatest);
    wrap(to, rounded as u64)
}

fn from_integer(to: Elementary, number: i128) -> u64 {
    match to {
        // One rounding, not two.
        Real => u64::from((number as f32).to_bits()),
        _ => (number as f64).to_bits(),
    }
}

/// Whether a value of one type is converted to the other implicitly (W501, 6-5-3, implicit casts). An integer
/// is converted to every integer that is as wide or wider: between signed and unsigned the pattern is kept. All
/// other types are converted only to wider ones, and keep their value (IEC 61131-3, 6.6.1.6, figure 12).
pub(crate) fn widens(from: Elementary, to: Elementary) -> bool {
    if from == to {
        return true;
    }
    match (from.class(), to.class()) {
        (Class::Signed | Class::Unsigned, Class::Signed | Class::Unsigned) => from.bits() <= to.bits(),
        (Class::Bool | Class::BitString, Class::BitString) | (Class::Real, Class::Real) => {
            from.bits() < to.bits()
        }
        // A REAL holds 24 bits exactly, an LREAL 53.
        (Class::Signed | Class::Unsigned, Class::Real) => from.bits() < to.bits(),
        _ => false,
    }
}

/// The common type of two operands; none if there is none. It is the wider of two integers, and for two of the
/// same width the unsigned one (W501, 6-5-3).
pub(crate) fn common(left: Elementary, right: Elementary) -> Option<Elementary> {
    match (widens(left, right), widens(right, left)) {
        (true, true) if left.class() == Class::Unsigned => Some(left),
        (true, _) => Some(right),
        (_, true) => Some(left),
        _ => [Real, Lreal].into_iter().find(|real| widens(left, *real) && widens(right, *real)),
    }
}

/// The narrowest type of a number that is written without one: a signed type, and ULINT for larger numbers.
pub(crate) fn natural(number: i128) -> Option<Elementary> {
    [Sint, Int, Dint, Lint, Ulint].into_iter().find(|candidate| fits(*candidate, number))
}

/// Whether a type can hold a number.
pub(crate) fn fits(elementary: Elementary, number: i128) -> bool {
    let (least, greatest) = range(elementary);
    (least..=greatest).contains(&number)
}
