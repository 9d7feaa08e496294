//! Requests for states.

use wire::AlState;

use super::reach::Reach;

/// Units get a request for a state.
pub(super) struct Request<'a> {
    pub(super) reach: Reach<'a>,
    pub(super) state: AlState,
    pub(super) acknowledges: bool,
}
