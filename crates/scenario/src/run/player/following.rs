//! The expectations that look at the result of an order: those that follow at once, in groups and behind them too.

use crate::model::{Expectation, Mode, Order, Trigger};
use crate::run::scenario::{PlayedStep, WrittenStep};

/// The expectations that follow at once, behind other orders of the same time, up to the first one that takes time. `behind`
/// are those behind the last of these steps.
pub(super) fn following<'a>(steps: &'a [PlayedStep], behind: &[&'a WrittenStep]) -> Vec<&'a WrittenStep> {
    let mut found = Vec::new();
    for (at, entry) in steps.iter().enumerate() {
        match entry {
            PlayedStep::Step(step) if step.step.trigger == Trigger::AtOnce => match &step.step.order {
                Order::Expect(expectation) => {
                    found.push(step);
                    if takes_time(expectation) {
                        return found;
                    }
                }
                Order::Master(_) | Order::Unit(_) | Order::Cpu(_) | Order::Line(_) => {}
            },
            PlayedStep::Group(group) if group.trigger == Trigger::AtOnce => {
                let behind = following(steps.get(at + 1..).unwrap_or_default(), behind);
                let sequences = group.members.sequences().iter();
                found.extend(sequences.flat_map(|steps| following(steps, &behind)));
                return found;
            }
            PlayedStep::Step(_) | PlayedStep::Group(_) => return found,
        }
    }
    found.extend(behind);
    found
}

const fn takes_time(Expectation { mode, .. }: &Expectation) -> bool {
    match mode {
        Mode::Now | Mode::Never | Mode::While(_) => false,
        Mode::Within(_) | Mode::For(_) | Mode::Until(_) | Mode::NeverUntil(_) => true,
    }
}
