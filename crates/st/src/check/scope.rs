//! The meaning of a name inside a program organization unit.

use std::collections::HashMap;

use crate::code::{Base, Place};
use crate::memory::Slot;
use crate::types::Type;

/// The names of one unit, in capitals.
#[derive(Clone, Debug, Default)]
pub(super) struct Scope {
    pub(super) symbols: HashMap<String, Symbol>,
    /// Slots that get their initial values at each call.
    pub(super) fresh: Vec<core::ops::Range<Slot>>,
}

/// A variable or a constant.
#[derive(Clone, Debug)]
pub(super) enum Symbol {
    Variable(Located),
    /// VAR CONSTANT of an elementary type: its value is in the code.
    Constant(Type, u64),
    /// Its declaration is wrong, and this has been reported.
    Wrong,
}

/// A variable, or a part of one.
#[derive(Clone, Debug)]
pub(super) struct Located {
    pub(super) place: Place,
    pub(super) type_: Type,
    pub(super) access: Access,
    /// Whether it is an element of an array, and others follow it.
    pub(super) is_element: bool,
}

/// Who may write a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Access {
    Write,
    /// A device variable with its position among the externals; a write to it is recorded there.
    Device(usize),
    /// Why it cannot be written.
    ReadOnly(&'static str),
}

impl Located {
    pub(super) fn in_memory(slot: Slot, type_: Type, access: Access) -> Self {
        Self {
            place: Place { base: Base::Memory, offset: slot, indices: Vec::new() },
            type_,
            access,
            is_element: false,
        }
    }

    pub(super) fn at(base: Base, offset: u32, type_: Type, access: Access) -> Self {
        Self { place: Place { base, offset, indices: Vec::new() }, type_, access, is_element: false }
    }
}

/// A name as a key: upper and lower case are equal.
pub(super) fn key(name: &str) -> String {
    name.to_ascii_uppercase()
}
