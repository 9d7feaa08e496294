//! Constants as a user writes them, outside of a program: the notation of initial values.

use crate::convert::{convert, fits, widens};
use crate::elementary::{Class, Elementary};
use crate::library::value_of;
use crate::memory::Memory;
use crate::syntax::ast::{
    Expression, ExpressionKind, Initial, InitialElement, Literal, Name, TypedValue, UnaryOperator,
};
use crate::syntax::parse_initial;
use crate::types::{Array, Enumeration, Member, Role, Type, member};
use crate::value::{real, real_bits};

/// The slots of the value that a text is; none if it is not a complete value of the type.
pub(super) fn read(type_: &Type, text: &str) -> Option<Vec<u64>> {
    let mut image = Image { text, memory: Memory::new(vec![0; type_.slots() as usize]) };
    match type_ {
        Type::Elementary(elementary) if value_of(*elementary, text).is_some() => {
            image.memory.set(0, value_of(*elementary, text)?);
        }
        _ => image.write(type_, 0, &parse_initial(text)?)?,
    }
    Some(image.memory.slice(0, type_.slots()).to_vec())
}

struct Image<'a> {
    text: &'a str,
    memory: Memory,
}

impl Image<'_> {
    fn write(&mut self, type_: &Type, slot: u32, initial: &Initial) -> Option<()> {
        match (type_, initial) {
            (Type::Array(array), Initial::Array { elements, .. }) => self.write_array(array, slot, elements),
            (Type::Struct(of), Initial::Struct { members, .. }) => {
                self.write_members(&of.members, slot, members)
            }
            (Type::Block(of), Initial::Struct { members, .. }) => {
                self.write_members(&of.members, slot, members)
            }
            (Type::Elementary(elementary), Initial::Expression(expression)) => {
                let written = self.text.get(expression.span.start as usize..expression.span.end as usize);
                let bits = written.and_then(|text| value_of(*elementary, text));
                self.memory.set(slot, bits.or_else(|| elementary_of(*elementary, expression))?);
                Some(())
            }
            (Type::Enum(enumeration), Initial::Expression(expression)) => {
                self.memory.set(slot, enumerated(enumeration, expression)? as u64);
                Some(())
            }
            (Type::String(capacity), Initial::Expression(expression)) => match &expression.kind {
                ExpressionKind::Literal(Literal::String(text)) => {
                    self.memory.put_text(slot, *capacity, text).ok()
                }
                _ => None,
            },
            (
                Type::Elementary(_)
                | Type::String(_)
                | Type::Array(_)
                | Type::Open(_)
                | Type::Struct(_)
                | Type::Enum(_)
                | Type::Block(_)
                | Type::Any,
                _,
            ) => None,
        }
    }

    /// All elements: a list that is too short is not the value of the array.
    fn write_array(&mut self, array: &Array, slot: u32, elements: &[InitialElement]) -> Option<()> {
        let size = array.element.slots();
        let mut written = 0_u32;
        for element in elements {
            let repeat = match &element.repeat {
                Some(repeat) => u32::try_from(whole_number(repeat)?).ok()?,
                None => 1,
            };
            let end = written.checked_add(repeat).filter(|end| *end <= array.elements())?;
            for place in written..end {
                self.write(&array.element, slot + place * size, &element.value)?;
            }
            written = end;
        }
        (written == array.elements()).then_some(())
    }

    /// All members, each once.
    fn write_members(&mut self, members: &[Member], slot: u32, given: &[(Name, Initial)]) -> Option<()> {
        let is_shown = |member: &&Member| member.role != Role::InOut;
        if members.iter().filter(is_shown).count() != given.len() {
            return None;
        }
        for (place, (name, initial)) in given.iter().enumerate() {
            let is_repeated =
                given[..place].iter().any(|(other, _)| other.text.eq_ignore_ascii_case(&name.text));
            let member = member(members, &name.text).filter(is_shown).filter(|_| !is_repeated)?;
            self.write(&member.type_, slot + member.offset, initial)?;
        }
        Some(())
    }
}

/// The literal of an expression, and whether a minus is before it.
fn literal(expression: &Expression) -> Option<(bool, &Literal)> {
    match &expression.kind {
        ExpressionKind::Literal(literal) => Some((false, literal)),
        ExpressionKind::Unary { operator: UnaryOperator::Minus, operand } => {
            literal(operand).map(|(is_negative, literal)| (!is_negative, literal))
        }
        ExpressionKind::Unary { operator: UnaryOperator::Plus, operand } => literal(operand),
        _ => None,
    }
}

fn whole_number(expression: &Expression) -> Option<i128> {
    match literal(expression)? {
        (is_negative, Literal::Integer(number)) => Some(signed(is_negative, (*number).into())),
        (is_negative, Literal::Typed { value: TypedValue::Integer(number), .. }) => {
            Some(signed(is_negative, *number))
        }
        _ => None,
    }
}

const fn signed(is_negative: bool, number: i128) -> i128 {
    if is_negative { -number } else { number }
}

/// The bits of a literal that becomes a value of the type by itself, as in a program.
fn elementary_of(target: Elementary, expression: &Expression) -> Option<u64> {
    let (is_negative, literal) = literal(expression)?;
    let fraction = |number: f64| if is_negative { -number } else { number };
    match literal {
        Literal::Bool(truth) => (!is_negative && target == Elementary::Bool).then_some(u64::from(*truth)),
        Literal::Integer(number) => integer_of(target, signed(is_negative, (*number).into())),
        Literal::Real(number) => real_of(target, fraction(*number)),
        Literal::Typed { elementary, value: TypedValue::Integer(number) } => {
            let number = signed(is_negative, *number);
            let is_own = target == *elementary || widens(*elementary, target);
            (is_own && fits(*elementary, number)).then(|| convert(*elementary, target, number as u64))
        }
        Literal::Typed { elementary, value: TypedValue::Real(number) } => {
            let bits = real_of(*elementary, fraction(*number))?;
            (target == *elementary || widens(*elementary, target)).then(|| convert(*elementary, target, bits))
        }
        Literal::Time(duration_ns) => {
            let duration_ns = if is_negative { duration_ns.checked_neg()? } else { *duration_ns };
            (target.class() == Class::Time).then_some(duration_ns as u64)
        }
        Literal::String(_) => None,
    }
}

fn integer_of(target: Elementary, number: i128) -> Option<u64> {
    match target.class() {
        Class::Real => Some(real_bits(target, number as f64)),
        Class::Bool | Class::BitString | Class::Signed | Class::Unsigned => {
            fits(target, number).then_some(number as u64)
        }
        Class::Time | Class::Date => None,
    }
}

fn real_of(target: Elementary, number: f64) -> Option<u64> {
    let bits = real_bits(target, number);
    let is_held = target.class() == Class::Real && real(target, bits).is_finite();
    is_held.then_some(bits)
}

/// The number of an enumeration value: its name, its name with the type, or a number.
fn enumerated(enumeration: &Enumeration, expression: &Expression) -> Option<i64> {
    let named = |name: &str| {
        let found = enumeration.values.iter().find(|(known, _)| known.eq_ignore_ascii_case(name));
        found.map(|(_, number)| *number)
    };
    match &expression.kind {
        ExpressionKind::Name(name) => named(name),
        ExpressionKind::EnumValue { type_name, value } => {
            let is_own = type_name.text.eq_ignore_ascii_case(&enumeration.name);
            is_own.then(|| named(&value.text)).flatten()
        }
        _ => i64::try_from(whole_number(expression)?).ok(),
    }
}
