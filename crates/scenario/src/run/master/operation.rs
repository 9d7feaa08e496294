//! Operations: the parts of a master's order, one dialogue each.

use ::master::{
    AlReport, Dialogue, MailboxConduct, MailboxDialogue, RawMessage, Reading, RegisterRead, RegisterWrite,
    SdoTransfer, Service, StateRequest, SyncManagerSettings, registers,
};
use wire::{AlState, Emergency, SdoTarget};

use super::asked_sdo::AskedSdo;
use super::given_up::OrderNumber;
use super::last_sdo::SdoNumber;
use super::raw::RawNumber;
use super::reach::Reach;
use crate::model::{Entry, StateName};

/// SyncManagers of the mailbox: from master to unit, and back.
pub(super) type MailboxChannels = (SyncManagerSettings, SyncManagerSettings);

/// One operation with one unit.
#[derive(Clone, Debug)]
pub(crate) struct Operation {
    pub(super) unit: usize,
    pub(super) what: What,
    /// It belongs to a larger order.
    is_part: bool,
    /// The step with the order requests only an SDO.
    ordered_sdo: Option<SdoNumber>,
    /// The order of a step to which it belongs; none: the master does it by itself.
    pub(super) order: Option<OrderNumber>,
}

#[derive(Clone, Debug)]
pub(super) enum What {
    /// Writes a register until a slave has accepted it.
    Write { offset: u16, write: RegisterWrite },
    /// Reads the state of the unit, and continues from there.
    Take { target: AlState, look: RegisterRead },
    /// Requests a state and waits for it.
    Reach(Reach),
    /// Everything is set for the process data: they start.
    Open(RegisterRead),
    /// An SDO.
    Sdo { asked: AskedSdo, mailbox: Box<MailboxDialogue>, is_begun: bool },
    /// Reads a register.
    ReadRegister { read: RegisterRead, number: RawNumber },
    /// A whole mailbox message, right or wrong.
    Message { mailbox: Box<MailboxDialogue>, is_begun: bool, number: RawNumber },
    /// Reads the mailbox once.
    Listen { mailbox: Box<MailboxDialogue>, is_begun: bool },
}

/// A read of AL status and AL status code.
const fn look() -> RegisterRead {
    RegisterRead::new(registers::AL_STATUS, AlReport::LENGTH_BYTES)
}

impl Operation {
    const fn new(unit: usize, what: What) -> Self {
        Self { unit, what, is_part: false, ordered_sdo: None, order: None }
    }

    pub(crate) const fn take(unit: usize, target: AlState) -> Self {
        Self::new(unit, What::Take { target, look: look() })
    }

    pub(crate) const fn write(unit: usize, offset: u16, data: Vec<u8>) -> Self {
        Self::new(unit, What::Write { offset, write: RegisterWrite::new(offset, data) })
    }

    pub(super) const fn reach(unit: usize, request: StateRequest, lowest: AlState) -> Self {
        Self::new(unit, What::Reach(Reach::new(request, lowest)))
    }

    pub(super) const fn open(unit: usize) -> Self {
        Self::new(unit, What::Open(look()))
    }

    pub(crate) fn download(unit: usize, channels: MailboxChannels, entry: Entry, value: &[u8]) -> Self {
        let transfer = SdoTransfer::download(SdoTarget::entry(entry.index, entry.sub), value);
        Self::sdo(
            unit,
            channels,
            AskedSdo::writing(format!("SDO download {entry}"), value),
            Service::Sdo(transfer),
        )
    }

    pub(crate) fn upload(unit: usize, channels: MailboxChannels, entry: Entry) -> Self {
        let transfer = SdoTransfer::upload(SdoTarget::entry(entry.index, entry.sub));
        Self::sdo(unit, channels, AskedSdo::reading(format!("SDO upload {entry}")), Service::Sdo(transfer))
    }

    /// A service whose answer is that of an SDO.
    pub(super) fn sdo(
        unit: usize,
        (out, inward): MailboxChannels,
        asked: AskedSdo,
        service: Service,
    ) -> Self {
        let mailbox = Box::new(MailboxDialogue::new(out, inward, service));
        Self::new(unit, What::Sdo { asked, mailbox, is_begun: false })
    }

    pub(super) const fn read_register(
        unit: usize,
        offset: u16,
        length_bytes: u16,
        number: RawNumber,
    ) -> Self {
        Self::new(unit, What::ReadRegister { read: RegisterRead::new(offset, length_bytes), number })
    }

    pub(super) fn message(
        unit: usize,
        (out, inward): MailboxChannels,
        message: Vec<u8>,
        number: RawNumber,
    ) -> Self {
        let mailbox = Box::new(MailboxDialogue::new(out, inward, Service::Raw(RawMessage::new(message))));
        Self::new(unit, What::Message { mailbox, is_begun: false, number })
    }

