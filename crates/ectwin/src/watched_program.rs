//! User programs in files that may change while they run.

mod stamps;

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use plc::{DeviceVariables, Program};

use crate::program_file::{ProgramFileError, ProgramText};

pub(crate) use stamps::{Stamps, stamps};

/// The files of a user program, and their contents as read for one unit.
#[derive(Debug)]
pub(crate) struct WatchedProgram {
    /// Files and folders, as named.
    pub(crate) paths: Vec<PathBuf>,
    /// Their state before they were read.
    pub(crate) stamps: Option<Stamps>,
    /// Their contents.
    pub(crate) text: ProgramText,
    pub(crate) variables: DeviceVariables,
    pub(crate) budget_statements: u64,
}

/// A program to be loaded, and the position of its unit.
pub(crate) type Loaded = (usize, Box<dyn Program + Send>);

/// A change of a program, for those units that have to load it.
pub(crate) struct Change {
    pub(crate) programs: Vec<Loaded>,
    pub(crate) report: Report,
}

/// What is logged when a change has been loaded.
pub(crate) struct Report {
    words: String,
    /// The change before it was wrong, and a warning.
    ends_warning: bool,
}

impl Report {
    pub(crate) fn log(&self) {
        if self.ends_warning {
            tracing::warn!("{}", self.words);
        } else {
            tracing::info!("{}", self.words);
        }
    }
}

/// Checks the files of a program repeatedly, for all units that run it.
pub(crate) struct Watch {
    /// Files and folders, as named.
    paths: Vec<PathBuf>,
    /// The state of the files before they were last read; none: it is not known.
    read: Option<Stamps>,
    /// Their state at the last check, or why it could not be determined.
    seen: Result<Stamps, String>,
    users: Vec<User>,
    /// The last logged error about files that cannot be read.
    logged: Option<String>,
    /// A file or a folder was missing at the last check.
    is_gone: bool,
    /// The last change was wrong, or could not be read.
    is_wrong: bool,
}

/// A unit that runs the program.
struct User {
    position: usize,
    running: Arc<ProgramText>,
    variables: DeviceVariables,
    budget_statements: u64,
}

impl Watch {
    /// One watch for each program: units whose programs have the same files share one.
    pub(crate) fn all(programs: impl IntoIterator<Item = (usize, WatchedProgram)>) -> Vec<Self> {
        let mut watches = BTreeMap::<Vec<PathBuf>, Self>::new();
        for (position, program) in programs {
            let WatchedProgram { paths, stamps, text, variables, budget_statements } = program;
            let behind_links = |path: &PathBuf| path.canonicalize().unwrap_or_else(|_| path.clone());
            let watch = watches.entry(paths.iter().map(behind_links).collect());
            let watch = watch.or_insert_with(|| Self::new(paths, stamps.clone()));
            if watch.read != stamps {
                // The files have changed between two units.
                watch.read = None;
            }
            let running = watch.same_text(text);
            watch.users.push(User { position, running, variables, budget_statements });
        }
        watches.into_values().collect()
    }

    fn new(paths: Vec<PathBuf>, read: Option<Stamps>) -> Self {
        let seen = read.clone().ok_or_else(String::new);
        Self { paths, read, seen, users: Vec::new(), logged: None, is_gone: false, is_wrong: false }
    }

    fn same_text(&self, text: ProgramText) -> Arc<ProgramText> {
        match self.users.first() {
            Some(first) if *first.running == text => Arc::clone(&first.running),
            _ => Arc::new(text),
        }
    }

    /// The program of each unit that must load it: its files have changed, and it has no mistakes for that
    /// unit. Mistakes are logged once, and the old program continues.
    pub(crate) fn look(&mut self) -> Option<Change> {
        let now = stamps(&self.paths);
        // A file that is being written changes from check to check, and is read when it no longer changes.
        // While an editor replaces it, it may be missing for a moment.
        let rests = self.seen == now;
        self.seen = now;
        match &self.seen {
            _ if !rests => None,
            Ok(stamps) if self.read.as_ref() == Some(stamps) && !self.is_gone => {
                self.logged = None;
                None
            }
            // Files that come back are read again, changed or not, so that the log shows what runs.
            Ok(stamps) => self.read(stamps.clone()),
            Err(reason) => {
                self.is_gone = true;
                self.log_once(reason.clone());
                None
            }
        }
    }

    fn read(&mut self, stamps: Stamps) -> Option<Change> {
        self.is_gone = false;
        match ProgramText::read(&self.paths) {
            Ok(text) => {
                self.read = Some(stamps);
                self.logged = None;
                self.compile(text)
            }
            Err(error) => {
                if !matches!(&error, ProgramFileError::Unreadable { reason, .. } if reason.may_pass()) {
                    self.read = Some(stamps);
                }
                self.log_once(error.to_string());
                None
            }
        }
    }

    fn log_once(&mut self, reason: String) {
        if self.logged.as_ref() != Some(&reason) {
            tracing::warn!("{reason}; the old program continues");
            self.logged = Some(reason);
            self.is_wrong = true;
        }
    }

    fn compile(&mut self, text: ProgramText) -> Option<Change> {
        let (name, text) = (self.name(), Arc::new(text));
        let mut loaded = Vec::new();
        let mut wrong = BTreeMap::<String, Vec<usize>>::new();
        // A reload would restart every timer in a unit that already runs this text.
        for user in self.users.iter_mut().filter(|user| user.running != text) {
            match text.compile(&user.variables, user.budget_statements) {
                Ok(program) => {
                    user.running = Arc::clone(&text);
                    loaded.push((user.position, program));
                }
                Err(error) => wrong.entry(error.to_string()).or_default().push(user.position),
            }
        }
        let ends_warning = core::mem::replace(&mut self.is_wrong, !wrong.is_empty());
        match (loaded.is_empty() && wrong.is_empty(), ends_warning) {
            (true, true) => tracing::warn!("{name} is correct again, and is the program that runs"),
            (true, false) => tracing::debug!("{name} was saved without changes"),
            (false, _) => {}
        }
        for (words, positions) in wrong {
            for line in words.lines() {
                tracing::warn!("{}", user_file::escaped(line));
            }
            let units = units(&positions);
            tracing::warn!("{name} has changed and is wrong: the old program continues in {units}");
        }
        let positions: Vec<_> = loaded.iter().map(|(position, _)| *position).collect();
        let words = match ends_warning {
            true => format!("{name} is correct again, and is loaded in {}", units(&positions)),
            false => format!("{name} has changed, and is loaded in {}", units(&positions)),
        };
        (!loaded.is_empty()).then(|| Change { programs: loaded, report: Report { words, ends_warning } })
    }

    /// The files and folders of the program in a message.
    fn name(&self) -> String {
        self.paths.iter().map(|path| path.display().to_string()).collect::<Vec<_>>().join(", ")
    }
}

/// Units by their ascending positions from 0: `unit 1`, `units 1 to 3, 7`.
fn units(positions: &[usize]) -> String {
    let runs = positions.chunk_by(|position, next| position + 1 == *next);
    let runs = runs.filter_map(|run| match run {
        [only] => Some(format!("{}", only + 1)),
        [first, .., last] => Some(format!("{} to {}", first + 1, last + 1)),
        [] => None,
    });
    let word = if positions.len() == 1 { "unit" } else { "units" };
    format!("{word} {}", runs.collect::<Vec<_>>().join(", "))
}

#[cfg(test)]
mod tests;
