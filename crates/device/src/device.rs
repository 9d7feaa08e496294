//! One slave: the stack around a unit, on one ESC.

mod requests;
mod start_up;
mod watch;

use esc::{AlEvents, Esc, Pdi, Port, SmIndex};
use time::{Duration, Instant};
use wire::{AlControl, AlState, AlStatus, AlStatusCode};

use crate::conduct::Conduct;
use crate::config::DeviceConfig;
use crate::mailbox_service::MailboxService;
use crate::power::Power;
use crate::unit::{Exchange, PortLinks, RefreshCause, Start, Unit};

/// What the stack listens to. Process data are not among it: the refresh runs freely.
const EVENTS: AlEvents = AlEvents::AL_CONTROL
    .union(AlEvents::SYNC_MANAGER_ACTIVATION)
    .union(AlEvents::WATCHDOG)
    .union(AlEvents::from_bits_truncate(0x0300));

/// A slave under power.
#[derive(Debug)]
pub struct Device<U> {
    unit: U,
    config: DeviceConfig,
    mailbox: Option<MailboxService>,
    status: AlStatus,
    code: AlStatusCode,
    /// The AL status code that the master finds after a restart.
    code_at_start: Option<AlStatusCode>,
    conduct: Conduct,
    /// When the state request that waits in AL control is taken.
    request_due: Option<Instant>,
    /// The master has asked for OP, and outputs have not come yet.
    op_request: Option<OpRequest>,
    /// Outputs have come since the slave left PRE-OP; OP watches over them from its beginning on.
    outputs_came: bool,
    /// Emergencies that found no mailbox, or no room in it.
    emergencies_lost: u64,
    next_refresh: Instant,
    power: Power,
}

impl<U: Unit> Device<U> {
    /// A slave that gets power at `now`, and the ESC that belongs to it.
    #[must_use]
    pub fn power_on(config: DeviceConfig, unit: U, now: Instant) -> (Self, Esc) {
        let esc = Esc::power_on(config.esc.clone(), config.sii_image.clone(), now);
        let mut device = Self {
            unit,
            conduct: config.conduct.clone(),
            config,
            mailbox: None,
            status: AlStatus::default(),
            code: AlStatusCode::NO_ERROR,
            code_at_start: None,
            request_due: None,
            op_request: None,
            outputs_came: false,
            emergencies_lost: 0,
            next_refresh: now,
            power: Power::Off,
        };
        let mailbox = device.config.mailbox;
        device.mailbox = mailbox.and_then(|mailbox| {
            device.unit.objects().map(|objects| MailboxService::new(mailbox, objects.table()))
        });
        let mut esc = esc;
        device.begin_start_up(device.config.start_up.first, &mut esc, now);
        (device, esc)
    }

    /// Starts again from INIT, as after power-on; the EEPROM keeps what was written to it.
    pub fn restart(&mut self, esc: &mut Esc, now: Instant, start: Start) {
        let code = self.unit.restart(now, start, esc.sii_image_mut());
        esc.reset(now);
        self.status = AlStatus::default();
        self.code = AlStatusCode::NO_ERROR;
        self.request_due = None;
        self.op_request = None;
        self.outputs_came = false;
        self.code_at_start = code;
        if let Some(mailbox) = &mut self.mailbox {
            mailbox.reset();
        }
        self.begin_start_up(self.config.start_up.again, esc, now);
    }

    /// Whether the slave has no power.
    #[must_use]
    pub const fn is_off(&self) -> bool {
        matches!(self.power, Power::Off)
    }

    /// The slave loses its power: it does nothing until [`Device::restart`]. Its cables are the network's.
    pub(crate) fn power_off(&mut self, now: Instant) {
        self.power = Power::Off;
        self.unit.power_off(now);
    }

    /// The unit model.
    #[must_use]
    pub const fn unit(&self) -> &U {
        &self.unit
    }

    /// The unit model, for what its application does to it.
    pub const fn unit_mut(&mut self) -> &mut U {
        &mut self.unit
    }

    /// State and error indication, as AL status shows them.
    #[must_use]
    pub const fn al_status(&self) -> AlStatus {
        self.status
    }

