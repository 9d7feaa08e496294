//! From power-on to the first step of the unit: until then only its controller answers.

use esc::Esc;
use time::{Duration, Instant};
use wire::{AlState, AlStatusCode};

use super::Device;
use crate::machine::State;
use crate::power::{Phase, Power};
use crate::unit::Unit;

impl<U: Unit> Device<U> {
    /// The slave has been powered on, or restarts; `code` is the code for the master. Without a start-up time
    /// it takes its first step immediately.
    pub(super) fn begin_start_up(
        &mut self,
        start_up: Duration,
        code: Option<AlStatusCode>,
        esc: &mut Esc,
        now: Instant,
    ) {
        let phase_time = Duration::from_nanos(start_up.as_nanos() / 2);
        self.power = Power::StartingUp { phase: Phase::Waiting, next: now + phase_time, phase_time, code };
        esc.pdi().set_operational(false);
        self.has_started(esc, now);
    }

    /// Whether the unit is running at `now`; due steps of its start-up are done first.
    pub(super) fn has_started(&mut self, esc: &mut Esc, now: Instant) -> bool {
        while let Power::StartingUp { phase, next, phase_time, code } = self.power {
            if now < next {
                return false;
            }
            match phase {
                Phase::Waiting => {
                    self.unit.initializing(now);
                    let next = next + phase_time;
                    self.power = Power::StartingUp { phase: Phase::Initializing, next, phase_time, code };
                }
                Phase::Initializing => self.start(code, esc, now),
            }
        }
        !self.is_off()
    }

    fn start(&mut self, code: Option<AlStatusCode>, esc: &mut Esc, now: Instant) {
        let has_period = self.unit.refresh_period().is_some();
        let next_refresh = if has_period { now + self.config.refresh_phase } else { Instant::NEVER };
        self.power = Power::On { next_refresh };
        let mut pdi = esc.pdi();
        pdi.set_operational(true);
        pdi.set_event_mask(self.events());
        self.open_sync_managers(&mut pdi);
        self.unit.entered(now, AlState::Init);
        self.take_actions(&mut pdi, now);
        if let (Some(code), State::Init { fault: None }) = (code, self.machine.state) {
            self.refuse(AlState::Init, code, &mut pdi, now);
        }
    }
}
