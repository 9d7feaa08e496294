//! Unit and model in parallel: both execute every operation, and their answers are compared.

use device::{Check, Start};
use nx_ect101::{EventCode, EventLevel, EventLog, NewestAcknowledged};
use proptest::prelude::*;
use proptest::test_runner::TestCaseResult;
use wire::AlState;

use crate::bench::Bench;
use crate::model::Model;
use crate::operations::{Operation, Setup, Write};
use crate::rows::{INFORMATION, MINOR_FAULT, MISMATCH_C_TO_M, MISMATCH_M_TO_C, OBSERVATION};
use crate::settings::{PdoSetting, io_settings, pdo_settings};

/// A unit and its model.
#[derive(Debug)]
pub(crate) struct Run {
    pub(crate) bench: Bench,
    pub(crate) model: Model,
    /// Object 10F3:03 reads the value written last.
    pub(crate) reads_last_acknowledged: bool,
    pdo_settings: Vec<PdoSetting>,
}

impl Run {
    pub(crate) fn power_on(setup: &Setup) -> Self {
        let io_settings = io_settings();
        let io = setup.io.get(&io_settings);
        let newest_acknowledged = match setup.reads_last_acknowledged {
            true => NewestAcknowledged::LastAcknowledged,
            false => NewestAcknowledged::NewestRecord,
        };
        let pdo_settings = pdo_settings();
        let observations: &[u32] = match setup.mismatches_are_observations {
            true => &[MISMATCH_M_TO_C, MISMATCH_C_TO_M],
            false => &[],
        };
        Self {
            bench: Bench::power_on(io, newest_acknowledged, observations),
            model: Model::power_on(io.clone(), pdo_settings[0].clone(), observations),
            reads_last_acknowledged: setup.reads_last_acknowledged,
            pdo_settings,
        }
    }

    /// Executes one operation on both, and then the regular actions of a slave stack and a memory.
    pub(crate) fn step(&mut self, operation: &Operation) -> TestCaseResult {
        match operation {
            Operation::AlErrors { code, times } => {
                for _ in 0..*times {
                    prop_assert_eq!(self.bench.al_error(*code), self.model.al_error(*code));
                }
            }
            Operation::AskForPreOp { found } => self.ask_for_pre_op(found)?,
            Operation::AskForSafeOp { setting, found } => {
                let setting = setting.get(&self.pdo_settings).clone();
                self.ask_for_safe_op(&setting, found)?;
            }
            Operation::AskForOp if self.model.state == AlState::SafeOp => self.enter(AlState::Op),
            Operation::AskForOp => {}
            Operation::Leave(state) => self.leave_for(*state),
            Operation::Write(write) => self.write(write)?,
            Operation::TakeEmergencies(most) => {
                let count = self.model.emergencies.len().min(*most);
                let expected: Vec<_> = self.model.emergencies.drain(..count).collect();
                prop_assert_eq!(self.bench.take_emergencies(*most), expected);
            }
            _ => self.do_outside(operation)?,
        }
        prop_assert_eq!(self.bench.fault(), self.model.fault());
        prop_assert_eq!(self.bench.emergencies_lost(), self.model.emergencies_lost);
        if self.model.fault().is_some() && self.model.state != AlState::Init {
            self.enter(AlState::Init);
        }
        self.bench.store();
        self.model.store();
        Ok(())
    }

    /// The actions of hardware, CPU Unit and user.
    fn do_outside(&mut self, operation: &Operation) -> TestCaseResult {
        let Self { bench, model, .. } = self;
        match operation {
            Operation::Inject(fault) => {
                bench.unit.inject(*fault);
                model.inject(*fault);
            }
            Operation::Remove(fault) => {
                bench.unit.remove(*fault);
                model.remove(*fault);
            }
            Operation::ResetErrors { times } => {
                (0..*times).for_each(|_| bench.unit.reset_errors());
                (0..*times).for_each(|_| model.reset_errors());
            }
            Operation::ClearEventLog { log, times } => {
                (0..*times).for_each(|_| bench.unit.clear_event_log(*log));
                let number = match log {
                    EventLog::System => 1,
                    EventLog::Access => 2,
                    EventLog::None => return Ok(()),
                };
                (0..*times).for_each(|_| model.clear_event_log(number));
            }
            Operation::Refresh { time_ns, refreshing } => return self.refresh(*time_ns, *refreshing),
            Operation::SetLevel { event, level } => return self.set_level(*event, *level),
            _ => return self.start_again(operation),
        }
        Ok(())
    }

