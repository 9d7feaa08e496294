//! Operators by the types of their operands: the common type of two operands, and the operations that exist.

use super::value::Kind;
use crate::convert::{common, fits, natural, widens};
use crate::elementary::{Class, Elementary};
use crate::operators::Binary;
use crate::syntax::ast::BinaryOperator;
use crate::types::Type;

/// The common type of two operands.
pub(super) fn operand_type(operator: Binary, left: &Kind, right: &Kind) -> Option<Elementary> {
    if operator == Binary::Power {
        return power_type(left, right);
    }
    match (left, right) {
        (Kind::Type(Type::Elementary(a)), Kind::Type(Type::Elementary(b))) => common(*a, *b),
        (Kind::Type(Type::Elementary(a)), Kind::Integer(number))
        | (Kind::Integer(number), Kind::Type(Type::Elementary(a))) => with_number(*a, *number),
        (Kind::Type(Type::Elementary(a)), Kind::Real(_))
        | (Kind::Real(_), Kind::Type(Type::Elementary(a))) => {
            [Elementary::Real, Elementary::Lreal].into_iter().find(|real| widens(*a, *real))
        }
        _ => None,
    }
}

/// A number without a type takes the type of the other operand if it fits. Otherwise its own type is the
/// narrowest signed one, and the common type is determined as for operands with types: a negative number
/// becomes unsigned together with an unsigned operand that is as wide or wider (W501, 6-5-3).
pub(super) fn with_number(elementary: Elementary, number: i128) -> Option<Elementary> {
    match elementary.class() {
        Class::Time | Class::Date => None,
        Class::Real => Some(elementary),
        _ if fits(elementary, number) => Some(elementary),
        Class::Bool => None,
        Class::BitString => {
            let wider = [Elementary::Word, Elementary::Dword, Elementary::Lword];
            wider.into_iter().find(|wider| widens(elementary, *wider) && fits(*wider, number))
        }
        Class::Signed | Class::Unsigned => common(elementary, natural(number)?),
    }
}

/// The power of two REALs, or of a REAL and a narrow integer, is a REAL; all other powers are LREAL.
fn power_type(left: &Kind, right: &Kind) -> Option<Elementary> {
    let numeric = |kind: &Kind| match kind {
        Kind::Integer(_) | Kind::Real(_) => Some(Elementary::Real),
        Kind::Type(Type::Elementary(elementary)) => match elementary.class() {
            Class::Real => Some(*elementary),
            Class::Signed | Class::Unsigned => Some(Elementary::Lreal),
            _ => None,
        },
        _ => None,
    };
    Some(numeric(left)?.max(numeric(right)?))
}

/// TIME with TIME, or with a number.
pub(super) fn time_operator(operator: Binary, left: &Kind, right: &Kind) -> Option<Binary> {
    let [left, right] = [left, right].map(|kind| match kind {
        Kind::Integer(_) => Some(Class::Signed),
        Kind::Real(_) => Some(Class::Real),
        Kind::Type(Type::Elementary(elementary)) => Some(elementary.class()),
        _ => None,
    });
    match (operator, left?, right?) {
        (Binary::Add | Binary::Subtract, Class::Time, Class::Time) => Some(operator),
        (Binary::Multiply, Class::Time, Class::Signed | Class::Unsigned)
        | (Binary::Multiply, Class::Signed | Class::Unsigned, Class::Time)
        | (Binary::Divide, Class::Time, Class::Signed | Class::Unsigned) => Some(operator),
        (Binary::Multiply, Class::Time, Class::Real) | (Binary::Multiply, Class::Real, Class::Time) => {
            Some(Binary::MultiplyTime)
        }
        (Binary::Divide, Class::Time, Class::Real) => Some(Binary::DivideTime),
        _ => None,
    }
}

/// A date or a time of day with a TIME, or two of the same type: the type of the operation and its result.
pub(super) fn date_operation(operator: Binary, left: &Kind, right: &Kind) -> Option<Elementary> {
    let [left, right] = [left, right].map(|kind| match kind {
        Kind::Type(Type::Elementary(elementary)) => Some(*elementary),
        _ => None,
    });
    let moment = left.filter(|moment| moment.class() == Class::Date)?;
    match (operator, right?) {
        (Binary::Add | Binary::Subtract, Elementary::Time) if moment != Elementary::Date => Some(moment),
        // Both are nanoseconds from the same origin.
        (Binary::Subtract, other) if other == moment => Some(Elementary::Time),
        _ => None,
    }
}

/// Whether an operation exists for a class of types.
pub(super) fn suits(operator: Binary, class: Class) -> bool {
    match operator {
        Binary::Add | Binary::Subtract | Binary::Multiply | Binary::Divide => {
            matches!(class, Class::Signed | Class::Unsigned | Class::Real)
        }
        Binary::Modulo => matches!(class, Class::Signed | Class::Unsigned),
        Binary::Power => class == Class::Real,
        Binary::And | Binary::Or | Binary::Xor => matches!(class, Class::Bool | Class::BitString),
        Binary::Equal
        | Binary::NotEqual
        | Binary::Less
        | Binary::LessOrEqual
        | Binary::Greater
        | Binary::GreaterOrEqual
        | Binary::MultiplyTime
        | Binary::DivideTime => true,
    }
}

pub(super) const fn is_comparison(operator: Binary) -> bool {
    use Binary::*;
    matches!(operator, Equal | NotEqual | Less | LessOrEqual | Greater | GreaterOrEqual)
}

pub(super) fn classes(left: &Kind, right: &Kind) -> [Option<Class>; 2] {
    [left, right].map(|kind| match kind {
        Kind::Type(type_) => type_.elementary().map(Elementary::class),
        Kind::Integer(_) => Some(Class::Signed),
        Kind::Real(_) => Some(Class::Real),
        Kind::Nothing => None,
    })
}

const fn row(operator: BinaryOperator) -> (Binary, &'static str) {
    match operator {
        BinaryOperator::Power => (Binary::Power, "**"),
        BinaryOperator::Multiply => (Binary::Multiply, "*"),
        BinaryOperator::Divide => (Binary::Divide, "/"),
        BinaryOperator::Modulo => (Binary::Modulo, "MOD"),
        BinaryOperator::Add => (Binary::Add, "+"),
        BinaryOperator::Subtract => (Binary::Subtract, "-"),
        BinaryOperator::Less => (Binary::Less, "<"),
        BinaryOperator::LessOrEqual => (Binary::LessOrEqual, "<="),
        BinaryOperator::Greater => (Binary::Greater, ">"),
        BinaryOperator::GreaterOrEqual => (Binary::GreaterOrEqual, ">="),
        BinaryOperator::Equal => (Binary::Equal, "="),
        BinaryOperator::NotEqual => (Binary::NotEqual, "<>"),
        BinaryOperator::And => (Binary::And, "AND"),
        BinaryOperator::Xor => (Binary::Xor, "XOR"),
        BinaryOperator::Or => (Binary::Or, "OR"),
    }
}

pub(super) const fn code_of(operator: BinaryOperator) -> Binary {
    row(operator).0
}

pub(super) const fn sign(operator: BinaryOperator) -> &'static str {
    row(operator).1
}
