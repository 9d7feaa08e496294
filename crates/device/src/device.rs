//! One slave: the stack around a unit, on one ESC.

mod actions;
mod process_data;
mod requests;
mod start_up;
mod watch;

use esc::{AlEvents, Esc, Pdi, SmIndex};
use mailbox::MailboxNote;
use time::{Duration, Instant};
use wire::{AlState, AlStatus, AlStatusCode};

use crate::conduct::Conduct;
use crate::config::DeviceConfig;
use crate::machine::{Indication, Machine, ProcessData, State};
use crate::mailbox_service::MailboxService;
use crate::power::Power;
use crate::process_image::ProcessImage;
use crate::unit::{RefreshCause, Start, Unit};

/// The events that the stack always handles.
const EVENTS: AlEvents =
    AlEvents::AL_CONTROL.union(AlEvents::SYNC_MANAGER_ACTIVATION).union(AlEvents::WATCHDOG);

/// A slave with power.
#[derive(Debug)]
pub struct Device<U> {
    unit: U,
    config: DeviceConfig,
    mailbox: Option<MailboxService>,
    process_image: ProcessImage,
    conduct: Conduct,
    power: Power,
    /// The last values, while the slave has no power.
    machine: Machine,
    /// Emergencies for which there was no mailbox, or no room in it.
    emergencies_lost: u64,
}

impl<U: Unit> Device<U> {
    /// A slave that is powered on at `now`, and its ESC. All the memory that they ever use is allocated here.
    ///
    /// # Panics
    /// If the description is inconsistent, see [`DeviceConfig::validate`].
    #[must_use]
    pub fn power_on(mut config: DeviceConfig, mut unit: U, now: Instant) -> (Self, Esc) {
        if let Err(error) = config.validate() {
            panic!("{error}");
        }
        let sii_image = core::mem::take(&mut config.sii_image);
        let mut esc = Esc::power_on(config.esc, sii_image, now);
        let mailbox = config
            .mailbox
            .and_then(|mailbox| unit.objects().map(|objects| MailboxService::new(mailbox, objects.table())));
        let mut device = Self {
            unit,
            mailbox,
            process_image: ProcessImage::new(&config.process_data),
            conduct: config.conduct.clone(),
            config,
            power: Power::Off,
            machine: Machine::START,
            emergencies_lost: 0,
        };
        device.begin_start_up(device.config.start_up.first, None, &mut esc, now);
        (device, esc)
    }

    /// Starts again from INIT, as after power-on; the EEPROM keeps its contents. A slave without power starts only by
    /// [`Start::PowerOn`]; any other start has no effect on it.
    pub fn restart(&mut self, esc: &mut Esc, now: Instant, start: Start) {
        if self.is_off() && start != Start::PowerOn {
            return;
        }
        let code = self.unit.restart(now, start, esc.sii_image_mut());
        esc.reset(now);
        self.machine = Machine::START;
        if let Some(mailbox) = &mut self.mailbox {
            mailbox.reset();
        }
        self.begin_start_up(self.config.start_up.again, code, esc, now);
    }

    /// Whether the slave has no power.
    #[must_use]
    pub const fn is_off(&self) -> bool {
        matches!(self.power, Power::Off)
    }

    /// Switches the slave's power off: it does nothing until [`Start::PowerOn`]. Its cables belong to the network.
    pub(crate) fn power_off(&mut self, now: Instant) {
        if self.is_off() {
            return;
        }
        self.power = Power::Off;
        self.unit.power_off(now);
    }

    /// The unit model.
    #[must_use]
    pub const fn unit(&self) -> &U {
        &self.unit
    }

    /// The unit model, for access by its application.
    pub const fn unit_mut(&mut self) -> &mut U {
        &mut self.unit
    }

    /// State and error indication, as AL status shows them.
    #[must_use]
    pub const fn al_status(&self) -> AlStatus {
        self.machine.status()
    }

    /// AL status code as register 0x0134 shows it.
    #[must_use]
    pub const fn al_status_code(&self) -> AlStatusCode {
        self.machine.code()
    }

    /// Takes the oldest note of what has happened in the mailbox, for an observer. Without one a few are kept.
    #[inline]
    pub fn take_mailbox_note(&mut self) -> Option<MailboxNote> {
        self.mailbox.as_mut().and_then(MailboxService::take_note)
    }

    /// Mutable access to the conduct of the state machine; [`Device::behave`] restores the configured conduct.
    pub const fn conduct_mut(&mut self) -> &mut Conduct {
        &mut self.conduct
    }

    /// Sets the time from receipt to response for mailbox requests received from now on.
    pub fn set_response_time(&mut self, response_time: Duration) {
        if let Some(mailbox) = &mut self.mailbox {
            mailbox.set_response_time(response_time);
        }
    }

    /// Restores the power-on settings of conduct, mailbox and SII timing. The contents of the SII are unchanged.
    pub fn behave(&mut self, esc: &mut Esc) {
        self.conduct = self.config.conduct.clone();
        if let Some(mailbox) = self.config.mailbox {
            self.set_response_time(mailbox.response_time);
        }
        esc.set_sii_timing(self.config.esc.sii);
    }

