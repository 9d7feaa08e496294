//! Generates expressions of a type from choices.

use crate::expression::{Expression, Node, VARIABLES};
use crate::tape::Tape;
use crate::types::{ALL, BOOL, Kind, TIME, Type, meet, widens};
use crate::values::Value;

/// An expression of this type, with at most this number of levels.
pub(crate) fn expression(type_: Type, levels: usize, tape: &mut Tape<'_>) -> Expression {
    if levels == 0 {
        return leaf(type_, tape);
    }
    match (tape.below(5), type_.kind) {
        (0, _) => leaf(type_, tape),
        (1, Kind::Time) => scaled(levels, tape),
        (1, _) => {
            let others: Vec<Type> = ALL.into_iter().filter(|other| other.kind != Kind::Time).collect();
            let from = tape.pick(&others);
            of(type_, Node::Converted(Box::new(expression(from, levels - 1, tape))))
        }
        (2, Kind::Bool) => comparison(levels, tape),
        (2, Kind::Bits) => of(type_, Node::Unary("NOT", Box::new(expression(type_, levels - 1, tape)))),
        (2, Kind::Signed | Kind::Real | Kind::Time) => {
            of(type_, Node::Unary("-", Box::new(expression(type_, levels - 1, tape))))
        }
        (3, Kind::Bool) => of(type_, Node::Unary("NOT", Box::new(expression(type_, levels - 1, tape)))),
        _ => operation(type_, levels, tape),
    }
}

fn of(type_: Type, node: Node) -> Expression {
    Expression { type_, node }
}

fn variable(type_: Type, tape: &mut Tape<'_>) -> Expression {
    of(type_, Node::Variable(tape.below(VARIABLES)))
}

fn leaf(type_: Type, tape: &mut Tape<'_>) -> Expression {
    match (tape.below(3), type_.kind) {
        // A real has literals, but not for NaN and the infinities.
        (0, kind) if kind != Kind::Real => of(type_, Node::Literal(Value::random(type_, tape))),
        _ => variable(type_, tape),
    }
}

/// Two operands whose common type is this one.
fn operation(type_: Type, levels: usize, tape: &mut Tape<'_>) -> Expression {
    let operators: &[&'static str] = match type_.kind {
        Kind::Bool | Kind::Bits => &["AND", "OR", "XOR"],
        Kind::Signed | Kind::Unsigned => &["+", "-", "*", "/", "MOD"],
        Kind::Real => &["+", "-", "*", "/"],
        Kind::Time => &["+", "-"],
    };
    let operator = tape.pick(operators);
    let pairs: Vec<(Type, Type)> = ALL
        .into_iter()
        .flat_map(|left| ALL.into_iter().map(move |right| (left, right)))
        .filter(|(left, right)| meet(*left, *right) == Some(type_))
        .collect();
    let (left, right) = tape.pick(&pairs);
    let first = Box::new(expression(left, levels - 1, tape));
    let second = if matches!(operator, "/" | "MOD") {
        // A divisor that is known to be zero is refused before the program runs.
        variable(right, tape)
    } else if left == type_ && type_.is_integer() && tape.below(4) == 0 {
        number(type_, tape)
    } else {
        expression(right, levels - 1, tape)
    };
    of(type_, Node::Binary(operator, first, Box::new(second)))
}

/// A number without a type that fits one.
fn number(type_: Type, tape: &mut Tape<'_>) -> Expression {
    let number = type_.wrapped(tape.bits().into());
    of(type_, Node::Number(number.max(0)))
}

fn comparison(levels: usize, tape: &mut Tape<'_>) -> Expression {
    let operator = tape.pick(&["=", "<>", "<", "<=", ">", ">="]);
    let left = tape.pick(&ALL);
    let rights: Vec<Type> = ALL.into_iter().filter(|right| meet(left, *right).is_some()).collect();
    let right = tape.pick(&rights);
    let [left, right] = [left, right].map(|type_| Box::new(expression(type_, levels - 1, tape)));
    of(BOOL, Node::Binary(operator, left, right))
}

/// A TIME by an integer, and an integer by a TIME.
fn scaled(levels: usize, tape: &mut Tape<'_>) -> Expression {
    let factors: Vec<Type> =
        ALL.into_iter().filter(|factor| factor.is_integer() && widens(*factor, crate::types::LINT)).collect();
    let factor = tape.pick(&factors);
    let time = Box::new(expression(TIME, levels - 1, tape));
    let node = match tape.below(3) {
        0 => Node::Binary("/", time, Box::new(variable(factor, tape))),
        1 => Node::Binary("*", Box::new(expression(factor, levels - 1, tape)), time),
        _ => Node::Binary("*", time, Box::new(expression(factor, levels - 1, tape))),
    };
    of(TIME, node)
}
