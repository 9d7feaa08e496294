//! From the tree of a file to code: resolves names, checks types, makes conversions explicit, lays out memory.
//!
//! The library's blocks and the device variables are added as separate trees, read by the same parser.

mod calls;
mod case_labels;
mod configuration;
mod constants;
mod declarations;
mod expressions;
mod initials;
mod natives;
mod numbers;
mod open_arrays;
mod operands;
mod places;
mod recursion;
mod scope;
mod statements;
mod types;
mod units;
mod unknown_names;
mod value;

use std::collections::HashMap;

use crate::code::{Task, Unit};
use crate::layout::Layout;
use crate::memory::Slot;
use crate::problem::{PROBLEMS_SOUGHT, Problem, Span};
use crate::syntax::ast::{File, Pou, TypeDeclaration};
use crate::system::System;
use crate::types::Type;
use crate::variable::{External, Global, Variable};
use scope::{Scope, Symbol};

/// Maximum number of slots of a program: 8 MiB.
const SLOTS_MAX: u32 = 1 << 20;

/// The results of checking a program.
#[derive(Debug, Default)]
pub(crate) struct Checked {
    pub(crate) units: Vec<Unit>,
    /// The PROGRAMs that run, in this order.
    pub(crate) tasks: Vec<Task>,
    /// The length of a scan from the CONFIGURATION; none: it does not define one.
    pub(crate) period_ns: Option<u64>,
    pub(crate) initial: Vec<u64>,
    pub(crate) layouts: Vec<Layout>,
    pub(crate) variables: Vec<Variable>,
    pub(crate) externals: Vec<External>,
    /// The slots of the system-defined variables that the program uses.
    pub(crate) system: Vec<(System, Slot)>,
}

/// Trees against which a program is checked.
pub(crate) struct Surroundings<'t> {
    /// Types and blocks of the library.
    pub(crate) prelude: &'t File,
    /// The device variables as VAR_GLOBAL, in the order of `globals`.
    pub(crate) declared: &'t File,
    pub(crate) globals: &'t [Global],
}

/// The purpose of checking a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// It is to run, so it needs a PROGRAM.
    Run,
    /// It may be a part of a program: blocks, functions or types alone.
    Judge,
}

/// Checks a file.
pub(crate) fn check(
    file: &File,
    surroundings: &Surroundings<'_>,
    purpose: Purpose,
) -> Result<Checked, Vec<Problem>> {
    let mut checker = Checker::new(surroundings);
    checker.enter(surroundings.prelude, Origin::Library);
    checker.resolve_types(surroundings.prelude);
    assert!(checker.problems.is_empty(), "the library's own blocks: {:?}", checker.problems);
    checker.enter(file, Origin::User);
    checker.declare_globals(file);
    checker.resolve_types(file);
    checker.units(file);
    checker.refuse_recursion();
    checker.refuse_lack(file, purpose);
    if checker.problems.is_empty() { Ok(checker.out) } else { Err(checker.problems) }
}

/// The owner of a declaration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Origin {
    Library,
    User,
}

/// A name of a type or a program organization unit, from its declaration to its meaning.
enum Named<'t> {
    Type(&'t TypeDeclaration),
    Block(&'t Pou, Origin),
    Function(&'t Pou),
    Program,
    /// It is being resolved: a reference to it now is a reference to itself.
    Resolving,
    /// It is wrong, and this has been reported.
    Wrong,
    Shape(Shape),
    Signature(std::rc::Rc<Signature>),
}

/// A type with the initial value of its variables.
#[derive(Clone)]
struct Shape {
    type_: Type,
    initial: Vec<u64>,
}

/// A function of the program as its callers see it.
struct Signature {
    name: String,
    unit: u32,
    /// The positions of its inputs, in-outs and outputs in the memory: the offset is a slot.
    pins: Vec<crate::types::Member>,
    result: Option<(Slot, Type)>,
}

struct Checker<'t> {
    problems: Vec<Problem>,
    /// By names in capitals.
    named: HashMap<String, Named<'t>>,
    /// Enumeration values that may be used without their type: all types that have one with this name.
    enum_values: HashMap<String, Vec<(std::sync::Arc<crate::types::Enumeration>, i64)>>,
    /// VAR_GLOBAL of the file.
    globals: HashMap<String, Symbol>,
    /// Where the names of types, units and VAR_GLOBAL of the files are declared, by names in capitals.
    first_places: HashMap<String, Span>,
    surroundings: &'t Surroundings<'t>,
    /// For each device variable in use: its symbol.
    devices: HashMap<usize, Symbol>,
    /// The scopes of units that are declared and have no code yet.
    pending: Vec<Pending<'t>>,
    /// The slots of text literals.
    literals: std::collections::HashSet<Slot>,
    /// Number of types that are being resolved.
    type_depth: u32,
    /// Total number of slots of all types.
    type_slots: usize,
    /// Nesting depth of the code of each unit.
    own_depths: HashMap<u32, u32>,
    /// Caller and called unit of each call.
    calls: Vec<(u32, u32, Span)>,
    /// Whether library names with a leading underscore may be called.
    origin: Origin,
    out: Checked,
}

/// A unit whose body is still to be checked.
struct Pending<'t> {
    pou: &'t Pou,
    unit: u32,
    scope: Scope,
    origin: Origin,
}

impl<'t> Checker<'t> {
    fn new(surroundings: &'t Surroundings<'t>) -> Self {
        Self {
            problems: Vec::new(),
            named: HashMap::new(),
            enum_values: HashMap::new(),
            globals: HashMap::new(),
            first_places: HashMap::new(),
            surroundings,
            devices: HashMap::new(),
            pending: Vec::new(),
            literals: std::collections::HashSet::new(),
            type_depth: 0,
            type_slots: 0,
            own_depths: HashMap::new(),
            calls: Vec::new(),
            origin: Origin::User,
            // Slot 0 is not used, so that no reference leads to it.
            out: Checked { initial: vec![0], ..Checked::default() },
        }
    }

    /// Reports a problem, and returns no value.
    fn refuse<T>(&mut self, problem: Problem) -> Option<T> {
        if self.problems.len() < PROBLEMS_SOUGHT {
            self.problems.push(problem);
        }
        None
    }

    /// Whether there are so many problems that the rest is not checked.
    fn is_given_up(&self) -> bool {
        self.problems.len() >= PROBLEMS_SOUGHT
    }

    /// Takes slots with these initial values out of the memory.
    fn allocate(&mut self, initial: &[u64], span: Span) -> Option<Slot> {
        let slot = self.out.initial.len();
        if slot + initial.len() > SLOTS_MAX as usize {
            return self.refuse(Problem::new(
                span,
                format!("the program has more variables than its memory of {SLOTS_MAX} values holds"),
            ));
        }
        self.out.initial.extend_from_slice(initial);
        Slot::try_from(slot).ok()
    }

    fn new_unit(&mut self) -> u32 {
        self.out.units.push(Unit::default());
        (self.out.units.len() - 1) as u32
    }
}
