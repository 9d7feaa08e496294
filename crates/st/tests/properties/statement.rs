//! Statements over INT variables and an array: as a tree and as text.

use crate::tape::Tape;

/// Variables x0 to x3.
pub(crate) const NUMBERS: usize = 4;
/// Elements of the array.
pub(crate) const ELEMENTS: usize = 4;

#[derive(Clone, Debug)]
pub(crate) enum Number {
    Constant(i16),
    Variable(usize),
    /// The element at a number modulo the size of the array.
    Element(Box<Number>),
    Binary(char, Box<(Number, Number)>),
}

#[derive(Clone, Debug)]
pub(crate) struct Condition(pub(crate) &'static str, pub(crate) Number, pub(crate) Number);

#[derive(Clone, Debug)]
pub(crate) enum Statement {
    Assign(usize, Number),
    AssignElement(Number, Number),
    If(Vec<(Condition, Vec<Statement>)>, Vec<Statement>),
    Case(Number, Vec<((i16, i16), Vec<Statement>)>, Vec<Statement>),
    /// With a separate variable for each level of loops.
    For {
        level: usize,
        from: i16,
        to: i16,
        by: i16,
        body: Vec<Statement>,
    },
    /// At most this number of iterations.
    While {
        level: usize,
        turns: i16,
        condition: Condition,
        body: Vec<Statement>,
    },
    Repeat {
        level: usize,
        turns: i16,
        until: Condition,
        body: Vec<Statement>,
    },
    Exit,
    Continue,
    Return,
}

/// Statements from choices.
pub(crate) fn statements(tape: &mut Tape<'_>, levels: usize, loops: usize) -> Vec<Statement> {
    (0..tape.below(4)).map(|_| statement(tape, levels, loops)).collect()
}

fn statement(tape: &mut Tape<'_>, levels: usize, loops: usize) -> Statement {
    let choices = if levels == 0 { 4 } else { 10 };
    match tape.below(choices) {
        0 | 4 => Statement::Assign(tape.below(NUMBERS), number(tape, 2)),
        1 => Statement::AssignElement(number(tape, 1), number(tape, 2)),
        2 | 3 if loops > 0 && tape.below(2) == 0 => match tape.below(5) {
            0 | 1 => Statement::Exit,
            2 | 3 => Statement::Continue,
            _ => Statement::Return,
        },
        5 | 6 => if_statement(tape, levels, loops),
        7 => case(tape, levels, loops),
        8 => Statement::For {
            level: loops,
            from: constant(tape),
            to: constant(tape),
            by: tape.pick(&[1, -1, 2, -3]),
            body: statements(tape, levels - 1, loops + 1),
        },
        9 => {
            let (turns, condition) = (tape.below(5) as i16, condition(tape));
            let (level, body) = (loops, statements(tape, levels - 1, loops + 1));
            match tape.below(2) {
                0 => Statement::While { level, turns, condition, body },
                _ => Statement::Repeat { level, turns, until: condition, body },
            }
        }
        _ => Statement::Assign(tape.below(NUMBERS), number(tape, 1)),
    }
}

fn if_statement(tape: &mut Tape<'_>, levels: usize, loops: usize) -> Statement {
    let branches = (0..=tape.below(2)).map(|_| (condition(tape), statements(tape, levels - 1, loops)));
    Statement::If(branches.collect(), statements(tape, levels - 1, loops))
}

/// Arms whose ranges follow each other.
fn case(tape: &mut Tape<'_>, levels: usize, loops: usize) -> Statement {
    let mut next = -6;
    let arms = (0..tape.below(4)).map(|_| {
        let from = next + tape.below(3) as i16;
        let to = from + tape.below(3) as i16;
        next = to + 1;
        ((from, to), statements(tape, levels - 1, loops))
    });
    let arms = arms.collect();
    Statement::Case(number(tape, 1), arms, statements(tape, levels - 1, loops))
}

fn condition(tape: &mut Tape<'_>) -> Condition {
    Condition(tape.pick(&["<", "<=", "=", "<>", ">", ">="]), number(tape, 1), number(tape, 1))
}

fn constant(tape: &mut Tape<'_>) -> i16 {
    tape.below(9) as i16 - 4
}

fn number(tape: &mut Tape<'_>, levels: usize) -> Number {
    match tape.below(if levels == 0 { 3 } else { 5 }) {
        0 => Number::Constant(constant(tape)),
        1 => Number::Constant(tape.bits() as i16),
        2 => Number::Variable(tape.below(NUMBERS)),
        3 => Number::Element(Box::new(number(tape, levels - 1))),
        _ => {
            let operator = tape.pick(&['+', '-', '*']);
            Number::Binary(operator, Box::new((number(tape, levels - 1), number(tape, levels - 1))))
        }
    }
}

impl Number {
    pub(crate) fn text(&self) -> String {
        match self {
            Self::Constant(number) => format!("INT#{number}"),
            Self::Variable(place) => format!("x{place}"),
            Self::Element(index) => element(index),
            Self::Binary(operator, sides) => format!("({} {operator} {})", sides.0.text(), sides.1.text()),
        }
    }
}

fn element(index: &Number) -> String {
    format!("a[ABS({} MOD {ELEMENTS})]", index.text())
}

impl Condition {
    fn text(&self) -> String {
        format!("{} {} {}", self.1.text(), self.0, self.2.text())
    }
}

pub(crate) fn text(statements: &[Statement]) -> String {
    statements.iter().map(|statement| statement.text() + ";\n").collect()
}

impl Statement {
    fn text(&self) -> String {
        match self {
            Self::Assign(to, value) => format!("x{to} := {}", value.text()),
            Self::AssignElement(index, value) => format!("{} := {}", element(index), value.text()),
            Self::If(branches, otherwise) => {
                let branches = branches
                    .iter()
                    .map(|(condition, body)| format!("{} THEN\n{}", condition.text(), text(body)));
                let branches = branches.collect::<Vec<_>>().join("ELSIF ");
                format!("IF {branches}ELSE\n{}END_IF", text(otherwise))
            }
            Self::Case(selector, arms, otherwise) => {
                let arms = arms.iter().map(|((from, to), body)| format!("{from}..{to}: ;{}", text(body)));
                format!(
                    "CASE {} OF\n{}ELSE\n{}END_CASE",
                    selector.text(),
                    arms.collect::<String>(),
                    text(otherwise)
                )
            }
            Self::For { level, from, to, by, body } => {
                format!("FOR f{level} := {from} TO {to} BY {by} DO\n{}END_FOR", text(body))
            }
            Self::While { level, turns, condition, body } => {
                let body = text(body);
                let condition = condition.text();
                format!(
                    "w{level} := 0;\nWHILE w{level} < {turns} AND {condition} DO\nw{level} := w{level} + 1;\n{body}END_WHILE"
                )
            }
            Self::Repeat { level, turns, until, body } => {
                let (body, until) = (text(body), until.text());
                format!(
                    "w{level} := 0;\nREPEAT\nw{level} := w{level} + 1;\n{body}UNTIL w{level} >= {turns} OR {until} END_REPEAT"
                )
            }
            Self::Exit => "EXIT".to_owned(),
            Self::Continue => "CONTINUE".to_owned(),
            Self::Return => "RETURN".to_owned(),
        }
    }
}
