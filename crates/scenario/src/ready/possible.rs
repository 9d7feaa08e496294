//! What can never come: an AL status code that no unit shows, a register that is none, more records than a log holds,
//! an abort code that is none, the answer of what no step orders.

use esc::REGISTERS;
use unit_model::{PowerOn, UnitSection};
use wire::{AlState, AlStatusCode, SdoAbort};

use super::maker::Maker;
use super::model_words::Needed;
use super::ordered::sdo_unit;
use super::problem::Part;
use crate::model::{
    Condition, Disturbance, EventLog, FrameKind, LineOrder, MasterOrder, Quantity, UnitSet, WhichUnit,
};

/// Bytes of the registers; the RAM begins there.
const REGISTER_BYTES: usize = 0x1000;

impl Maker<'_> {
    /// Whether the unit of an SDO has a mailbox.
    pub(super) fn check_sdo(&mut self, order: &MasterOrder, part: Part) -> Option<()> {
        sdo_unit(order).map_or(Some(()), |unit| self.check_mailbox(unit, part))
    }

    /// Whether the unit of mailbox frames has a mailbox.
    pub(super) fn check_mailbox_frames(&mut self, order: &LineOrder, part: Part) -> Option<()> {
        let LineOrder::Disturb(Disturbance { frames, .. }) = order else { return Some(()) };
        match &frames.unit {
            Some(unit) if frames.kind == FrameKind::Mailbox => self.check_mailbox(unit, part),
            Some(_) | None => Some(()),
        }
    }

    pub(super) fn check_mailbox(&mut self, unit: &WhichUnit, part: Part) -> Option<()> {
        let is_known = Box::new(|unit: &dyn UnitSection| unit.shape().mailbox);
        self.check_words(
            &Needed { units: UnitSet::from(unit.clone()), words: "mailbox".to_owned(), is_known },
            part,
        )
    }

    /// Whether what a condition is about can come.
    pub(super) fn check_can_come(&mut self, condition: &Condition, part: Part) -> Option<()> {
        match condition {
            Condition::State { units, state, al_status_code } => {
                if *state == AlState::Boot {
                    let is_known = Box::new(|unit: &dyn UnitSection| unit.shape().boot);
                    let words = "state BOOT".to_owned();
                    self.check_words(&Needed { units: units.clone(), words, is_known }, part)?;
                }
                al_status_code.map_or(Some(()), |code| self.check_code(units, code.0, part))
            }
            Condition::Register { unit, register, value } => {
                self.check_register(unit, register.0, value.0.len(), part)
            }
            Condition::Value { of: Quantity::Register { unit, register }, .. } => {
                self.check_register(unit, register.0, 1, part)
            }
            Condition::EventLogHas { log, units, times: Some(count), .. } => {
                self.check_count(units, *log, *count, "records", part)
            }
            Condition::DiagnosisMessages { units, count } => {
                self.check_count(units, EventLog::System, *count, "messages", part)
            }
            Condition::DiagnosisMessage { unit, number: Some(number), .. }
            | Condition::DiagnosisMessageBytes { unit, number, .. } => self.check_count(
                &UnitSet::from(unit.clone()),
                EventLog::System,
                (*number).into(),
                "messages",
                part,
            ),
            Condition::SdoRefused { unit, abort_code } => {
                self.check_abort_code(abort_code.0, part)?;
                self.check_sdo_ordered(unit.as_ref(), part)
            }
            Condition::SdoGave { unit, .. } | Condition::SdoTaken { unit } => {
                self.check_sdo_ordered(unit.as_ref(), part)
            }
            Condition::RegisterGave { .. } => {
                let is_ordered = self.ordered.reads_register;
                self.check_ordered(is_ordered, "reads a register", "read register 0x0130 of unit 1", part)
            }
            Condition::MailboxGave { .. } | Condition::MailboxSilent => {
                let is_ordered = self.ordered.sends_message;
                let help = "send unit 1 the mailbox message …";
                self.check_ordered(is_ordered, "sends a mailbox message", help, part)
            }
            Condition::FrameGave { .. } | Condition::FrameLost => {
                let is_ordered = self.ordered.sends_frame;
                self.check_ordered(is_ordered, "sends a frame", "send the frame …", part)
            }
            Condition::MasterHas { act, .. } | Condition::Value { of: Quantity::Acts { act }, .. } => {
                self.check_act(act, part)
            }
            Condition::MasterHasBefore { first, then } => {
                self.check_act(first, part)?;
                self.check_act(then, part)
            }
            Condition::ProcessDataCome { percent, .. } => self.check_deviation(*percent, part),
            Condition::DiagnosisMessage { number: None, .. }
            | Condition::EventLogHas { times: None, .. }
            | Condition::Recorded { .. }
            | Condition::RecordedAgain { .. }
            | Condition::RecordedNothing { .. }
            | Condition::HasError { .. }
            | Condition::HasNoError { .. }
            | Condition::DiagnosisConsistent { .. }
            | Condition::NewMessages { .. }
            | Condition::Object { .. }
            | Condition::Outputs { .. }
            | Condition::Inputs { .. }
            | Condition::VariableBytes { .. }
            | Condition::VariableValue { .. }
            | Condition::ProgramVariable { .. }
            | Condition::UserDefinedError { .. }
            | Condition::NoUserDefinedError { .. }
            | Condition::TaskOverrun { .. }
            | Condition::NoTaskOverrun { .. }
            | Condition::ProgramError { .. }
            | Condition::NoProgramError { .. }
            | Condition::DataValid { .. }
            | Condition::DirectionValid { .. }
            | Condition::IoDataActive { .. }
            | Condition::UnitError { .. }
            | Condition::Indicator { .. }
            | Condition::WorkingCounter { .. }
            | Condition::Cycles { .. }
            | Condition::MasterIdle
            | Condition::MasterGaveUp
            | Condition::MasterGaveUpAgain
            | Condition::EveryWorkingCounterExpected
            | Condition::Emergency { .. }
            | Condition::EmergenciesLost { .. }
            | Condition::EventLogEmpty { .. }
            | Condition::CaptureReplayed
            | Condition::AnswersDiffer { .. }
            | Condition::Value { .. }
            | Condition::Not(_)
            | Condition::AllOf(_)
            | Condition::AnyOf(_) => Some(()),
        }
    }

    /// Whether one of the units can show an AL status code: one of the standard, of its model, or one with which a step
    /// lets a unit refuse a state.
    fn check_code(&mut self, units: &UnitSet, code: u16, part: Part) -> Option<()> {
        let is_of_model = |at: usize| {
            let tables = self.units.get(at).map(|unit| unit.file.section().model().tables());
            tables.is_some_and(|tables| tables.al_status_codes.iter().any(|row| row.code.0 == code))
        };
        let is_known = AlStatusCode(code).row().is_some()
            || self.ordered.has_random
            || self.ordered.codes.contains(&code)
            || units.positions(self.units.len()).any(|at| is_of_model(at) || self.refuses_with(at, code));
        if is_known {
            return Some(());
        }
        let message = format!("{units}: no AL status code {code:#06X} is shown there");
        let help = "`ectwin explain` has the codes; a step can make it one: `let unit 1 refuse OP with AL status code …`";
        self.refuse(part, message, help);
        None
    }

    /// Whether bytes from an address on begin and end in registers or RAM of the unit.
    pub(super) fn check_register(
        &mut self,
        unit: &WhichUnit,
        first: u16,
        length: usize,
        part: Part,
    ) -> Option<()> {
        let first = usize::from(first);
        let last = first + length.max(1) - 1;
        let end = if last < REGISTER_BYTES { REGISTER_BYTES } else { self.memory_bytes(unit)? };
        let message = if last >= end {
            format!(
                "{length} bytes from {first:#06X} on are behind the memory of the ESC, which ends at {:#06X}",
                end - 1
            )
        } else if !is_register(first) {
            format!("no register and no RAM of the ESC is at {first:#06X}")
        } else if !is_register(last) {
            format!("{length} bytes for the register at {first:#06X}: none is at {last:#06X}")
        } else {
            return Some(());
        };
        self.refuse(part, message, "the registers are below 0x1000, and the RAM begins there");
        None
    }

    /// Whether a unit refuses a state with this code by its unit file.
    fn refuses_with(&self, at: usize, code: u16) -> bool {
        let Some(unit) = self.units.get(at) else { return false };
        let refusals = unit.file.section().power_on(&PowerOn::default()).config.conduct.refusals;
        AlState::ALL.iter().any(|state| refusals.of(*state) == Some(AlStatusCode(code)))
    }

    fn memory_bytes(&self, unit: &WhichUnit) -> Option<usize> {
        let unit = self.units.get(unit.position())?;
        let config = unit.file.section().power_on(&PowerOn::default()).config;
        Some(REGISTER_BYTES + usize::from(config.esc.ram_kib) * 1024)
    }

    /// Whether the log of each unit has room for this number of records.
    fn check_count(
        &mut self,
        units: &UnitSet,
        log: EventLog,
        count: u64,
        what: &str,
        part: Part,
    ) -> Option<()> {
        let log = match log {
            EventLog::System => unit_model::EventLog::System,
            EventLog::Access => unit_model::EventLog::Access,
        };
        for at in units.positions(self.units.len()) {
            let Some(unit) = self.units.get(at) else { continue };
            let most = unit.file.section().model().records_max(log).unwrap_or(usize::MAX);
            if count > most as u64 {
                let message = format!("{count} {what} in a log of unit {}, which holds {most}", at + 1);
                let help = format!("at most {most}: the oldest record makes room for a new one");
                self.refuse(part, message, help);
                return None;
            }
        }
        Some(())
    }

    fn check_abort_code(&mut self, code: u32, part: Part) -> Option<()> {
        if SdoAbort(code).row().is_some() {
            return Some(());
        }
        let message = format!("{code:#010X} is no abort code of an SDO");
        self.refuse(part, message, "`ectwin explain 0x06090030` explains one");
        None
    }

    fn check_sdo_ordered(&mut self, unit: Option<&WhichUnit>, part: Part) -> Option<()> {
        if let Some(unit) = unit {
            self.check_mailbox(unit, part)?;
        }
        // A name of a unit, which is not resolved here, can be any.
        let is_meant = |at: &usize| *at == usize::MAX || unit.is_none_or(|unit| unit.position() == *at);
        let is_ordered = self.ordered.sdos.iter().any(is_meant);
        let words = unit.map_or("sends an SDO".to_owned(), |unit| format!("sends an SDO to {unit}"));
        self.check_ordered(is_ordered, &words, "read SDO 1018:01 of unit 1", part)
    }

    fn check_ordered(&mut self, is_ordered: bool, what: &str, order: &str, part: Part) -> Option<()> {
        if is_ordered || self.ordered.has_random {
            return Some(());
        }
        self.refuse(part, format!("no step {what}"), format!("a step that does: `master = \"{order}\"`"));
        None
    }
}

fn is_register(address: usize) -> bool {
    let holds = |row: &esc::Register| {
        let Some(behind) = address.checked_sub(usize::from(row.offset)) else { return false };
        let stride = usize::from(row.stride_bytes.max(1));
        behind / stride < usize::from(row.count) && behind % stride < usize::from(row.size_bytes)
    };
    address >= REGISTER_BYTES || REGISTERS.iter().any(holds)
}