    pub(crate) fn listen(unit: usize, (out, inward): MailboxChannels) -> Self {
        let mailbox = Box::new(MailboxDialogue::new(out, inward, Service::Listen));
        Self::new(unit, What::Listen { mailbox, is_begun: false })
    }

    /// The same as part of a larger order, whose remaining operations are dropped if it fails.
    pub(crate) fn within_an_order(self) -> Self {
        Self { is_part: true, ..self }
    }

    /// The same as part of the order with this number.
    pub(super) fn of_order(self, order: Option<OrderNumber>) -> Self {
        Self { order, ..self }
    }

    /// The same as the SDO with this number.
    pub(super) fn ordered_as(self, number: SdoNumber) -> Self {
        Self { ordered_sdo: Some(number), ..self }
    }

    pub(super) const fn ordered_sdo(&self) -> Option<SdoNumber> {
        self.ordered_sdo
    }

    /// The number of a register or a mailbox message that a step has ordered.
    pub(super) const fn raw_number(&self) -> Option<RawNumber> {
        match self.what {
            What::ReadRegister { number, .. } | What::Message { number, .. } => Some(number),
            What::Write { .. }
            | What::Take { .. }
            | What::Reach(_)
            | What::Open(_)
            | What::Sdo { .. }
            | What::Listen { .. } => None,
        }
    }

    pub(crate) const fn is_part(&self) -> bool {
        self.is_part
    }

    pub(crate) const fn is_listening(&self) -> bool {
        matches!(self.what, What::Listen { .. })
    }

    pub(crate) fn words(&self) -> String {
        let unit = format!("unit {}", self.unit + 1);
        match &self.what {
            What::Write { offset, .. } => format!("write to register {offset:#06X} of {unit}"),
            What::Take { target, .. } => format!("take {unit} to {}", StateName(*target)),
            What::Reach(reach) => format!("request {} of {unit}", StateName(reach.state())),
            What::Open(_) => format!("process data of {unit}"),
            What::Sdo { asked, .. } => format!("{asked} of {unit}"),
            What::ReadRegister { read, .. } => {
                format!("read of register {:#06X} of {unit}", read.access().offset())
            }
            What::Message { .. } => format!("mailbox message to {unit}"),
            What::Listen { .. } => format!("mailbox of {unit}"),
        }
    }

    pub(super) fn dialogue(&self) -> &dyn Dialogue {
        match &self.what {
            What::Write { write, .. } => write,
            What::Take { look, .. } | What::Open(look) => look,
            What::Reach(reach) => reach,
            What::ReadRegister { read, .. } => read,
            What::Sdo { mailbox, .. } | What::Message { mailbox, .. } | What::Listen { mailbox, .. } => {
                &**mailbox
            }
        }
    }

    pub(super) fn dialogue_mut(&mut self) -> &mut dyn Dialogue {
        match &mut self.what {
            What::Write { write, .. } => write,
            What::Take { look, .. } | What::Open(look) => look,
            What::Reach(reach) => reach,
            What::ReadRegister { read, .. } => read,
            What::Sdo { mailbox, .. } | What::Message { mailbox, .. } | What::Listen { mailbox, .. } => {
                &mut **mailbox
            }
        }
    }

    /// The mailbox that it uses.
    pub(super) fn mailbox(&mut self) -> Option<&mut MailboxDialogue> {
        match &mut self.what {
            What::Sdo { mailbox, .. } | What::Message { mailbox, .. } | What::Listen { mailbox, .. } => {
                Some(mailbox)
            }
            What::Write { .. }
            | What::Take { .. }
            | What::Reach(_)
            | What::Open(_)
            | What::ReadRegister { .. } => None,
        }
    }

    /// Starts to use the mailbox, before its first frame. A master that reads no replies still reads emergencies.
    pub(super) fn begin(&mut self, conduct: MailboxConduct) {
        let (mailbox, is_begun, conduct) = match &mut self.what {
            What::Sdo { mailbox, is_begun, .. } | What::Message { mailbox, is_begun, .. } => {
                (mailbox, is_begun, conduct)
            }
            What::Listen { mailbox, is_begun } => {
                (mailbox, is_begun, MailboxConduct { reading: Reading::Always, ..conduct })
            }
            What::Write { .. }
            | What::Take { .. }
            | What::Reach(_)
            | What::Open(_)
            | What::ReadRegister { .. } => return,
        };
        if !core::mem::replace(is_begun, true) {
            mailbox.begin(conduct);
        }
    }

    /// Changes how it handles the mailbox from now on.
    pub(super) fn change_mailbox(&mut self, change: impl Fn(&mut MailboxConduct)) {
        if let What::Sdo { mailbox, .. } | What::Message { mailbox, .. } = &mut self.what {
            change(mailbox.conduct_mut());
        }
    }

    /// Takes the oldest emergency that it has read.
    pub(super) fn take_emergency(&mut self) -> Option<Emergency> {
        self.mailbox()?.take_emergency()
    }
}
