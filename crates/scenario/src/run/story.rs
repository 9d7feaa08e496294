//! The reports of user programs and their CPU Units: a persistent one is reported once, and all are kept for
//! conditions.

use plc::{CpuEvent, ProgramEvent, ProgramTrouble};

/// The reports of one controller.
#[derive(Debug, Default)]
pub(crate) struct Story {
    /// The reports of the last task period; one that occurs again in this period is not new.
    going_on: Vec<CpuEvent>,
    alarms: Vec<Alarm>,
    overruns: u64,
    errors: Vec<ProgramTrouble>,
}

/// A user-defined error.
#[derive(Debug)]
struct Alarm {
    code: u16,
    times: u64,
    /// It has not been reset.
    stands: bool,
}

impl Story {
    /// A task period is over, with these events; events that were already in the period before are left out of
    /// the result.
    pub(crate) fn period(&mut self, events: impl Iterator<Item = CpuEvent>) -> Vec<String> {
        let told: Vec<CpuEvent> = events.collect();
        let is_news = |event: &&CpuEvent| !self.going_on.iter().any(|before| is_same_trouble(before, event));
        let news: Vec<CpuEvent> = told.iter().filter(is_news).cloned().collect();
        self.going_on = told;
        news.iter().map(|event| self.note(event)).collect()
    }

    /// An event between two task periods.
    pub(crate) fn between(&mut self, events: impl Iterator<Item = CpuEvent>) -> Vec<String> {
        events.map(|event| self.note(&event)).collect()
    }

    fn note(&mut self, event: &CpuEvent) -> String {
        match event {
            CpuEvent::Program(ProgramEvent::UserDefinedError { code, .. }) => self.raise(*code),
            CpuEvent::Program(ProgramEvent::UserDefinedErrorsReset { code }) => {
                let meant = self.alarms.iter_mut().filter(|alarm| *code == 0 || alarm.code == *code);
                meant.for_each(|alarm| alarm.stands = false);
            }
            CpuEvent::Program(ProgramEvent::TaskOverrun { .. }) => self.overruns += 1,
            CpuEvent::Program(ProgramEvent::Error(trouble) | ProgramEvent::Stopped(trouble)) => {
                self.errors.push(trouble.clone());
            }
            _ => {}
        }
        event.to_string()
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
    pub(crate) fn alarm(&self, code: u16) -> (u64, bool) {
        let alarm = self.alarms.iter().find(|alarm| alarm.code == code);
        alarm.map_or((0, false), |alarm| (alarm.times, alarm.stands))
    }

    pub(crate) fn has_alarms(&self) -> bool {
        self.alarms.iter().any(|alarm| alarm.stands)
    }

    pub(crate) fn alarm_words(&self) -> String {
        let words = self.alarms.iter().map(|Alarm { code, times, stands }| {
            let reset = if *stands { "" } else { ", reset" };
            format!("16#{code:X} {times} times{reset}")
        });
        listed("user-defined errors", words)
    }

    pub(crate) const fn overruns(&self) -> u64 {
        self.overruns
    }

    /// Errors of the program, the oldest first; a persistent one is one error.
    pub(crate) fn errors(&self) -> &[ProgramTrouble] {
        &self.errors
    }

    pub(crate) fn error_words(&self) -> String {
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

/// Whether it is the same again, which is not reported in every task period.
fn is_same_trouble(before: &CpuEvent, now: &CpuEvent) -> bool {
    let (CpuEvent::Program(before), CpuEvent::Program(now)) = (before, now) else { return false };
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

    fn alarm(code: u16, info1: u64) -> CpuEvent {
        CpuEvent::Program(ProgramEvent::UserDefinedError { code, info1, info2: 0 })
    }

    fn error(line: usize) -> CpuEvent {
        let what = "division by zero".into();
        CpuEvent::Program(ProgramEvent::Error(ProgramTrouble { what, line, column: 1, file: None }))
    }

    #[test]
    fn what_goes_on_is_told_once_and_again_after_a_pause() {
        let mut story = Story::default();
        let told = [1, 1, 0, 1].map(|times| story.period((0..times).map(|at| alarm(0x101, at))).len());
        assert_eq!(told, [1, 0, 0, 1]);
        assert_eq!((story.alarm(0x101), story.alarm(0x102)), ((2, true), (0, false)));
    }

    #[test]
    fn a_reset_ends_user_defined_errors() {
        let mut story = Story::default();
        let reset = |code| CpuEvent::Program(ProgramEvent::UserDefinedErrorsReset { code });
        story.period([alarm(1, 0), alarm(2, 0)].into_iter());
        assert!(story.has_alarms());
        story.period([reset(2)].into_iter());
        assert_eq!((story.alarm(1), story.alarm(2)), ((1, true), (1, false)));
        story.period([reset(0)].into_iter());
        assert!(!story.has_alarms());
        assert_eq!(story.alarm_words(), "user-defined errors: 16#1 1 times, reset, 16#2 1 times, reset");
        assert_eq!(story.period([reset(0)].into_iter()).len(), 1, "a reset is told each time");
    }

    #[test]
    fn errors_at_two_places_are_two() {
        let mut story = Story::default();
        for _ in 0..3 {
            story.period([error(5), error(7)].into_iter());
        }
        assert_eq!(story.error_words(), "errors of the program: 5:1 division by zero, 7:1 division by zero");
        assert_eq!(Story::default().error_words(), "there were no errors of the program");
    }

    #[test]
    fn a_change_of_the_mode_is_told_each_time() {
        let mut story = Story::default();
        let change = || CpuEvent::ModeChanged(plc::OperatingMode::Program);
        assert_eq!(story.between([change(), change()].into_iter()), ["PROGRAM mode"; 2]);
    }
}
