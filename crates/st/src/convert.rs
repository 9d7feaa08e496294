//! Conversions between elementary types: which happen by themselves, and what they do.

use crate::elementary::Elementary::{self, *};
use crate::elementary::{Class, Elementary as E};
use crate::value::{integer, range, real, real_bits, wrap};

/// Converts a value. Integers and bit strings are cut to the width of the target (overflow wraps); to BOOL
/// everything but zero is TRUE; a floating point number is rounded to the nearest integer, halves to the even one,
/// and stays at the limit of the target beyond it, NaN becomes zero.
pub(crate) fn convert(from: Elementary, to: Elementary, bits: u64) -> u64 {
    match (from.class(), to.class()) {
        _ if from == to => bits,
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
    let (least, greatest) = range(to);
    // `as` saturates and makes zero of NaN.
    let rounded = (number.round_ties_even() as i128).clamp(least, greatest);
    rounded as u64
}

fn from_integer(to: Elementary, number: i128) -> u64 {
    match to {
        // One rounding, not two.
        Real => u64::from((number as f32).to_bits()),
        _ => (number as f64).to_bits(),
    }
}

/// Whether a value of the one type becomes a value of the other by itself: no value is lost, and the kind stays
/// (IEC 61131-3, 6.6.1.6, figure 12).
pub(crate) fn widens(from: Elementary, to: Elementary) -> bool {
    if from == to {
        return true;
    }
    match (from.class(), to.class()) {
        (Class::Bool | Class::BitString, Class::BitString)
        | (Class::Signed, Class::Signed)
        | (Class::Unsigned, Class::Unsigned | Class::Signed)
        | (Class::Real, Class::Real) => from.bits() < to.bits(),
        // A REAL holds 24 bits exactly, an LREAL 53.
        (Class::Signed | Class::Unsigned, Class::Real) => from.bits() < to.bits(),
        _ => false,
    }
}

/// The narrowest type that both become by themselves; none if there is none.
pub(crate) fn common(left: Elementary, right: Elementary) -> Option<Elementary> {
    if widens(left, right) {
        return Some(right);
    }
    if widens(right, left) {
        return Some(left);
    }
    let candidates = [Sint, Int, Dint, Lint, Real, Lreal];
    candidates.into_iter().find(|candidate| widens(left, *candidate) && widens(right, *candidate))
}

/// The narrowest type of a number that is written without one.
pub(crate) fn natural(number: i128) -> Option<Elementary> {
    [E::Sint, E::Int, E::Dint, E::Lint, E::Ulint].into_iter().find(|candidate| fits(*candidate, number))
}

/// Whether a type holds a number.
pub(crate) fn fits(elementary: Elementary, number: i128) -> bool {
    let (least, greatest) = range(elementary);
    (least..=greatest).contains(&number)
}
