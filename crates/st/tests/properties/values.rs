//! Values in the evaluators, and in the notation of an instance.

use st::{Instance, NoHost, Program};

use crate::tape::Tape;
use crate::types::{Kind, Type};

/// A value: its type is known from the context.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Value {
    Whole(i128),
    Single(f32),
    Double(f64),
}

/// A fault that ends an evaluation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct DividedByZero;

impl Value {
    /// A value of a type, often at its limits.
    pub(crate) fn random(type_: Type, tape: &mut Tape<'_>) -> Self {
        let bits = tape.bits();
        let number = bits as i64 as f64;
        let reals =
            [0.0, -0.0, 0.5, -1.5, 2.5, 1e10, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 1e-300, 3.4e38];
        match (type_.kind, type_.bits) {
            (Kind::Real, 32) => {
                Self::Single(if bits.is_multiple_of(2) { tape.pick(&reals) as f32 } else { number as f32 })
            }
            (Kind::Real, _) => Self::Double(if bits.is_multiple_of(2) { tape.pick(&reals) } else { number }),
            _ => Self::Whole(type_.wrapped(bits.into())),
        }
    }

    pub(crate) fn whole(self) -> i128 {
        match self {
            Self::Whole(number) => number,
            other => panic!("{other:?} is no whole number"),
        }
    }

    pub(crate) fn double(self) -> f64 {
        match self {
            Self::Whole(number) => number as f64,
            Self::Single(number) => number.into(),
            Self::Double(number) => number,
        }
    }

    /// In the notation of `Instance::set`.
    pub(crate) fn written(self, type_: Type) -> String {
        match (self, type_.kind) {
            (Self::Whole(number), Kind::Bool) => if number == 0 { "FALSE" } else { "TRUE" }.to_owned(),
            (Self::Whole(number), Kind::Bits) => format!("16#{number:X}"),
            (Self::Whole(number), Kind::Time) => format!("T#{number}ns"),
            (Self::Whole(number), _) => number.to_string(),
            (Self::Single(number), _) => format!("{number:?}"),
            (Self::Double(number), _) => format!("{number:?}"),
        }
    }

    /// The same value, bit by bit; all NaN are equal.
    pub(crate) fn is(self, other: Self) -> bool {
        match (self, other) {
            (Self::Whole(a), Self::Whole(b)) => a == b,
            (Self::Single(a), Self::Single(b)) => a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan()),
            (Self::Double(a), Self::Double(b)) => a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan()),
            _ => false,
        }
    }

    /// In the notation of `Instance::value`; a TIME only as its nanoseconds.
    pub(crate) fn read(type_: Type, text: &str) -> Self {
        match (type_.kind, type_.bits) {
            (Kind::Bool, _) => Self::Whole((text == "TRUE").into()),
            (Kind::Bits, _) => {
                let digits = text.strip_prefix("16#").expect("a bit string");
                Self::Whole(i128::from_str_radix(digits, 16).expect("its digits"))
            }
            (Kind::Real, 32) => Self::Single(text.parse().expect("a REAL")),
            (Kind::Real, _) => Self::Double(text.parse().expect("an LREAL")),
            _ => Self::Whole(text.parse().expect("a number")),
        }
    }
}

/// Runs a program once with these variables set.
pub(crate) fn run(
    program: &Program,
    variables: &[(String, String)],
    budget: u64,
) -> (Instance, Option<st::Fault>) {
    let mut instance = program.start();
    for (name, value) in variables {
        assert!(instance.set(name, value), "{name} := {value}");
    }
    let result = instance.scan(0, budget, &mut NoHost);
    (instance, result.err().map(|stopped| stopped.fault))
}
