//! How to cause each of the 38 events, and how to remove its cause.

use ectwin::{EventLog, Fault};
use nx_ect101::layout;

use crate::stage::{INIT, INPUTS_BYTES, OP, OUTPUTS_BYTES, PRE_OP, SAFE_OP, Stage};

/// The time at which the cause appears.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum When {
    /// It is in the unit file.
    UnitFile,
    /// Before the unit starts.
    Start,
    /// In INIT.
    Init,
    /// In PRE-OP.
    PreOp,
    /// In OP, while data are exchanged.
    Op,
}

/// One event, caused alone.
pub(crate) struct Case {
    pub(crate) code: &'static str,
    pub(crate) when: When,
    /// The contents of the unit file in addition to the model.
    pub(crate) unit_file: &'static str,
    pub(crate) cause: fn(&mut Stage),
    /// Removes the cause, if the recovery does not also remove it.
    pub(crate) remove: fn(&mut Stage),
    /// Attached information 1, if the event has it.
    pub(crate) detail: Option<u32>,
}

const fn nothing(_: &mut Stage) {}

const fn case(code: &'static str, when: When, cause: fn(&mut Stage)) -> Case {
    Case { code, when, unit_file: "", cause, remove: nothing, detail: None }
}

const fn file(code: &'static str, unit_file: &'static str, detail: Option<u32>) -> Case {
    Case { code, when: When::UnitFile, unit_file, cause: nothing, remove: nothing, detail }
}

impl Case {
    const fn removed_by(self, remove: fn(&mut Stage)) -> Self {
        Self { remove, ..self }
    }

    const fn telling(self, detail: u32) -> Self {
        Self { detail: Some(detail), ..self }
    }
}

fn inject(stage: &mut Stage, fault: Fault) {
    stage.unit().inject(fault);
    stage.run_for_ms(2);
}

fn remove(stage: &mut Stage, fault: Fault) {
    stage.unit().remove(fault);
}

fn break_and_start(stage: &mut Stage, fault: Fault) {
    inject(stage, fault);
    stage.unit().cycle_power();
    stage.run_for_ms(2);
}

/// Sets lengths that match the mapping, and requests SAFE-OP.
fn ask_for_safe_op(stage: &mut Stage, outputs_bytes: u16, inputs_bytes: u16) {
    stage.set_process_data(outputs_bytes, inputs_bytes);
    stage.request(SAFE_OP);
}

fn uints(base: u32, subs: impl IntoIterator<Item = u32>) -> Vec<u32> {
    subs.into_iter().map(|sub| base | sub << 8 | 240).collect()
}

/// A SyncManager 2 with this control byte.
fn control_outputs(stage: &mut Stage, control: u8) {
    stage.set_sync_manager(2, layout::OUTPUTS_START, OUTPUTS_BYTES, control);
    stage.request(SAFE_OP);
}

const RX: u32 = 0x7000_0000;
const TX: u32 = 0x6000_0000;

