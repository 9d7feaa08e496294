//! Statements.

use super::case_labels::CaseLabels;
use super::expressions::Body;
use super::numbers::{coerce, elementary_of, operand_of};
use super::scope::Located;
use super::value::{Kind, Value};
use crate::code::{Assign, Case, CaseArm, Code, For, Statement, StatementKind};
use crate::elementary::{Class, Elementary};
use crate::problem::{Problem, Span};
use crate::syntax::ast::{self, CaseLabel, Expression};
use crate::types::Type;
use crate::value::integer;

impl Body<'_, '_> {
    /// Checks statements; wrong ones are left out, and the program does not run.
    pub(super) fn statements(&mut self, statements: &[ast::Statement]) -> Vec<Statement> {
        self.nested(|body| statements.iter().filter_map(|statement| body.statement(statement)).collect())
    }

    fn statement(&mut self, statement: &ast::Statement) -> Option<Statement> {
        if self.checker.is_given_up() {
            return None;
        }
        let span = statement.span;
        let kind = match &statement.kind {
            ast::StatementKind::Empty => return None,
            ast::StatementKind::Assign { to, value } => self.assign(to, value)?,
            ast::StatementKind::Call(call) => self.call_statement(call)?,
            ast::StatementKind::If { branches, otherwise } => {
                let branches = branches.iter().map(|(condition, body)| {
                    let condition = self.condition(condition);
                    let body = self.statements(body);
                    Some((condition?, body))
                });
                let branches = branches.collect::<Vec<_>>();
                let otherwise = self.statements(otherwise);
                StatementKind::If { branches: branches.into_iter().collect::<Option<_>>()?, otherwise }
            }
            ast::StatementKind::Case { selector, arms, otherwise } => self.case(selector, arms, otherwise)?,
            ast::StatementKind::For { variable, from, to, by, body } => {
                self.count(variable, [Some(from), Some(to), by.as_ref()], body, span)?
            }
            ast::StatementKind::While { condition, body } => {
                let condition = self.condition(condition);
                let body = self.looped(body);
                StatementKind::While { condition: condition?, body }
            }
            ast::StatementKind::Repeat { body, until } => {
                let body = self.looped(body);
                StatementKind::Repeat { body, until: self.condition(until)? }
            }
            ast::StatementKind::Exit => self.in_loop("EXIT", StatementKind::Exit, span)?,
            ast::StatementKind::Continue => self.in_loop("CONTINUE", StatementKind::Continue, span)?,
            ast::StatementKind::Return => StatementKind::Return,
        };
        Some(Statement { kind, span })
    }

    fn looped(&mut self, body: &[ast::Statement]) -> Vec<Statement> {
        self.loops += 1;
        let body = self.statements(body);
        self.loops -= 1;
        body
    }

    fn in_loop(&mut self, name: &str, kind: StatementKind, span: Span) -> Option<StatementKind> {
        if self.loops > 0 {
            return Some(kind);
        }
        let problem = Problem::new(span, format!("{name} is not inside a loop"));
        self.checker.refuse(problem.help("RETURN leaves the program organization unit"))
    }

    fn assign(&mut self, to: &Expression, value: &Expression) -> Option<StatementKind> {
        let Some(target) = self.target(to) else {
            // Both sides are checked, so that mistakes in both are reported.
            self.expression(value);
            return None;
        };
        let value = self.expression_for(value, &target.type_);
        let fitting = coerce(self.checker, value?, &target.type_)?;
        Some(StatementKind::Assign(Assign { to: target.place, value: fitting.code, put: fitting.put }))
    }

    /// A variable that is writable.
    pub(super) fn target(&mut self, expression: &Expression) -> Option<Located> {
        let located = self.place(expression)?;
        self.checker.written(&located, expression.span)?;
        Some(located)
    }