    /// The time at which the device must be polled next, independent of frames.
    #[must_use]
    pub fn deadline(&self) -> Instant {
        let next_refresh = match self.power {
            Power::Off => return Instant::NEVER,
            Power::StartingUp { next, .. } => return next,
            Power::On { next_refresh } => next_refresh,
        };
        let mailbox = self.mailbox.as_ref().map_or(Instant::NEVER, MailboxService::deadline);
        let outputs = self.machine.state.op_request().map_or(Instant::NEVER, |request| request.deadline);
        let request = self.machine.request_due.unwrap_or(Instant::NEVER);
        next_refresh.min(mailbox).min(outputs).min(request)
    }

    /// Whether it has to be polled, whatever the time is: its ESC interrupts, the next outputs take it to OP, or
    /// outputs that go out at the end of a frame have come.
    pub(crate) fn is_called(&self, esc: &Esc) -> bool {
        esc.interrupts_pdi() || self.machine.state.op_request().is_some() || self.follows_frame(esc)
    }

    /// Does what is due at `now`: requests of the master, expired times, the refresh.
    pub fn poll(&mut self, esc: &mut Esc, now: Instant) {
        esc.advance(now);
        if !self.is_off() && esc.pdi().take_reset_request() {
            self.restart(esc, now, Start::EscReset);
        }
        if !self.has_started(esc, now) {
            return;
        }
        let mut pdi = esc.pdi();
        self.take_actions(&mut pdi, now);
        if pdi.take_activation_event() {
            self.watch_sync_managers(&mut pdi, now);
        }
        self.watch_al_control(&mut pdi, now);
        if pdi.take_watchdog_event() && self.al_state() == AlState::Op {
            self.drop_to(AlState::SafeOp, &[AlStatusCode::SYNC_MANAGER_WATCHDOG], &mut pdi, now);
        }
        self.watch_op_request(&mut pdi, now);
        self.refresh(&mut pdi, now);
        self.take_actions(&mut pdi, now);
        if self.poll_mailbox(&mut pdi, now) {
            self.take_actions(&mut pdi, now);
        }
    }

    const fn al_state(&self) -> AlState {
        self.machine.state.al_state()
    }

    /// Whether a mailbox request was served, which may have changed the unit.
    fn poll_mailbox(&mut self, pdi: &mut Pdi<'_>, now: Instant) -> bool {
        let state = self.al_state();
        if state == AlState::Init {
            return false;
        }
        let (Some(mailbox), Some(objects)) = (&mut self.mailbox, self.unit.objects()) else { return false };
        mailbox.poll(now, state, pdi, objects)
    }

    /// Changes the internal state; [`Device::show`] updates AL status afterwards, so that the inputs of SAFE-OP
    /// are present before AL status indicates it.
    fn enter(&mut self, state: AlState, pdi: &mut Pdi<'_>, now: Instant) {
        let before = self.machine.state;
        let next = self.state_to_enter(state, pdi);
        self.machine.state = next;
        if next.al_state() == before.al_state() {
            return;
        }
        self.open_sync_managers(pdi);
        pdi.set_event_mask(self.events());
        if let State::Op { process_data: ProcessData { outputs_came: true, .. } } = next {
            self.start_watchdog(pdi, now);
        }
        if (matches!(before, State::Init { .. }) || matches!(next, State::Init { .. }))
            && let Some(mailbox) = &mut self.mailbox
        {
            mailbox.reset();
        }
        self.unit.entered(now, state);
        self.exchange(RefreshCause::Change, pdi, now);
    }

    /// The state, with the data that it takes over from the previous one.
    fn state_to_enter(&self, state: AlState, pdi: &Pdi<'_>) -> State {
        // Determined here, because a fall-back closes the outputs and clears the flag that outputs were received.
        let process_data = match self.machine.state.process_data() {
            Some(before) => ProcessData {
                outputs_came: before.outputs_came || self.outputs_received(pdi),
                sync_mode: before.sync_mode,
            },
            None => ProcessData { outputs_came: false, sync_mode: self.sync_mode(pdi) },
        };
        match state {
            AlState::Init => State::Init { fault: None },
            AlState::PreOp => State::PreOp,
            AlState::Boot => State::Boot,
            AlState::SafeOp => State::SafeOp { process_data, op_request: None },
            AlState::Op => State::Op { process_data },
            // There is no row with this transition.
            AlState::Other(_) => self.machine.state,
        }
    }

    /// INIT has no mailbox, and process data begin with SAFE-OP (reference 5.1): what does not belong to the
    /// state is closed for the ECAT side, and is empty when it opens.
    fn open_sync_managers(&self, pdi: &mut Pdi<'_>) {
        let state = self.al_state();
        let has_process_data = self.machine.state.process_data().is_some();
        for described in &self.config.process_data {
            pdi.set_deactivated(described.sync_manager, !has_process_data);
        }
        if self.config.mailbox.is_some() {
            for index in [SmIndex::MAILBOX_RECEIVE, SmIndex::MAILBOX_SEND] {
                pdi.set_deactivated(index, state == AlState::Init);
            }
        }
    }

    /// The events that interrupt the stack in the present state.
    fn events(&self) -> AlEvents {
        let mailbox = [SmIndex::MAILBOX_RECEIVE, SmIndex::MAILBOX_SEND];
        let mailbox = mailbox.into_iter().filter(|_| self.config.mailbox.is_some());
        mailbox
            .chain(self.sync_events())
            .fold(EVENTS, |events, index| events | AlEvents::from_bits_retain(0x100 << index.0))
    }

    fn show(&mut self, indication: Indication, pdi: &mut Pdi<'_>) {
        self.machine.indication = indication;
        pdi.set_al_status(self.machine.status(), self.machine.code());
    }
}
