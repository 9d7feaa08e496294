//! The variables of a program with their names: its own, and those of its surroundings.

use crate::elementary::Elementary;
use crate::layout::Layout;
use crate::memory::Slot;
use crate::types::Type;

/// A variable that exists without a declaration: a device variable or a system-defined one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Global {
    /// Its name.
    pub name: String,
    /// Its AT specification, such as `IOBus://unit#1/UDINT 01 C to M`; none if it has none.
    pub at: Option<String>,
    /// Its type in the notation of a declaration, such as `ARRAY[0..14] OF UINT`.
    pub type_name: String,
    /// Whether a program may write it.
    pub writable: bool,
    /// The value of a constant one, in the notation of a declaration; none: it is refreshed.
    pub constant: Option<String>,
}

/// A device variable that a program uses.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct External {
    /// Its position among the globals with which the program was compiled.
    pub global: usize,
    pub(crate) slot: Slot,
    pub(crate) layout: Layout,
    /// Whether the program writes it.
    pub written: bool,
}

impl External {
    /// Its number of bytes.
    #[must_use]
    pub fn size_bytes(&self) -> usize {
        self.layout.values.iter().map(|(_, elementary): &(u32, Elementary)| elementary.size_bytes()).sum()
    }
}

/// A PROGRAM instance.
#[derive(Clone, Debug)]
pub(crate) struct Owner {
    /// Its name, which may be empty: that of the PROGRAM, or the one in a CONFIGURATION.
    pub(crate) name: String,
    /// The name of the PROGRAM.
    pub(crate) program: String,
}

/// A variable in the memory, with its name.
#[derive(Clone, Debug)]
pub(crate) struct Variable {
    /// None: it is global.
    pub(crate) owner: Option<Owner>,
    pub(crate) name: String,
    pub(crate) type_: Type,
    pub(crate) slot: Slot,
    pub(crate) retain: bool,
}