    /// AL status code as register 0x0134 shows it.
    #[must_use]
    pub const fn al_status_code(&self) -> AlStatusCode {
        self.code
    }

    /// Times and refusals of the state machine, to be changed; [`Device::behave`] takes the change back.
    pub const fn conduct_mut(&mut self) -> &mut Conduct {
        &mut self.conduct
    }

    /// Mailbox requests that come from now on are answered this long after they came.
    pub fn set_response_time(&mut self, response_time: Duration) {
        if let Some(mailbox) = &mut self.mailbox {
            mailbox.set_response_time(response_time);
        }
    }

    /// Conduct, mailbox and SII take their times of power-on again. The content of the SII stays.
    pub fn behave(&mut self, esc: &mut Esc) {
        self.conduct = self.config.conduct.clone();
        if let Some(mailbox) = self.config.mailbox {
            self.set_response_time(mailbox.response_time);
        }
        esc.set_sii_timing(self.config.esc.sii);
    }

    /// When the device has to be polled next, whatever the wire does.
    #[must_use]
    pub fn deadline(&self) -> Instant {
        match self.power {
            Power::Off => return Instant::NEVER,
            Power::StartingUp { next, .. } => return next,
            Power::On => {}
        }
        let mailbox = self.mailbox.as_ref().map_or(Instant::NEVER, MailboxService::deadline);
        let outputs = self.op_request.map_or(Instant::NEVER, |request| request.deadline);
        self.next_refresh.min(mailbox).min(outputs).min(self.request_due.unwrap_or(Instant::NEVER))
    }

    /// Whether the next outputs take the slave to OP.
    pub(crate) const fn awaits_outputs(&self) -> bool {
        self.op_request.is_some()
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
        if pdi.take_activation_event() {
            self.watch_sync_managers(&mut pdi, now);
        }
        self.watch_al_control(&mut pdi, now);
        if pdi.take_watchdog_event() && self.status.state == AlState::Op {
            self.drop_to(AlState::SafeOp, &[AlStatusCode::SYNC_MANAGER_WATCHDOG], &mut pdi, now);
        }
        self.watch_op_request(&mut pdi, now);
        if now >= self.next_refresh {
            self.refresh(&mut pdi, now);
        }
        self.watch_fault(&mut pdi, now);
        self.queue_emergencies();
        self.poll_mailbox(&mut pdi, now);
        self.queue_emergencies();
    }

    fn queue_emergencies(&mut self) {
        while let Some(emergency) = self.unit.take_emergency() {
            // Lost ones are counted.
            let _ = self.queue_emergency(emergency);
        }
    }

    /// Runs the unit's refresh and sets the time of the next one; what was missed is not made up for.
    fn refresh(&mut self, pdi: &mut Pdi<'_>, now: Instant) {
        self.exchange(RefreshCause::Period, pdi, now);
        let period = self.unit.refresh_period();
        self.next_refresh += period;
        if self.next_refresh <= now && period > Duration::ZERO {
            let missed = now.saturating_since(self.next_refresh).as_nanos() / period.as_nanos() + 1;
            self.next_refresh += period * missed;
        }
    }

    fn exchange(&mut self, cause: RefreshCause, pdi: &mut Pdi<'_>, now: Instant) {
        let state = self.status.state;
        self.outputs_came |= pdi.outputs_received(SmIndex::OUTPUTS);
        let valid = state == AlState::Op && pdi.outputs_received(SmIndex::OUTPUTS) && !pdi.watchdog_expired();
        let links = PortLinks { in_port: pdi.link(Port::In), out_port: pdi.link(Port::Out) };
        let unit = &mut self.unit;
        if matches!(state, AlState::SafeOp | AlState::Op) {
            pdi.exchange(SmIndex::OUTPUTS, SmIndex::INPUTS, |outputs, inputs| {
                let outputs = valid.then_some(outputs);
                unit.refresh(now, Exchange { cause, state, links, outputs, inputs });
            });
        } else {
            unit.refresh(now, Exchange { cause, state, links, outputs: None, inputs: &mut [] });
        }
    }

