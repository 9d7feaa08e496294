//! The state machine from the master's side: requests, acknowledges, the Explicit Device ID.

use core::fmt;

use wire::{AlControl, AlState, AlStatus, AlStatusCode};

use crate::access::{Access, Answer, Dialogue, Patience, Progress, Wait, word};
use crate::registers;

/// AL status and AL status code, from one read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct AlReport {
    /// The actual state, and whether an error is indicated.
    pub status: AlStatus,
    /// The error; the Explicit Device ID if that was requested.
    pub code: AlStatusCode,
}

impl AlReport {
    /// Bytes from AL status to the end of the AL status code.
    pub const LENGTH_BYTES: u16 = 6;

    /// Nothing has been read yet.
    pub(crate) const NOTHING: Self = Self {
        status: AlStatus { state: AlState::Other(0), error: false, device_id_loaded: false },
        code: AlStatusCode::NO_ERROR,
    };

    /// Whether it shows one of the standard's states, and no error.
    #[must_use]
    pub const fn is_good(self) -> bool {
        !self.status.error && !matches!(self.status.state, AlState::Other(_))
    }

    /// The result of a read of 6 bytes from 0x0130; for 2 bytes the code is 0.
    #[must_use]
    pub fn parse(bytes: &[u8]) -> Self {
        let code = bytes.get(4..).map_or(0, word);
        Self { status: AlStatus::from_bits(word(bytes)), code: AlStatusCode(code) }
    }
}

impl fmt::Display for AlReport {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.status.fmt(formatter)?;
        if self.status.error { write!(formatter, ", AL status code {}", self.code) } else { Ok(()) }
    }
}

const READ_AL_STATUS: Access<'static> =
    Access::Read { offset: registers::AL_STATUS, length_bytes: AlReport::LENGTH_BYTES };

/// Writes AL control until a slave accepts it.
#[derive(Clone, Copy, Debug)]
struct Request {
    bits: [u8; 2],
    /// It was sent without an answer: if no slave accepts the next one, the slave has this one.
    may_be_taken: bool,
}

impl Request {
    const fn new(control: AlControl) -> Self {
        Self { bits: control.bits().to_le_bytes(), may_be_taken: false }
    }

    const fn access(&self) -> Access<'_> {
        Access::Write { offset: registers::AL_CONTROL, data: &self.bits }
    }

    /// Whether the slave has the request; otherwise how to continue.
    fn answer(&mut self, answer: Option<Answer<'_>>) -> Result<(), Progress> {
        match answer {
            None => {
                self.may_be_taken = true;
                Err(Progress::Next)
            }
            Some(Answer { working_counter: 0, .. }) if !self.may_be_taken => Err(Progress::Later),
            Some(_) => Ok(()),
        }
    }
}

/// Requests a state and waits until AL status shows it. An error that AL status shows then is a refusal, except
/// after a request that acknowledges: the slave may not have seen that yet.
#[derive(Clone, Debug)]
pub struct StateRequest {
    control: AlControl,
    wait: Wait,
    /// Until it is accepted.
    request: Option<Request>,
    report: AlReport,
}

impl StateRequest {
    /// Requests `state`; the time-out is that of this transition.
    #[must_use]
    pub const fn new(state: AlState, wait: Wait) -> Self {
        let control = AlControl { state, acknowledge: false, device_id_request: false, reserved: 0 };
        Self::of(control, wait, AlReport::NOTHING)
    }

    /// Acknowledges the error in `shown`, in the state in `shown`.
    #[must_use]
    pub const fn acknowledge(shown: AlReport) -> Self {
        let state = shown.status.state;
        let control = AlControl { state, acknowledge: true, device_id_request: false, reserved: 0 };
        Self::of(control, Wait::BackToInit, shown)
    }

    /// Requests `state`, which is usually INIT, and acknowledges any error.
    #[must_use]
    pub const fn reset(state: AlState) -> Self {
        let control = AlControl { state, acknowledge: true, device_id_request: false, reserved: 0 };
        Self::of(control, Wait::BackToInit, AlReport::NOTHING)
    }

