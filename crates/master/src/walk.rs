//! The way of a slave from state to state: what is written before each request, and what after it.

use esi::Transition;
use wire::AlState;

use crate::access::Wait;
use crate::channels::{FmmuSettings, SyncManagerSettings};
use crate::job::Job;
use crate::mailbox::MailboxDialogue;
use crate::queue::Then;
use crate::registers::{self, SYNC_MANAGER_ACTIVATE};
use crate::sdo::SdoTransfer;
use crate::service::Service;
use crate::settings::{MailboxSettings, SlaveSettings};
use crate::state::{AlReport, StateRequest};

/// States on the way up.
const WAY_UP: [AlState; 4] = [AlState::Init, AlState::PreOp, AlState::SafeOp, AlState::Op];
/// Offers the SII to the PDI.
const OWNED_BY_PDI: [u8; 1] = [0x01];

/// The level of a state on the way up; none for BOOT and for a value that is not a state.
fn floor(state: AlState) -> Option<usize> {
    WAY_UP.iter().position(|&step| step == state)
}

/// Whether a state has process data.
pub(crate) fn has_process_data(state: AlState) -> bool {
    floor(state).is_some_and(|floor| floor >= 2)
}

/// Whether a state has the standard mailbox.
pub(crate) fn has_mailbox(state: AlState) -> bool {
    floor(state).is_some_and(|floor| floor >= 1)
}

/// Whether the way includes PRE-OP to SAFE-OP, so that process data are set.
pub(crate) fn sets_process_data(from: AlState, target: AlState) -> bool {
    has_process_data(target) && !has_process_data(from)
}

/// The jobs that take a slave from the state that it shows to `target`.
pub(crate) fn way(
    shown: AlReport,
    target: AlState,
    settings: &SlaveSettings,
    fmmus: &[FmmuSettings],
) -> Vec<(Job, Then)> {
    let mut way = Way { settings, fmmus, jobs: Vec::new() };
    let mut at = shown.status.state;
    if shown.status.error {
        way.push(Job::State(StateRequest::acknowledge(shown)));
    }
    // The only neighbour of BOOT is INIT.
    let leaves_the_way = floor(at).is_none() || floor(target).is_none();
    if leaves_the_way && at != target && at != AlState::Init {
        way.request(AlState::Init, Wait::BackToInit);
        at = AlState::Init;
    }
    match (floor(at), floor(target)) {
        (Some(from), Some(goal)) => way.along(from, goal),
        _ if at == target => {}
        _ => way.boot(target),
    }
    way.arrive(target)
}

struct Way<'a> {
    settings: &'a SlaveSettings,
    fmmus: &'a [FmmuSettings],
    jobs: Vec<(Job, Then)>,
}

impl Way<'_> {
    fn push(&mut self, job: Job) {
        self.jobs.push((job, Then::Continue));
    }

    fn request(&mut self, state: AlState, wait: Wait) {
        self.push(Job::State(StateRequest::new(state, wait)));
    }

    fn along(&mut self, from: usize, goal: usize) {
        if goal < from {
            let wait = if WAY_UP[goal] == AlState::SafeOp { Wait::BackToSafeOp } else { Wait::BackToInit };
            self.request(WAY_UP[goal], wait);
        }
        for state in WAY_UP.into_iter().take(goal + 1).skip(from + 1) {
            match state {
                AlState::PreOp => self.init_to_pre_op(),
                AlState::SafeOp => self.pre_op_to_safe_op(),
                _ => self.safe_op_to_op(),
            }
        }
    }

    fn init_to_pre_op(&mut self) {
        if let Some(mailbox) = &self.settings.mailbox {
            self.sync_manager(&mailbox.out);
            self.sync_manager(&mailbox.inward);
        }
        self.registers(Transition::Ip);
        self.push(Job::write(registers::SII_OWNER, &OWNED_BY_PDI));
        self.jobs.push((Job::State(StateRequest::new(AlState::PreOp, Wait::PreOp)), Then::RestartMailbox));
        self.start_up(Transition::Ip);
    }

    fn pre_op_to_safe_op(&mut self) {
        self.start_up(Transition::Ps);
        for area in &self.settings.process_data {
            self.sync_manager(&area.sync_manager);
        }
        for area in self.settings.process_data.iter().filter(|area| area.bits == 0) {
            let nothing = FmmuSettings { number: area.fmmu, ..FmmuSettings::default() };
            self.push(Job::write(registers::fmmu(area.fmmu), &nothing.pack()));
        }
        for fmmu in self.fmmus {
            self.push(Job::write(registers::fmmu(fmmu.number), &fmmu.pack()));
        }
        self.registers(Transition::Ps);
        self.jobs.push((Job::State(StateRequest::new(AlState::SafeOp, Wait::SafeOpOp)), Then::Open));
    }

    fn safe_op_to_op(&mut self) {
        self.start_up(Transition::So);
        self.registers(Transition::So);
        self.request(AlState::Op, Wait::SafeOpOp);
    }

    /// BOOT, or a number that is not a state.
    fn boot(&mut self, target: AlState) {
        let areas = self.settings.mailbox.as_ref().and_then(MailboxSettings::in_boot);
        if let (Some((out, inward)), AlState::Boot) = (areas, target) {
            self.sync_manager(&out);
            self.sync_manager(&inward);
        }
        self.jobs.push((Job::State(StateRequest::new(target, Wait::PreOp)), Then::RestartMailbox));
    }

    /// A SyncManager accepts new settings only while it is disabled.
    fn sync_manager(&mut self, settings: &SyncManagerSettings) {
        let offset = registers::sync_manager(settings.number);
        self.push(Job::write(offset + SYNC_MANAGER_ACTIVATE, &[0]));
        self.push(Job::write(offset, &settings.pack()));
    }

    fn registers(&mut self, transition: Transition) {
        for register in self.settings.registers.iter().filter(|register| register.transition == transition) {
            self.push(Job::write(register.offset, &register.data));
        }
    }

    fn start_up(&mut self, transition: Transition) {
        let Some(mailbox) = &self.settings.mailbox else { return };
        for sdo in self.settings.start_up.iter().filter(|sdo| sdo.transition == transition) {
            let service = Service::Sdo(SdoTransfer::download(sdo.target, &sdo.data));
            self.push(Job::mailbox(MailboxDialogue::new(mailbox.out, mailbox.inward, service)));
        }
    }

    /// The last job shows the reached state.
    fn arrive(mut self, target: AlState) -> Vec<(Job, Then)> {
        if !matches!(self.jobs.last(), None | Some((Job::State(_), _))) {
            self.jobs.push((Job::read_al_status(), Then::Arrive(target)));
        }
        self.jobs
    }
}
