//! The value of an expression that has been checked: its type and its code.

use core::fmt;

use crate::code::Code;
use crate::elementary::Elementary;
use crate::problem::Span;
use crate::types::Type;
use crate::value::integer;

/// An expression that has been checked.
#[derive(Debug)]
pub(super) struct Value {
    pub(super) kind: Kind,
    /// For a number without a type: without meaning.
    pub(super) code: Code,
    pub(super) span: Span,
}

/// The kind of an expression.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Kind {
    Type(Type),
    /// A whole number that takes the type that its context requires.
    Integer(i128),
    /// A number with a fraction that becomes REAL or LREAL, as its context requires.
    Real(f64),
    /// A function without a result.
    Nothing,
}

impl fmt::Display for Kind {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Type(type_) => type_.fmt(formatter),
            Self::Integer(number) => write!(formatter, "the number {number}"),
            Self::Real(number) => write!(formatter, "the number {number}"),
            Self::Nothing => formatter.write_str("nothing"),
        }
    }
}

impl Value {
    pub(super) fn of(type_: Type, code: Code, span: Span) -> Self {
        Self { kind: Kind::Type(type_), code, span }
    }

    pub(super) fn elementary(elementary: Elementary, code: Code, span: Span) -> Self {
        Self::of(Type::Elementary(elementary), code, span)
    }

    pub(super) fn constant(elementary: Elementary, bits: u64, span: Span) -> Self {
        Self::elementary(elementary, Code::Constant(bits), span)
    }

    pub(super) const fn untyped(kind: Kind, span: Span) -> Self {
        Self { kind, code: Code::Constant(0), span }
    }

    /// The number of a negative constant, with or without a type.
    pub(super) fn negative_constant(&self) -> Option<i128> {
        let number = match (&self.kind, &self.code) {
            (Kind::Integer(number), _) => *number,
            (Kind::Type(Type::Elementary(elementary)), Code::Constant(bits)) => integer(*elementary, *bits),
            _ => return None,
        };
        (number < 0).then_some(number)
    }

    pub(super) fn type_if_elementary(&self) -> Option<Elementary> {
        match &self.kind {
            Kind::Type(type_) => type_.elementary(),
            Kind::Integer(_) | Kind::Real(_) | Kind::Nothing => None,
        }
    }
}