    fn case(
        &mut self,
        selector: &Expression,
        arms: &[ast::CaseArm],
        otherwise: &[ast::Statement],
    ) -> Option<StatementKind> {
        let selector = self.expression(selector);
        let type_ = selector.as_ref().and_then(|value| match &value.kind {
            Kind::Type(type_) => Some(type_.clone()),
            Kind::Integer(_) => Some(Type::Elementary(Elementary::Lint)),
            _ => None,
        });
        let mut checked = Vec::<CaseArm>::new();
        let mut above = CaseLabels::default();
        for arm in arms {
            let mut labels = Vec::new();
            for label in &arm.labels {
                if let Some(type_) = &type_ {
                    labels.extend(self.label(label, type_, &above));
                }
            }
            labels.iter().for_each(|(from, to)| above.take(*from, *to));
            let body = self.statements(&arm.body);
            checked.push(CaseArm { labels, body });
        }
        let otherwise = self.statements(otherwise);
        let selector = selector?;
        let Some(elementary) = type_.as_ref().and_then(selectable) else {
            let message = format!(
                "the selector of CASE must be a whole number, a bit string or an enumeration, not {}",
                selector.kind
            );
            return self.checker.refuse(Problem::new(selector.span, message));
        };
        let value = match selector.kind {
            Kind::Integer(_) => elementary_of(self.checker, selector, elementary)?,
            _ => selector.code,
        };
        Some(StatementKind::Case { selector: Case { value, elementary }, arms: checked, otherwise })
    }

    fn label(&mut self, label: &CaseLabel, type_: &Type, above: &CaseLabels) -> Option<(i128, i128)> {
        let (from, to, span) = match label {
            CaseLabel::Value(value) => {
                let number = self.label_value(value, type_)?;
                (number, number, value.span)
            }
            CaseLabel::Range(from, to) => {
                let span = from.span.to(to.span);
                (self.label_value(from, type_)?, self.label_value(to, type_)?, span)
            }
        };
        if to < from {
            return self.checker.refuse(Problem::new(span, format!("the range {from}..{to} is empty")));
        }
        if above.has_any(from, to) {
            return self.checker.refuse(Problem::new(span, "an arm above has this value already"));
        }
        Some((from, to))
    }

    fn label_value(&mut self, expression: &Expression, type_: &Type) -> Option<i128> {
        let elementary = selectable(type_)?;
        let value = self.expression(expression)?;
        let span = value.span;
        let code = match type_ {
            // A label is compared with the selector.
            Type::Elementary(elementary) => operand_of(self.checker, value, *elementary)?,
            _ => coerce(self.checker, value, type_)?.code,
        };
        match code {
            Code::Constant(bits) => Some(integer(elementary, bits)),
            _ => self.checker.refuse(
                Problem::new(span, "a CASE label must be known before the program runs")
                    .help("use a number, an enumeration value or a VAR CONSTANT"),
            ),
        }
    }

    fn count(
        &mut self,
        variable: &Expression,
        numbers: [Option<&Expression>; 3],
        body: &[ast::Statement],
        span: Span,
    ) -> Option<StatementKind> {
        let target = self.target(variable);
        let values = numbers.map(|number| number.map(|number| self.expression(number)));
        let body = self.looped(body);
        let target = target?;
        let Some(elementary) = target
            .type_
            .elementary()
            .filter(|elementary| matches!(elementary.class(), Class::Signed | Class::Unsigned))
        else {
            let message = format!("FOR counts in a whole number, not in {}", target.type_);
            return self.checker.refuse(Problem::new(variable.span, message));
        };
        let [from, to, by] = values;
        let from = elementary_of(self.checker, from??, elementary)?;
        let to = elementary_of(self.checker, to??, elementary)?;
        let by = match by {
            Some(by) => self.step(by?, elementary)?,
            None => Code::Constant(1),
        };
        if matches!(by, Code::Constant(0)) {
            return self.checker.refuse(Problem::new(span, "the step of FOR is zero"));
        }
        Some(StatementKind::For(For { variable: target.place, elementary, from, to, by, body }))
    }

    /// The step of FOR. A negative constant would become a large step of an unsigned variable, and the loop would
    /// not run.
    fn step(&mut self, by: Value, elementary: Elementary) -> Option<Code> {
        let Some(step) = by.negative_constant().filter(|_| elementary.class() == Class::Unsigned) else {
            return elementary_of(self.checker, by, elementary);
        };
        let message =
            format!("the step {step} is negative, and FOR counts in {elementary}, which is unsigned");
        self.checker.refuse(Problem::new(by.span, message).help("count down in a signed type, such as DINT"))
    }
}

/// The type in which CASE compares.
fn selectable(type_: &Type) -> Option<Elementary> {
    match type_ {
        Type::Enum(_) => Some(Elementary::Lint),
        Type::Elementary(elementary) => {
            let class = elementary.class();
            matches!(class, Class::Signed | Class::Unsigned | Class::BitString).then_some(*elementary)
        }
        _ => None,
    }
}
