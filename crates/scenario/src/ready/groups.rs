//! Groups of steps: whether their times are possible, and their executable form.

use time::Duration;

use super::maker::Maker;
use super::problem::{Part, StepPart};
use super::steps::{Ground, Place};
use super::written::Written;
use crate::model::{Group, Members, Repetition, ScriptStep, Trigger};
use crate::run::{PlayedStep, WrittenGroup};

/// Maximum number of groups around a step.
pub(crate) const DEPTH_MAX: usize = 16;

impl Maker<'_> {
    /// The executable form of a group; none if it is too deep.
    pub(super) fn group(
        &mut self,
        group: Group,
        own: Written,
        written: &mut dyn Iterator<Item = Written>,
        mut place: Place,
        ground: Ground,
    ) -> Option<(WrittenGroup, Duration)> {
        let part = Part::Step(place.at, StepPart::Whole);
        if place.depth == DEPTH_MAX {
            let message = format!("this step is in {DEPTH_MAX} groups, and a group cannot be in more");
            self.refuse(part, message, "use fewer groups in each other");
            return None;
        }
        let Group { mut trigger, members } = group;
        if let Trigger::When(condition) = &mut trigger {
            self.check_when(condition, place.at, ground);
        }
        if members.sequences().iter().any(Vec::is_empty) {
            self.refuse(part, "a group without steps does nothing", "give it a step, or remove it");
        }
        place.depth += 1;
        let (members, reached) = match members {
            Members::Sequence(steps) => {
                let (steps, reached) = self.sequence(steps, written, place, ground);
                (Members::Sequence(steps), reached)
            }
            Members::Repeat { repetition, steps } => {
                self.check_rounds(place.at, repetition);
                let within = Place { is_repeated: true, ..place };
                let (steps, reached) = self.sequence(steps, written, within, ground);
                let pauses = repetition.every.as_nanos().saturating_mul(repetition.times.saturating_sub(1));
                let early = repetition.jitter.min(Duration::from_nanos(pauses));
                let pauses = Duration::from_nanos(pauses - early.as_nanos());
                (Members::Repeat { repetition, steps }, reached + pauses)
            }
            Members::Together(sequences) => {
                let mut reached = place.reached;
                let each = sequences.into_iter().map(|steps| {
                    let (steps, end) = self.sequence(steps, written, place, ground);
                    reached = reached.max(end);
                    steps
                });
                let sequences = each.collect();
                (Members::Together(sequences), reached)
            }
        };
        let Written { line, text, .. } = own;
        Some((WrittenGroup { trigger, members, line, text }, reached))
    }

    /// The executable form of steps in a group, and the earliest time of their end.
    fn sequence(
        &mut self,
        steps: Vec<ScriptStep>,
        written: &mut dyn Iterator<Item = Written>,
        place: Place,
        ground: Ground,
    ) -> (Vec<PlayedStep>, Duration) {
        let mut reached = place.reached;
        let mut played = Vec::new();
        for step in steps {
            let own = Place { reached, ..place };
            if let Some((step, end)) = self.entry(step, written, own, ground) {
                played.push(step);
                reached = end;
            }
        }
        (played, reached)
    }

    fn check_rounds(&mut self, at: usize, repetition: Repetition) {
        self.check_repetition(at, repetition);
        let Repetition { every, jitter, .. } = repetition;
        if jitter <= every && jitter.as_nanos() > every.as_nanos() / 2 {
            let message = format!("a jitter of {jitter} is more than half of the period of {every}");
            self.refuse(Part::Step(at, StepPart::Whole), message, "rounds follow each other in their order");
        }
    }
}
