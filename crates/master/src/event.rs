//! The events that a master reports, and the results of orders.

use core::fmt;

use esi::sii::SiiContents;

use wire::Emergency;

use crate::access::DATAGRAM_BYTES_MAX;
use crate::reaction::ServiceFailure;
use crate::sii::SiiFailure;
use crate::state::AlReport;

/// An order of the caller. The events of its parts carry it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct RequestId(pub(crate) u64);

/// An event.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    /// The part of an order that concerns one slave, or all of them together, is complete.
    Finished {
        /// The order.
        request: RequestId,
        /// The slave's position; none for all.
        slave: Option<usize>,
        /// Its result.
        result: Result<Outcome, Failure>,
    },
    /// A slave has sent an emergency.
    Emergency {
        /// The slave's position.
        slave: usize,
        /// The message.
        emergency: Emergency,
    },
}

/// The result of a successful order.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// It is done, without a value.
    Done,
    /// This many slaves were found.
    Found(u16),
    /// The data read: memory, the value of an SDO, the reply to a message. Empty after a write by mailbox.
    Data(Vec<u8>),
    /// The returned datagram.
    Datagram {
        /// Its working counter.
        working_counter: u16,
        /// Its data.
        data: Vec<u8>,
    },
    /// AL status after the request.
    State(AlReport),
    /// The Explicit Device ID.
    DeviceId(u16),
    /// The contents of the SII.
    Sii(Box<SiiContents>),
}

/// Why an order failed.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// There is no such slave.
    NoSlave,
    /// More bytes than one datagram can carry, which are 1,486.
    TooLong {
        /// Their number.
        length_bytes: usize,
    },
    /// An area of process data is longer than an FMMU can map, which is 65,535 bytes.
    AreaTooLong {
        /// Its length.
        length_bytes: usize,
    },
    /// The frame did not return.
    Lost,
    /// The slave does not accept the access.
    NoAnswer,
    /// The SII was busy for too long.
    SiiBusy,
    /// The SII cannot be read.
    Sii(SiiFailure),
    /// The slave refuses the state, or has left it; the AL status that it shows.
    Refused(AlReport),
    /// The state was not reached in time; the AL status that the slave shows.
    NotReached(AlReport),
    /// A mailbox service failed.
    Mailbox(ServiceFailure),
}

impl fmt::Display for Failure {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSlave => formatter.write_str("there is no such slave"),
            Self::TooLong { length_bytes } => {
                write!(formatter, "{length_bytes} bytes in one datagram, {DATAGRAM_BYTES_MAX} at most")
            }
            Self::AreaTooLong { length_bytes } => {
                write!(formatter, "{length_bytes} bytes of process data for one FMMU, {} at most", u16::MAX)
            }
            Self::Lost => formatter.write_str("the frame did not return"),
            Self::NoAnswer => formatter.write_str("the slave does not accept the access"),
            Self::SiiBusy => formatter.write_str("the SII is busy for too long"),
            Self::Sii(failure) => failure.fmt(formatter),
            Self::Refused(report) => write!(formatter, "the slave refuses the state: {report}"),
            Self::NotReached(report) => write!(formatter, "the state is not reached in time: {report}"),
            Self::Mailbox(failure) => failure.fmt(formatter),
        }
    }
}

impl core::error::Error for Failure {}
