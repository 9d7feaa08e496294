//! The state of a slave's state machine: the states with their data, and what AL status shows.

use time::Instant;
use wire::{AlControl, AlState, AlStatus, AlStatusCode};

use crate::sync_mode::SyncMode;

/// The state of a slave, its indication, and the request that waits in AL control.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Machine {
    pub(crate) state: State,
    pub(crate) indication: Indication,
    /// The time at which the request in AL control is taken.
    pub(crate) request_due: Option<Instant>,
}

impl Machine {
    /// INIT without an error.
    pub(crate) const START: Self =
        Self { state: State::Init { fault: None }, indication: Indication::Nothing, request_due: None };

    pub(crate) const fn status(&self) -> AlStatus {
        AlStatus {
            state: self.state.al_state(),
            error: matches!(self.indication, Indication::Error(_)),
            device_id_loaded: matches!(self.indication, Indication::DeviceId(_)),
        }
    }

    pub(crate) const fn code(&self) -> AlStatusCode {
        match self.indication {
            Indication::Nothing => AlStatusCode::NO_ERROR,
            Indication::DeviceId(id) => AlStatusCode(id),
            Indication::Error(code) => code,
        }
    }
}

/// A state of the EtherCAT state machine.
#[derive(Clone, Copy, Debug)]
pub(crate) enum State {
    Init {
        /// A fault of the unit keeps the slave here; every request is refused with this code.
        fault: Option<AlStatusCode>,
    },
    PreOp,
    Boot,
    SafeOp {
        process_data: ProcessData,
        /// A request for OP waits for outputs.
        op_request: Option<OpRequest>,
    },
    Op {
        process_data: ProcessData,
    },
}

impl State {
    pub(crate) const fn al_state(self) -> AlState {
        match self {
            Self::Init { .. } => AlState::Init,
            Self::PreOp => AlState::PreOp,
            Self::Boot => AlState::Boot,
            Self::SafeOp { .. } => AlState::SafeOp,
            Self::Op { .. } => AlState::Op,
        }
    }

    /// The process data in SAFE-OP and OP.
    pub(crate) const fn process_data(self) -> Option<ProcessData> {
        match self {
            Self::Init { .. } | Self::PreOp | Self::Boot => None,
            Self::SafeOp { process_data, .. } | Self::Op { process_data } => Some(process_data),
        }
    }

    pub(crate) const fn process_data_mut(&mut self) -> Option<&mut ProcessData> {
        match self {
            Self::Init { .. } | Self::PreOp | Self::Boot => None,
            Self::SafeOp { process_data, .. } | Self::Op { process_data } => Some(process_data),
        }
    }

    pub(crate) const fn op_request(self) -> Option<OpRequest> {
        match self {
            Self::SafeOp { op_request, .. } => op_request,
            Self::Init { .. } | Self::PreOp | Self::Boot | Self::Op { .. } => None,
        }
    }

    /// Removes and returns the waiting request for OP.
    pub(crate) const fn take_op_request(&mut self) -> Option<OpRequest> {
        match self {
            Self::SafeOp { op_request, .. } => op_request.take(),
            Self::Init { .. } | Self::PreOp | Self::Boot | Self::Op { .. } => None,
        }
    }
}

/// The exchange of process data since the slave left PRE-OP.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ProcessData {
    pub(crate) sync_mode: SyncMode,
    /// Outputs have been received: OP monitors them from its start.
    pub(crate) outputs_came: bool,
}

/// A request for OP that waits for outputs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OpRequest {
    pub(crate) control: AlControl,
    /// Without outputs it is refused at this time.
    pub(crate) deadline: Instant,
}

/// What AL status and AL status code show in addition to the state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Indication {
    Nothing,
    /// The Explicit Device ID that the master has requested.
    DeviceId(u16),
    /// An error, until it is acknowledged.
    Error(AlStatusCode),
}

impl Indication {
    /// Without a code there is no error indication.
    pub(crate) const fn error(code: AlStatusCode) -> Self {
        match code {
            AlStatusCode::NO_ERROR => Self::Nothing,
            code => Self::Error(code),
        }
    }
}