    fn poll_mailbox(&mut self, pdi: &mut Pdi<'_>, now: Instant) {
        let state = self.status.state;
        if !matches!(state, AlState::PreOp | AlState::SafeOp | AlState::Op) {
            return;
        }
        let (Some(mailbox), Some(objects)) = (&mut self.mailbox, self.unit.objects()) else { return };
        if mailbox.poll(now, state, pdi, objects) {
            self.follow_alias(pdi);
            if self.unit.take_status_change() {
                self.exchange(RefreshCause::Change, pdi, now);
            }
        }
    }

    /// The unit may have been given another station alias.
    fn follow_alias(&self, pdi: &mut Pdi<'_>) {
        if let Some(alias) = self.unit.station_alias() {
            pdi.set_station_alias(alias);
        }
    }

    /// Queues an emergency message, if the state has a mailbox; false if it is lost, which is counted.
    pub fn queue_emergency(&mut self, emergency: wire::Emergency) -> bool {
        let has_mailbox = self.status.state != AlState::Init;
        let mailbox = self.mailbox.as_mut().filter(|_| has_mailbox);
        let is_queued = mailbox.is_some_and(|mailbox| mailbox.mailbox().queue_emergency(emergency).is_ok());
        self.emergencies_lost += u64::from(!is_queued);
        is_queued
    }

    /// How many emergencies have found no room in the unit, no mailbox in their state, or no room in it, since
    /// power-on. Those that waited when the slave went to INIT are not among them.
    #[must_use]
    pub fn emergencies_lost(&self) -> u64 {
        self.emergencies_lost + self.unit.emergencies_lost()
    }

    /// Changes the state inside; what the wire sees follows by [`Device::show`], so that the inputs of
    /// SAFE-OP are there before AL status says so.
    fn enter(&mut self, state: AlState, pdi: &mut Pdi<'_>, now: Instant) {
        let before = self.status.state;
        self.status.state = state;
        if state == before {
            return;
        }
        // Here, because a fall-back closes the outputs and forgets that some have come.
        let had_process_data = matches!(before, AlState::SafeOp | AlState::Op);
        self.outputs_came = had_process_data && (self.outputs_came || pdi.outputs_received(SmIndex::OUTPUTS));
        self.open_sync_managers(pdi);
        if state == AlState::Op && self.outputs_came {
            pdi.start_watchdog(SmIndex::OUTPUTS, now);
        }
        if (before == AlState::Init || state == AlState::Init)
            && let Some(mailbox) = &mut self.mailbox
        {
            mailbox.reset();
        }
        self.unit.entered(now, state);
        self.exchange(RefreshCause::Change, pdi, now);
    }

    /// INIT has no mailbox, and process data begin with SAFE-OP (reference 5.1): what the state does not have
    /// is closed for the wire, and begins empty when it opens.
    fn open_sync_managers(&self, pdi: &mut Pdi<'_>) {
        let state = self.status.state;
        let process_data = matches!(state, AlState::SafeOp | AlState::Op);
        for index in [SmIndex::OUTPUTS, SmIndex::INPUTS] {
            pdi.set_deactivated(index, !process_data);
        }
        if self.config.mailbox.is_some() {
            for index in [SmIndex::MAILBOX_RECEIVE, SmIndex::MAILBOX_SEND] {
                pdi.set_deactivated(index, state == AlState::Init);
            }
        }
    }

    fn show_error(&mut self, state: AlState, code: AlStatusCode, pdi: &mut Pdi<'_>) {
        self.show(error_status(state, code), code, pdi);
    }

    fn show(&mut self, status: AlStatus, code: AlStatusCode, pdi: &mut Pdi<'_>) {
        self.status = status;
        self.code = code;
        pdi.set_al_status(status, code);
    }
}

/// A request for OP that waits for outputs.
#[derive(Clone, Copy, Debug)]
struct OpRequest {
    control: AlControl,
    /// Without outputs it is refused then.
    deadline: Instant,
}

/// AL status with an error in `state`; without a code there is no error indication.
fn error_status(state: AlState, code: AlStatusCode) -> AlStatus {
    AlStatus { state, error: code != AlStatusCode::NO_ERROR, device_id_loaded: false }
}
