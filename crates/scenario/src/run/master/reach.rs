//! Waiting for a state, until the unit refuses it or falls back.

use ::master::{Access, AlReport, Answer, Dialogue, Patience, Progress, StateRequest};
use wire::AlState;

use crate::model::StateName;

/// States on the way up, the lowest first.
pub(super) const WAY_UP: [AlState; 4] = [AlState::Init, AlState::PreOp, AlState::SafeOp, AlState::Op];

/// Requests a state and waits for it; meanwhile the unit must not be in a state below `lowest`.
#[derive(Clone, Debug)]
pub(super) struct Reach {
    request: StateRequest,
    lowest: AlState,
}

impl Reach {
    pub(super) const fn new(request: StateRequest, lowest: AlState) -> Self {
        Self { request, lowest }
    }

    /// The requested state.
    pub(super) const fn state(&self) -> AlState {
        self.request.state()
    }

    /// Why it cannot succeed any more: an error indication is a refusal, and a state below the lowest one shows
    /// that the unit has fallen back, for example after a power cycle.
    pub(super) fn refusal(&self) -> Option<String> {
        let AlReport { status, code } = self.request.report();
        let fell_back = is_below(status.state, self.lowest);
        if !status.error && !fell_back {
            return None;
        }
        let (shown, wanted) = (StateName(status.state), StateName(self.state()));
        let verb = if fell_back { "fell back to" } else { "stays in" };
        let code = if status.error { format!(" with {:#06X}", code.0) } else { String::new() };
        Some(format!("{verb} {shown}{code}, asked for {wanted}"))
    }
}

impl Dialogue for Reach {
    fn access(&self) -> Access<'_> {
        self.request.access()
    }

    /// It ends with a refusal, too.
    fn answer(&mut self, answer: Option<Answer<'_>>) -> Progress {
        match self.request.answer(answer) {
            Progress::Later if self.refusal().is_some() => Progress::Done,
            progress => progress,
        }
    }

    fn patience(&self) -> Patience {
        self.request.patience()
    }
}

/// The level of a state; none for BOOT and for a value that is not a state.
pub(super) fn floor(state: AlState) -> Option<usize> {
    WAY_UP.iter().position(|&step| step == state)
}

fn is_below(state: AlState, other: AlState) -> bool {
    floor(state).zip(floor(other)).is_some_and(|(state, other)| state < other)
}