    const fn of(control: AlControl, wait: Wait, report: AlReport) -> Self {
        Self { control, wait, request: Some(Request::new(control)), report }
    }

    /// The requested state.
    #[must_use]
    pub const fn state(&self) -> AlState {
        self.control.state
    }

    /// AL status as last read.
    #[must_use]
    pub const fn report(&self) -> AlReport {
        self.report
    }

    /// Whether the slave has accepted the request, or may have.
    #[must_use]
    pub const fn is_taken(&self) -> bool {
        self.request.is_none()
    }

    /// Whether the state is reached, without an error.
    #[must_use]
    pub fn is_reached(&self) -> bool {
        self.report.status.state == self.control.state && !self.report.status.error
    }

    fn watch(&mut self, data: &[u8]) -> Progress {
        self.report = AlReport::parse(data);
        let is_refused = self.report.status.error && !self.control.acknowledge;
        if self.is_reached() || is_refused { Progress::Done } else { Progress::Later }
    }
}

impl Dialogue for StateRequest {
    fn access(&self) -> Access<'_> {
        self.request.as_ref().map_or(READ_AL_STATUS, Request::access)
    }

    fn answer(&mut self, answer: Option<Answer<'_>>) -> Progress {
        if let Some(request) = &mut self.request {
            return match request.answer(answer) {
                Ok(()) => {
                    self.request = None;
                    Progress::NextStage
                }
                Err(progress) => progress,
            };
        }
        let Some(answer) = answer else { return Progress::Next };
        answer.taken().map_or(Progress::Later, |data| self.watch(data))
    }

    /// A slow slave keeps the previous request until it has executed it.
    fn patience(&self) -> Patience {
        Patience::State(self.wait)
    }
}

/// Requests the Explicit Device ID of a slave, and then clears the request.
#[derive(Clone, Debug)]
pub struct DeviceIdRequest {
    state: AlState,
    request: Option<Request>,
    id: Option<u16>,
    report: AlReport,
}

impl DeviceIdRequest {
    /// A request to a slave in `state`, without an error.
    #[must_use]
    pub const fn new(state: AlState) -> Self {
        let report = AlReport {
            status: AlStatus { state, error: false, device_id_loaded: false },
            code: AlStatusCode::NO_ERROR,
        };
        Self { state, request: Some(Request::new(Self::control(state, true))), id: None, report }
    }

    /// The ID; none if the slave shows an error instead, or before it is done.
    #[must_use]
    pub const fn id(&self) -> Option<u16> {
        self.id
    }

    /// AL status as last read.
    #[must_use]
    pub const fn report(&self) -> AlReport {
        self.report
    }

    const fn control(state: AlState, device_id_request: bool) -> AlControl {
        AlControl { state, acknowledge: false, device_id_request, reserved: 0 }
    }

    fn watch(&mut self, data: &[u8]) -> Progress {
        self.report = AlReport::parse(data);
        let AlStatus { error, device_id_loaded, .. } = self.report.status;
        match (self.id, device_id_loaded) {
            _ if error => Progress::Done,
            (None, true) => {
                self.id = Some(self.report.code.0);
                self.request = Some(Request::new(Self::control(self.state, false)));
                Progress::NextStage
            }
            (Some(_), false) => Progress::Done,
            (None, false) | (Some(_), true) => Progress::Later,
        }
    }
}

impl Dialogue for DeviceIdRequest {
    fn access(&self) -> Access<'_> {
        self.request.as_ref().map_or(READ_AL_STATUS, Request::access)
    }

    fn answer(&mut self, answer: Option<Answer<'_>>) -> Progress {
        if let Some(request) = &mut self.request {
            return match request.answer(answer) {
                Ok(()) => {
                    self.request = None;
                    Progress::Next
                }
                Err(progress) => progress,
            };
        }
        let Some(answer) = answer else { return Progress::Next };
        answer.taken().map_or(Progress::Later, |data| self.watch(data))
    }

    fn patience(&self) -> Patience {
        Patience::Access
    }
}
