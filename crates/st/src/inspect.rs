//! Values of a program's variables by their names, for tests, panels and traces.

mod constant;
#[cfg(test)]
mod tests;

use core::fmt::Write;

use crate::elementary::{Class, Elementary};
use crate::library::text_of;
use crate::memory::Slot;
use crate::program::Instance;
use crate::types::{Role, Type, member};
use crate::variable::Owner;

impl Instance {
    /// The value of a variable as text: `x`, `Main.x`, `timer.Q`, `table[3].speed`. None if there is no such
    /// variable. Arrays and structures include all their parts.
    #[must_use]
    pub fn value(&self, path: &str) -> Option<String> {
        let (type_, slot) = self.find(path)?;
        let mut text = String::new();
        self.write(&mut text, &type_, slot);
        Some(text)
    }

    /// Sets a variable to a constant of Structured Text, such as `16#FF`, `INT#5`, `'text'`, `[1, 2, 3(0)]` or
    /// `(x := 1, y := 2)`, with all elements and members; what [`Instance::value`] returns is such a constant too,
    /// except for texts with `$` or `'`. False, and nothing is set, if there is no such variable, or the text is
    /// not a value of its type.
    pub fn set(&mut self, path: &str, text: &str) -> bool {
        let Some((type_, slot)) = self.find(path) else { return false };
        let Some(image) = constant::read(&type_, text) else { return false };
        self.memory.slice_mut(slot, type_.slots()).copy_from_slice(&image);
        true
    }

    /// The names of all variables for a name: `x`, or `Main.x` with its PROGRAM.
    pub fn names(&self) -> impl Iterator<Item = String> {
        self.variables().iter().map(|variable| match &variable.owner {
            Some(owner) if !owner.name.is_empty() => format!("{}.{}", owner.name, variable.name),
            _ => variable.name.clone(),
        })
    }

    fn find(&self, path: &str) -> Option<(Type, Slot)> {
        let mut parts = split(path);
        let first = parts.next()?;
        let named = |name: &str, is_owner: &dyn Fn(Option<&Owner>) -> bool| {
            self.variables().iter().find(|variable| {
                variable.name.eq_ignore_ascii_case(name) && is_owner(variable.owner.as_ref())
            })
        };
        // A program's own variable hides the global one with the same name.
        let own = named(first, &|owner| owner.is_some()).or_else(|| named(first, &|owner| owner.is_none()));
        let start = match own {
            Some(variable) => variable,
            None => {
                // The first running instance of a PROGRAM is also found by the PROGRAM's name.
                let name = parts.next()?;
                let own =
                    |owner: Option<&Owner>| owner.is_some_and(|owner| owner.name.eq_ignore_ascii_case(first));
                let of_program = |owner: Option<&Owner>| {
                    owner.is_some_and(|owner| owner.program.eq_ignore_ascii_case(first))
                };
                named(name, &own).or_else(|| named(name, &of_program))?
            }
        };
        parts.try_fold((start.type_.clone(), start.slot), |(type_, slot), part| step(&type_, slot, part))
    }

    fn write(&self, text: &mut String, type_: &Type, slot: Slot) {
        match type_ {
            Type::Elementary(elementary) => text.push_str(&written(*elementary, self.memory.get(slot))),
            Type::Enum(enumeration) => {
                let number = self.memory.get(slot) as i64;
                let name = enumeration.values.iter().find(|(_, value)| *value == number);
                match name {
                    Some((name, _)) => text.push_str(name),
                    None => text.push_str(&number.to_string()),
                }
            }
            Type::String(_) => {
                // Writing to a String cannot fail.
                let _ = write!(text, "'{}'", String::from_utf8_lossy(&self.memory.text(slot)));
            }
            Type::Array(array) => {
                let slots = array.element.slots();
                let parts = (0..array.elements()).map(|place| (None, &array.element, slot + place * slots));
                self.write_parts(text, ['[', ']'], parts);
            }
            Type::Struct(structure) => self.write_members(text, &structure.members, slot),
            Type::Block(block) => self.write_members(text, &block.members, slot),
            Type::Any | Type::Open(_) => text.push('?'),
        }
    }

    fn write_members(&self, text: &mut String, members: &[crate::types::Member], slot: Slot) {
        let own = members.iter().filter(|member| member.role != Role::InOut);
        let parts = own.map(|member| (Some(member.name.as_str()), &member.type_, slot + member.offset));
        self.write_parts(text, ['(', ')'], parts);
    }

    fn write_parts<'a>(
        &self,
        text: &mut String,
        brackets: [char; 2],
        parts: impl Iterator<Item = (Option<&'a str>, &'a Type, Slot)>,
    ) {
        text.push(brackets[0]);
        for (place, (name, type_, slot)) in parts.enumerate() {
            if place > 0 {
                text.push_str(", ");
            }
            if let Some(name) = name {
                text.push_str(name);
                text.push_str(" := ");
            }
            self.write(text, type_, slot);
        }
        text.push(brackets[1]);
    }
}

/// Bit strings in hexadecimal, as usual for engineers; everything else like its conversion to STRING.
fn written(elementary: Elementary, bits: u64) -> String {
    match elementary.class() {
        Class::BitString => format!("16#{bits:X}"),
        _ => text_of(elementary, bits).to_string(),
    }
}

/// Names and indices: `a.b[1,2]` is `a`, `b`, `[1,2]`.
fn split(path: &str) -> impl Iterator<Item = &str> {
    path.split('.').flat_map(|part| {
        let index = part.find('[').unwrap_or(part.len());
        let (name, indices) = part.split_at(index);
        [name.trim(), indices.trim()].into_iter().filter(|part| !part.is_empty())
    })
}

fn step(type_: &Type, slot: Slot, part: &str) -> Option<(Type, Slot)> {
    match type_ {
        Type::Array(array) => {
            let indices = part.strip_prefix('[')?.strip_suffix(']')?;
            let mut flat = 0;
            let mut given = indices.split(',');
            for bound in &array.bounds {
                let index = given.next()?.trim().parse::<i64>().ok()?;
                if !bound.holds(index.into()) {
                    return None;
                }
                flat = flat * bound.count() + u32::try_from(index - bound.lower).ok()?;
            }
            given.next().is_none().then(|| (array.element.clone(), slot + flat * array.element.slots()))
        }
        Type::Struct(structure) => {
            member(&structure.members, part).map(|found| (found.type_.clone(), slot + found.offset))
        }
        Type::Block(block) => {
            let own = member(&block.members, part).filter(|found| found.role != Role::InOut);
            own.map(|found| (found.type_.clone(), slot + found.offset))
        }
        _ => None,
    }
}
