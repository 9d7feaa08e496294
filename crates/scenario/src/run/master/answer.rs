//! What an operation that is over leads to.

use ::master::{AlReport, ServiceFailure, StateRequest, Wait};
use wire::AlState;

use super::last_sdo::{SdoNumber, SdoResult};
use super::operation::{Operation, What};
use super::process_data::ProcessData;
use super::slave::Slave;
use crate::model::StateName;

/// How an operation ends.
pub(crate) enum Outcome {
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
    Exchange(usize),
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
    /// Why it cannot be done, whatever comes: while a state is waited for, an error indication is a refusal, and a
    /// state below the lowest is that of a unit which has fallen back, such as one whose power was cycled.
    pub(super) fn refusal(&self) -> Option<String> {
        let What::Reach { request, lowest } = &self.what else { return None };
        let AlReport { status, code } = request.report();
        let fell_back = is_below(status.state, *lowest);
        if !status.error && !fell_back {
            return None;
        }
        let (shown, wanted) = (StateName(status.state), StateName(request.state()));
        let verb = if fell_back { "fell back to" } else { "stays in" };
        let code = if status.error { format!(" with {:#06X}", code.0) } else { String::new() };
        Some(format!("unit {} {verb} {shown}{code}, asked for {wanted}", self.unit + 1))
    }

    /// It is over.
    pub(super) fn end(self, slaves: &mut [Slave], process_data: &mut ProcessData) -> Outcome {
        if let Some(reason) = self.refusal() {
            return Outcome::Failed(reason);
        }
        let (unit, number) = (self.unit, self.ordered_sdo());
        match self.what {
            What::Write { .. } | What::Reach { .. } | What::Listen { .. } => Outcome::Done(Vec::new()),
            What::Take { target, look } => {
                let slave = slaves.get_mut(unit);
                let report = AlReport::parse(look.data());
                Outcome::Done(
                    slave.map_or(Vec::new(), |slave| way(unit, report, target, slave, process_data)),
                )
            }
            What::Open(_) => Outcome::Done(vec![Step::Exchange(unit)]),
            What::Sdo { mailbox, .. } => match mailbox.into_service().into_result() {
                Ok(value) => Outcome::Done(vec![Step::SdoResult { number, result: Ok(value) }]),
                Err(ServiceFailure::Abort(code)) => {
                    Outcome::Done(vec![Step::SdoResult { number, result: Err(code.0) }])
                }
                Err(ServiceFailure::Mailbox(code)) => Outcome::Failed(format!("mailbox error {}", code.0)),
                Err(failure) => Outcome::Failed(failure.to_string()),
            },
        }
    }
}

/// How far up a state is; none for BOOT and for what is no state.
fn floor(state: AlState) -> Option<usize> {
    WAY_UP.iter().position(|&step| step == state)
}

fn is_below(state: AlState, other: AlState) -> bool {
    floor(state).zip(floor(other)).is_some_and(|(state, other)| state < other)
}

/// The way from where a unit is to where it is to be, as a real master goes it.
fn way(
    unit: usize,
    shown: AlReport,
    target: AlState,
    slave: &mut Slave,
    process_data: &mut ProcessData,
) -> Vec<Step> {
    let part = |operation: Operation| Step::Do(operation.within_an_order());
    // How long a state may take is the same for all transitions.
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
        // A unit waits for outputs on its way to OP: a master that has stopped begins with them again.
        steps.push(part(Operation::open(unit)));
    }
    while at < goal {
        at += 1;
        match at {
            1 => steps.extend(slave.set_mailboxes().into_iter().map(Step::Do)),
            2 => {
                steps.extend(slave.startup_sdos().into_iter().map(Step::Do));
                steps.extend(slave.set_process_data(process_data).into_iter().map(Step::Do));
            }
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

/// States on the way up, the nearest first.
const WAY_UP: [AlState; 4] = [AlState::Init, AlState::PreOp, AlState::SafeOp, AlState::Op];
