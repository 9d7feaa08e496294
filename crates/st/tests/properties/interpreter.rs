//! Executes statements, and counts their cost.

use crate::statement::{Condition, ELEMENTS, NUMBERS, Number, Statement};

/// Maximum nesting depth of loops.
pub(crate) const LOOPS: usize = 4;

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Interpreter {
    pub(crate) numbers: [i16; NUMBERS],
    pub(crate) elements: [i16; ELEMENTS],
    /// The variables of FOR.
    pub(crate) counters: [i16; LOOPS],
    /// The iterations of WHILE and REPEAT.
    pub(crate) turns: [i16; LOOPS],
    /// Number of statements executed, and number of iterations ended.
    pub(crate) used: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Flow {
    Next,
    Exit,
    Continue,
    Return,
}

impl Interpreter {
    pub(crate) fn run(&mut self, statements: &[Statement]) -> Flow {
        for statement in statements {
            self.used += 1;
            let flow = self.statement(statement);
            if flow != Flow::Next {
                return flow;
            }
        }
        Flow::Next
    }

    fn statement(&mut self, statement: &Statement) -> Flow {
        match statement {
            Statement::Assign(to, value) => self.numbers[*to] = self.number(value),
            Statement::AssignElement(index, value) => {
                let value = self.number(value);
                let place = self.place(index);
                self.elements[place] = value;
            }
            Statement::If(branches, otherwise) => {
                let chosen = branches.iter().find(|(condition, _)| self.holds(condition));
                return self.run(chosen.map_or(otherwise, |(_, body)| body));
            }
            Statement::Case(selector, arms, otherwise) => {
                let number = self.number(selector);
                let chosen = arms.iter().find(|((from, to), _)| (from..=to).contains(&&number));
                return self.run(chosen.map_or(otherwise, |(_, body)| body));
            }
            Statement::For { level, from, to, by, body } => {
                return self.count(*level, [*from, *to, *by], body);
            }
            Statement::While { level, turns, condition, body } => {
                // The number of iterations is set by a separate statement, and counted by one in each iteration.
                self.used += 1;
                self.turns[*level] = 0;
                while self.turns[*level] < *turns && self.holds(condition) {
                    match self.turn(*level, body) {
                        Flow::Exit => break,
                        Flow::Return => return Flow::Return,
                        _ => self.used += 1,
                    }
                }
            }
            Statement::Repeat { level, turns, until, body } => {
                self.used += 1;
                self.turns[*level] = 0;
                loop {
                    match self.turn(*level, body) {
                        Flow::Exit => break,
                        Flow::Return => return Flow::Return,
                        _ => self.used += 1,
                    }
                    if self.turns[*level] >= *turns || self.holds(until) {
                        break;
                    }
                }
            }
            Statement::Exit => return Flow::Exit,
            Statement::Continue => return Flow::Continue,
            Statement::Return => return Flow::Return,
        }
        Flow::Next
    }

    fn turn(&mut self, level: usize, body: &[Statement]) -> Flow {
        self.used += 1;
        self.turns[level] += 1;
        self.run(body)
    }

    fn count(&mut self, level: usize, [from, to, by]: [i16; 3], body: &[Statement]) -> Flow {
        self.counters[level] = from;
        while if by > 0 { self.counters[level] <= to } else { self.counters[level] >= to } {
            match self.run(body) {
                Flow::Exit => break,
                Flow::Return => return Flow::Return,
                _ => self.used += 1,
            }
            self.counters[level] += by;
        }
        Flow::Next
    }

    fn holds(&self, condition: &Condition) -> bool {
        let (left, right) = (self.number(&condition.1), self.number(&condition.2));
        match condition.0 {
            "<" => left < right,
            "<=" => left <= right,
            "=" => left == right,
            "<>" => left != right,
            ">" => left > right,
            _ => left >= right,
        }
    }

    fn number(&self, number: &Number) -> i16 {
        match number {
            Number::Constant(number) => *number,
            Number::Variable(place) => self.numbers[*place],
            Number::Element(index) => self.elements[self.place(index)],
            Number::Binary(operator, sides) => {
                let (left, right) = (self.number(&sides.0), self.number(&sides.1));
                match operator {
                    '+' => left.wrapping_add(right),
                    '-' => left.wrapping_sub(right),
                    _ => left.wrapping_mul(right),
                }
            }
        }
    }

    fn place(&self, index: &Number) -> usize {
        usize::from((self.number(index) % ELEMENTS as i16).unsigned_abs())
    }
}
