//! Variables, their members and their elements.

use super::Checker;
use super::expressions::Body;
use super::scope::{Access, Located, Symbol, key};
use super::unknown_names::{nearest, remedy};
use super::value::Kind;
use crate::code::{Code, Dimension, Element};
use crate::elementary::{Class, Elementary};
use crate::problem::{Problem, Span};
use crate::syntax::ast::{Expression, ExpressionKind, Name};
use crate::types::Extent;
use crate::types::{Array, Bound, Role, Type, member};
use crate::value::integer;

/// The elementary values of a type, one after the other; none for a type that also has others.
pub(super) fn flatten(type_: &Type) -> Option<Vec<(u32, Elementary)>> {
    match type_ {
        Type::Elementary(elementary) => Some(vec![(0, *elementary)]),
        Type::Enum(_) => Some(vec![(0, Elementary::Dint)]),
        Type::Array(array) => {
            let element = flatten(&array.element)?;
            let slots = array.element.slots();
            let all = (0..array.elements()).flat_map(|place| {
                element.iter().map(move |(offset, elementary)| (place * slots + offset, *elementary))
            });
            Some(all.collect())
        }
        Type::Struct(structure) => {
            let mut all = Vec::new();
            for member in &structure.members {
                let values = flatten(&member.type_)?;
                all.extend(
                    values.into_iter().map(|(offset, elementary)| (member.offset + offset, elementary)),
                );
            }
            Some(all)
        }
        Type::String(_) | Type::Block(_) | Type::Any | Type::Open(_) => None,
    }
}

impl Checker<'_> {
    /// Refuses a write to a variable that cannot be written, and records a write to a device variable.
    pub(super) fn written(&mut self, located: &Located, span: Span) -> Option<()> {
        match located.access {
            Access::Write => Some(()),
            Access::Device(external) => {
                self.out.externals[external].written = true;
                Some(())
            }
            Access::ReadOnly(why) => {
                self.refuse(Problem::new(span, format!("this cannot be written: {why}")))
            }
        }
    }
}

impl Body<'_, '_> {
    /// The variable that an expression refers to; none, after a report, if it is not a variable.
    pub(super) fn place(&mut self, expression: &Expression) -> Option<Located> {
        match &expression.kind {
            ExpressionKind::Name(name) => match self.symbol(name) {
                Some(Symbol::Variable(located)) => Some(located),
                Some(Symbol::Constant(..)) => {
                    let message = format!("`{name}` is a constant, and a variable is needed");
                    self.checker.refuse(Problem::new(expression.span, message))
                }
                Some(Symbol::Wrong) => None,
                None => self.unknown(name, expression.span),
            },
            ExpressionKind::Member { of, member } => self.member(of, member),
            ExpressionKind::Index { of, indices } => self.element(of, indices, expression.span),
            _ => self.checker.refuse(Problem::new(expression.span, "a variable is needed here")),
        }
    }

    /// The meaning of a name, unless it is not a variable.
    pub(super) fn symbol(&mut self, name: &str) -> Option<Symbol> {
        let key = key(name);
        if let Some(symbol) = self.scope.symbols.get(&key) {
            return Some(symbol.clone());
        }
        if self.is_library() {
            return None;
        }
        if let Some(symbol) = self.checker.globals.get(&key) {
            return Some(symbol.clone());
        }
        self.checker.device_named(name).or_else(|| self.checker.system_variable(name))
    }

    pub(super) fn unknown<T>(&mut self, name: &str, span: Span) -> Option<T> {
        let own = self.scope.symbols.keys().chain(self.checker.globals.keys()).cloned();
        let remedy = remedy(name, own, self.checker.surroundings.globals, "declare it in VAR … END_VAR");
        self.checker.refuse(Problem::new(span, format!("there is no variable `{name}`")).help(remedy))
    }

