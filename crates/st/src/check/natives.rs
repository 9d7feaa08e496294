//! Calls of functions of the library.

use super::expressions::Body;
use super::numbers::{coerce, elementary_of, operand_of};
use super::operands::with_number;
use super::scope::Located;
use super::value::{Kind, Value};
use crate::code::{Code, Element, NativeArgument, NativeCall};
use crate::convert::{common, natural, widens};
use crate::elementary::{Class, Elementary};
use crate::library::{self, Function, Native, Pin, ResultType, Takes};
use crate::machine::ARGUMENTS_MAX;
use crate::memory::Slot;
use crate::problem::{Problem, Span};
use crate::syntax::ast::{Argument, Call, Expression, Name};
use crate::types::Extent;
use crate::types::{STRING_CHARACTERS_MAX, Type, string_slots};

/// Maximum number of arguments of a call: each has three slots at most.
const GIVEN_MAX: usize = ARGUMENTS_MAX / 3;

/// An argument that has been checked.
enum Looked {
    Value(Value),
    Variable(Located, Span),
    /// It is left out: the pin's default.
    Default(u64),
}

/// The types of the generic pins of a call.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Generic {
    Elementary(Elementary),
    Text,
}

impl Body<'_, '_> {
    /// `wanted` is the type that numbers without a type become if nothing else determines it.
    pub(super) fn call_native(
        &mut self,
        native: Native,
        call: &Call,
        wanted: Option<Elementary>,
    ) -> Option<Value> {
        let function = native.0;
        let given = self.native_pins(function, call)?;
        let mut looked = Vec::new();
        for (pin, expression) in given {
            looked.push((pin, self.look(function, pin, expression, call.span)?));
        }
        let generic = self.generic(function, &looked, wanted, call.span)?;
        let capacity = text_capacity(function, &looked);
        let mut arguments = Vec::new();
        let mut elements = None;
        for (pin, looked) in looked {
            arguments.push(self.native_argument(pin, looked, generic, &mut elements)?);
        }
        self.native_value(native, generic, capacity, arguments, call.span)
    }

    /// A text as a value of a type.
    pub(super) fn value_of_text(&mut self, to: Elementary, value: Value, span: Span) -> Option<Value> {
        let (native, arguments) = (Native(&library::FROM_TEXT), vec![NativeArgument::Value(value.code)]);
        self.native_value(native, Generic::Elementary(to), None, arguments, span)
    }

    /// A value as a text.
    pub(super) fn text_of_value(&mut self, from: Elementary, value: Value, span: Span) -> Option<Value> {
        let ResultType::TextOf(capacity) = library::TO_TEXT.result else { return None };
        let (native, arguments) = (Native(&library::TO_TEXT), vec![NativeArgument::Value(value.code)]);
        self.native_value(native, Generic::Elementary(from), Some(capacity), arguments, span)
    }

    /// A value with a type: a number without a type gets the narrowest one from DINT on, or LREAL.
    pub(super) fn typed(&mut self, value: Value) -> Value {
        let elementary = match value.kind {
            Kind::Integer(number) => natural(number).map(|natural| natural.max(Elementary::Dint)),
            Kind::Real(_) => Some(Elementary::Lreal),
            _ => None,
        };
        let span = value.span;
        match elementary {
            Some(elementary) => match elementary_of(self.checker, value, elementary) {
                Some(code) => Value::of(Type::Elementary(elementary), code, span),
                None => Value { kind: Kind::Nothing, code: Code::Constant(0), span },
            },
            None => value,
        }
    }

