//! Expressions: as a tree, as text, and their values.

use crate::conversions::converted;
use crate::types::{BOOL, Kind, LINT, Type, meet};
use crate::values::{DividedByZero, Value};

/// Number of variables of each type in a program.
pub(crate) const VARIABLES: usize = 3;

/// An expression with its type.
#[derive(Clone, Debug)]
pub(crate) struct Expression {
    pub(crate) type_: Type,
    pub(crate) node: Node,
}

#[derive(Clone, Debug)]
pub(crate) enum Node {
    Variable(usize),
    /// `INT#-5`.
    Literal(Value),
    /// A number that takes the type of the other operand.
    Number(i128),
    Unary(&'static str, Box<Expression>),
    Binary(&'static str, Box<Expression>, Box<Expression>),
    /// `INT_TO_REAL(…)`.
    Converted(Box<Expression>),
}

/// The values of all variables.
pub(crate) type Variables = Vec<(Type, Vec<Value>)>;

pub(crate) fn name_of(type_: Type, place: usize) -> String {
    format!("{}_{place}", type_.name.to_lowercase())
}

/// The precedence of an operator: IEC 61131-3, table 71.
fn strength(operator: &str) -> u8 {
    match operator {
        "OR" => 1,
        "XOR" => 2,
        "AND" => 3,
        "=" | "<>" => 4,
        "<" | "<=" | ">" | ">=" => 5,
        "+" | "-" => 6,
        "*" | "/" | "MOD" => 7,
        other => panic!("{other} is no operator"),
    }
}

impl Expression {
    /// As text with the minimum of parentheses.
    pub(crate) fn text(&self) -> String {
        match &self.node {
            Node::Variable(place) => name_of(self.type_, *place),
            Node::Literal(value) => literal(self.type_, *value),
            Node::Number(number) => number.to_string(),
            Node::Converted(operand) => {
                format!("{}_TO_{}({})", operand.type_.name, self.type_.name, operand.text())
            }
            Node::Unary(operator, operand) => match operand.node {
                Node::Binary(..) | Node::Unary(..) | Node::Number(..) => {
                    format!("{operator} ({})", operand.text())
                }
                _ => format!("{operator} {}", operand.text()),
            },
            Node::Binary(operator, left, right) => {
                let own = strength(operator);
                let (left, right) = (left.side(own), right.side(own + 1));
                format!("{left} {operator} {right}")
            }
        }
    }

    fn side(&self, at_least: u8) -> String {
        match self.node {
            Node::Binary(operator, ..) if strength(operator) < at_least => format!("({})", self.text()),
            _ => self.text(),
        }
    }

    pub(crate) fn value(&self, variables: &Variables) -> Result<Value, DividedByZero> {
        Ok(match &self.node {
            Node::Variable(place) => {
                let (_, values) =
                    variables.iter().find(|(type_, _)| *type_ == self.type_).expect("variables");
                values[*place]
            }
            Node::Literal(value) => *value,
            Node::Number(number) => converted(LINT, self.type_, Value::Whole(*number)),
            Node::Converted(operand) => converted(operand.type_, self.type_, operand.value(variables)?),
            Node::Unary(operator, operand) => unary(operator, self.type_, operand.value(variables)?),
            Node::Binary(operator, left, right) => return self.binary(operator, left, right, variables),
        })
    }

    fn binary(
        &self,
        operator: &str,
        left: &Self,
        right: &Self,
        variables: &Variables,
    ) -> Result<Value, DividedByZero> {
        let first = left.value(variables)?;
        // The right operand is not evaluated if the left one determines the result.
        match (operator, self.type_ == BOOL && left.type_ == BOOL && right.type_ == BOOL, first) {
            ("AND", true, Value::Whole(0)) | ("OR", true, Value::Whole(1)) => return Ok(first),
            _ => {}
        }
        let second = right.value(variables)?;
        if self.type_.kind == Kind::Time && left.type_ != right.type_ {
            let [first, second] = [first, second].map(|value| LINT.wrapped(value.whole()));
            return of_wholes(operator, self.type_, first, second);
        }
        let met = meet(left.type_, right.type_).expect("a common type");
        let [first, second] =
            [(left.type_, first), (right.type_, second)].map(|(from, value)| widened(from, met, value));
        match (first, second) {
            (Value::Single(a), Value::Single(b)) => Ok(of_singles(operator, a, b)),
            (Value::Double(a), Value::Double(b)) => Ok(of_doubles(operator, a, b)),
            (a, b) => of_wholes(operator, met, a.whole(), b.whole()),
        }
    }
}

fn widened(from: Type, to: Type, value: Value) -> Value {
    match (value, to.kind) {
        (Value::Whole(_), Kind::Real) | (Value::Single(_), _) => converted(from, to, value),
        // The sign may be lost, and the pattern is kept.
        (Value::Whole(number), Kind::Signed | Kind::Unsigned) => Value::Whole(to.wrapped(number)),
        _ => value,
    }
}

fn literal(type_: Type, value: Value) -> String {
    match type_.kind {
        Kind::Time => value.written(type_),
        _ => format!("{}#{}", type_.name, value.written(type_)),
    }
}

fn unary(operator: &str, type_: Type, operand: Value) -> Value {
    match (operator, operand) {
        ("-", Value::Whole(number)) => Value::Whole(type_.wrapped(-number)),
        ("-", Value::Single(number)) => Value::Single(-number),
        ("-", Value::Double(number)) => Value::Double(-number),
        ("NOT", Value::Whole(number)) => Value::Whole(type_.limits().1 - number),
        (_, operand) => operand,
    }
}

fn of_wholes(operator: &str, type_: Type, a: i128, b: i128) -> Result<Value, DividedByZero> {
    let number = match operator {
        "+" => a + b,
        "-" => a - b,
        // Two ULINTs: 2^128 and 2^64 wrap in the same way.
        "*" => a.wrapping_mul(b),
        "/" | "MOD" if b == 0 => return Err(DividedByZero),
        "/" => a / b,
        "MOD" => a % b,
        "AND" => a & b,
        "OR" => a | b,
        "XOR" => a ^ b,
        _ => return Ok(Value::Whole(compared(operator, a.partial_cmp(&b)).into())),
    };
    Ok(Value::Whole(type_.wrapped(number)))
}

fn of_singles(operator: &str, a: f32, b: f32) -> Value {
    match operator {
        "+" => Value::Single(a + b),
        "-" => Value::Single(a - b),
        "*" => Value::Single(a * b),
        "/" => Value::Single(a / b),
        _ => Value::Whole(compared(operator, a.partial_cmp(&b)).into()),
    }
}

fn of_doubles(operator: &str, a: f64, b: f64) -> Value {
    match operator {
        "+" => Value::Double(a + b),
        "-" => Value::Double(a - b),
        "*" => Value::Double(a * b),
        "/" => Value::Double(a / b),
        _ => Value::Whole(compared(operator, a.partial_cmp(&b)).into()),
    }
}

fn compared(operator: &str, order: Option<core::cmp::Ordering>) -> bool {
    use core::cmp::Ordering::{Equal, Greater, Less};
    match operator {
        "=" => order == Some(Equal),
        "<>" => order != Some(Equal),
        "<" => order == Some(Less),
        "<=" => matches!(order, Some(Less | Equal)),
        ">" => order == Some(Greater),
        ">=" => matches!(order, Some(Greater | Equal)),
        other => panic!("{other} compares nothing"),
    }
}
