//! Initial values: written to the initial image of a variable.

use super::constants::Constants;
use super::scope::Scope;
use super::{Checker, Shape};
use crate::problem::{Problem, Span};
use crate::syntax::ast::{Initial, InitialElement, Name};
use crate::types::{Array, Member, Role, Type, member};

/// The position of an initial value in the source.
pub(super) fn span(initial: &Initial) -> Span {
    match initial {
        Initial::Expression(expression) => expression.span,
        Initial::Array { span, .. } | Initial::Struct { span, .. } => *span,
    }
}

impl Checker<'_> {
    /// A shape with the initial value of a declaration.
    pub(super) fn with_initial(
        &mut self,
        mut shape: Shape,
        initial: Option<&Initial>,
        scope: &Scope,
    ) -> Option<Shape> {
        if let Some(initial) = initial {
            self.write_initial(&shape.type_, initial, &mut shape.initial, scope)?;
        }
        Some(shape)
    }

    fn write_initial(
        &mut self,
        type_: &Type,
        initial: &Initial,
        image: &mut [u64],
        scope: &Scope,
    ) -> Option<()> {
        match (type_, initial) {
            (Type::Array(array), Initial::Array { elements, span }) => {
                self.write_array(array, elements, *span, image, scope)
            }
            (Type::Struct(structure), Initial::Struct { members, .. }) => {
                self.write_members(&structure.members, members, image, scope)
            }
            (Type::Block(block), Initial::Struct { members, .. }) => {
                self.write_members(&block.members, members, image, scope)
            }
            (Type::Elementary(_) | Type::Enum(_) | Type::String(_), Initial::Expression(expression)) => {
                Constants::new(self, scope).write(type_, expression, image)
            }
            (_, other) => {
                let message = format!("this is not an initial value of {type_}");
                let help = match type_ {
                    Type::Array(_) => "an array is written [1, 2, 3] or [15(0)]",
                    Type::Struct(_) | Type::Block(_) => "members are written (name := value, …)",
                    _ => "a single value is written as it is",
                };
                self.refuse(Problem::new(span(other), message).help(help))
            }
        }
    }

    fn write_array(
        &mut self,
        array: &Array,
        elements: &[InitialElement],
        span: Span,
        image: &mut [u64],
        scope: &Scope,
    ) -> Option<()> {
        let size = array.element.slots() as usize;
        let count = i128::from(array.elements());
        let mut written = 0_i128;
        for element in elements {
            let repeat = match &element.repeat {
                Some(repeat) => self.constant_integer(repeat, scope)?,
                None => 1,
            };
            if repeat < 0 || written + repeat > count {
                let message = format!("the array has {count} elements, and more are given");
                return self.refuse(Problem::new(span, message));
            }
            let from = written as usize * size;
            written += repeat;
            if repeat > 0 {
                let first = &mut image[from..from + size];
                self.write_initial(&array.element, &element.value, first, scope)?;
            }
            for place in 1..repeat as usize {
                image.copy_within(from..from + size, from + place * size);
            }
        }
        Some(())
    }

    fn write_members(
        &mut self,
        members: &[Member],
        given: &[(Name, Initial)],
        image: &mut [u64],
        scope: &Scope,
    ) -> Option<()> {
        for (name, initial) in given {
            let Some(member) = member(members, &name.text).filter(|member| member.role != Role::InOut) else {
                let near = super::unknown_names::nearest(
                    &name.text,
                    members.iter().map(|member| member.name.clone()),
                );
                let problem = Problem::new(name.span, format!("there is no member `{}`", name.text));
                return self.refuse(match near {
                    Some(near) => problem.did_you_mean(near),
                    None => problem,
                });
            };
            let from = member.offset as usize;
            let slots = member.type_.slots() as usize;
            self.write_initial(&member.type_, initial, &mut image[from..from + slots], scope)?;
        }
        Some(())
    }
}
