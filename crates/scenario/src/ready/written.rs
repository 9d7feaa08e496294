//! How a step was written, and its place: kept separately from the typed step, for messages and the trace.

use core::ops::Range;

use crate::model::{Expectation, Members, Order, Repetition, ScriptStep, Step};
use crate::words::Spoken;

/// The words of a step and their place.
pub(crate) struct Written {
    /// Line, from 1; for a script that is not a file, the number of the step.
    pub(crate) line: usize,
    /// The bytes of the step in the file.
    pub(crate) bytes: Range<usize>,
    /// The sentence of the order or of the condition.
    pub(crate) text: String,
}

impl Written {
    /// For the step at this position of a script that is not a file.
    pub(super) fn of_script(at: usize, step: &ScriptStep) -> Self {
        let text = match step {
            ScriptStep::Step(Step { order, .. }) => sentence(order),
            ScriptStep::Random(_) => String::new(),
            ScriptStep::Group(group) => group_words(&group.members),
        };
        Self { line: at + 1, bytes: 0..0, text }
    }
}

fn sentence(order: &Order) -> String {
    match order {
        Order::Master(order) => order.to_string(),
        Order::Unit(order) => order.to_string(),
        Order::Cpu(order) => order.to_string(),
        Order::Line(order) => order.sentence(),
        Order::Expect(Expectation { condition, .. }) => condition.to_string(),
    }
}

/// The keys that make a group of steps.
pub(crate) fn group_words<S>(members: &Members<S>) -> String {
    match members {
        Members::Sequence(_) => "steps".to_owned(),
        Members::Repeat { repetition: Repetition { times, every, .. }, .. } => {
            format!("repeat = {times}, every = \"{every}\"")
        }
        Members::Together(_) => "together".to_owned(),
    }
}
