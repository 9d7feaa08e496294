//! Expressions that are known before the program runs.

use super::expressions::Body;
use super::scope::Scope;
use super::value::Kind;
use super::{Checker, numbers};
use crate::code::Code;
use crate::elementary::{Class, Elementary};
use crate::problem::Problem;
use crate::syntax::ast::Expression;
use crate::types::{Type, string_slots};
use crate::value::integer;

/// Evaluates constant expressions in a scope.
pub(super) struct Constants<'c, 't> {
    checker: &'c mut Checker<'t>,
    scope: &'c Scope,
}

impl<'c, 't> Constants<'c, 't> {
    pub(super) const fn new(checker: &'c mut Checker<'t>, scope: &'c Scope) -> Self {
        Self { checker, scope }
    }

    /// A whole number.
    pub(super) fn integer(mut self, expression: &Expression) -> Option<i128> {
        let value = self.body().expression(expression)?;
        match (&value.kind, &value.code) {
            (Kind::Integer(number), _) => Some(*number),
            (Kind::Type(Type::Elementary(elementary)), Code::Constant(bits))
                if matches!(elementary.class(), Class::Signed | Class::Unsigned | Class::BitString) =>
            {
                Some(integer(*elementary, *bits))
            }
            (Kind::Type(Type::Enum(_)), Code::Constant(bits)) => Some((*bits as i64).into()),
            _ => self.checker.refuse(
                Problem::new(
                    expression.span,
                    "this is not a whole number that is known before the program runs",
                )
                .help("use a number, or a VAR CONSTANT"),
            ),
        }
    }

    /// A TIME in nanoseconds.
    pub(super) fn duration(mut self, expression: &Expression) -> Option<i64> {
        let value = self.body().expression_for(expression, &Type::Elementary(Elementary::Time))?;
        match numbers::elementary_of(self.checker, value, Elementary::Time)? {
            Code::Constant(bits) => Some(bits as i64),
            _ => self.refuse_unknown(expression),
        }
    }

    fn refuse_unknown<T>(self, expression: &Expression) -> Option<T> {
        let message = "this is not a duration that is known before the program runs";
        self.checker.refuse(Problem::new(expression.span, message))
    }

    /// Writes the value of a type to the image of its variable.
    pub(super) fn write(mut self, type_: &Type, expression: &Expression, image: &mut [u64]) -> Option<()> {
        let value = self.body().expression_for(expression, type_)?;
        if let (Type::String(capacity), Kind::Type(Type::String(length)), Code::Address(place)) =
            (type_, &value.kind, &value.code)
        {
            if length > capacity {
                let message = format!("the text has {length} characters, and {type_} holds {capacity}");
                return self.checker.refuse(Problem::new(expression.span, message));
            }
            let (from, slots) = (place.offset as usize, string_slots(*length) as usize);
            let literal = place.base == crate::code::Base::Memory && self.checker.is_literal(place.offset);
            if literal {
                let text = &self.checker.out.initial[from..from + slots];
                image[..slots].copy_from_slice(text);
                return Some(());
            }
        } else {
            let value = numbers::coerce(self.checker, value, type_)?;
            if let Code::Constant(bits) = value.code {
                image[0] = bits;
                return Some(());
            }
        }
        self.checker
            .refuse(Problem::new(expression.span, "an initial value must be known before the program runs"))
    }

    fn body(&mut self) -> Body<'_, 't> {
        Body::for_constants(self.checker, self.scope)
    }
}