#[rustfmt::skip]
pub(crate) const CASES: &[Case] = &[
    case("00200000", When::Start, |stage| break_and_start(stage, Fault::NonVolatileMemory))
        .removed_by(|stage| remove(stage, Fault::NonVolatileMemory)),
    case("09450000", When::Start, |stage| break_and_start(stage, Fault::Esc))
        .removed_by(|stage| remove(stage, Fault::Esc)),
    case("09460000", When::Init, |stage| {
        inject(stage, Fault::SiiVerification);
        stage.set_mailboxes();
        stage.request(PRE_OP);
    }).removed_by(|stage| remove(stage, Fault::SiiVerification)),
    case("10410000", When::Start, |stage| break_and_start(stage, Fault::ControlParameters))
        .removed_by(|stage| remove(stage, Fault::ControlParameters)),
    case("35050000", When::PreOp, |stage| ask_for_safe_op(stage, OUTPUTS_BYTES - 1, INPUTS_BYTES)),
    case("35060000", When::PreOp, |stage| ask_for_safe_op(stage, OUTPUTS_BYTES, INPUTS_BYTES + 1)),
    case("35070000", When::PreOp, |stage| control_outputs(stage, layout::OUTPUTS_CONTROL & !0x40)),
    case("35090000", When::PreOp, |stage| {
        stage.assign(0x1C13, &[0x1A01, 0x1BFE, 0x1BFF]);
        ask_for_safe_op(stage, OUTPUTS_BYTES, INPUTS_BYTES - 2);
    }),
    case("350A0000", When::PreOp, |stage| {
        stage.assign(0x1C12, &[0x1601, 0x1A00]);
        ask_for_safe_op(stage, OUTPUTS_BYTES + 2, INPUTS_BYTES);
    }),
    case("350B0000", When::PreOp, |stage| { stage.request(OP); }),
    case("350C0000", When::PreOp, |stage| { stage.request(0x05); }),
    case("35180000", When::PreOp, |stage| {
        stage.write(0x0981, &[0x01]);
        stage.request(SAFE_OP);
    }).removed_by(|stage| stage.write(0x0981, &[0x00])),
    file("39130000", "io_allocation.m_to_c.uints = 6\nio_allocation.c_to_m.uints = [\"7000:02\"]", Some(0x1601)),
    case("39140000", When::PreOp, |stage| {
        stage.map(0x1601, &uints(RX, [2]));
        ask_for_safe_op(stage, 30, INPUTS_BYTES);
    }).telling(0x1601),
    case("39150000", When::PreOp, |stage| {
        stage.map(0x1A01, &uints(TX, [2]));
        ask_for_safe_op(stage, OUTPUTS_BYTES, 34);
    }).telling(0x1A01),
    file("39160000", "io_allocation.m_to_c.uints = 6\nio_allocation.c_to_m.uints = 4", None),
    file("39170000", "io_allocation.m_to_c.uints = 4\nio_allocation.c_to_m.uints = 6", None),
    file("39190000", "io_allocation.m_to_c.uints = [\"6000:02\"]\nio_allocation.c_to_m.uints = 6", Some(0x1A01)),
    file("391A0000", "io_allocation.m_to_c.uints = 6\nio_allocation.c_to_m.uints = [\"7000:01\", \"7001:01\"]", Some(0x1601)),
    file("391B0000", "io_allocation.m_to_c.uints = [\"6000:01\", \"6001:01\"]\nio_allocation.c_to_m.uints = 6", Some(0x1A01)),
    file("391C0000", "io_allocation.m_to_c.uints = 6\nio_allocation.c_to_m = { uints = 40, udint = 1 }", None),
    file("391D0000", "io_allocation.m_to_c = { uints = 40, udint = 1 }\nio_allocation.c_to_m.uints = 6", None),
    case("391E0000", When::PreOp, |stage| {
        stage.map(0x1601, &[0x7000_01F0, 0x7001_0150]);
        ask_for_safe_op(stage, 40, INPUTS_BYTES);
    }).telling(0x1601),
    case("391F0000", When::PreOp, |stage| {
        stage.map(0x1A01, &[0x6000_01F0, 0x6001_0150]);
        ask_for_safe_op(stage, OUTPUTS_BYTES, 44);
    }).telling(0x1A01),
    case("392C0000", When::PreOp, |stage| {
        stage.map(0x1601, &uints(RX, 1..=40));
        stage.map(0x1603, &[0x7002_0120]);
        stage.assign(0x1C12, &[0x1601, 0x1603]);
        ask_for_safe_op(stage, 1204, INPUTS_BYTES);
    }),
    case("392D0000", When::PreOp, |stage| {
        stage.map(0x1A01, &uints(TX, 1..=40));
        stage.map(0x1A03, &[0x6002_0120]);
        stage.assign(0x1C13, &[0x1A00, 0x1A01, 0x1A03]);
        ask_for_safe_op(stage, OUTPUTS_BYTES, 1206);
    }),
    case("392E0000", When::PreOp, |stage| {
        stage.assign(0x1C12, &[0x1603, 0x1601]);
        ask_for_safe_op(stage, OUTPUTS_BYTES + 16, INPUTS_BYTES);
    }),
    case("392F0000", When::PreOp, |stage| {
        stage.assign(0x1C13, &[0x1A00, 0x1BFE, 0x1A01, 0x1BFF]);
        ask_for_safe_op(stage, OUTPUTS_BYTES, INPUTS_BYTES);
    }),
    case("39320000", When::PreOp, |stage| {
        inject(stage, Fault::SmEventMode);
        stage.request(SAFE_OP);
    }).removed_by(|stage| remove(stage, Fault::SmEventMode)),
    case("39330000", When::PreOp, |stage| control_outputs(stage, layout::OUTPUTS_CONTROL | 0x02)),
    case("39340000", When::Init, |stage| {
        stage.set_mailboxes();
        let (start, length_bytes) = (layout::MAILBOX_RECEIVE_START, layout::MAILBOX_BYTES - 2);
        stage.set_sync_manager(0, start, length_bytes, layout::MAILBOX_RECEIVE_CONTROL);
        stage.request(PRE_OP);
    }),
    case("40200000", When::Op, |stage| inject(stage, Fault::Processing))
        .removed_by(|stage| remove(stage, Fault::Processing)).telling(0),
    case("80200000", When::Op, |stage| inject(stage, Fault::IoCommunications))
        .removed_by(|stage| remove(stage, Fault::IoCommunications)),
    case("80240000", When::Op, |stage| inject(stage, Fault::ClockNotSynchronized))
        .removed_by(|stage| remove(stage, Fault::ClockNotSynchronized)),
    case("85000000", When::Op, |stage| stage.run_for_ms(200)),
    case("80220000", When::Op, |stage| inject(stage, Fault::MessageCommunications)).telling(0),
    case("90400000", When::Op, |stage| {
        stage.unit().clear_event_log(EventLog::System);
        stage.run_for_ms(2);
    }).telling(1),
    case("94B80000", When::Op, |stage| {
        stage.unit().restart();
        stage.run_for_ms(2);
    }),
];

/// The state of the unit in which the cause of a case appears.
pub(crate) fn state_before(when: When) -> u8 {
    match when {
        When::UnitFile | When::Start | When::Init => INIT,
        When::PreOp => PRE_OP,
        When::Op => OP,
    }
}
