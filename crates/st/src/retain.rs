//! Which parts of a program's memory survive a restart and a change of the program: variables with RETAIN.

use core::fmt::{self, Write};

use crate::memory::Slot;
use crate::types::{Member, Role, Type};
use crate::variable::Variable;

/// A part of the memory that is kept.
#[derive(Clone, Debug)]
pub(crate) struct Retained {
    /// Its owner, in upper case.
    pub(crate) path: String,
    /// Everything on which its slots depend: a variable with a different declaration is another variable.
    pub(crate) shape: String,
    pub(crate) slot: Slot,
    pub(crate) slots: u32,
}

/// All of them, found once when the program is compiled.
pub(crate) fn of(variables: &[Variable]) -> Vec<Retained> {
    let mut all = Vec::new();
    for variable in variables {
        let owner = variable.owner.as_ref().map_or("global ".to_owned(), |owner| format!("{}.", owner.name));
        let path = format!("{owner}{}", variable.name).to_ascii_uppercase();
        collect(&mut all, path, &variable.type_, variable.slot, variable.retain);
    }
    all
}

fn collect(all: &mut Vec<Retained>, path: String, type_: &Type, slot: Slot, retain: bool) {
    if retain {
        let shape = Shape(type_).to_string();
        all.push(Retained { path, shape, slot, slots: type_.slots() });
    } else if holds_retained(type_) {
        collect_parts(all, &path, type_, slot);
    }
}

fn collect_parts(all: &mut Vec<Retained>, path: &str, type_: &Type, slot: Slot) {
    match type_ {
        Type::Block(block) => {
            for member in own(&block.members) {
                let path = format!("{path}.{}", member.name.to_ascii_uppercase());
                collect(all, path, &member.type_, slot + member.offset, member.retain);
            }
        }
        Type::Array(array) => {
            let slots = array.element.slots();
            for element in 0..array.elements() {
                collect(
                    all,
                    format!("{path} {array} {element}"),
                    &array.element,
                    slot + element * slots,
                    false,
                );
            }
        }
        _ => {}
    }
}

/// A VAR_IN_OUT is a variable of its caller, not in the instance.
fn own(members: &[Member]) -> impl Iterator<Item = &Member> {
    members.iter().filter(|member| member.role != Role::InOut)
}

fn holds_retained(type_: &Type) -> bool {
    match type_ {
        Type::Block(block) => {
            own(&block.members).any(|member| member.retain || holds_retained(&member.type_))
        }
        Type::Array(array) => holds_retained(&array.element),
        _ => false,
    }
}

/// A type with all its parts.
struct Shape<'a>(&'a Type);

impl fmt::Display for Shape<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Type::Struct(structure) => write_members(formatter, &structure.members),
            Type::Block(block) => write_members(formatter, &block.members),
            Type::Array(array) => {
                for bound in &array.bounds {
                    write!(formatter, "[{}..{}]", bound.lower, bound.upper)?;
                }
                Shape(&array.element).fmt(formatter)
            }
            Type::Enum(enumeration) => {
                formatter.write_str(&enumeration.name)?;
                enumeration.values.iter().try_for_each(|(name, number)| write!(formatter, " {name}={number}"))
            }
            Type::Elementary(_) | Type::String(_) | Type::Any | Type::Open(_) => self.0.fmt(formatter),
        }
    }
}

fn write_members(formatter: &mut fmt::Formatter<'_>, members: &[Member]) -> fmt::Result {
    formatter.write_char('(')?;
    for member in members {
        let name = member.name.to_ascii_uppercase();
        match member.role {
            // For a reference only its position counts.
            Role::InOut => write!(formatter, "{name}@{}:reference;", member.offset)?,
            _ => write!(formatter, "{name}@{}:{};", member.offset, Shape(&member.type_))?,
        }
    }
    formatter.write_char(')')
}
