//! What an order decides about a condition. A condition that is true before an order that ends it has to be false before
//! it counts as the result of the order.
//!
//! An order has an [`Effect`], and a condition is about a [`Subject`]; [`decided`] has an answer for each pair of them. All
//! matches are exhaustive, so that no order, condition, effect or subject can be left out.
//!
//! Only what an order causes later is an effect. What it changes at once, such as the state of a unit that restarts, has
//! changed when the expectation after it looks for the first time.

#![deny(clippy::wildcard_enum_match_arm)]

mod about;
mod effect;
mod outcome;
mod reach;
mod request;
mod written;

use core::cmp::Ordering;

use wire::AlState;

use crate::model::{Condition, DataDirection, Order, Quantity, Same, Test, WhichUnit};
use crate::run::check::passes;
use crate::run::observed::Reading;
use about::{About, Subject, about};
use effect::{Effect, effect};
use outcome::Outcome;
use request::Request;

/// Whether an order ends a condition that is true.
pub(crate) fn ends(order: &Order, condition: &Condition) -> bool {
    outcome(&effect(order), condition) == Outcome::False
}

/// Whether an order makes a master work that is expected to have nothing to do: it can be done in no virtual time.
pub(crate) const fn is_work(order: &Order, condition: &Condition) -> bool {
    matches!((order, condition), (Order::Master(_), Condition::MasterIdle))
}

fn outcome(effect: &Effect<'_>, condition: &Condition) -> Outcome {
    let part = |part: &Condition| outcome(effect, part);
    match about(condition) {
        About::Not(inner) => part(inner).not(),
        About::AllOf(parts) => Outcome::all_of(parts.iter().map(part)),
        // One of them is true unless all are false.
        About::AnyOf(parts) => Outcome::all_of(parts.iter().map(part).map(Outcome::not)).not(),
        About::World(subject) => decided(effect, &subject),
    }
}

/// The table of effects and subjects.
fn decided(effect: &Effect<'_>, subject: &Subject<'_>) -> Outcome {
    match effect {
        Effect::Nothing => Outcome::Open,
        Effect::Request(request) => requested(request, subject),
        Effect::Written(written) => match subject {
            Subject::Bytes(expected) => written.decides(expected),
            Subject::Value { of, test } => of_value(effect, of, test, |of| written.reading(of)),
            Subject::State { .. } | Subject::Valid { .. } => {
                written.request().map_or(Outcome::Open, |request| requested(&request, subject))
            }
            Subject::Healthy(_)
            | Subject::IoDataActive { .. }
            | Subject::WorkingCounter { .. }
            | Subject::EveryWorkingCounter
            | Subject::Other => Outcome::Open,
        },
        Effect::Interrupted(interrupted) => match subject {
            Subject::State { units, holds_in, .. } => {
                let ends = interrupted.leaves_op && holds_in.only(AlState::Op);
                Outcome::false_if(ends && interrupted.reach.overlaps(units))
            }
            Subject::Valid { units, direction, valid } if interrupted.leaves_op => {
                m_to_c(interrupted.reach.decides(units, !valid), *direction)
            }
            Subject::WorkingCounter { unit, value } => {
                Outcome::false_if(*value > 0 && interrupted.reach.has(unit))
            }
            Subject::EveryWorkingCounter => Outcome::False,
            Subject::Value { of, test } => {
                let none = |unit: &WhichUnit| interrupted.reach.has(unit).then(|| Reading::count(0));
                of_value(effect, of, test, |of| working_counter_of(of).and_then(none))
            }
            Subject::Valid { .. }
            | Subject::Bytes(_)
            | Subject::Healthy(_)
            | Subject::IoDataActive { .. }
            | Subject::Other => Outcome::Open,
        },
        Effect::Contact(reach) => match subject {
            Subject::WorkingCounter { unit, value } => Outcome::false_if(*value == 0 && reach.has(unit)),
            Subject::State { .. }
            | Subject::Valid { .. }
            | Subject::EveryWorkingCounter
            | Subject::Value { .. }
            | Subject::Bytes(_)
            | Subject::Healthy(_)
            | Subject::IoDataActive { .. }
            | Subject::Other => Outcome::Open,
        },
        Effect::Fault(reach) => match subject {
            Subject::Healthy(units) => Outcome::false_if(reach.overlaps(units)),
            Subject::State { .. }
            | Subject::Valid { .. }
            | Subject::WorkingCounter { .. }
            | Subject::EveryWorkingCounter
            | Subject::Value { .. }
            | Subject::Bytes(_)
            | Subject::IoDataActive { .. }
            | Subject::Other => Outcome::Open,
        },
        Effect::IoStopped { reach, is_seen } => match subject {
            Subject::Healthy(units) => Outcome::false_if(reach.overlaps(units)),
            Subject::Valid { units, valid, .. } => reach.decides(units, !valid),
            Subject::IoDataActive { units, active } if *is_seen => reach.decides(units, !active),
            Subject::IoDataActive { .. }
            | Subject::State { .. }
            | Subject::WorkingCounter { .. }
            | Subject::EveryWorkingCounter
            | Subject::Value { .. }
            | Subject::Bytes(_)
            | Subject::Other => Outcome::Open,
        },
        Effect::IoStarted(reach) => match subject {
            Subject::IoDataActive { units, active } => reach.decides(units, *active),
            Subject::State { .. }
            | Subject::Valid { .. }
            | Subject::Healthy(_)
            | Subject::WorkingCounter { .. }
            | Subject::EveryWorkingCounter
            | Subject::Value { .. }
            | Subject::Bytes(_)
            | Subject::Other => Outcome::Open,
        },
    }
}

