//! Numbers as values of variables, for whatever computes them: a sine, a ramp, a table over time.

use core::ops::RangeInclusive;

use arrayvec::ArrayVec;
use iec_types::{Class, Elementary};

use crate::variable::VariableValue;

/// How numbers become values of an elementary type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Numeric(Elementary);

impl Numeric {
    /// The type, if its values are numbers: BOOL (0 and 1), bit strings, integers, REAL and LREAL.
    #[must_use]
    pub fn of(elementary: Elementary) -> Option<Self> {
        match elementary.class() {
            Class::Bool | Class::BitString | Class::Signed | Class::Unsigned | Class::Real => {
                Some(Self(elementary))
            }
            Class::Time | Class::Date => None,
        }
    }

    /// Whether its values are whole numbers.
    #[must_use]
    pub fn is_whole(self) -> bool {
        self.0.class() != Class::Real
    }

    /// Its least and greatest number. Of a type with 64 bits the next numbers that a float of 64 bits has.
    #[must_use]
    pub fn range(self) -> RangeInclusive<f64> {
        let power = |bits: u32| 2.0_f64.powi(i32::try_from(bits).unwrap_or(i32::MAX));
        let bits = self.0.bits();
        match self.0.class() {
            Class::Signed => -power(bits - 1)..=power(bits - 1) - 1.0,
            Class::Real if bits == 32 => f32::MIN.into()..=f32::MAX.into(),
            Class::Real => f64::MIN..=f64::MAX,
            Class::Bool | Class::BitString | Class::Unsigned | Class::Time | Class::Date => {
                0.0..=power(bits) - 1.0
            }
        }
    }

    /// The value of a number: the nearest whole number where the type has no others, the limit of the type beyond it.
    #[must_use]
    pub fn value(self, number: f64) -> VariableValue {
        let size_bytes = self.0.size_bytes();
        let bytes = match self.0.class() {
            // The casts of floats to integers end at the limits of the integer.
            Class::Real if size_bytes == 4 => u64::from((number as f32).to_bits()),
            Class::Real => number.to_bits(),
            Class::Signed => {
                let range = self.range();
                number.round().clamp(*range.start(), *range.end()) as i64 as u64
            }
            Class::Bool | Class::BitString | Class::Unsigned | Class::Time | Class::Date => {
                let range = self.range();
                number.round().clamp(*range.start(), *range.end()) as u64
            }
        };
        let mut value: VariableValue = ArrayVec::new();
        value.extend(bytes.to_le_bytes().into_iter().take(size_bytes));
        value
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::VariableType;

    fn shown(elementary: Elementary, number: f64) -> String {
        let numeric = Numeric::of(elementary).expect("a type of numbers");
        VariableType::single(elementary).show(&numeric.value(number)).to_string()
    }

    #[test]
    fn a_number_becomes_the_nearest_value() {
        for (elementary, number, text) in [
            (Elementary::Bool, 0.4, "FALSE"),
            (Elementary::Bool, 7.0, "TRUE"),
            (Elementary::Sint, -128.4, "-128"),
            (Elementary::Sint, -500.0, "-128"),
            (Elementary::Usint, 254.5, "255"),
            (Elementary::Uint, -3.0, "0"),
            (Elementary::Int, 1e9, "32767"),
            (Elementary::Dint, -2.5, "-3"),
            (Elementary::Ulint, 1e30, "18446744073709551615"),
            (Elementary::Lint, -1e30, "-9223372036854775808"),
        ] {
            assert_eq!(shown(elementary, number), text, "{elementary} {number}");
        }
        assert_eq!(
            Numeric::of(Elementary::Real).map(|real| real.value(0.5).to_vec()),
            Some(vec![0, 0, 0, 63])
        );
    }

    #[test]
    fn times_and_dates_are_no_numbers() {
        for elementary in Elementary::ALL {
            let is_number = !matches!(elementary.class(), Class::Time | Class::Date);
            assert_eq!(Numeric::of(elementary).is_some(), is_number, "{elementary}");
        }
    }

    #[test]
    fn the_limits_of_a_type_are_its_own_values() {
        for numeric in Elementary::ALL.into_iter().filter_map(Numeric::of) {
            let (least, most) = (*numeric.range().start(), *numeric.range().end());
            if numeric.is_whole() {
                let beyond = (numeric.value(least * 2.0 - 1.0), numeric.value(most * 2.0 + 1.0));
                assert_eq!(beyond, (numeric.value(least), numeric.value(most)), "{numeric:?}");
            }
            assert_ne!(numeric.value(least), numeric.value(most), "{numeric:?}");
            assert_eq!(numeric.value(most).len(), numeric.0.size_bytes());
        }
    }
}
