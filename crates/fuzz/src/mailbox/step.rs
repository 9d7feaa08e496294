//! The steps of an input and their notation.
//!
//! ```text
//! unit nx 400 400             the objects, nx or small, and the lengths of the mailboxes in bytes
//! state op                    init, preop, boot, safeop or op
//! send 0A000000000320…        a message in hexadecimal digits
//! fetch                       what the unit has to send without a further request
//! read                        the master has read its mailbox
//! repeat                      it asks for the last message again
//! emergency                   the unit queues an emergency message
//! reset                       as at INIT to PRE-OP
//! ```

use std::fmt;
use std::str::FromStr;

use mailbox::MailboxSizes;
use wire::AlState;

use crate::hex::{Hex, hex};

/// A step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Step {
    Unit { model: Model, receive_bytes: u16, send_bytes: u16 },
    State(AlState),
    Send(Vec<u8>),
    Fetch,
    Read,
    Repeat,
    Emergency,
    Reset,
}

/// The objects of the unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Model {
    /// Those of an NX-ECT101.
    Nx,
    /// A few of every kind.
    Small,
}

pub(super) const STATES: [(&str, AlState); 5] = [
    ("init", AlState::Init),
    ("preop", AlState::PreOp),
    ("boot", AlState::Boot),
    ("safeop", AlState::SafeOp),
    ("op", AlState::Op),
];

impl fmt::Display for Step {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unit { model, receive_bytes, send_bytes } => {
                let model = if *model == Model::Nx { "nx" } else { "small" };
                write!(formatter, "unit {model} {receive_bytes} {send_bytes}")
            }
            Self::State(state) => {
                let name = STATES.iter().find(|(_, known)| known == state).map_or("init", |(name, _)| name);
                write!(formatter, "state {name}")
            }
            Self::Send(bytes) => write!(formatter, "send {}", Hex(bytes)),
            Self::Fetch => formatter.write_str("fetch"),
            Self::Read => formatter.write_str("read"),
            Self::Repeat => formatter.write_str("repeat"),
            Self::Emergency => formatter.write_str("emergency"),
            Self::Reset => formatter.write_str("reset"),
        }
    }
}

/// A line that is not a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct NoStep;

impl FromStr for Step {
    type Err = NoStep;

    fn from_str(line: &str) -> Result<Self, NoStep> {
        read(line.trim()).ok_or(NoStep)
    }
}

fn read(line: &str) -> Option<Step> {
    let (word, rest) = line.split_once(' ').unwrap_or((line, ""));
    Some(match word {
        "unit" => {
            let mut words = rest.split(' ');
            let model = match words.next()? {
                "nx" => Model::Nx,
                "small" => Model::Small,
                _ => return None,
            };
            let legal = MailboxSizes::MIN_BYTES..=MailboxSizes::MAX_BYTES;
            let mut bytes = || words.next()?.parse().ok().filter(|bytes| legal.contains(bytes));
            Step::Unit { model, receive_bytes: bytes()?, send_bytes: bytes()? }
        }
        "state" => Step::State(STATES.iter().find(|(name, _)| *name == rest)?.1),
        "send" => Step::Send(hex(rest)?),
        "fetch" => Step::Fetch,
        "read" => Step::Read,
        "repeat" => Step::Repeat,
        "emergency" => Step::Emergency,
        "reset" => Step::Reset,
        _ => return None,
    })
}
