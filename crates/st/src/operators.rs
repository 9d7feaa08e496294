//! The operators on values of one elementary type. Integers wrap on overflow, division by zero is a fault, floating
//! point follows IEEE 754; powers come from `libm`, so that they are the same on every machine.

use crate::calendar;
use crate::elementary::{Class, Elementary};
use crate::fault::Fault;
use crate::value::{real, real_bits, wrap};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unary {
    Negate,
    /// The complement of a bit string or a BOOL.
    Not,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    Modulo,
    Power,
    Equal,
    NotEqual,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
    And,
    Or,
    Xor,
    /// A TIME by an LREAL.
    MultiplyTime,
    /// A TIME divided by an LREAL.
    DivideTime,
}

/// An operator with one operand.
pub(crate) fn unary(operator: Unary, elementary: Elementary, operand: u64) -> u64 {
    match (operator, elementary.class()) {
        (Unary::Negate, Class::Real) => real_bits(elementary, -real(elementary, operand)),
        (Unary::Negate, _) => wrap(elementary, operand.wrapping_neg()),
        (Unary::Not, _) => wrap(elementary, !operand),
    }
}

/// An operator with two operands of the type `elementary`; the operand added to a date or subtracted from it is a TIME.
pub(crate) fn binary(operator: Binary, elementary: Elementary, left: u64, right: u64) -> Result<u64, Fault> {
    match (operator, elementary.class()) {
        (Binary::And, _) => Ok(left & right),
        (Binary::Or, _) => Ok(left | right),
        (Binary::Xor, _) => Ok(left ^ right),
        (Binary::MultiplyTime, _) => Ok(scale_time(left, f64::from_bits(right))),
        (Binary::DivideTime, _) => divide_time(left, f64::from_bits(right)),
        (_, Class::Real) if elementary == Elementary::Real => Ok(single(operator, left, right)),
        (_, Class::Real) => Ok(double(operator, left, right)),
        (_, Class::Signed | Class::Time) => {
            signed(operator, left as i64, right as i64).map(|bits| wrap(elementary, bits))
        }
        (Binary::Add, Class::Date) => Ok(calendar::later(elementary, left, (right as i64).into())),
        (Binary::Subtract, Class::Date) => Ok(calendar::later(elementary, left, -i128::from(right as i64))),
        (_, Class::Unsigned | Class::BitString | Class::Bool | Class::Date) => {
            unsigned(operator, left, right).map(|bits| wrap(elementary, bits))
        }
    }
}

/// Whether `left operator right` is true, for their order; there is no order if one of them is NaN.
pub(crate) fn compare(operator: Binary, order: Option<core::cmp::Ordering>) -> bool {
    match operator {
        Binary::Equal => order.is_some_and(core::cmp::Ordering::is_eq),
        Binary::NotEqual => !order.is_some_and(core::cmp::Ordering::is_eq),
        Binary::Less => order.is_some_and(core::cmp::Ordering::is_lt),
        Binary::LessOrEqual => order.is_some_and(core::cmp::Ordering::is_le),
        Binary::Greater => order.is_some_and(core::cmp::Ordering::is_gt),
        Binary::GreaterOrEqual => order.is_some_and(core::cmp::Ordering::is_ge),
        _ => unreachable!("{operator:?} does not compare: the checker lets no other operator through"),
    }
}

fn signed(operator: Binary, left: i64, right: i64) -> Result<u64, Fault> {
    let number = match operator {
        Binary::Add => left.wrapping_add(right),
        Binary::Subtract => left.wrapping_sub(right),
        Binary::Multiply => left.wrapping_mul(right),
        Binary::Divide | Binary::Modulo if right == 0 => return Err(Fault::DivisionByZero),
        Binary::Divide => left.wrapping_div(right),
        Binary::Modulo => left.wrapping_rem(right),
        _ => return Ok(compare(operator, Some(left.cmp(&right))).into()),
    };
    Ok(number as u64)
}

fn unsigned(operator: Binary, left: u64, right: u64) -> Result<u64, Fault> {
    Ok(match operator {
        Binary::Add => left.wrapping_add(right),
        Binary::Subtract => left.wrapping_sub(right),
        Binary::Multiply => left.wrapping_mul(right),
        Binary::Divide | Binary::Modulo if right == 0 => return Err(Fault::DivisionByZero),
        Binary::Divide => left / right,
        Binary::Modulo => left % right,
        _ => compare(operator, Some(left.cmp(&right))).into(),
    })
}

fn single(operator: Binary, left: u64, right: u64) -> u64 {
    let (left, right) = (f32::from_bits(left as u32), f32::from_bits(right as u32));
    let number = match operator {
        Binary::Add => left + right,
        Binary::Subtract => left - right,
        Binary::Multiply => left * right,
        Binary::Divide => left / right,
        Binary::Modulo => left % right,
        Binary::Power => libm::pow(left.into(), right.into()) as f32,
        _ => return compare(operator, left.partial_cmp(&right)).into(),
    };
    number.to_bits().into()
}

fn double(operator: Binary, left: u64, right: u64) -> u64 {
    let (left, right) = (f64::from_bits(left), f64::from_bits(right));
    let number = match operator {
        Binary::Add => left + right,
        Binary::Subtract => left - right,
        Binary::Multiply => left * right,
        Binary::Divide => left / right,
        Binary::Modulo => left % right,
        Binary::Power => libm::pow(left, right),
        _ => return compare(operator, left.partial_cmp(&right)).into(),
    };
    number.to_bits()
}

/// Rounded to the nanosecond; a longer duration is limited to the longest.
fn scale_time(time: u64, factor: f64) -> u64 {
    (time as i64 as f64 * factor).round_ties_even() as i64 as u64
}

fn divide_time(time: u64, divisor: f64) -> Result<u64, Fault> {
    if divisor == 0.0 {
        return Err(Fault::DivisionByZero);
    }
    Ok((time as i64 as f64 / divisor).round_ties_even() as i64 as u64)
}