    fn native_pins<'a>(
        &mut self,
        function: &'static Function,
        call: &'a Call,
    ) -> Option<Vec<(&'static Pin, Option<&'a Expression>)>> {
        let mut given: Vec<(&'static Pin, Option<&'a Expression>)> =
            function.pins.iter().map(|pin| (pin, None)).collect();
        let mut next = 0;
        for argument in &call.arguments {
            let (place, expression, span) = match argument {
                Argument::Positional(expression) => {
                    if next == given.len() && function.variadic && next < GIVEN_MAX {
                        given.push((&function.pins[function.pins.len() - 1], None));
                    }
                    self.refuse_comparison(expression, |name| {
                        function.pins.iter().any(|pin| pin.name.eq_ignore_ascii_case(name))
                    })?;
                    next += 1;
                    (next - 1, expression, expression.span)
                }
                Argument::Input { name, value } => {
                    let place = self.native_pin(function, name)?;
                    while place >= given.len() {
                        given.push((&function.pins[function.pins.len() - 1], None));
                    }
                    (place, value, name.span)
                }
                Argument::Output { name, .. } => {
                    let message = format!("`{}` has no output `{}`", function.name, name.text);
                    return self.checker.refuse(Problem::new(name.span, message));
                }
            };
            let Some(pin) = given.get_mut(place) else {
                let most = if function.variadic { GIVEN_MAX } else { function.pins.len() };
                let message = format!("`{}` has {most} arguments at most", function.name);
                return self.checker.refuse(Problem::new(span, message));
            };
            if pin.1.replace(expression).is_some() {
                let message = format!("the pin `{}` is given twice", pin.0.name);
                return self.checker.refuse(Problem::new(span, message));
            }
        }
        Some(given)
    }

    fn native_pin(&mut self, function: &Function, name: &Name) -> Option<usize> {
        let of_name = |pin: &Pin| {
            pin.name.eq_ignore_ascii_case(&name.text)
                || (!pin.alias.is_empty() && pin.alias.eq_ignore_ascii_case(&name.text))
        };
        match function.pins.iter().position(of_name).or_else(|| further_pin(function, &name.text)) {
            Some(place) => Some(place),
            None => {
                self.unknown_pin(function.name, function.pins.iter().map(|pin| pin.name.to_owned()), name)
            }
        }
    }

    fn look(
        &mut self,
        function: &Function,
        pin: &Pin,
        expression: Option<&Expression>,
        span: Span,
    ) -> Option<Looked> {
        let Some(expression) = expression else {
            return match pin.default {
                Some(default) => Some(Looked::Default(default)),
                None => {
                    let message = format!("`{}` needs its argument `{}`", function.name, pin.name);
                    self.checker.refuse(Problem::new(span, message))
                }
            };
        };
        match pin.takes {
            Takes::Variable(_) | Takes::Elements { written: true } => {
                let located = self.target(expression)?;
                Some(Looked::Variable(located, expression.span))
            }
            Takes::Elements { written: false } | Takes::Reference => {
                let located = self.place(expression)?;
                Some(Looked::Variable(located, expression.span))
            }
            _ => self.expression(expression).map(Looked::Value),
        }
    }

    /// The type that the generic pins have in this call.
    fn generic(
        &mut self,
        function: &Function,
        looked: &[(&Pin, Looked)],
        wanted: Option<Elementary>,
        span: Span,
    ) -> Option<Generic> {
        let exact = looked.iter().find_map(|(pin, looked)| match (pin.takes, looked) {
            (Takes::Variable(classes), Looked::Variable(located, span)) => Some((classes, located, *span)),
            _ => None,
        });
        if let Some((classes, located, span)) = exact {
            let elementary =
                located.type_.elementary().filter(|elementary| classes.contains(&elementary.class()));
            return match elementary {
                Some(elementary) => Some(Generic::Elementary(elementary)),
                None => self.refuse_class(function, &Kind::Type(located.type_.clone()), classes, span),
            };
        }
        let mut met: Option<Generic> = None;
        let mut met_at = span;
        let mut classes: &[Class] = &[];
        for (pin, looked) in looked {
            let (Takes::Generic(of) | Takes::GenericOrText(of)) = pin.takes else { continue };
            let Looked::Value(value) = looked else { continue };
            classes = of;
            let text = matches!(pin.takes, Takes::GenericOrText(_));
            let found = match &value.kind {
                Kind::Type(Type::String(_)) if text => Generic::Text,
                Kind::Type(Type::Elementary(elementary)) => Generic::Elementary(*elementary),
                Kind::Integer(_) | Kind::Real(_) => continue,
                other => return self.refuse_class(function, other, of, value.span),
            };
            met = match (met, found) {
                (None, found) => {
                    met_at = value.span;
                    Some(found)
                }
                (Some(Generic::Elementary(a)), Generic::Elementary(b)) => match common(a, b) {
                    Some(both) => Some(Generic::Elementary(both)),
                    None => return self.refuse_mixture(function, a.name(), b.name(), value.span),
                },
                (Some(Generic::Text), Generic::Text) => Some(Generic::Text),
                _ => return self.refuse_mixture(function, "STRING", "a number", value.span),
            };
        }
        if classes.is_empty() {
            return Some(Generic::Elementary(Elementary::Bool));
        }
        match met {
            Some(Generic::Text) => Some(Generic::Text),
            Some(Generic::Elementary(elementary)) => {
                let literals = numbers_in(looked);
                let wide = literals.iter().try_fold(elementary, with_literal);
                let fitting = wide.and_then(|wide| of_classes(wide, classes));
                match fitting {
                    Some(elementary) => Some(Generic::Elementary(elementary)),
                    None => {
                        let kind = Kind::Type(Type::Elementary(elementary));
                        self.refuse_class(function, &kind, classes, met_at)
                    }
                }
            }
            None => self.literal_type(function, looked, classes, wanted, span),
        }
    }

    /// Only numbers: the type that the context requires if it can hold them all, else the narrowest from DINT
    /// on, or LREAL.
    fn literal_type(
        &mut self,
        function: &Function,
        looked: &[(&Pin, Looked)],
        classes: &[Class],
        wanted: Option<Elementary>,
        span: Span,
    ) -> Option<Generic> {
        let literals = numbers_in(looked);
        let holds_all = |elementary: &Elementary| {
            classes.contains(&elementary.class()) && literals.iter().all(|kind| holds(*elementary, kind))
        };
        if let Some(wanted) = wanted.filter(holds_all) {
            return Some(Generic::Elementary(wanted));
        }
        let Some(first) = literals.first() else {
            return Some(Generic::Elementary(Elementary::Bool));
        };
        let start = match first {
            Kind::Real(_) => Elementary::Lreal,
            _ if classes.contains(&Class::Signed) => Elementary::Dint,
            _ if classes.contains(&Class::BitString) => Elementary::Byte,
            _ => Elementary::Lreal,
        };
        let wide = literals.iter().try_fold(start, with_literal);
        match wide.and_then(|wide| of_classes(wide, classes)) {
            Some(elementary) => Some(Generic::Elementary(elementary)),
            None => self.refuse_class(function, first, classes, span),
        }
    }

    fn refuse_class<T>(
        &mut self,
        function: &Function,
        kind: &Kind,
        classes: &[Class],
        span: Span,
    ) -> Option<T> {
        let names = Elementary::ALL.iter().filter(|elementary| classes.contains(&elementary.class()));
        let names = names.map(|elementary| elementary.name()).collect::<Vec<_>>();
        let message = format!("`{}` does not accept {kind}", function.name);
        self.checker.refuse(Problem::new(span, message).help(format!("it accepts {}", names.join(", "))))
    }

    fn refuse_mixture<T>(&mut self, function: &Function, one: &str, other: &str, span: Span) -> Option<T> {
        let message = format!("`{}` requires values of one type, not {one} and {other}", function.name);
        self.checker.refuse(Problem::new(span, message).help("convert one of them"))
    }

    fn native_argument(
        &mut self,
        pin: &Pin,
        looked: Looked,
        generic: Generic,
        elements: &mut Option<Type>,
    ) -> Option<NativeArgument> {
        match looked {
            Looked::Default(bits) => Some(NativeArgument::Value(Code::Constant(bits))),
            Looked::Value(value) => match pin.takes {
                Takes::Any(classes) => self.native_of_any(pin, value, classes),
                _ => self.native_input(pin, value, generic).map(NativeArgument::Value),
            },
            Looked::Variable(located, span) => match pin.takes {
                Takes::Elements { .. } => self.native_elements(located, span, elements),
                Takes::Reference => Some(NativeArgument::Any(located.place)),
                _ => Some(NativeArgument::Reference(located.place)),
            },
        }
    }

    /// The argument of a pin that takes every type of these classes: its bits, and whether they are a ULINT.
    fn native_of_any(&mut self, pin: &Pin, value: Value, classes: &[Class]) -> Option<NativeArgument> {
        let value = self.typed(value);
        match &value.kind {
            Kind::Type(Type::Elementary(Elementary::Ulint)) if classes.contains(&Class::Unsigned) => {
                Some(NativeArgument::Ulint(value.code))
            }
            Kind::Type(Type::Elementary(elementary)) if classes.contains(&elementary.class()) => {
                Some(NativeArgument::Value(value.code))
            }
            other => {
                let message = format!("`{}` does not accept {other}", pin.name);
                self.checker.refuse(Problem::new(value.span, message))
            }
        }
    }

    fn native_input(&mut self, pin: &Pin, value: Value, generic: Generic) -> Option<Code> {
        match (pin.takes, generic) {
            (Takes::Fixed(elementary), _) => elementary_of(self.checker, value, elementary),
            (Takes::Text, _) => {
                let target = Type::String(STRING_CHARACTERS_MAX as u16);
                coerce(self.checker, value, &target).map(|fitting| fitting.code)
            }
            (Takes::GenericOrText(_), Generic::Text) if matches!(value.kind, Kind::Type(Type::String(_))) => {
                Some(value.code)
            }
            (_, Generic::Elementary(elementary)) => operand_of(self.checker, value, elementary),
            (_, Generic::Text) => {
                let message = format!("`{}` is a STRING here, like the others", pin.name);
                self.checker.refuse(Problem::new(value.span, message))
            }
        }
    }

    /// A whole array is passed as its first element.
    fn native_elements(
        &mut self,
        located: Located,
        span: Span,
        elements: &mut Option<Type>,
    ) -> Option<NativeArgument> {
        // The slots after a member of an element hold the other members of that element, not more of the same kind.
        let is_element = located.is_element || matches!(located.type_, Type::Array(_) | Type::Open(_));
        let located = match &located.type_ {
            Type::Array(array) => first_element(&located, &array.element, Extent::Fixed(array.elements())),
            Type::Open(array) => first_element(&located, &array.element, array.extent()),
            _ => located,
        };
        if located.type_.holds_blocks() {
            let message = format!("an instance of {} cannot be copied", located.type_);
            return self.checker.refuse(Problem::new(span, message));
        }
        match elements {
            Some(before) if *before != located.type_ => {
                let message = format!("the elements are {before} and {}", located.type_);
                return self.checker.refuse(Problem::new(span, message).help("both must have the same type"));
            }
            _ => *elements = Some(located.type_.clone()),
        }
        let element_slots = located.type_.slots();
        Some(NativeArgument::Elements { place: located.place, element_slots, in_array: is_element })
    }

    fn native_value(
        &mut self,
        native: Native,
        generic: Generic,
        capacity: Option<u16>,
        arguments: Vec<NativeArgument>,
        span: Span,
    ) -> Option<Value> {
        let elementary = match generic {
            Generic::Elementary(elementary) => elementary,
            Generic::Text => Elementary::Byte,
        };
        let kind = match (native.0.result, generic) {
            (result, Generic::Elementary(elementary)) if result.elementary(elementary).is_some() => {
                Kind::Type(Type::Elementary(result.elementary(elementary).unwrap_or(elementary)))
            }
            _ => Kind::Type(Type::String(capacity.unwrap_or(STRING_CHARACTERS_MAX as u16))),
        };
        let text = match &kind {
            Kind::Type(Type::String(capacity)) => {
                let slots = string_slots(*capacity) as usize;
                (self.checker.allocate(&vec![0; slots], span)?, *capacity)
            }
            _ => (Slot::default(), 0),
        };
        let code = Code::Native(Box::new(NativeCall { native, elementary, arguments, text }));
        Some(Value { kind, code, span })
    }
}

