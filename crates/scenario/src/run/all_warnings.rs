//! The warnings of a scenario: those of its file, and those of a play.

use super::scenario::{PlayedStep, Scenario};
use super::warning::Warning;
use crate::model::{Order, Step, Trigger};

impl Scenario {
    /// The warnings of the file and of a play, in the order of the lines. Nobody has written what random steps do.
    pub(super) fn all_warnings(&self, of_play: Vec<Warning>) -> Vec<Warning> {
        let mut warnings = self.warnings.clone();
        if self.title.trim().is_empty() {
            let message = "it is empty; it says in a sentence what the scenario shows".to_owned();
            warnings.push(Warning { line: 1, text: "title".to_owned(), message });
        }
        if self.random.is_empty() {
            warnings.extend(self.expects_nothing());
            warnings.extend(of_play);
        }
        warnings.sort_by_key(|warning| warning.line);
        warnings
    }

    /// The warning that no step can fail.
    fn expects_nothing(&self) -> Option<Warning> {
        let steps = self.each_step();
        let can_fail = self.golden_trace.is_some()
            || steps.into_iter().any(|step| expects(&step.step))
            || groups_wait(&self.steps);
        let message = "no step expects anything, so nothing is tested; such as `{ expect = \"all units are in OP\", within = \"5s\" }`, or a golden trace";
        (!can_fail).then(|| Warning { line: 1, text: self.title.clone(), message: message.to_owned() })
    }
}

const fn expects(step: &Step) -> bool {
    matches!(step.order, Order::Expect(_)) || matches!(step.trigger, Trigger::When(_))
}

/// Whether a group waits for a condition.
fn groups_wait(entries: &[PlayedStep]) -> bool {
    entries.iter().any(|entry| match entry {
        PlayedStep::Step(_) => false,
        PlayedStep::Group(group) => {
            let mut sequences = group.members.sequences().iter();
            matches!(group.trigger, Trigger::When(_)) || sequences.any(|steps| groups_wait(steps))
        }
    })
}
