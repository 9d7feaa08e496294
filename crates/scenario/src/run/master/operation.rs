//! Operations: what one order of the master comes down to, a frame at a time.

use nx_ect101::layout;
use wire::{AlState, Command, FrameBuilder};

use super::habits::MailboxHabits;
use super::last_sdo::SdoNumber;
use super::sdo::{Phase, SdoMessage};
use crate::model::{FrameKind, StateName};

const AL_CONTROL: u16 = 0x0120;
const AL_STATUS: u16 = 0x0130;
/// Status of SyncManager 1; bit 3: a message lies in it.
const MAILBOX_STATUS: u16 = 0x080D;
/// Activate of SyncManager 1.
const MAILBOX_ACTIVATE: u16 = 0x080E;

/// One operation with one unit.
#[derive(Clone, Debug)]
pub(crate) struct Operation {
    pub(super) unit: usize,
    pub(super) what: What,
    /// It belongs to a larger order.
    is_part: bool,
    /// The step that orders it asks for an SDO, and for nothing else.
    ordered_sdo: Option<SdoNumber>,
}

#[derive(Clone, Debug)]
pub(super) enum What {
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

impl Operation {
    pub(super) const fn new(unit: usize, what: What) -> Self {
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
}
