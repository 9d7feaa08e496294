//! A program that has been checked, and its execution.

use std::collections::HashMap;
use std::sync::Arc;

use crate::SOURCE_BYTES_MAX;
use crate::check::{Checked, Purpose, Surroundings, check};
use crate::fault::Fault;
use crate::host::Host;
use crate::library::PRELUDE;
use crate::machine::Machine;
use crate::memory::Memory;
use crate::problem::{Problem, Span};
use crate::problems::Problems;
use crate::retain::{self, Retained};
use crate::scan::{Budget, Scan};
use crate::sources::Sources;
use crate::syntax::ast::File;
use crate::syntax::{parse, parse_from};
use crate::system::System;
use crate::value;
use crate::variable::{External, Global, Variable};

/// An executable program: it is compiled once and can be started any number of times.
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

/// Reads and checks a program. It may use the library and `globals`.
///
/// # Errors
/// The problems, with positions.
///
/// # Panics
/// If a global has a type that cannot be parsed: the caller must pass valid types.
pub fn compile(sources: impl Into<Sources>, globals: &[Global]) -> Result<Program, Problems> {
    let sources = sources.into();
    let checked = checked(&sources, globals, Purpose::Run)?;
    let retained = retain::of(&checked.variables);
    Ok(Program { inner: Arc::new(Inner { sources, checked, retained }) })
}

/// Checks files that may be only part of a program: blocks, functions or types without a PROGRAM.
///
/// # Errors
/// The problems, with positions.
///
/// # Panics
/// As [`compile`].
pub fn judge(sources: impl Into<Sources>, globals: &[Global]) -> Result<(), Problems> {
    let sources = sources.into();
    checked(&sources, globals, Purpose::Judge).map(|_| ())
}

fn checked(sources: &Sources, globals: &[Global], purpose: Purpose) -> Result<Checked, Problems> {
    let file = read(sources).map_err(|problems| Problems::of_syntax(sources.clone(), problems))?;
    let declarations = declarations(globals);
    let (declared, wrong) = parse(&declarations);
    assert!(wrong.is_empty(), "the device variables: {}", Problems::new(&declarations, wrong));
    let surroundings = Surroundings { prelude: &PRELUDE, declared: &declared, globals };
    check(&file, &surroundings, purpose).map_err(|problems| Problems::new(sources.clone(), problems))
}

/// All files as one tree. Each is read separately: a block left open in one does not extend into the next.
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

/// Statements without a PROGRAM around them are permitted in one file only: the order of two would be undefined.
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

    /// The files from which it was made.
    #[must_use]
    pub fn sources(&self) -> &Sources {
        &self.inner.sources
    }

    /// The program at its start: every variable has its initial value.
    #[must_use]
    pub fn start(&self) -> Instance {
        let memory = Memory::new(self.inner.checked.initial.clone());
        Instance { program: self.clone(), memory, used: 0, scans: 0 }
    }

    /// The length of a task period according to the shortest INTERVAL of the CONFIGURATION, in nanoseconds;
    /// none if the program does not define it.
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
    /// Number of scans that have been started.
    scans: u64,
}

/// Position and reason of the early end of a scan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stopped {
    /// The fault.
    pub fault: Fault,
    /// The statement, or the index.
    pub span: Span,
}

impl Instance {
    /// Executes each PROGRAM that is due once, in the order of the priorities of their tasks, else in the order
    /// of the file. `now_ns` is the time of its timers: nanoseconds from any origin, never decreasing. `budget`
    /// is the number of statements that may run.
    ///
    /// # Errors
    /// Position and reason of its early end; what it has written before is kept.
    pub fn scan(&mut self, now_ns: u64, budget: u64, host: &mut dyn Host) -> Result<(), Stopped> {
        let scans = self.scans;
        self.scans += 1;
        self.set_system(System::FirstScan, scans == 0);
        let checked = &self.program.inner.checked;
        let scan = Scan {
            memory: &mut self.memory,
            layouts: &checked.layouts,
            host,
            now_ns,
            budget: Budget::new(budget),
            steps: 0,
        };
        let (initial, units) = (&checked.initial, &checked.units);
        let mut machine = Machine { scan, initial, units, instance: 0, at: Span::default() };
        let due = checked.tasks.iter().filter(|task| scans.is_multiple_of(task.every));
        let result = due.flat_map(|task| &task.programs).try_for_each(|unit| machine.run(*unit));
        let result = result.map_err(|fault| Stopped { fault, span: machine.at });
        self.used = budget - machine.scan.budget.left();
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

    /// Number of statements of its budget that the last scan has used.
    #[must_use]
    pub const fn used(&self) -> u64 {
        self.used
    }

    /// The program being executed.
    #[must_use]
    pub const fn program(&self) -> &Program {
        &self.program
    }

    /// Restarts: variables have their initial values, except those with RETAIN, which keep their values.
    pub fn restart(&mut self) {
        let mut next = self.program.start();
        for kept in &self.program.inner.retained {
            let values = self.memory.slice(kept.slot, kept.slots);
            next.memory.slice_mut(kept.slot, kept.slots).copy_from_slice(values);
        }
        *self = next;
    }

    /// Hands the values over to a changed program: variables with RETAIN keep their values if name and type are
    /// the same.
    #[must_use]
    pub fn succeeded_by(&self, mut next: Self) -> Self {
        let old = self.program.inner.retained.iter();
        let old: HashMap<_, _> = old.map(|before| ((&before.path, &before.shape), before)).collect();
        let program = next.program.clone();
        for kept in &program.inner.retained {
            let before = old.get(&(&kept.path, &kept.shape));
            // The same shape has the same length.
            if let Some(before) = before.filter(|before| before.slots == kept.slots) {
                let values = self.memory.slice(before.slot, before.slots);
                next.memory.slice_mut(kept.slot, kept.slots).copy_from_slice(values);
            }
        }
        next
    }

    /// Reads a device variable: its bytes, little endian, value after value.
    pub fn load(&mut self, external: &External, octets: &[u8]) {
        let mut rest = octets;
        for (offset, elementary) in &external.layout.values {
            let (own, behind) = rest.split_at(elementary.size_bytes().min(rest.len()));
            self.memory.set(external.slot + offset, value::unpack(*elementary, own));
            rest = behind;
        }
    }

    /// Writes a device variable.
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
