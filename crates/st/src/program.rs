//! A program that has been checked, and its run.

use std::collections::HashMap;
use std::sync::Arc;

use crate::SOURCE_BYTES_MAX;
use crate::check::{Checked, Purpose, Surroundings, check};
use crate::code::Slot;
use crate::elementary::Elementary;
use crate::fault::Fault;
use crate::host::Host;
use crate::library::PRELUDE;
use crate::machine::{Budget, Layout, Machine};
use crate::memory::Memory;
use crate::problem::{Problem, Problems, Span};
use crate::retain::{self, Retained};
use crate::sources::Sources;
use crate::syntax::ast::File;
use crate::syntax::{parse, parse_from};
use crate::system::System;
use crate::types::Type;
use crate::value;

/// A variable that is there without being declared: a device variable or a system-defined one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Global {
    /// Its name.
    pub name: String,
    /// Its AT specification, such as `IOBus://unit#1/UDINT 01 C to M`; none if it has none.
    pub at: Option<String>,
    /// Its type as it is written in a declaration, such as `ARRAY[0..14] OF UINT`.
    pub type_name: String,
    /// Whether a program may write it.
    pub writable: bool,
    /// The value of one that never changes, as it is written in a declaration; none: it is refreshed.
    pub constant: Option<String>,
}

/// A device variable that a program uses.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct External {
    /// Its place among the globals that the program was compiled with.
    pub global: usize,
    pub(crate) slot: Slot,
    pub(crate) layout: Layout,
    /// Whether the program writes it.
    pub written: bool,
}

/// PROGRAMs that run together.
#[derive(Clone, Debug)]
pub(crate) struct Task {
    /// In each scan, or in each so many of them.
    pub(crate) every: u64,
    /// Their units, in the order in which they run.
    pub(crate) programs: Vec<u32>,
}

/// A PROGRAM that runs.
#[derive(Clone, Debug)]
pub(crate) struct Owner {
    /// Its name, which may be empty: that of the PROGRAM, or the one that a CONFIGURATION gives it.
    pub(crate) name: String,
    /// The name of the PROGRAM.
    pub(crate) program: String,
}

/// A variable that lies in the memory under a name.
#[derive(Clone, Debug)]
pub(crate) struct Variable {
    /// None: it is global.
    pub(crate) owner: Option<Owner>,
    pub(crate) name: String,
    pub(crate) type_: Type,
    pub(crate) slot: Slot,
    pub(crate) retain: bool,
}

/// A program that can run: compile it once, start it as often as you like.
#[derive(Clone, Debug)]
pub struct Program {
    inner: Arc<Inner>,
}

#[derive(Debug)]
struct Inner {
    sources: Sources,
    checked: Checked,
    retained: Vec<Retained>,
}

/// Reads and checks a program. What it takes for granted are the library and `globals`.
///
/// # Errors
/// What is wrong with it, with places.
///
/// # Panics
/// If a global has a type that cannot be read: whoever gives globals knows their types.
pub fn compile(sources: impl Into<Sources>, globals: &[Global]) -> Result<Program, Problems> {
    let sources = sources.into();
    match checked(&sources, globals, Purpose::Run) {
        Ok(checked) => {
            let retained = retain::of(&checked.variables);
            Ok(Program { inner: Arc::new(Inner { sources, checked, retained }) })
        }
        Err(problems) => Err(Problems::new(sources, problems)),
    }
}

/// Checks files that may be only a part of a program: blocks, functions or types without a PROGRAM.
///
/// # Errors
/// What is wrong with them, with places.
///
/// # Panics
/// As [`compile`].
pub fn judge(sources: impl Into<Sources>, globals: &[Global]) -> Result<(), Problems> {
    let sources = sources.into();
    match checked(&sources, globals, Purpose::Judge) {
        Ok(_) => Ok(()),
        Err(problems) => Err(Problems::new(sources, problems)),
    }
}

fn checked(sources: &Sources, globals: &[Global], purpose: Purpose) -> Result<Checked, Vec<Problem>> {
    let file = read(sources)?;
    let declarations = declarations(globals);
    let (declared, wrong) = parse(&declarations);
    assert!(wrong.is_empty(), "the device variables: {}", Problems::new(&declarations, wrong));
    check(&file, &Surroundings { prelude: &PRELUDE, declared: &declared, globals }, purpose)
}

/// All files as one tree. Each is read by itself: what one leaves open does not reach into the next.
fn read(sources: &Sources) -> Result<File, Vec<Problem>> {
    if sources.size_bytes() > SOURCE_BYTES_MAX {
        let size_bytes = sources.size_bytes();
        let message = format!("the source has {size_bytes} bytes, {SOURCE_BYTES_MAX} are the most");
        return Err(vec![Problem::new(Span::default(), message)]);
    }
    let (mut whole, mut problems) = (File::default(), Vec::new());
    for (text, start) in sources.each() {
        let (file, wrong) = parse_from(text, start);
        problems.extend(wrong);
        whole.append(file);
    }
    problems.extend(second_unnamed(&whole));
    if problems.is_empty() { Ok(whole) } else { Err(problems) }
}

/// Statements without a PROGRAM around them can be in one file only: of two, no one knows which is first.
fn second_unnamed(file: &File) -> Option<Problem> {
    let mut unnamed = file.units.iter().filter(|unit| unit.is_unnamed_program());
    let second = unnamed.nth(1)?;
    let message = "another file has statements without a PROGRAM too";
    let help = "write PROGRAM name … END_PROGRAM around the statements of each";
    Some(Problem::new(second.name.span, message).help(help))
}

