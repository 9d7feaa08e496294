//! Arrays of any length: the arguments of a VAR_IN_OUT, and the bounds of its array.

use super::expressions::Body;
use super::numbers::converted;
use super::scope::Located;
use super::value::Value;
use crate::code::{Base, Code, Place, Put};
use crate::elementary::Elementary;
use crate::problem::{Problem, Span};
use crate::syntax::ast::{Argument, Call, Expression};
use crate::types::{Member, OpenArray, Type};

impl Body<'_, '_> {
    /// An array for an in-out of any length: its position, and its bounds.
    pub(super) fn open(
        &mut self,
        pin: &Member,
        array: &OpenArray,
        located: &Located,
        span: Span,
    ) -> Option<Vec<(u32, Code, Put)>> {
        let bounds = bounds_of(located).filter(|bounds| bounds.len() == array.dimensions);
        let is_own = match &located.type_ {
            Type::Array(given) => given.element == array.element,
            Type::Open(given) => given.element == array.element,
            _ => false,
        };
        let Some(bounds) = bounds.filter(|_| is_own) else {
            let message = format!("`{}` requires {}, not {}", pin.name, pin.type_, located.type_);
            let help = "the elements have exactly the type of its elements";
            return self.checker.refuse(Problem::new(span, message).help(help));
        };
        let parts =
            core::iter::once(Code::Address(located.place.clone())).chain(bounds.into_iter().flatten());
        Some((pin.offset..).zip(parts).map(|(offset, code)| (offset, code, Put::Value)).collect())
    }

    /// `LOWER_BOUND(array, dimension)` and `UPPER_BOUND`: IEC 61131-3, table 36; a DINT.
    pub(super) fn bound_of_array(&mut self, is_upper: bool, call: &Call) -> Option<Value> {
        let given = |argument: &'_ Argument| match argument {
            Argument::Positional(expression) => Some(expression.clone()),
            Argument::Input { value, .. } => Some(value.clone()),
            Argument::Output { .. } => None,
        };
        let arguments: Vec<Expression> = call.arguments.iter().filter_map(given).collect();
        let [array, dimension] = arguments.as_slice() else {
            let problem = Problem::new(call.span, "it needs an array and the number of a dimension");
            return self.checker.refuse(problem.help("dimensions count from 1: LOWER_BOUND(table, 1)"));
        };
        let located = self.place(array)?;
        let number = self.checker.constant_integer(dimension, self.scope)?;
        let place = usize::try_from(number - 1).ok();
        let bounds = place.and_then(|place| bounds_of(&located)?.into_iter().nth(place));
        let Some(bounds) = bounds else {
            let message = format!("{} has no dimension {number}", located.type_);
            return self.checker.refuse(Problem::new(dimension.span, message));
        };
        let code = bounds.into_iter().nth(usize::from(is_upper))?;
        let code = converted(code, Elementary::Lint, Elementary::Dint);
        Some(Value::of(Type::Elementary(Elementary::Dint), code, call.span))
    }
}

/// The lower and the upper bound of each dimension of an array, as LINT; none if it is not an array.
fn bounds_of(located: &Located) -> Option<Vec<[Code; 2]>> {
    match &located.type_ {
        Type::Array(array) => {
            let bounds = array.bounds.iter();
            Some(
                bounds
                    .map(|bound| [bound.lower, bound.upper].map(|bound| Code::Constant(bound as u64)))
                    .collect(),
            )
        }
        Type::Open(array) => {
            let (base, reference) = match located.place.base {
                Base::ReferenceInMemory(slot) => (Base::Memory, slot),
                Base::ReferenceInInstance(offset) => (Base::Instance, offset),
                Base::Memory | Base::Instance => return None,
            };
            let load = |offset| Code::Load(Place { base, offset, indices: Vec::new() });
            let dimensions = 0..array.dimensions as u32;
            Some(dimensions.map(|place| [1, 2].map(|side| load(reference + 2 * place + side))).collect())
        }
        _ => None,
    }
}
