//! Whether the effects of orders are still to come.

use plant::line::Choice;
use time::Instant;
use wire::AlState;

use super::Bench;

/// The request of the master.
const AL_CONTROL: u16 = 0x0120;

impl Bench<'_> {
    /// Whether a unit has not taken a request, or a fault of frames will end by itself.
    pub(crate) fn is_unsettled(&self) -> bool {
        let mut ends_by_itself = false;
        self.line.each_active(self.now, &mut |fault| ends_by_itself |= fault.until != Instant::NEVER);
        ends_by_itself || (0..self.count()).any(|at| self.has_request(at))
    }

    /// Whether a request for a state waits in AL control.
    fn has_request(&self, at: usize) -> bool {
        let (Some(device), Some(esc)) = (self.network.device(at), self.network.esc(at)) else { return false };
        let mut control = [0; 2];
        esc.look(AL_CONTROL, &mut control, self.now);
        let status = device.al_status();
        let requested = AlState::from_bits(u16::from_le_bytes(control));
        !device.is_off() && !status.error && requested != status.state
    }

    /// The number of frames after which all faults with a number of frames are over.
    pub(crate) fn frames_to_come(&self) -> u64 {
        let to_come = |choice: Choice, seen: u64| match choice {
            Choice::Next(count) => count.saturating_sub(seen),
            Choice::Behind { skip, count } => skip.saturating_add(count).saturating_sub(seen),
            Choice::All | Choice::Percent(_) | Choice::PerMille(_) | Choice::Every(_) => 0,
        };
        let mut most = 0;
        self.line.each_active(self.now, &mut |fault| {
            most = most.max(to_come(fault.disturbance.frames.choice, fault.frames_seen));
        });
        most
    }

    /// When the watchdogs that run now have expired.
    pub(crate) fn shows_until(&self) -> Instant {
        let deadlines = (0..self.count()).filter_map(|at| self.network.esc(at)).map(esc::Esc::deadline);
        deadlines.filter(|deadline| *deadline != Instant::NEVER).max().unwrap_or(self.now)
    }
}
