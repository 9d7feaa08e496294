//! The consequences of a completed operation.

use ::master::{AlReport, ServiceFailure, StateRequest, Wait};
use wire::AlState;

use super::asked_sdo::AskedSdo;
use super::last_sdo::{SdoNumber, SdoResult};
use super::operation::{Operation, What};
use super::process_data::ProcessData;
use super::raw::RawNumber;
use super::reach::{WAY_UP, floor};
use super::slave::Slave;
use crate::model::StateName;

/// The end of an operation.
pub(crate) enum Outcome {
    /// It is done, with this consequence.
    Done(Vec<Step>),
    /// It has failed.
    Failed(String),
}

/// The consequence of an operation.
pub(crate) enum Step {
    /// Another operation.
    Do(Operation),
    /// Process data of a unit begin.
    Exchange(usize),
    /// Process data of a unit end.
    Close(usize),
    /// A unit has a mailbox from now on, or no longer has one.
    Listen { unit: usize, listens: bool },
    /// An SDO was answered; in words with its object and its value.
    SdoResult { unit: usize, number: Option<SdoNumber>, words: String, result: SdoResult },
    /// A register or a mailbox message was read.
    RawAnswer { number: RawNumber, bytes: Vec<u8> },
    /// A report.
    Tell(String),
}

impl Operation {
    /// Why it has failed although it is complete.
    fn refusal(&self) -> Option<String> {
        let What::Reach(reach) = &self.what else { return None };
        Some(format!("unit {} {}", self.unit + 1, reach.refusal()?))
    }

    /// It is complete.
    pub(super) fn end(self, slaves: &mut [Slave], process_data: &mut ProcessData) -> Outcome {
        if let Some(reason) = self.refusal() {
            return Outcome::Failed(reason);
        }
        let (unit, number) = (self.unit, self.ordered_sdo());
        match self.what {
            What::Write { .. } | What::Reach(_) | What::Listen { .. } => Outcome::Done(Vec::new()),
            What::Take { target, look } => {
                let slave = slaves.get_mut(unit);
                let report = AlReport::parse(look.data());
                Outcome::Done(
                    slave.map_or(Vec::new(), |slave| way(unit, report, target, slave, process_data)),
                )
            }
            What::Open(_) => Outcome::Done(vec![Step::Exchange(unit)]),
            What::ReadRegister { read, number } => {
                Outcome::Done(vec![Step::RawAnswer { number, bytes: read.into_data() }])
            }
            What::Message { mailbox, number, .. } => match mailbox.into_service().into_result() {
                Ok(bytes) => Outcome::Done(vec![Step::RawAnswer { number, bytes }]),
                Err(failure) => Outcome::Failed(failure.to_string()),
            },
            What::Sdo { asked, mailbox, .. } => match mailbox.into_service().into_result() {
                Ok(value) => Outcome::Done(vec![sdo_result(unit, number, &asked, Ok(value))]),
                Err(ServiceFailure::Abort(code)) => {
                    Outcome::Done(vec![sdo_result(unit, number, &asked, Err(code.0))])
                }
                Err(ServiceFailure::Mailbox(code)) => Outcome::Failed(format!("mailbox error {}", code.0)),
                Err(failure) => Outcome::Failed(failure.to_string()),
            },
        }
    }
}

fn sdo_result(unit: usize, number: Option<SdoNumber>, asked: &AskedSdo, result: SdoResult) -> Step {
    let words = format!("{asked} of unit {} {}", unit + 1, asked.outcome_words(&result));
    Step::SdoResult { unit, number, words, result }
}

/// The way from the present state of a unit to its target, like that of a real master.
fn way(
    unit: usize,
    shown: AlReport,
    target: AlState,
    slave: &mut Slave,
    process_data: &mut ProcessData,
) -> Vec<Step> {
    let part = |operation: Operation| Step::Do(operation.within_an_order());
    // The time-out of a state is the same for all transitions.
    let reach =
        |state, lowest| part(Operation::reach(unit, StateRequest::new(state, Wait::SafeOpOp), lowest));
    if slave.take_reset() {
        let reset = Operation::reach(unit, StateRequest::reset(AlState::Init), AlState::Init);
        return vec![Step::Close(unit), part(reset), part(Operation::take(unit, target))];
    }
    let mut steps = Vec::new();
    let state = shown.status.state;
    let (Some(mut at), Some(goal)) = (floor(state), floor(target)) else {
        return vec![reach(target, AlState::Init)];
    };
    if shown.status.error {
        steps.push(part(Operation::reach(unit, StateRequest::acknowledge(shown), state)));
    }
    if goal < at {
        if goal < 2 {
            steps.push(Step::Close(unit));
        }
        steps.push(reach(target, target));
    }
    if at == 2 && goal == 3 {
        // A unit waits for outputs on its way to OP: a master that has stopped starts to send them again.
        steps.push(part(Operation::open(unit)));
    }
    while at < goal {
        at += 1;
        match at {
            1 => steps.extend(slave.set_mailboxes().into_iter().map(Step::Do)),
            2 => {
                steps.extend(slave.pre_op_sdos().into_iter().map(Step::Do));
                steps.extend(slave.set_process_data(process_data).into_iter().map(Step::Do));
            }
            3 => steps.extend(slave.safe_op_sdos().into_iter().map(Step::Do)),
            _ => {}
        }
        steps.push(reach(WAY_UP[at], WAY_UP[at - 1]));
        if at == 2 {
            steps.push(part(Operation::open(unit)));
        }
    }
    steps.push(Step::Listen { unit, listens: goal > 0 });
    let name = StateName(target);
    steps.push(Step::Tell(format!("takes unit {} to {name}", unit + 1)));
    steps
}
