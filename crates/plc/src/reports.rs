//! What the programs of a controller have reported since it has power: a persistent report counts once.

use std::collections::VecDeque;

use crate::program_event::{ProgramEvent, ProgramTrouble};

/// Number of errors of programs that are kept.
const ERRORS_MAX: usize = 256;

/// Room for the reports of one task period, and for different user-defined errors; more need memory once.
const ROOM: usize = 64;

/// The reports of the programs of one controller. They are kept when they are taken from its event log.
#[derive(Debug)]
pub struct Reports {
    /// Those of the task period before the last one; one that occurs again is not new.
    before: Vec<ProgramEvent>,
    /// Those of the last task period.
    present: Vec<ProgramEvent>,
    alarms: Vec<Alarm>,
    overruns: u64,
    /// At most [`ERRORS_MAX`], the oldest first.
    errors: VecDeque<ProgramTrouble>,
}

/// A user-defined error.
#[derive(Debug)]
struct Alarm {
    code: u16,
    times: u64,
    /// It has not been reset.
    stands: bool,
}

impl Default for Reports {
    fn default() -> Self {
        let [before, present] = [(); 2].map(|()| Vec::with_capacity(ROOM));
        Self { before, present, alarms: Vec::with_capacity(ROOM), overruns: 0, errors: VecDeque::new() }
    }
}

impl Reports {
    /// A task period is over, with these reports.
    pub fn period(&mut self, events: impl Iterator<Item = ProgramEvent>) {
        core::mem::swap(&mut self.before, &mut self.present);
        self.present.clear();
        for event in events {
            if self.is_new(&event) {
                self.note(&event);
            }
            self.present.push(event);
        }
    }

    /// Whether a report of the last task period was not in the period before it.
    #[must_use]
    pub fn is_new(&self, event: &ProgramEvent) -> bool {
        !is_among(&self.before, event)
    }

    fn note(&mut self, event: &ProgramEvent) {
        match event {
            ProgramEvent::UserDefinedError { code, .. } => self.raise(*code),
            ProgramEvent::UserDefinedErrorsReset { code } => {
                let meant = self.alarms.iter_mut().filter(|alarm| *code == 0 || alarm.code == *code);
                meant.for_each(|alarm| alarm.stands = false);
            }
            ProgramEvent::TaskOverrun { .. } => self.overruns += 1,
            ProgramEvent::Error(trouble) | ProgramEvent::Stopped(trouble) => {
                if self.errors.len() == ERRORS_MAX {
                    self.errors.pop_front();
                }
                self.errors.push_back(trouble.clone());
            }
        }
    }

    fn raise(&mut self, code: u16) {
        match self.alarms.iter_mut().find(|alarm| alarm.code == code) {
            Some(alarm) => {
                alarm.times += 1;
                alarm.stands = true;
            }
            None => self.alarms.push(Alarm { code, times: 1, stands: true }),
        }
    }

    /// Number of occurrences of a user-defined error, and whether it is present.
    #[must_use]
    pub fn alarm(&self, code: u16) -> (u64, bool) {
        let alarm = self.alarms.iter().find(|alarm| alarm.code == code);
        alarm.map_or((0, false), |alarm| (alarm.times, alarm.stands))
    }

    /// Whether a user-defined error is present.
    #[must_use]
    pub fn has_alarms(&self) -> bool {
        self.alarms.iter().any(|alarm| alarm.stands)
    }

    /// The user-defined errors in words.
    #[must_use]
    pub fn alarm_words(&self) -> String {
        let words = self.alarms.iter().map(|Alarm { code, times, stands }| {
            let reset = if *stands { "" } else { ", reset" };
            format!("16#{code:X} {}{reset}", user_file::times(*times))
        });
        listed("user-defined errors", words)
    }

    /// Number of task overruns; a persistent one is one.
    #[must_use]
    pub const fn overruns(&self) -> u64 {
        self.overruns
    }

    /// The last 256 errors of programs, the oldest first; a persistent one is one error.
    #[must_use]
    pub const fn errors(&self) -> &VecDeque<ProgramTrouble> {
        &self.errors
    }

    /// The errors of programs in words.
    #[must_use]
    pub fn error_words(&self) -> String {
        let words = self.errors.iter().map(|trouble| {
            let ProgramTrouble { what, line, column, file } = trouble;
            let file = file.as_ref().map(|file| format!("{file}:")).unwrap_or_default();
            format!("{file}{line}:{column} {what}")
        });
        listed("errors of the program", words)
    }
}

fn listed(what: &str, words: impl Iterator<Item = String>) -> String {
    let words: Vec<String> = words.collect();
    if words.is_empty() { format!("there were no {what}") } else { format!("{what}: {}", words.join(", ")) }
}

fn is_among(reports: &[ProgramEvent], event: &ProgramEvent) -> bool {
    reports.iter().any(|before| is_same_trouble(before, event))
}

/// Whether it is the same again, which is not reported in every task period.
fn is_same_trouble(before: &ProgramEvent, now: &ProgramEvent) -> bool {
    match (before, now) {
        (ProgramEvent::UserDefinedError { code, .. }, ProgramEvent::UserDefinedError { code: other, .. }) => {
            code == other
        }
        (ProgramEvent::UserDefinedErrorsReset { .. }, _) => false,
        _ => before == now,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn alarm(code: u16, info1: u64) -> ProgramEvent {
        ProgramEvent::UserDefinedError { code, info1, info2: 0 }
    }

    fn error(line: usize) -> ProgramEvent {
        let what = "division by zero".into();
        ProgramEvent::Error(ProgramTrouble { what, line, column: 1, file: None })
    }

    #[test]
    fn what_goes_on_is_new_once_and_again_after_a_pause() {
        let mut reports = Reports::default();
        let new = [1, 1, 0, 1].map(|times| {
            reports.period((0..times).map(|at| alarm(0x101, at)));
            reports.is_new(&alarm(0x101, 0))
        });
        assert_eq!(new, [true, false, false, true]);
        assert_eq!((reports.alarm(0x101), reports.alarm(0x102)), ((2, true), (0, false)));
    }

    #[test]
    fn a_reset_ends_user_defined_errors() {
        let mut reports = Reports::default();
        let reset = |code| ProgramEvent::UserDefinedErrorsReset { code };
        reports.period([alarm(1, 0), alarm(2, 0)].into_iter());
        assert!(reports.has_alarms());
        reports.period([reset(2)].into_iter());
        assert_eq!((reports.alarm(1), reports.alarm(2)), ((1, true), (1, false)));
        reports.period([reset(0)].into_iter());
        assert!(!reports.has_alarms());
        assert_eq!(reports.alarm_words(), "user-defined errors: 16#1 once, reset, 16#2 once, reset");
        reports.period([reset(0)].into_iter());
        assert!(reports.is_new(&reset(0)), "a reset is new each time");
    }

    #[test]
    fn errors_at_two_places_are_two() {
        let mut reports = Reports::default();
        for _ in 0..3 {
            reports.period([error(5), error(7)].into_iter());
        }
        assert_eq!(
            reports.error_words(),
            "errors of the program: 5:1 division by zero, 7:1 division by zero"
        );
        assert_eq!(Reports::default().error_words(), "there were no errors of the program");
    }

    #[test]
    fn the_oldest_error_of_too_many_is_forgotten() {
        let mut reports = Reports::default();
        (1..=300).for_each(|line| reports.period([error(line)].into_iter()));
        assert_eq!(reports.errors().len(), ERRORS_MAX);
        assert_eq!(reports.errors().front().map(|first| first.line), Some(45));
    }
}
