//! The exchange of process data: when it occurs, and which outputs are valid.

use esc::{Esc, Pdi, Port, SmIndex};
use time::{Duration, Instant};
use wire::AlState;

use super::Device;
use crate::power::Power;
use crate::settings::{Lengths, Settings};
use crate::sync_managers::{DataDirection, DataLength, ProcessDataConfig};
use crate::sync_mode::SyncMode;
use crate::unit::{Exchange, PortLinks, RefreshCause, Unit};

/// DC activation bit 0: the cyclic unit is active.
const CYCLIC_OPERATION: u8 = 1;

impl<U: Unit> Device<U> {
    /// Refreshes the unit if its timer or the master triggers it.
    pub(super) fn refresh(&mut self, pdi: &mut Pdi<'_>, now: Instant) {
        if let Power::On { next_refresh } = self.power
            && now >= next_refresh
        {
            self.exchange(RefreshCause::Period, pdi, now);
            self.power = Power::On { next_refresh: self.refresh_after(next_refresh, now) };
        } else if self.is_synchronised(pdi) {
            self.exchange(RefreshCause::SyncManager, pdi, now);
        }
    }

    /// Whether the master has exchanged process data with which the unit synchronises.
    fn is_synchronised(&self, pdi: &Pdi<'_>) -> bool {
        self.sync_events().any(|index| pdi.has_event(index) && pdi.sync_manager(index).pdi_event)
            || self.frame_events().any(|index| pdi.has_event(index))
    }

    /// Whether a frame has brought outputs that are applied at the end of the frame.
    pub(super) fn follows_frame(&self, esc: &Esc) -> bool {
        self.frame_events().any(|index| esc.has_sync_manager_event(index))
    }

    /// Missed refreshes are not repeated, and the phase is unchanged.
    fn refresh_after(&self, refreshed: Instant, now: Instant) -> Instant {
        let Some(period) = self.unit.refresh_period() else { return Instant::NEVER };
        let mut next = refreshed + period;
        if next <= now && period > Duration::ZERO {
            let missed = now.saturating_since(next).as_nanos() / period.as_nanos() + 1;
            next += period * missed;
        }
        next
    }

    pub(super) fn exchange(&mut self, cause: RefreshCause, pdi: &mut Pdi<'_>, now: Instant) {
        let state = self.al_state();
        let received = self.outputs_received(pdi);
        let has_process_data = match self.machine.state.process_data_mut() {
            Some(process_data) => {
                process_data.outputs_came |= received;
                true
            }
            None => false,
        };
        let valid = state == AlState::Op && received && !pdi.watchdog_expired();
        let links = PortLinks { in_port: pdi.link(Port::In), out_port: pdi.link(Port::Out) };
        let unit = &mut self.unit;
        if has_process_data {
            self.process_image.exchange(pdi, |outputs, inputs| {
                let outputs = valid.then_some(outputs);
                unit.refresh(now, Exchange { cause, state, links, outputs, inputs });
            });
        } else {
            unit.refresh(now, Exchange { cause, state, links, outputs: None, inputs: &mut [] });
        }
    }

    /// Whether the master has written all outputs since they were opened.
    pub(super) fn outputs_received(&self, pdi: &Pdi<'_>) -> bool {
        let mut with_data =
            self.sync_managers_of(DataDirection::Outputs).filter(|&index| pdi.carries_data(index)).peekable();
        with_data.peek().is_some() && with_data.all(|index| pdi.outputs_received(index))
    }

    pub(super) fn start_watchdog(&self, pdi: &mut Pdi<'_>, now: Instant) {
        for index in self.sync_managers_of(DataDirection::Outputs) {
            pdi.start_watchdog(index, now);
        }
    }

    /// The process data that show an error to a master: the outputs, or the inputs of a unit without outputs.
    pub(super) fn close_process_data(&self, pdi: &mut Pdi<'_>) {
        let direction = if self.has_outputs() { DataDirection::Outputs } else { DataDirection::Inputs };
        for index in self.sync_managers_of(direction) {
            pdi.set_deactivated(index, true);
        }
    }

    /// Whether the mapping has outputs.
    pub(super) fn has_outputs(&self) -> bool {
        let all = self.config.process_data.iter().zip(self.lengths());
        all.into_iter().any(|(described, bytes)| described.direction == DataDirection::Outputs && bytes > 0)
    }

    pub(super) fn sync_managers_of(&self, direction: DataDirection) -> impl Iterator<Item = SmIndex> + '_ {
        let all = self.config.process_data.iter();
        all.filter(move |described| described.direction == direction).map(|described| described.sync_manager)
    }

    /// The SyncManagers with whose events an SM-synchronous unit synchronises at present.
    pub(super) fn sync_events(&self) -> impl Iterator<Item = SmIndex> + '_ {
        let followed = self
            .is_in(SyncMode::SmSynchronous)
            .then(|| if self.has_outputs() { DataDirection::Outputs } else { DataDirection::Inputs });
        followed.into_iter().flat_map(|direction| self.sync_managers_of(direction))
    }

    /// The SyncManagers whose outputs are applied at the end of a frame.
    fn frame_events(&self) -> impl Iterator<Item = SmIndex> + '_ {
        let followed = self.is_in(SyncMode::EndOfFrame).then_some(DataDirection::Outputs);
        followed.into_iter().flat_map(|direction| self.sync_managers_of(direction))
    }

    /// Whether process data are exchanged, and in this mode.
    fn is_in(&self, sync_mode: SyncMode) -> bool {
        self.machine.state.process_data().is_some_and(|data| data.sync_mode == sync_mode)
    }

    /// The synchronisation mode that the master has set.
    pub(super) fn sync_mode(&self, pdi: &Pdi<'_>) -> SyncMode {
        if pdi.dc_activation() & CYCLIC_OPERATION != 0 {
            return SyncMode::Dc;
        }
        let first = self.config.sync_modes.first().copied();
        self.unit.sync_mode().or(first).unwrap_or(SyncMode::FreeRun)
    }

    /// The settings of the master together with the expected ones, passed to `look`.
    pub(super) fn with_settings<T>(&self, pdi: &Pdi<'_>, look: impl FnOnce(&Settings<'_, '_>) -> T) -> T {
        let (config, lengths) = (&self.config, &self.lengths());
        look(&Settings { config, lengths, sync_mode: self.sync_mode(pdi), pdi })
    }

    fn lengths(&self) -> Lengths {
        let length = |described: &ProcessDataConfig| match described.length {
            DataLength::Fixed(bytes) => bytes,
            DataLength::Mapped { .. } => self.unit.mapped_bytes(described.sync_manager),
        };
        self.config.process_data.iter().map(length).collect()
    }
}