/// The position of a pin after the last one of the table: `In3` after `In2`.
fn further_pin(function: &Function, name: &str) -> Option<usize> {
    let last = function.pins.last().filter(|_| function.variadic)?;
    let letters = last.name.trim_end_matches(|last: char| last.is_ascii_digit());
    let number: usize = last.name.get(letters.len()..)?.parse().ok()?;
    let (given_letters, given) = name.split_at_checked(letters.len())?;
    let further = given.parse::<usize>().ok()?.checked_sub(number)?;
    let place = function.pins.len() - 1 + further;
    (given_letters.eq_ignore_ascii_case(letters) && place < GIVEN_MAX).then_some(place)
}

fn first_element(located: &Located, element: &Type, extent: Extent) -> Located {
    let mut place = located.place.clone();
    // No index: the first of all.
    place.indices.push(Element { dimensions: Vec::new(), element_slots: element.slots(), extent });
    Located { place, type_: element.clone(), access: located.access, is_element: true }
}

/// The numbers without types among the generic arguments.
fn numbers_in(looked: &[(&Pin, Looked)]) -> Vec<Kind> {
    let generic =
        looked.iter().filter(|(pin, _)| matches!(pin.takes, Takes::Generic(_) | Takes::GenericOrText(_)));
    let kinds = generic.filter_map(|(_, looked)| match looked {
        Looked::Value(Value { kind: kind @ (Kind::Integer(_) | Kind::Real(_)), .. }) => Some(kind.clone()),
        _ => None,
    });
    kinds.collect()
}

