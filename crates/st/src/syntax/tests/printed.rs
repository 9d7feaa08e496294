//! Trees as text: full parentheses, so that nothing depends on the precedence of operators.

use core::fmt::Write as _;

use crate::syntax::ast::{
    Argument, BinaryOperator, Call, CaseLabel, Expression, ExpressionKind, Literal, Statement, StatementKind,
    TypedValue, UnaryOperator,
};

/// An expression with parentheses around everything that has an operator.
pub(super) fn expression(tree: &Expression) -> String {
    match &tree.kind {
        ExpressionKind::Literal(value) => literal(value),
        ExpressionKind::Name(name) => name.clone(),
        ExpressionKind::Member { of, member } => format!("{}.{}", expression(of), member.text),
        ExpressionKind::Index { of, indices } => format!("{}[{}]", expression(of), list(indices)),
        ExpressionKind::EnumValue { type_name, value } => format!("{}#{}", type_name.text, value.text),
        ExpressionKind::Unary { operator, operand } => {
            let sign = match operator {
                UnaryOperator::Minus => "-",
                UnaryOperator::Plus => "+",
                UnaryOperator::Not => "NOT ",
            };
            format!("({sign}{})", expression(operand))
        }
        ExpressionKind::Binary { operator, left, right } => {
            format!("({} {} {})", expression(left), symbol(*operator), expression(right))
        }
        ExpressionKind::Call(tree) => call(tree),
    }
}

fn list(trees: &[Expression]) -> String {
    trees.iter().map(expression).collect::<Vec<_>>().join(", ")
}

fn call(tree: &Call) -> String {
    let arguments = tree.arguments.iter().map(|argument| match argument {
        Argument::Positional(value) => expression(value),
        Argument::Input { name, value } => format!("{} := {}", name.text, expression(value)),
        Argument::Output { name, negated, to } => {
            let not = if *negated { "NOT " } else { "" };
            format!("{not}{} => {}", name.text, to.as_ref().map(expression).unwrap_or_default())
        }
    });
    format!("{}({})", expression(&tree.callee), arguments.collect::<Vec<_>>().join(", "))
}

fn literal(value: &Literal) -> String {
    match value {
        Literal::Bool(true) => "TRUE".to_owned(),
        Literal::Bool(false) => "FALSE".to_owned(),
        Literal::Integer(value) => value.to_string(),
        Literal::Real(value) => format!("{value:?}"),
        Literal::Typed { elementary, value: TypedValue::Integer(value) } => format!("{elementary}#{value}"),
        Literal::Typed { elementary, value: TypedValue::Real(value) } => format!("{elementary}#{value:?}"),
        Literal::Time(nanoseconds) => format!("T#{nanoseconds}ns"),
        Literal::String(bytes) => {
            let mut text = String::from("'");
            for byte in bytes {
                if byte.is_ascii_alphanumeric() {
                    text.push(char::from(*byte));
                } else {
                    let _ = write!(text, "${byte:02X}");
                }
            }
            text + "'"
        }
    }
}

pub(super) fn symbol(operator: BinaryOperator) -> &'static str {
    match operator {
        BinaryOperator::Power => "**",
        BinaryOperator::Multiply => "*",
        BinaryOperator::Divide => "/",
        BinaryOperator::Modulo => "MOD",
        BinaryOperator::Add => "+",
        BinaryOperator::Subtract => "-",
        BinaryOperator::Less => "<",
        BinaryOperator::LessOrEqual => "<=",
        BinaryOperator::Greater => ">",
        BinaryOperator::GreaterOrEqual => ">=",
        BinaryOperator::Equal => "=",
        BinaryOperator::NotEqual => "<>",
        BinaryOperator::And => "AND",
        BinaryOperator::Xor => "XOR",
        BinaryOperator::Or => "OR",
    }
}

/// Statements in one line.
pub(super) fn statements(trees: &[Statement]) -> String {
    trees.iter().map(statement).collect::<Vec<_>>().join(" ")
}

fn statement(tree: &Statement) -> String {
    match &tree.kind {
        StatementKind::Empty => ";".to_owned(),
        StatementKind::Assign { to, value } => format!("{} := {};", expression(to), expression(value)),
        StatementKind::Call(tree) => format!("{};", call(tree)),
        StatementKind::If { branches, otherwise } => {
            let branch = |(condition, body): &(Expression, Vec<Statement>)| {
                format!("{} {{{}}}", expression(condition), statements(body))
            };
            let branches = branches.iter().map(branch).collect::<Vec<_>>().join(" ");
            format!("if {branches} else {{{}}}", statements(otherwise))
        }
        StatementKind::Case { selector, arms, otherwise } => {
            let label = |label: &CaseLabel| match label {
                CaseLabel::Value(value) => expression(value),
                CaseLabel::Range(from, to) => format!("{}..{}", expression(from), expression(to)),
            };
            let arms = arms.iter().map(|arm| {
                let labels = arm.labels.iter().map(label).collect::<Vec<_>>().join(", ");
                format!("{labels}: {{{}}}", statements(&arm.body))
            });
            let arms = arms.collect::<Vec<_>>().join(" ");
            format!("case {} {arms} else {{{}}}", expression(selector), statements(otherwise))
        }
        StatementKind::For { variable, from, to, by, body } => {
            let by = by.as_ref().map(|by| format!(" by {}", expression(by))).unwrap_or_default();
            let (variable, from, to) = (expression(variable), expression(from), expression(to));
            format!("for {variable} {from} to {to}{by} {{{}}}", statements(body))
        }
        StatementKind::While { condition, body } => {
            format!("while {} {{{}}}", expression(condition), statements(body))
        }
        StatementKind::Repeat { body, until } => {
            format!("repeat {{{}}} until {}", statements(body), expression(until))
        }
        StatementKind::Exit => "exit;".to_owned(),
        StatementKind::Continue => "continue;".to_owned(),
        StatementKind::Return => "return;".to_owned(),
    }
}