fn declarations(globals: &[Global]) -> String {
    let mut text = "VAR_GLOBAL\n".to_owned();
    for Global { name, type_name, constant, .. } in globals {
        let initial = constant.as_ref().map(|value| format!(" := {value}")).unwrap_or_default();
        text.push_str(&format!("{name} : {type_name}{initial};\n"));
    }
    text + "END_VAR\n"
}

impl Program {
    /// The device variables that the program uses.
    #[must_use]
    pub fn externals(&self) -> &[External] {
        &self.inner.checked.externals
    }

    /// The files that it was made of.
    #[must_use]
    pub fn sources(&self) -> &Sources {
        &self.inner.sources
    }

    /// The program at its beginning: every variable has its initial value.
    #[must_use]
    pub fn start(&self) -> Instance {
        let memory = Memory::new(self.inner.checked.initial.clone());
        Instance { program: self.clone(), memory, used: 0, scans: 0 }
    }

    /// How long a task period is by the shortest INTERVAL of the CONFIGURATION, in nanoseconds; none if the program says
    /// nothing of it.
    #[must_use]
    pub fn period_ns(&self) -> Option<u64> {
        self.inner.checked.period_ns
    }
}

/// A program in operation.
#[derive(Clone, Debug)]
pub struct Instance {
    program: Program,
    pub(crate) memory: Memory,
    used: u64,
    /// How many scans have begun.
    scans: u64,
}

/// Where and why a scan ended before its end.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stopped {
    /// What went wrong.
    pub fault: Fault,
    /// The statement, or the index.
    pub span: Span,
}

impl Instance {
    /// Runs each PROGRAM that is due once, by the priorities of their tasks, else in the order of the file. `now_ns` is the time of its timers: nanoseconds from
    /// whatever moment, never less than before. `budget` is how many statements may run.
    ///
    /// # Errors
    /// Where and why it ended before its end; what it has written until then stays.
    pub fn scan(&mut self, now_ns: u64, budget: u64, host: &mut dyn Host) -> Result<(), Stopped> {
        let scans = self.scans;
        self.scans += 1;
        self.set_system(System::FirstScan, scans == 0);
        let checked = &self.program.inner.checked;
        let mut machine = Machine {
            memory: &mut self.memory,
            initial: &checked.initial,
            units: &checked.units,
            layouts: &checked.layouts,
            host,
            now_ns,
            budget: Budget::new(budget),
            steps: 0,
            instance: 0,
            at: Span::default(),
        };
        let due = checked.tasks.iter().filter(|task| scans.is_multiple_of(task.every));
        let result = due.flat_map(|task| &task.programs).try_for_each(|unit| machine.run(*unit));
        let result = result.map_err(|fault| Stopped { fault, span: machine.at });
        self.used = budget - machine.budget.left();
        if result.as_ref().is_err_and(|stopped| stopped.fault.is_instruction_error()) {
            self.set_system(System::InstructionError, true);
        }
        result
    }

    fn set_system(&mut self, system: System, value: bool) {
        let named = &self.program.inner.checked.system;
        if let Some((_, slot)) = named.iter().find(|(own, _)| *own == system) {
            self.memory.set(*slot, value.into());
        }
    }

    /// How many statements the last scan used of its budget.
    #[must_use]
    pub const fn used(&self) -> u64 {
        self.used
    }

    /// The program that runs.
    #[must_use]
    pub const fn program(&self) -> &Program {
        &self.program
    }

    /// Begins again: variables have their initial values, but those with RETAIN, which stay.
    pub fn restart(&mut self) {
        let mut next = self.program.start();
        for kept in &self.program.inner.retained {
            let values = self.memory.slice(kept.slot, kept.slots);
            next.memory.slice_mut(kept.slot, kept.slots).copy_from_slice(values);
        }
        *self = next;
    }

    /// Gives over to a changed program: variables with RETAIN keep their values where name and type are the same.
    #[must_use]
    pub fn succeeded_by(&self, mut next: Self) -> Self {
        let old = self.program.inner.retained.iter();
        let old: HashMap<_, _> = old.map(|before| ((&before.path, &before.shape), before)).collect();
        let program = next.program.clone();
        for kept in &program.inner.retained {
            let before = old.get(&(&kept.path, &kept.shape));
            // The same shape is as long.
            if let Some(before) = before.filter(|before| before.slots == kept.slots) {
                let values = self.memory.slice(before.slot, before.slots);
                next.memory.slice_mut(kept.slot, kept.slots).copy_from_slice(values);
            }
        }
        next
    }

    /// Takes in a device variable: its bytes, little endian, value after value.
    pub fn load(&mut self, external: &External, octets: &[u8]) {
        let mut rest = octets;
        for (offset, elementary) in &external.layout.values {
            let (own, behind) = rest.split_at(elementary.size_bytes().min(rest.len()));
            self.memory.set(external.slot + offset, value::unpack(*elementary, own));
            rest = behind;
        }
    }

    /// Gives out a device variable.
    pub fn store(&self, external: &External, octets: &mut [u8]) {
        let mut rest = octets;
        for (offset, elementary) in &external.layout.values {
            let (own, behind) = rest.split_at_mut(elementary.size_bytes().min(rest.len()));
            value::pack(self.memory.get(external.slot + offset), own);
            rest = behind;
        }
    }

    pub(crate) fn variables(&self) -> &[Variable] {
        &self.program.inner.checked.variables
    }
}

impl External {
    /// How many bytes it has.
    #[must_use]
    pub fn size_bytes(&self) -> usize {
        self.layout.values.iter().map(|(_, elementary): &(u32, Elementary)| elementary.size_bytes()).sum()
    }
}
