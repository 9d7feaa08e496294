//! Habits: the choices in which real masters differ.

use esi::Timeouts;
use time::Duration;

use crate::access::{Address, Patience, Wait};
use crate::mailbox::MailboxConduct;
use crate::process_data::Exchange;

/// The habits of a master. The default is a patient one that fills its frames.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Habits {
    /// How slaves are addressed.
    pub addressing: Addressing,
    /// Most datagrams of one frame, beside those of process data. At least 1.
    pub datagrams_max: usize,
    /// What is in the index field of datagrams.
    pub indexes: Indexes,
    /// How long an answer may take before the frame counts as lost.
    pub answer_patience: Duration,
    /// From one look at a status to the next.
    pub poll_period: Duration,
    /// How long a slave may leave accesses alone: a write that nobody takes, a read that nobody answers.
    pub access_patience: Duration,
    /// How long one command of the SII may take.
    pub sii_patience: Duration,
    /// From one look into a mailbox, for emergencies, to the next one; none: it never looks unasked.
    pub listen_period: Option<Duration>,
    /// How mailboxes are treated at first.
    pub mailbox: MailboxConduct,
    /// How process data are exchanged at first.
    pub exchange: Exchange,
}

/// How slaves are addressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Addressing {
    /// By position: APRD, APWR.
    Position,
    /// By station addresses, which count from this one on: FPRD, FPWR.
    Station {
        /// Of the first slave.
        first: u16,
    },
}

impl Addressing {
    /// How the slave at a position is addressed when it was identified.
    #[must_use]
    pub const fn of(self, position: u16) -> Address {
        match self {
            Self::Position => Address::Position(position),
            Self::Station { first } => Address::Station(first.wrapping_add(position)),
        }
    }
}

/// What is in the index field of datagrams.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Indexes {
    /// They count on from frame to frame, so that an answer is known by its first index.
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
            access_patience: Duration::from_secs(1),
            sii_patience: Duration::from_millis(500),
            listen_period: Some(Duration::from_millis(10)),
            mailbox: MailboxConduct::default(),
            exchange: Exchange::default(),
        }
    }
}

impl Habits {
    /// How long a dialogue may wait for this; a state and a mailbox as long as the device says.
    pub(crate) const fn patience(&self, patience: Patience, timeouts: &Timeouts) -> Duration {
        match patience {
            Patience::Access => self.access_patience,
            Patience::Sii => self.sii_patience,
            Patience::State(wait) => Duration::from_millis(match wait {
                Wait::PreOp => timeouts.pre_op_ms as u64,
                Wait::SafeOpOp => timeouts.safe_op_op_ms as u64,
                Wait::BackToInit => timeouts.back_to_init_ms as u64,
                Wait::BackToSafeOp => timeouts.back_to_safe_op_ms as u64,
            }),
            Patience::MailboxRequest => Duration::from_millis(timeouts.mailbox_request_ms as u64),
            Patience::MailboxResponse => Duration::from_millis(timeouts.mailbox_response_ms as u64),
        }
    }
}
