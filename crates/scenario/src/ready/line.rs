//! Faults of frames: whether frames can meet them, and their names.

use user_file::did_you_mean;

use super::fault_names::AtWork;
use super::maker::Maker;
use super::problem::Part;
use crate::model::{Choice, Disturbance, FaultName, LineOrder};

impl Maker<'_> {
    /// Refuses faults that no frame can meet, names that are in use, and the end of faults that are not at work.
    pub(super) fn check_line(&mut self, order: &LineOrder, part: Part) -> Option<()> {
        match order {
            LineOrder::Disturb(disturbance) => {
                self.check_effect(disturbance, part)?;
                if self.follows_steps { self.check_name(disturbance, part) } else { Some(()) }
            }
            LineOrder::End { name } if self.follows_steps => self.check_end(name, part),
            LineOrder::End { .. } => Some(()),
            LineOrder::BeQuiet => {
                self.fault_names.end_all();
                Some(())
            }
            LineOrder::Unplug { .. } | LineOrder::Plug { .. } => Some(()),
        }
    }

    fn check_effect(&mut self, disturbance: &Disturbance, part: Part) -> Option<()> {
        if disturbance.frames.choice.is_none() {
            self.refuse(
                part,
                "0 frames get the fault, so it does nothing",
                "a number from 1, such as `the next 3 frames`",
            );
            return None;
        }
        if !disturbance.is_possible() {
            let help = "the sentences of `line` in docs/user/scenario-reference.md show what each fault has";
            self.refuse(part, "the fault has no such place, or its numbers are not possible", help);
            return None;
        }
        match disturbance.lasts {
            Some(lasts) if lasts > self.limit => {
                let limit = self.limit;
                let message = format!("a fault for {lasts} is longer than the limit of {limit}");
                self.refuse(part, message, "leave `for` out: it lasts to the end");
                None
            }
            _ => Some(()),
        }
    }

    fn check_name(&mut self, disturbance: &Disturbance, part: Part) -> Option<()> {
        let Some(name) = &disturbance.name else { return Some(()) };
        if self.fault_names.of(name) == Some(AtWork::Yes) {
            let message = format!("a fault called {name} is at work already");
            self.refuse(part, message, format!("another name, or `end {name}` before it"));
            return None;
        }
        let ends_by_itself = disturbance.lasts.is_some()
            || matches!(disturbance.frames.choice, Choice::Next(_) | Choice::Behind { .. });
        self.fault_names.set(name, if ends_by_itself { AtWork::Maybe } else { AtWork::Yes });
        Some(())
    }

    fn check_end(&mut self, name: &FaultName, part: Part) -> Option<()> {
        let message = match self.fault_names.of(name) {
            Some(AtWork::Yes | AtWork::Maybe) => {
                self.fault_names.set(name, AtWork::No);
                return Some(());
            }
            Some(AtWork::No) => format!("the fault called {name} has ended before this step"),
            None => {
                self.refuse_end(name, part);
                return None;
            }
        };
        self.refuse(part, message, self.help_for_end(name));
        None
    }

    /// No step before this one gives a fault this name.
    pub(super) fn refuse_end(&mut self, name: &FaultName, part: Part) {
        let message = format!("no step before this one makes a fault called {name}");
        self.refuse(part, message, self.help_for_end(name));
    }

    fn help_for_end(&self, name: &FaultName) -> String {
        match self.fault_names.nearest(name) {
            Some(nearest) => did_you_mean(format_args!("end {nearest}")),
            None => format!("a fault gets its name as in `lose all frames called {name}`"),
        }
    }
}