/// Whether a number without a type can be of this type.
fn holds(elementary: Elementary, kind: &Kind) -> bool {
    match (kind, elementary.class()) {
        (_, Class::Time | Class::Date) => false,
        (_, Class::Real) => true,
        (Kind::Integer(number), _) => crate::convert::fits(elementary, *number),
        _ => false,
    }
}

/// The narrowest type that holds a number and fits this one.
fn with_literal(elementary: Elementary, kind: &Kind) -> Option<Elementary> {
    match kind {
        Kind::Integer(number) => match elementary.class() {
            // A value that does not fit is reported with its position.
            Class::Bool | Class::Time | Class::Date => Some(elementary),
            _ => with_number(elementary, *number),
        },
        Kind::Real(_) => {
            [Elementary::Real, Elementary::Lreal].into_iter().find(|real| widens(elementary, *real))
        }
        _ => Some(elementary),
    }
}

/// The type itself if it is in one of the classes, else the REAL to which it is converted, if that is.
fn of_classes(elementary: Elementary, classes: &[Class]) -> Option<Elementary> {
    if classes.contains(&elementary.class()) {
        return Some(elementary);
    }
    let reals = [Elementary::Real, Elementary::Lreal];
    reals.into_iter().find(|real| classes.contains(&Class::Real) && widens(elementary, *real))
}

/// The maximum number of characters of a STRING result.
fn text_capacity(function: &Function, looked: &[(&Pin, Looked)]) -> Option<u16> {
    let capacities = looked.iter().filter_map(|(_, looked)| match looked {
        Looked::Value(Value { kind: Kind::Type(Type::String(capacity)), .. }) => Some(usize::from(*capacity)),
        _ => None,
    });
    let characters = match function.result {
        ResultType::TextOf(capacity) => capacity.into(),
        ResultType::TextOfAll => capacities.sum(),
        ResultType::Text | ResultType::Generic => capacities.max()?,
        ResultType::Fixed(_) | ResultType::Whole => return None,
    };
    Some(characters.min(STRING_CHARACTERS_MAX) as u16)
}
