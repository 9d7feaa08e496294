//! How a slave deviates from fast and normal behaviour: transition times, refused states, ignored acknowledges.

use time::Duration;
use wire::{AlState, AlStatusCode};

use crate::state_machine::TRANSITIONS;

/// The conduct of a slave. The default is fast and normal.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Conduct {
    /// How long a request waits in AL control before the slave takes it.
    pub transition_times: TransitionTimes,
    /// The states that it refuses.
    pub refusals: Refusals,
    /// While it shows an error, a request with the acknowledge bit is ignored. A request for INIT without the
    /// bit is accepted.
    pub ignores_acknowledge: bool,
}

/// The time of each transition, one per row of [`TRANSITIONS`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TransitionTimes([Duration; TRANSITIONS.len()]);

impl TransitionTimes {
    /// The same time for every transition.
    #[must_use]
    pub const fn every(time: Duration) -> Self {
        Self([time; TRANSITIONS.len()])
    }

    /// Sets the time of the transition with these letters, such as `PS`; false if there is none.
    pub fn set(&mut self, letters: &str, time: Duration) -> bool {
        let row = TRANSITIONS.iter().position(|row| row.letters == letters);
        let place = row.and_then(|row| self.0.get_mut(row));
        place.map(|place| *place = time).is_some()
    }

    /// The time from one state to another; zero if this is not a transition.
    #[must_use]
    pub fn of(&self, from: AlState, to: AlState) -> Duration {
        let row = TRANSITIONS.iter().position(|row| row.from == from && row.to == to);
        row.and_then(|row| self.0.get(row)).copied().unwrap_or(Duration::ZERO)
    }
}

/// The AL status code with which each state is refused.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Refusals([Option<AlStatusCode>; AlState::ALL.len()]);

impl Refusals {
    /// Refuses `state` with this code, or accepts it again; false for a value that is not a state.
    pub fn set(&mut self, state: AlState, code: Option<AlStatusCode>) -> bool {
        let place = AlState::ALL.iter().position(|&known| known == state).and_then(|at| self.0.get_mut(at));
        place.map(|place| *place = code).is_some()
    }

    /// The code with which `state` is refused, if it is refused.
    #[must_use]
    pub fn of(&self, state: AlState) -> Option<AlStatusCode> {
        let at = AlState::ALL.iter().position(|&known| known == state)?;
        *self.0.get(at)?
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_transition_has_its_own_time() {
        let mut times = TransitionTimes::every(Duration::from_millis(1));
        assert!(times.set("PS", Duration::from_millis(7)));
        assert!(!times.set("PB", Duration::from_millis(7)), "no transition");
        for row in TRANSITIONS {
            let expected = if row.letters == "PS" { 7 } else { 1 };
            assert_eq!(times.of(row.from, row.to), Duration::from_millis(expected), "{}", row.letters);
        }
        assert_eq!(times.of(AlState::Init, AlState::Op), Duration::ZERO, "no transition");
    }

    #[test]
    fn each_state_has_its_own_refusal() {
        let mut refusals = Refusals::default();
        for (code, state) in (1..).map(AlStatusCode).zip(AlState::ALL) {
            assert!(refusals.set(state, Some(code)));
        }
        assert_eq!(
            AlState::ALL.map(|state| refusals.of(state).map(|code| code.0)),
            [1, 2, 3, 4, 5].map(Some)
        );
        assert!(!refusals.set(AlState::Other(5), Some(AlStatusCode(1))));
        assert!(refusals.set(AlState::Op, None) && refusals.of(AlState::Op).is_none());
    }
}
