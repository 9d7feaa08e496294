//! Operations: what one order of the master comes down to, a frame at a time.

use nx_ect101::layout;
use wire::{AlState, AlStatus, Command, FrameBuilder, Returned};

use super::last_sdo::{SdoNumber, SdoResult};
use super::process_data::logical_address;
use super::sdo::{Phase, Received, SdoMessage};
use super::slave::Slave;
use super::{MailboxHabits, WAY_UP};
use crate::expectation::StateName;
use crate::orders::FrameKind;

const AL_CONTROL: u16 = 0x0120;
const AL_STATUS: u16 = 0x0130;
/// Status of SyncManager 1; bit 3: a message lies in it.
const MAILBOX_STATUS: u16 = 0x080D;
/// Activate of SyncManager 1.
const MAILBOX_ACTIVATE: u16 = 0x080E;

/// One operation with one unit.
#[derive(Clone, Debug)]
pub(crate) struct Operation {
    unit: usize,
    what: What,
    /// It belongs to a larger order.
    is_part: bool,
    /// The step that orders it asks for an SDO, and for nothing else.
    ordered_sdo: Option<SdoNumber>,
}

#[derive(Clone, Debug)]
enum What {
    /// Writes a register until somebody has taken it.
    Write { offset: u16, data: Vec<u8> },
    /// Looks where the unit is, and goes on from there.
    Take(AlState),
    /// Asks for a state and waits for it; meanwhile the unit is in no state below `lowest`.
    Reach { bits: u16, lowest: AlState, asked: bool },
    /// Everything is set for the process data: they begin.
    Open,
    /// An SDO.
    Sdo { message: SdoMessage, phase: Phase },
    /// Looks into the mailbox, once.
    Listen { full: bool },
}

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
    const fn new(unit: usize, what: What) -> Self {
        Self { unit, what, is_part: false, ordered_sdo: None }
    }

    pub(crate) const fn take(unit: usize, state: AlState) -> Self {
        Self::new(unit, What::Take(state))
    }

    pub(crate) const fn write(unit: usize, offset: u16, data: Vec<u8>) -> Self {
        Self::new(unit, What::Write { offset, data })
    }

    pub(crate) fn download(unit: usize, entry: (u16, u8), value: &[u8]) -> Self {
        Self::new(unit, What::Sdo { message: SdoMessage::download(entry, value), phase: Phase::Ask })
    }

    pub(crate) fn upload(unit: usize, entry: (u16, u8)) -> Self {
        Self::new(unit, What::Sdo { message: SdoMessage::upload(entry), phase: Phase::Ask })
    }

    pub(crate) const fn listen(unit: usize) -> Self {
        Self::new(unit, What::Listen { full: false })
    }

    /// The same as a part of a larger order, which it takes with it when it fails.
    pub(crate) fn within_an_order(self) -> Self {
        Self { is_part: true, ..self }
    }

    /// The same as the SDO of this number.
    pub(super) fn ordered_as(self, number: SdoNumber) -> Self {
        Self { ordered_sdo: Some(number), ..self }
    }

    pub(super) const fn ordered_sdo(&self) -> Option<SdoNumber> {
        self.ordered_sdo
    }

    pub(crate) const fn is_part(&self) -> bool {
        self.is_part
    }

    pub(crate) const fn is_listening(&self) -> bool {
        matches!(self.what, What::Listen { .. })
    }

    pub(crate) const fn waits_for_state(&self) -> bool {
        matches!(self.what, What::Reach { .. })
    }

    pub(crate) fn words(&self) -> String {
        let unit = format!("unit {}", self.unit + 1);
        match &self.what {
            What::Write { offset, .. } => format!("write to register {offset:#06X} of {unit}"),
            What::Take(state) => format!("take {unit} to {}", StateName(*state)),
            What::Reach { bits, .. } => {
                format!("request {} of {unit}", StateName(AlState::from_bits(*bits & 0x0F)))
            }
            What::Open => format!("process data of {unit}"),
            What::Sdo { message, .. } => format!("{} of {unit}", message.words()),
            What::Listen { .. } => format!("mailbox of {unit}"),
        }
    }

    /// Its next frame.
    pub(crate) fn frame(&mut self, habits: &mut MailboxHabits) -> (Vec<u8>, FrameKind) {
        let position = (self.unit as u16).wrapping_neg();
        let write = |offset, data: &[u8]| {
            FrameBuilder::new().physical(Command::Apwr, position, offset, data).finish()
        };
        let read = |offset, length_bytes: usize| {
            FrameBuilder::new().physical(Command::Aprd, position, offset, &vec![0; length_bytes]).finish()
        };
        match &mut self.what {
            What::Write { offset, data } => (write(*offset, data), FrameKind::Any),
            What::Reach { bits, asked: false, .. } => {
                (write(AL_CONTROL, &bits.to_le_bytes()), FrameKind::Any)
            }
            What::Take(_) | What::Reach { .. } | What::Open => (read(AL_STATUS, 6), FrameKind::Any),
            What::Sdo { message, phase: phase @ (Phase::Ask | Phase::Asked | Phase::AskedAgain) } => {
                *phase = if *phase == Phase::Ask { Phase::Asked } else { Phase::AskedAgain };
                (write(layout::MAILBOX_RECEIVE_START, &message.mailbox(habits)), FrameKind::Mailbox)
            }
            What::Sdo { phase: Phase::Read, .. } if habits.reads_nothing() => {
                (read(MAILBOX_STATUS, 1), FrameKind::Mailbox)
            }
            What::Sdo { phase: Phase::Read, .. } | What::Listen { full: true } => {
                (read(layout::MAILBOX_SEND_START, usize::from(layout::MAILBOX_BYTES)), FrameKind::Mailbox)
            }
            What::Sdo { phase: Phase::LookAtRepeat, .. } => (read(MAILBOX_ACTIVATE, 1), FrameKind::Mailbox),
            What::Sdo { phase: Phase::AskToRepeat(activate), .. } => {
                (write(MAILBOX_ACTIVATE, &[*activate]), FrameKind::Mailbox)
            }
            What::Sdo { .. } | What::Listen { .. } => (read(MAILBOX_STATUS, 1), FrameKind::Mailbox),
        }
    }

    /// What comes back.
    pub(crate) fn answer(&mut self, answer: &Returned, slaves: &mut [Slave]) -> Outcome {
        if answer.working_counter == 0 {
            if let What::Sdo { phase, .. } = &mut self.what {
                phase.not_taken();
            }
            return Outcome::Again;
        }
        let (unit, number) = (self.unit, self.ordered_sdo);
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
            What::Sdo { phase, .. } => phase.answer(answer, number),
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
