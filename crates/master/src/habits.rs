//! Habits: the choices in which real masters differ.

use esi::Timeouts;
use time::Duration;

use crate::access::{Address, Patience, Wait};
use crate::mailbox::MailboxConduct;
use crate::process_data::Exchange;

/// The habits of a master. The default has long time-outs and fills its frames.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Habits {
    /// How slaves are addressed.
    pub addressing: Addressing,
    /// Maximum number of datagrams in one frame, in addition to those of process data. At least 1.
    pub datagrams_max: usize,
    /// The contents of the index field of datagrams.
    pub indexes: Indexes,
    /// Time-out for an answer; then the frame counts as lost. At least [`Habits::PERIOD_MIN`].
    pub answer_patience: Duration,
    /// Time between two reads of a status. At least [`Habits::PERIOD_MIN`].
    pub poll_period: Duration,
    /// Time-outs of dialogues.
    pub time_outs: TimeOuts,
    /// Time between two reads of a mailbox for emergencies, at least [`Habits::PERIOD_MIN`]; none: it reads the
    /// mailbox only after a request.
    pub listen_period: Option<Duration>,
    /// The initial handling of mailboxes.
    pub mailbox: MailboxConduct,
    /// The initial settings for the exchange of process data.
    pub exchange: Exchange,
}

/// How slaves are addressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Addressing {
    /// By position: APRD, APWR.
    Position,
    /// By station addresses, which count up from this one: FPRD, FPWR.
    Station {
        /// Address of the first slave.
        first: u16,
    },
}

impl Addressing {
    /// The address of the slave at a position when it has been identified.
    #[must_use]
    pub const fn of(self, position: u16) -> Address {
        match self {
            Self::Position => Address::Position(position),
            Self::Station { first } => Address::Station(first.wrapping_add(position)),
        }
    }
}

/// The time-outs of dialogues, and what restarts them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TimeOuts {
    /// Restarted at each stage of a dialogue, by what it waits for then. Those of states and mailbox are the slave's.
    EachStage {
        /// For an access that no slave accepts or answers.
        access: Duration,
        /// For one command of the SII.
        sii: Duration,
    },
    /// Fixed for the whole dialogue.
    WholeDialogue {
        /// For a dialogue that requests a state.
        state: Duration,
        /// For every other one.
        other: Duration,
    },
}

impl Default for TimeOuts {
    fn default() -> Self {
        Self::EachStage { access: Duration::from_secs(1), sii: Duration::from_millis(500) }
    }
}

/// The contents of the index field of datagrams.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Indexes {
    /// They count on from frame to frame, so that an answer is identified by its first index.
    Running,
    /// They count from 0 in each frame.
    FromZero,
}

impl Default for Habits {
    fn default() -> Self {
        Self {
            addressing: Addressing::Station { first: 0x1001 },
            datagrams_max: 15,
            indexes: Indexes::Running,
            answer_patience: Duration::from_millis(20),
            poll_period: Duration::from_micros(500),
            time_outs: TimeOuts::default(),
            listen_period: Some(Duration::from_millis(10)),
            mailbox: MailboxConduct::default(),
            exchange: Exchange::default(),
        }
    }
}

impl Habits {
    /// The shortest period and time-out: a master that repeats an access without any time in between would never come
    /// to an end in virtual time.
    pub const PERIOD_MIN: Duration = Duration::from_micros(1);

    /// The same with periods and time-outs of at least [`Habits::PERIOD_MIN`].
    pub(crate) fn that_take_time(self) -> Self {
        let long_enough = |period: Duration| period.max(Self::PERIOD_MIN);
        Self {
            answer_patience: long_enough(self.answer_patience),
            poll_period: long_enough(self.poll_period),
            listen_period: self.listen_period.map(long_enough),
            ..self
        }
    }

    /// Time-out of a dialogue that waits for this, for a slave with these time-outs.
    #[must_use]
    pub const fn patience(&self, patience: Patience, timeouts: &Timeouts) -> Duration {
        match (self.time_outs, patience) {
            (TimeOuts::WholeDialogue { state, .. }, Patience::State(_)) => state,
            (TimeOuts::WholeDialogue { other, .. }, _) => other,
            (TimeOuts::EachStage { access, .. }, Patience::Access) => access,
            (TimeOuts::EachStage { sii, .. }, Patience::Sii) => sii,
            (TimeOuts::EachStage { .. }, Patience::State(wait)) => Duration::from_millis(match wait {
                Wait::PreOp => timeouts.pre_op_ms as u64,
                Wait::SafeOpOp => timeouts.safe_op_op_ms as u64,
                Wait::BackToInit => timeouts.back_to_init_ms as u64,
                Wait::BackToSafeOp => timeouts.back_to_safe_op_ms as u64,
            }),
            (TimeOuts::EachStage { .. }, Patience::MailboxRequest) => {
                Duration::from_millis(timeouts.mailbox_request_ms as u64)
            }
            (TimeOuts::EachStage { .. }, Patience::MailboxResponse) => {
                Duration::from_millis(timeouts.mailbox_response_ms as u64)
            }
        }
    }
}
