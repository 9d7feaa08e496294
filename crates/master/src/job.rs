//! Jobs: the dialogues in a slave's queue, and their results.

use crate::access::{DATAGRAM_BYTES_MAX, Dialogue};
use crate::event::{Failure, Outcome};
use crate::mailbox::MailboxDialogue;
use crate::reaction::ServiceFailure;
use crate::register::{RegisterRead, RegisterWrite};
use crate::registers;
use crate::search::Search;
use crate::sii::SiiReader;
use crate::state::{AlReport, DeviceIdRequest, StateRequest};

/// A dialogue in a queue.
#[derive(Clone, Debug)]
pub(crate) enum Job {
    Read(RegisterRead),
    Write(RegisterWrite),
    State(StateRequest),
    DeviceId(DeviceIdRequest),
    Sii(Box<SiiReader>),
    Search(Search),
    Mailbox(Box<MailboxDialogue>),
}

impl Job {
    pub(crate) const fn read_al_status() -> Self {
        Self::read(registers::AL_STATUS, AlReport::LENGTH_BYTES)
    }

    pub(crate) fn mailbox(dialogue: MailboxDialogue) -> Self {
        Self::Mailbox(Box::new(dialogue))
    }

    pub(crate) const fn read(offset: u16, length_bytes: u16) -> Self {
        Self::Read(RegisterRead::new(offset, length_bytes))
    }

    pub(crate) fn write(offset: u16, data: &[u8]) -> Self {
        Self::Write(RegisterWrite::new(offset, data.to_vec()))
    }

    pub(crate) fn dialogue(&self) -> &dyn Dialogue {
        match self {
            Self::Read(read) => read,
            Self::Write(write) => write,
            Self::State(request) => request,
            Self::DeviceId(request) => request,
            Self::Sii(reader) => &**reader,
            Self::Search(search) => search,
            Self::Mailbox(mailbox) => &**mailbox,
        }
    }

    pub(crate) fn dialogue_mut(&mut self) -> &mut dyn Dialogue {
        match self {
            Self::Read(read) => read,
            Self::Write(write) => write,
            Self::State(request) => request,
            Self::DeviceId(request) => request,
            Self::Sii(reader) => &mut **reader,
            Self::Search(search) => search,
            Self::Mailbox(mailbox) => &mut **mailbox,
        }
    }

    /// Number of data bytes of its longest access, as far as it is known. A mailbox is written and read as a whole.
    fn longest_access_bytes(&self) -> usize {
        match self {
            Self::Mailbox(mailbox) => mailbox.longest_access_bytes(),
            _ => self.dialogue().access().length_bytes(),
        }
    }

    /// Whether each of its accesses fits into a datagram.
    pub(crate) fn fits(&self) -> bool {
        self.longest_access_bytes() <= DATAGRAM_BYTES_MAX
    }

    /// Its result when it is done.
    pub(crate) fn result(self) -> Result<Outcome, Failure> {
        match self {
            Self::Read(read) => Ok(Outcome::Data(read.into_data())),
            Self::Write(_) => Ok(Outcome::Done),
            Self::State(request) if request.is_reached() => Ok(Outcome::State(request.report())),
            Self::State(request) => Err(Failure::Refused(request.report())),
            Self::DeviceId(request) => {
                request.id().map(Outcome::DeviceId).ok_or(Failure::Refused(request.report()))
            }
            Self::Sii(reader) => match reader.into_result() {
                Some(Ok(contents)) => Ok(Outcome::Sii(Box::new(contents))),
                Some(Err(failure)) => Err(Failure::Sii(failure)),
                None => Err(Failure::NoAnswer),
            },
            Self::Search(search) => Ok(Outcome::Found(search.found())),
            Self::Mailbox(mailbox) => {
                mailbox.into_service().into_result().map(Outcome::Data).map_err(Failure::Mailbox)
            }
        }
    }

    /// Its result when it has waited for too long, or cannot be sent.
    pub(crate) fn failure(&self) -> Failure {
        match self {
            _ if !self.fits() => Failure::TooLong { length_bytes: self.longest_access_bytes() },
            Self::Read(_) | Self::Write(_) | Self::Search(_) => Failure::NoAnswer,
            Self::State(request) if request.is_taken() => Failure::NotReached(request.report()),
            Self::State(_) => Failure::NoAnswer,
            Self::DeviceId(request) => Failure::NotReached(request.report()),
            Self::Sii(_) => Failure::SiiBusy,
            Self::Mailbox(mailbox) if mailbox.is_taken() => Failure::Mailbox(ServiceFailure::NoReply),
            Self::Mailbox(_) => Failure::Mailbox(ServiceFailure::NotTaken),
        }
    }
}
