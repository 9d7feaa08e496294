//! What an answer to an operation leads to.

use wire::{AlState, AlStatus, Returned};

use super::last_sdo::{SdoNumber, SdoResult};
use super::operation::{Operation, What};
use super::process_data::logical_address;
use super::sdo::{Answered, Received, SdoMessage};
use super::slave::Slave;
use crate::model::StateName;

/// What an answer leads to.
pub(crate) enum Outcome {
    /// The same frame once more, a little later.
    Again,
    /// The next frame of the operation.
    Next,
    /// An emergency was read; the operation goes on.
    Received(u16),
    /// It is done, and this follows.
    Done(Vec<Step>),
    /// It cannot be done.
    Failed(String),
}

/// What follows from an operation.
pub(crate) enum Step {
    /// A further operation.
    Do(Operation),
    /// Process data of a unit begin.
    Exchange { unit: usize, outputs_bytes: u16, inputs_bytes: u16 },
    /// Process data of a unit end.
    Close(usize),
    /// A unit has a mailbox from now on, or has none any more.
    Listen { unit: usize, listens: bool },
    /// An SDO was answered.
    SdoResult { number: Option<SdoNumber>, result: SdoResult },
    /// Something to tell.
    Tell(String),
}

impl Operation {
    /// What comes back.
    pub(crate) fn answer(&mut self, answer: &Returned, slaves: &mut [Slave]) -> Outcome {
        if answer.working_counter == 0 {
            if let What::Sdo { phase, .. } = &mut self.what {
                phase.not_taken();
            }
            return Outcome::Again;
        }
        let (unit, number) = (self.unit, self.ordered_sdo());
        match &mut self.what {
            What::Write { .. } => Outcome::Done(Vec::new()),
            What::Take(target) => {
                let status = AlStatus::from_bits(word(answer, 0));
                Outcome::Done(
                    slaves.get_mut(unit).map_or(Vec::new(), |slave| way(unit, status, *target, slave)),
                )
            }
            What::Reach { asked, .. } if !*asked => {
                *asked = true;
                Outcome::Next
            }
            What::Reach { bits, lowest, .. } => reached(unit, *bits, *lowest, answer),
            What::Open => Outcome::Done(open(unit, slaves)),
            What::Sdo { phase, .. } => match phase.answer(answer) {
                Answered::NotYet => Outcome::Again,
                Answered::Next => Outcome::Next,
                Answered::Emergency(code) => Outcome::Received(code),
                Answered::Done(result) => Outcome::Done(vec![Step::SdoResult { number, result }]),
                Answered::Failed(words) => Outcome::Failed(words),
            },
            What::Listen { full: false } if answer.data.first().is_some_and(|status| status & 0x08 == 0) => {
                Outcome::Done(Vec::new())
            }
            What::Listen { full } if !*full => {
                *full = true;
                Outcome::Next
            }
            What::Listen { full } => {
                *full = false;
                match SdoMessage::received(&answer.data) {
                    Received::Emergency(code) => Outcome::Received(code),
                    _ => Outcome::Done(Vec::new()),
                }
            }
        }
    }
}

fn word(answer: &Returned, at: usize) -> u16 {
    answer.data.get(at..at + 2).map_or(0, |bytes| u16::from_le_bytes([bytes[0], bytes[1]]))
}

/// AL status while a state is waited for. An error indication is a refusal; a state below `lowest` is that of a unit
/// which has fallen back, such as one whose power was cycled, and no waiting brings it to the state.
fn reached(unit: usize, bits: u16, lowest: AlState, answer: &Returned) -> Outcome {
    let (status, code) = (AlStatus::from_bits(word(answer, 0)), word(answer, 4));
    let wanted = AlState::from_bits(bits & 0x0F);
    let fell_back = is_below(status.state, lowest);
    if status.error || fell_back {
        let (shown, wanted) = (StateName(status.state), StateName(wanted));
        let verb = if fell_back { "fell back to" } else { "stays in" };
        let code = if status.error { format!(" with {code:#06X}") } else { String::new() };
        return Outcome::Failed(format!("unit {} {verb} {shown}{code}, asked for {wanted}", unit + 1));
    }
    if status.state == wanted { Outcome::Done(Vec::new()) } else { Outcome::Again }
}

/// How far up a state is; none for BOOT and for what is no state.
fn floor(state: AlState) -> Option<usize> {
    WAY_UP.iter().position(|&step| step == state)
}

fn is_below(state: AlState, other: AlState) -> bool {
    floor(state).zip(floor(other)).is_some_and(|(state, other)| state < other)
}

/// The way from where a unit is to where it is to be, as a real master goes it.
fn way(unit: usize, status: AlStatus, target: AlState, slave: &mut Slave) -> Vec<Step> {
    let part = |what| Step::Do(Operation::new(unit, what).within_an_order());
    let reach = |state: AlState, lowest| part(What::Reach { bits: state.bits(), lowest, asked: false });
    let acknowledge =
        |state: AlState| part(What::Reach { bits: state.bits() | 0x10, lowest: state, asked: false });
    if slave.take_reset() {
        return vec![Step::Close(unit), acknowledge(AlState::Init), part(What::Take(target))];
    }
    let mut steps = Vec::new();
    let (Some(mut at), Some(goal)) = (floor(status.state), floor(target)) else {
        return vec![reach(target, AlState::Init)];
    };
    if status.error {
        steps.push(acknowledge(status.state));
    }
    if goal < at {
        if goal < 2 {
            steps.push(Step::Close(unit));
        }
        steps.push(reach(target, target));
    }
    if at == 2 && goal == 3 {
        // A unit waits for outputs on its way to OP: a master that has stopped begins with them again.
        steps.push(part(What::Open));
    }
    while at < goal {
        at += 1;
        match at {
            1 => steps.extend(slave.set_mailboxes().into_iter().map(Step::Do)),
            2 => {
                steps.extend(slave.startup_sdos().into_iter().map(Step::Do));
                steps.extend(slave.set_process_data(logical_address(unit)).into_iter().map(Step::Do));
            }
            _ => {}
        }
        steps.push(reach(WAY_UP[at], WAY_UP[at - 1]));
        if at == 2 {
            steps.push(part(What::Open));
        }
    }
    steps.push(Step::Listen { unit, listens: goal > 0 });
    let name = StateName(target);
    steps.push(Step::Tell(format!("takes unit {} to {name}", unit + 1)));
    steps
}

fn open(unit: usize, slaves: &[Slave]) -> Vec<Step> {
    let lengths = slaves.get(unit).map(|slave| (slave.outputs_bytes(), slave.inputs_bytes()));
    let exchange =
        lengths.map(|(outputs_bytes, inputs_bytes)| Step::Exchange { unit, outputs_bytes, inputs_bytes });
    exchange.into_iter().collect()
}

/// States on the way up, the nearest first.
const WAY_UP: [AlState; 4] = [AlState::Init, AlState::PreOp, AlState::SafeOp, AlState::Op];
