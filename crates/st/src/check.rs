//! From the tree of a file to code: names are resolved, types checked, conversions written out, memory laid out.
//!
//! The library's own blocks and the device variables come in as trees of their own, read by the same parser.

mod calls;
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

use std::collections::HashMap;

use crate::code::{Slot, Unit};
use crate::machine::Layout;
use crate::problem::{PROBLEMS_SOUGHT, Problem, Span};
use crate::program::{External, Global, Task, Variable};
use crate::syntax::ast::{File, Pou, TypeDeclaration};
use crate::system::System;
use crate::types::Type;
use scope::{Scope, Symbol};

/// Most slots of a program: 8 MiB.
const SLOTS_MAX: u32 = 1 << 20;

/// What a program is made of.
#[derive(Debug, Default)]
pub(crate) struct Checked {
    pub(crate) units: Vec<Unit>,
    /// The PROGRAMs that run, in this order.
    pub(crate) tasks: Vec<Task>,
    /// How long a scan is by the CONFIGURATION; none: it says nothing.
    pub(crate) period_ns: Option<u64>,
    pub(crate) initial: Vec<u64>,
    pub(crate) layouts: Vec<Layout>,
    pub(crate) variables: Vec<Variable>,
    pub(crate) externals: Vec<External>,
    /// Where the system-defined variables lie that the program names.
    pub(crate) system: Vec<(System, Slot)>,
}

/// Trees that a program is checked against.
pub(crate) struct Surroundings<'t> {
    /// Types and blocks of the library.
    pub(crate) prelude: &'t File,
    /// The device variables as VAR_GLOBAL, in the order of `globals`.
    pub(crate) declared: &'t File,
    pub(crate) globals: &'t [Global],
}

/// What a program is checked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// It is to run, so that it needs a PROGRAM.
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

/// Whose a declaration is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Origin {
    Library,
    User,
}

/// A name for a type or a program organization unit, from its declaration to what it means.
enum Named<'t> {
    Type(&'t TypeDeclaration),
    Block(&'t Pou, Origin),
    Function(&'t Pou),
    Program,
    /// It is being resolved: who meets it now meets himself.
    Resolving,
    /// It is wrong, and that has been told.
    Wrong,
    Shape(Shape),
    Signature(std::rc::Rc<Signature>),
}

/// A type with the value that its variables have at the beginning.
#[derive(Clone)]
struct Shape {
    type_: Type,
    initial: Vec<u64>,
}

/// A function of the program as its callers see it.
struct Signature {
    name: String,
    unit: u32,
    /// Where its inputs, in-outs and outputs lie in the memory: the offset is a slot.
    pins: Vec<crate::types::Member>,
    result: Option<(Slot, Type)>,
}

struct Checker<'t> {
    problems: Vec<Problem>,
    /// By names in capitals.
    named: HashMap<String, Named<'t>>,
    /// Enumeration values that may be named without their type: all types that have one of this name.
    enum_values: HashMap<String, Vec<(std::sync::Arc<crate::types::Enumeration>, i64)>>,
    /// VAR_GLOBAL of the file.
    globals: HashMap<String, Symbol>,
    surroundings: &'t Surroundings<'t>,
    /// Of each device variable that is used: its symbol.
    devices: HashMap<usize, Symbol>,
    /// The scopes of units that are declared and have no code yet.
    pending: Vec<Pending<'t>>,
    /// Where text literals lie.
    literals: std::collections::HashSet<Slot>,
    /// How many types are being resolved.
    type_depth: u32,
    /// How many slots all types have together.
    type_slots: usize,
    /// How deep the code of each unit lies in itself.
    own_depths: HashMap<u32, u32>,
    /// Who calls whom.
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
            surroundings,
            devices: HashMap::new(),
            pending: Vec::new(),
            literals: std::collections::HashSet::new(),
            type_depth: 0,
            type_slots: 0,
            own_depths: HashMap::new(),
            calls: Vec::new(),
            origin: Origin::User,
            // Slot 0 belongs to nobody, so that no reference is it.
            out: Checked { initial: vec![0], ..Checked::default() },
        }
    }

    /// Tells a problem, and has no value to give.
    fn refuse<T>(&mut self, problem: Problem) -> Option<T> {
        if self.problems.len() < PROBLEMS_SOUGHT {
            self.problems.push(problem);
        }
        None
    }

    /// Whether so much is wrong that the rest is left aside.
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
