//! Expectations that cannot fail: their condition holds in every state, or, for `never`, in none.

use super::maker::Maker;
use super::problem::{Part, StepPart};
use crate::model::{Condition, Expectation, Mode};

impl Maker<'_> {
    /// Whether an expectation can fail, as far as its conditions say.
    pub(super) fn check_can_fail(&mut self, at: usize, Expectation { condition, mode }: &Expectation) {
        let part = Part::Step(at, StepPart::Order);
        match mode {
            Mode::While(other) if other == condition => {
                let message = "`while` is the condition of the expectation itself, so it cannot fail";
                let help = "`while` names another condition, such as `while = \"unit 1 is in OP\"`";
                return self.refuse(Part::Step(at, StepPart::While), message, help);
            }
            Mode::Until(other) | Mode::NeverUntil(other) if other == condition => {
                let message = "`until` is the condition of the expectation itself, so nothing is checked";
                let help = "`until` names another condition; `within = \"1s\"` waits for this one";
                return self.refuse(Part::Step(at, StepPart::Until), message, help);
            }
            Mode::Now
            | Mode::Within(_)
            | Mode::For(_)
            | Mode::Never
            | Mode::While(_)
            | Mode::Until(_)
            | Mode::NeverUntil(_) => {}
        }
        match mode {
            Mode::Never | Mode::NeverUntil(_) => {
                if holds_in_none(condition) {
                    let message =
                        "it can never hold, because its parts exclude each other: `never` cannot fail";
                    self.refuse(part, message, "leave one of the parts out, or name another unit in it");
                }
            }
            Mode::Now | Mode::Within(_) | Mode::For(_) | Mode::Until(_) | Mode::While(_) => {
                if holds_in_all(condition) {
                    let message = "it always holds, whatever the state is: the expectation cannot fail";
                    self.refuse(part, message, "leave one of the parts out, or name another unit in it");
                }
            }
        }
    }
}

/// Whether a condition is true in every state.
fn holds_in_all(condition: &Condition) -> bool {
    match condition {
        Condition::Not(part) => holds_in_none(part),
        Condition::AllOf(parts) => !parts.is_empty() && parts.iter().all(holds_in_all),
        Condition::AnyOf(parts) => {
            parts.iter().any(holds_in_all) || has_contraries(parts, |part| !can_be_neither(part))
        }
        _ => false,
    }
}

/// Whether a condition is true in no state.
fn holds_in_none(condition: &Condition) -> bool {
    match condition {
        Condition::Not(part) => holds_in_all(part),
        Condition::AllOf(parts) => {
            parts.iter().any(holds_in_none) || has_contraries(parts, |_| true) || has_two_states(parts)
        }
        Condition::AnyOf(parts) => !parts.is_empty() && parts.iter().all(holds_in_none),
        _ => false,
    }
}

/// Whether one of them is `not` of another one for which this is true.
fn has_contraries(parts: &[Condition], is_meant: impl Fn(&Condition) -> bool) -> bool {
    let is_contrary = |part: &Condition| match part {
        Condition::Not(inner) => is_meant(inner) && parts.contains(inner),
        _ => false,
    };
    parts.iter().any(is_contrary)
}

/// Whether two of them are about different states of the same units.
fn has_two_states(parts: &[Condition]) -> bool {
    let states = || {
        parts.iter().filter_map(|part| match part {
            Condition::State { units, state, al_status_code } => Some((units, (state, al_status_code))),
            _ => None,
        })
    };
    states().any(|(units, state)| states().any(|(others, other)| units == others && state != other))
}

/// Whether `any of` a condition and `not` of it is accepted: neither may hold, as for a value of a unit without power, or a
/// search has written it.
fn can_be_neither(condition: &Condition) -> bool {
    match condition {
        Condition::Not(_) | Condition::AllOf(_) | Condition::AnyOf(_) => {
            condition.parts().iter().any(can_be_neither)
        }
        Condition::Value { .. }
        | Condition::DiagnosisConsistent { .. }
        | Condition::VariableBytes { .. }
        | Condition::VariableValue { .. }
        | Condition::ProgramVariable { .. } => true,
        // A search writes it as the step that does nothing, where none of the random steps is left.
        Condition::MasterIdle => true,
        _ => false,
    }
}