    fn member(&mut self, of: &Expression, name: &Name) -> Option<Located> {
        let located = self.place(of)?;
        let members = match &located.type_ {
            Type::Struct(structure) => &structure.members,
            Type::Block(block) => &block.members,
            other => {
                let message = format!("{other} has no members");
                return self.checker.refuse(Problem::new(name.span, message));
            }
        };
        let alias = match &located.type_ {
            Type::Block(block) => crate::library::block_pin(&block.name, &name.text),
            _ => None,
        };
        let is_block = matches!(located.type_, Type::Block(_));
        let visible = |role| !is_block || matches!(role, Role::Input | Role::Output);
        let found = member(members, alias.unwrap_or(&name.text)).filter(|found| visible(found.role));
        let Some(found) = found else {
            let names =
                members.iter().filter(|member| visible(member.role)).map(|member| member.name.clone());
            let problem = Problem::new(name.span, format!("{} has no member `{}`", located.type_, name.text));
            let problem = match nearest(&name.text, names) {
                Some(near) => problem.did_you_mean(near),
                None => problem,
            };
            return self.checker.refuse(problem);
        };
        let access = match found.role {
            Role::Output if is_block => Access::ReadOnly("it is an output"),
            _ => located.access,
        };
        let mut place = located.place.clone();
        place.offset += found.offset;
        Some(Located { place, type_: found.type_.clone(), access, is_element: false })
    }

    fn element(&mut self, of: &Expression, indices: &[Expression], span: Span) -> Option<Located> {
        let located = self.place(of)?;
        let (dimensions, element, extent) = match &located.type_ {
            Type::Array(array) => {
                self.count_indices(array.bounds.len(), indices, span)?;
                let dimensions = self.dimensions(array, indices)?;
                (dimensions, array.element.clone(), Extent::Fixed(array.elements()))
            }
            Type::Open(array) => {
                self.count_indices(array.dimensions, indices, span)?;
                let dimensions =
                    indices.iter().map(|index| self.open_dimension(index)).collect::<Option<_>>()?;
                (dimensions, array.element.clone(), array.extent())
            }
            _ => {
                let message = format!("{} has no elements", located.type_);
                return self.checker.refuse(Problem::new(span, message));
            }
        };
        let mut place = located.place.clone();
        place.indices.push(Element { dimensions, element_slots: element.slots(), extent });
        Some(Located { place, type_: element, access: located.access, is_element: true })
    }

    /// a[1] of two dimensions would be a row: IEC 61131-3 permits only elements.
    fn count_indices(&mut self, dimensions: usize, indices: &[Expression], span: Span) -> Option<()> {
        if indices.len() == dimensions {
            return Some(());
        }
        let message =
            format!("the array has {dimensions} dimensions, and {} indices are given", indices.len());
        self.checker.refuse(Problem::new(span, message))
    }

    fn open_dimension(&mut self, index: &Expression) -> Option<Dimension> {
        let (code, elementary) = self.whole_index(index)?;
        Some(Dimension { index: code, elementary, lower: 0, upper: 0, stride: 0, span: index.span })
    }

    fn dimensions(&mut self, array: &Array, indices: &[Expression]) -> Option<Vec<Dimension>> {
        let mut stride = array.elements();
        let mut dimensions = Vec::new();
        for (bound, index) in array.bounds.iter().zip(indices) {
            stride /= bound.count();
            let Bound { lower, upper } = *bound;
            let (code, elementary) = self.index(*bound, index)?;
            dimensions.push(Dimension { index: code, elementary, lower, upper, stride, span: index.span });
        }
        Some(dimensions)
    }

    fn index(&mut self, bound: Bound, index: &Expression) -> Option<(Code, Elementary)> {
        let (code, elementary) = self.whole_index(index)?;
        match code {
            Code::Constant(bits) if !bound.holds(integer(elementary, bits)) => {
                self.outside(bound, integer(elementary, bits), index.span)
            }
            code => Some((code, elementary)),
        }
    }

    /// An index with its type: a whole number.
    fn whole_index(&mut self, index: &Expression) -> Option<(Code, Elementary)> {
        let value = self.expression(index)?;
        match value.kind {
            // Numbers without a type are between the minimum LINT and the maximum ULINT.
            Kind::Integer(number) if number >= 0 => Some((Code::Constant(number as u64), Elementary::Ulint)),
            Kind::Integer(number) => Some((Code::Constant(number as u64), Elementary::Lint)),
            Kind::Type(Type::Elementary(elementary))
                if matches!(elementary.class(), Class::Signed | Class::Unsigned) =>
            {
                Some((value.code, elementary))
            }
            Kind::Type(Type::Enum(_)) => Some((value.code, Elementary::Dint)),
            other => {
                let message = format!("an index is a whole number, not {other}");
                self.checker.refuse(Problem::new(index.span, message))
            }
        }
    }

    fn outside<T>(&mut self, bound: Bound, index: i128, span: Span) -> Option<T> {
        let message = format!("index {index} is outside {}..{}", bound.lower, bound.upper);
        self.checker.refuse(Problem::new(span, message))
    }
}
