//! The representation of elementary values in 64 bits.
//!
//! Signed integers and TIME are sign-extended; unsigned integers, bit strings and BOOL have zeros in the upper
//! bits; REAL and LREAL are their IEEE 754 bits; dates and times of day are as in [`crate::calendar`]. So each
//! value has one representation, and equal values are equal slots, except for NaN and the two zeros.

use crate::calendar;
use crate::elementary::{Class, Elementary};

/// Units of a TIME from the longest to the shortest, and their nanoseconds. IEC 61131-3, table 8.
pub(crate) const TIME_UNITS: [(&str, u64); 7] = [
    ("d", 86_400_000_000_000),
    ("h", 3_600_000_000_000),
    ("m", 60_000_000_000),
    ("s", 1_000_000_000),
    ("ms", 1_000_000),
    ("us", 1_000),
    ("ns", 1),
];

/// Cuts `bits` to the width of an integer, a bit string, a BOOL or a TIME: overflow wraps. Other values are unchanged.
pub(crate) const fn wrap(elementary: Elementary, bits: u64) -> u64 {
    let unused = 64 - elementary.bits();
    match elementary.class() {
        Class::Signed | Class::Time => (((bits << unused) as i64) >> unused) as u64,
        Class::Bool | Class::BitString | Class::Unsigned => (bits << unused) >> unused,
        Class::Real | Class::Date => bits,
    }
}

/// The minimum and maximum value of all types except the floating point ones.
pub(crate) const fn range(elementary: Elementary) -> (i128, i128) {
    let bits = elementary.bits();
    match elementary.class() {
        Class::Signed | Class::Time => (-(1 << (bits - 1)), (1 << (bits - 1)) - 1),
        Class::Bool | Class::BitString | Class::Unsigned => (0, (1 << bits) - 1),
        Class::Date => (0, calendar::last(elementary) as i128),
        Class::Real => (0, 0),
    }
}

/// The number represented by the bits of an integer, a bit string, a BOOL or a TIME.
pub(crate) const fn integer(elementary: Elementary, bits: u64) -> i128 {
    match elementary.class() {
        Class::Signed | Class::Time => bits as i64 as i128,
        _ => bits as i128,
    }
}

/// The number represented by the bits of a REAL or an LREAL.
pub(crate) fn real(elementary: Elementary, bits: u64) -> f64 {
    match elementary {
        Elementary::Real => f64::from(f32::from_bits(bits as u32)),
        _ => f64::from_bits(bits),
    }
}

/// The bits of a number as REAL or LREAL.
pub(crate) fn real_bits(elementary: Elementary, number: f64) -> u64 {
    match elementary {
        Elementary::Real => u64::from((number as f32).to_bits()),
        _ => number.to_bits(),
    }
}

/// Writes a value little endian; `octets` has the length of the type in a message.
pub(crate) fn pack(bits: u64, octets: &mut [u8]) {
    for (octet, value) in octets.iter_mut().zip(bits.to_le_bytes()) {
        *octet = value;
    }
}

/// Reads a little-endian value; missing bytes are zero.
pub(crate) fn unpack(elementary: Elementary, octets: &[u8]) -> u64 {
    let mut all = [0; 8];
    for (octet, value) in all.iter_mut().zip(octets) {
        *octet = *value;
    }
    let bits = u64::from_le_bytes(all);
    match elementary {
        // A byte other than 0 is TRUE.
        Elementary::Bool => u64::from(bits != 0),
        _ => wrap(elementary, bits),
    }
}
