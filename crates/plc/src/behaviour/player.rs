//! The behaviours at work.

use core::fmt;
use std::path::Path;

use time::{Duration, Instant};
use variables::{Numeric, Target};

use super::course::{Course, CsvProblem};
use super::section::{BehaviourSection, Does, Loop};
use super::signal::Signal;
use crate::io::Io;
use crate::program::Program;

/// The behaviours of one unit, as a program of its CPU Unit.
#[derive(Clone, Debug)]
pub struct Behaviours {
    signals: Vec<Playing>,
    loops: Vec<Loop>,
    /// The power-on with which the signals began.
    power_cycles: u32,
}

#[derive(Clone, Debug)]
struct Playing {
    target: Target,
    numeric: Numeric,
    signal: Signal,
    seed: u64,
    /// The earliest time for another value; none: never again.
    next: Option<Duration>,
}

/// A CSV file that a behaviour cannot use.
#[derive(Debug)]
pub enum CsvUnusable<E> {
    /// It cannot be read.
    Unreadable(E),
    /// What is in it.
    Wrong(CsvProblem),
}

impl<E: fmt::Display> fmt::Display for CsvUnusable<E> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unreadable(error) => error.fmt(formatter),
            Self::Wrong(problem) => problem.fmt(formatter),
        }
    }
}

impl Behaviours {
    /// The behaviours of a unit file whose CSV files have been read; none if it has none.
    #[must_use]
    pub fn of(section: &BehaviourSection, seed: u64) -> Option<Self> {
        if section.is_empty() {
            return None;
        }
        let signals = (1_u64..).zip(&section.behaviours).filter_map(|(number, behaviour)| {
            let Does::Signal(signal) = &behaviour.does else { return None };
            let signal = signal.clone();
            // Two variables of one seed have different numbers.
            let seed = seed.wrapping_add(number.wrapping_mul(0xD134_2543_DE82_EF95));
            let (target, numeric) = (behaviour.target, behaviour.numeric);
            Some(Playing { target, numeric, signal, seed, next: Some(Duration::ZERO) })
        });
        Some(Self { signals: signals.collect(), loops: section.loops.clone(), power_cycles: 0 })
    }
}

impl BehaviourSection {
    /// Reads the CSV files by `read`, which gets paths as the unit file has them.
    ///
    /// # Errors
    /// The first file that cannot be used, with its path.
    pub fn read_csv<E>(
        &mut self,
        mut read: impl FnMut(&Path) -> Result<String, E>,
    ) -> Result<(), (user_file::Located<std::path::PathBuf>, CsvUnusable<E>)> {
        for behaviour in &mut self.behaviours {
            let Does::Csv(keys) = &behaviour.does else { continue };
            let unusable = |problem| (keys.file.clone(), problem);
            let text = read(&keys.file.value).map_err(|error| unusable(CsvUnusable::Unreadable(error)))?;
            let range = behaviour.numeric.range();
            let course = Course::from_csv(&text, keys.column.as_deref(), keys.repeats, &range)
                .map_err(|problem| unusable(CsvUnusable::Wrong(problem)))?;
            behaviour.does = Does::Signal(Signal::Csv(course));
        }
        Ok(())
    }
}

impl Program for Behaviours {
    fn scan(&mut self, io: &mut Io) {
        if self.power_cycles != io.power_cycles() {
            self.power_cycles = io.power_cycles();
            self.signals.iter_mut().for_each(|playing| playing.next = Some(Duration::ZERO));
        }
        let at = io.now().saturating_since(Instant::ZERO);
        for playing in self.signals.iter_mut().filter(|playing| playing.next.is_some_and(|next| next <= at)) {
            let value = playing.signal.value(at, playing.seed, playing.numeric.is_whole());
            // The reader of the unit file has checked the variable.
            let _ = io.write(playing.target, &playing.numeric.value(value));
            playing.next = playing.signal.next_change(at);
        }
        for pair in &self.loops {
            if let Ok(value) = io.read(pair.from) {
                let _ = io.write(pair.to, &value);
            }
        }
    }
}

#[cfg(test)]
mod tests;