    fn start_again(&mut self, operation: &Operation) -> TestCaseResult {
        let Self { bench, model, .. } = self;
        match operation {
            Operation::Restart(start) => {
                let expected = (*start == Start::Restart).then_some(0x0060);
                model.restart(*start);
                prop_assert_eq!(bench.restart(*start), expected);
            }
            Operation::PowerCycle { damaged } => {
                bench.cycle_power(*damaged);
                model.cycle_power(*damaged);
            }
            _ => unreachable!("{operation:?} is the master's"),
        }
        Ok(())
    }

    fn enter(&mut self, state: AlState) {
        self.bench.enter(state);
        self.model.enter(state);
    }

    /// The slave goes to a lower state, if `state` is below its present one.
    fn leave_for(&mut self, state: AlState) {
        let ladder = [AlState::Init, AlState::PreOp, AlState::SafeOp, AlState::Op];
        let height = |state| ladder.iter().position(|&step| step == state);
        if height(state) < height(self.model.state) {
            self.enter(state);
        }
    }

    /// The master goes to INIT and requests PRE-OP.
    fn ask_for_pre_op(&mut self, found: &[u16]) -> TestCaseResult {
        if self.model.fault().is_some() {
            return Ok(());
        }
        self.leave_for(AlState::Init);
        let verdict = self.bench.check(Check::Mailbox, found);
        prop_assert_eq!(verdict, self.model.check_mailbox(found));
        if verdict.is_ok() {
            self.enter(AlState::PreOp);
        }
        Ok(())
    }

    /// The master goes to PRE-OP, sets the mapping and requests SAFE-OP.
    fn ask_for_safe_op(&mut self, setting: &PdoSetting, found: &[u16]) -> TestCaseResult {
        if self.model.state == AlState::Init {
            self.ask_for_pre_op(&[])?;
        }
        self.leave_for(AlState::PreOp);
        if self.model.state == AlState::Init {
            return Ok(());
        }
        self.bench.map(setting);
        let verdict = self.bench.check(Check::ProcessData, found);
        prop_assert_eq!(verdict, self.model.check_process_data(setting, found));
        if verdict.is_ok() {
            self.enter(AlState::SafeOp);
        }
        Ok(())
    }

    fn write(&mut self, write: &Write) -> TestCaseResult {
        let Self { bench, model, .. } = self;
        let (done, expected) = match write {
            Write::Acknowledge(sub) => (bench.write(0x10F3, 3, &[*sub]), model.acknowledge(*sub)),
            Write::AcknowledgeNewest => {
                let newest = bench.read(0x10F3, 2);
                let expected = match model.log.newest() {
                    // It would be a clear.
                    0 => return Ok(()),
                    newest => model.acknowledge(newest),
                };
                (bench.write(0x10F3, 3, &newest), expected)
            }
            Write::Flags(flags) => (bench.write(0x10F3, 5, &flags.to_le_bytes()), model.set_flags(*flags)),
            Write::ClearErrors(value) => {
                (bench.write(0x2002, 2, &[*value]), model.write_clear_errors(*value))
            }
            Write::ClearHistory(value) => {
                (bench.write(0x2100, 0, &value.to_le_bytes()), model.write_clear_history(*value))
            }
        };
        prop_assert_eq!(done, expected);
        Ok(())
    }

    fn set_level(&mut self, event: u32, level: EventLevel) -> TestCaseResult {
        let number = match level {
            EventLevel::Information => INFORMATION,
            EventLevel::Observation => OBSERVATION,
            EventLevel::MinorFault => MINOR_FAULT,
        };
        let code = EventCode(event);
        let taken = self.bench.unit.set_event_level(code, level).is_ok();
        prop_assert_eq!(taken, self.model.set_level(event, number));
        // A user's setting is kept without power.
        prop_assert_eq!(self.bench.settings.event_levels.set(code, level).is_ok(), taken);
        Ok(())
    }
}