/// What a request for a state decides. Whether the unit takes it is what an expectation tests.
fn requested(Request { reach, state, acknowledges }: &Request<'_>, subject: &Subject<'_>) -> Outcome {
    match subject {
        Subject::State { units, holds_in, has_code } => match (holds_in.in_state(*state), has_code) {
            (false, _) => reach.decides(units, false),
            (true, false) => reach.decides(units, true),
            // An error in this state stays until it is acknowledged.
            (true, true) => Outcome::false_if(*acknowledges && reach.overlaps(units)),
        },
        Subject::Valid { units, direction, valid } => {
            m_to_c(reach.decides(units, (*state == AlState::Op) == *valid), *direction)
        }
        Subject::Bytes(_)
        | Subject::Value { .. }
        | Subject::Healthy(_)
        | Subject::IoDataActive { .. }
        | Subject::WorkingCounter { .. }
        | Subject::EveryWorkingCounter
        | Subject::Other => Outcome::Open,
    }
}

/// What becomes of a condition on Data … Valid, if this becomes of its part on M to C.
fn m_to_c(outcome: Outcome, direction: Option<DataDirection>) -> Outcome {
    match direction {
        Some(DataDirection::MToC) => outcome,
        Some(DataDirection::CToM) => Outcome::Open,
        // Both directions hold only together.
        None => Outcome::all_of([outcome, Outcome::Open].into_iter()),
    }
}

/// What becomes of a test, if the order decides the value.
fn of_value(
    effect: &Effect<'_>,
    of: &Quantity,
    test: &Test,
    reading: impl FnOnce(&Quantity) -> Option<Reading>,
) -> Outcome {
    match test {
        // It is false at the beginning of its step anyway.
        Test::Changes => Outcome::Open,
        Test::IsNot(text) => match of.is(text) {
            Ok(Same::Condition(same)) => outcome(effect, &same).not(),
            Ok(Same::Number(number)) => {
                let equal = reading(of).map(|reading| reading.compare(number) == Some(Ordering::Equal));
                equal.map_or(Outcome::Open, |equal| Outcome::of(!equal))
            }
            Err(_) => Outcome::Open,
        },
        Test::Equals(_)
        | Test::AtLeast(_)
        | Test::AtMost(_)
        | Test::Above(_)
        | Test::Below(_)
        | Test::Between { .. }
        | Test::BeginsWith(_)
        | Test::HasBits(_)
        | Test::HasNoBits(_)
        | Test::Is(_) => {
            let passes = reading(of).and_then(|reading| passes(test, &reading));
            passes.map_or(Outcome::Open, |passed| Outcome::of(passed.is_ok()))
        }
    }
}

/// The unit of a quantity that is its working counter.
const fn working_counter_of(of: &Quantity) -> Option<&WhichUnit> {
    match of {
        Quantity::WorkingCounter { unit } => Some(unit),
        Quantity::Object { .. }
        | Quantity::Register { .. }
        | Quantity::OutputByte { .. }
        | Quantity::InputByte { .. }
        | Quantity::Outputs { .. }
        | Quantity::Inputs { .. }
        | Quantity::Variable { .. }
        | Quantity::ProgramVariable { .. }
        | Quantity::Records { .. }
        | Quantity::Acts { .. }
        | Quantity::MeanPeriod { .. }
        | Quantity::LongestPeriod { .. }
        | Quantity::Emergencies { .. }
        | Quantity::Cycles => None,
    }
}

#[cfg(test)]
mod tests;
