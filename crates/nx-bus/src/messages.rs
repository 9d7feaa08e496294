//! NX messages: the requests with which the CPU Unit reads and writes objects of the unit, and their responses.
//!
//! Two bounded queues between two threads; neither end ever waits. The unit answers when it refreshes. It
//! publishes its image before it sends the responses, and the CPU Unit takes responses before it takes the
//! image: so no flag that a user program sees is older than a response that it has received.

use core::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, TryRecvError, TrySendError, sync_channel};

use arrayvec::ArrayVec;
use wire::{ObjectIndex, SdoAbort, SubIndex};

/// Maximum number of requests that wait for their responses.
pub const REQUESTS_MAX: usize = 8;

/// Length of the longest NX object in bytes.
pub const VALUE_BYTES_MAX: usize = 200;

/// The value of an NX object, little endian.
pub type NxValue = ArrayVec<u8, VALUE_BYTES_MAX>;

/// A request of the CPU Unit for an object.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NxRequest {
    /// Returned with the response.
    pub number: u32,
    /// Index of the NX object.
    pub index: ObjectIndex,
    /// Its subindex.
    pub sub: SubIndex,
    /// The value to write; none: the object is read.
    pub value: Option<NxValue>,
}

/// The answer of the unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NxResponse {
    /// The number of the request.
    pub number: u32,
    /// The value that was read, empty after a write; or the error.
    pub result: Result<NxValue, NxMessageError>,
}

/// Why a request is refused. The manual does not define numbers for these errors, so there are none here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NxMessageError {
    /// The unit has no such object.
    ObjectDoesNotExist,
    /// The object has no such subindex.
    SubindexDoesNotExist,
    /// Objects that accept I/O allocations are not accessible by message (manual, A-7-3).
    NotAccessibleByMessage,
    /// The object cannot be written.
    ReadOnly,
    /// The value has another length than the object.
    LengthMismatch {
        /// Length of the object in bytes.
        expected_bytes: usize,
    },
    /// The master has not read the last message, which is kept (manual, A-5-3).
    NotReady,
    /// The unit has no power, or it starts.
    NotReachable,
}

impl NxMessageError {
    /// The SDO abort code with which a CoE object reports the same to a master.
    #[must_use]
    pub const fn sdo_abort(self) -> SdoAbort {
        match self {
            Self::ObjectDoesNotExist => SdoAbort::OBJECT_DOES_NOT_EXIST,
            Self::SubindexDoesNotExist => SdoAbort::SUBINDEX_DOES_NOT_EXIST,
            Self::NotAccessibleByMessage => SdoAbort::UNSUPPORTED_ACCESS,
            Self::ReadOnly => SdoAbort::READ_ONLY,
            Self::LengthMismatch { .. } => SdoAbort::LENGTH_MISMATCH,
            Self::NotReady => SdoAbort::LOCAL_CONTROL,
            Self::NotReachable => SdoAbort::GENERAL,
        }
    }
}

impl fmt::Display for NxMessageError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::ObjectDoesNotExist => "the object does not exist",
            Self::SubindexDoesNotExist => "the subindex does not exist",
            Self::NotAccessibleByMessage => "the object is accessible by I/O allocation only",
            Self::ReadOnly => "the object is read-only",
            Self::LengthMismatch { expected_bytes } => {
                return write!(formatter, "the object has {expected_bytes} bytes");
            }
            Self::NotReady => "the last message has not been read yet",
            Self::NotReachable => "the unit does not answer",
        })
    }
}

impl core::error::Error for NxMessageError {}

/// Why a request was not sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotSent {
    /// Too many are already waiting; it can be sent later.
    Full,
    /// The unit no longer exists.
    NotReachable,
}

/// What each end may know of the other without a look into a queue, which costs much more.
#[derive(Debug, Default)]
struct Signals {
    /// There may be requests.
    requests: AtomicBool,
    /// There may be responses, or the unit no longer exists.
    responses: AtomicBool,
    /// A request was given up.
    discarded: AtomicBool,
}

/// The CPU Unit's end: it sends requests.
#[derive(Debug)]
pub struct CpuMessages {
    requests: SyncSender<NxRequest>,
    responses: Receiver<NxResponse>,
    signals: Arc<Signals>,
}

impl CpuMessages {
    /// Sends a request, without waiting.
    ///
    /// # Errors
    /// [`REQUESTS_MAX`] requests wait, or the unit no longer exists.
    pub fn send(&mut self, request: NxRequest) -> Result<(), NotSent> {
        self.requests.try_send(request).map_err(|error| match error {
            TrySendError::Full(_) => NotSent::Full,
            TrySendError::Disconnected(_) => NotSent::NotReachable,
        })?;
        // Release: who sees it also finds the request.
        self.signals.requests.store(true, Ordering::Release);
        Ok(())
    }

    /// A request for which there was no room is not sent again: the unit detects this.
    pub fn discard(&mut self) {
        // Only a flag: no other data depend on it.
        self.signals.discarded.store(true, Ordering::Relaxed);
    }

    /// The next response received; none if there is none yet.
    ///
    /// # Errors
    /// [`NxMessageError::NotReachable`] if the unit no longer exists and there are no further responses.
    pub fn receive(&mut self) -> Result<Option<NxResponse>, NxMessageError> {
        let signal = &self.signals.responses;
        if !is_given(signal) {
            return Ok(None);
        }
        let received = match self.responses.try_recv() {
            Ok(response) => Ok(Some(response)),
            Err(TryRecvError::Empty) => return Ok(None),
            Err(TryRecvError::Disconnected) => Err(NxMessageError::NotReachable),
        };
        look_again(signal);
        received
    }
}

/// The unit's end: it answers.
#[derive(Debug)]
pub struct UnitMessages {
    requests: Receiver<NxRequest>,
    responses: SyncSender<NxResponse>,
    /// Responses that must not be visible before the corresponding image.
    held: ArrayVec<NxResponse, REQUESTS_MAX>,
    /// The unit has left the bus, and has not answered the requests sent meanwhile yet.
    has_left: bool,
    /// Dropped after the queues: the CPU Unit looks into them once more when the unit no longer exists.
    signals: UnitSignals,
}

/// The signals in the hands of the unit: its end is one.
#[derive(Debug)]
struct UnitSignals(Arc<Signals>);

impl Drop for UnitSignals {
    fn drop(&mut self) {
        self.0.responses.store(true, Ordering::Release);
    }
}

impl UnitMessages {
    /// Whether a request was discarded since the last call.
    #[must_use]
    pub fn take_discarded(&self) -> bool {
        let UnitSignals(signals) = &self.signals;
        is_given(&signals.discarded)
    }

    /// Answers the received requests, the oldest first, and holds the responses back. Requests that were sent while
    /// the unit had left the bus are refused. Returns whether there are any responses.
    pub fn answer(&mut self, mut answer: impl FnMut(&NxRequest) -> Result<NxValue, NxMessageError>) -> bool {
        while !self.held.is_full() {
            let Some(request) = self.next_request() else {
                self.has_left = false;
                break;
            };
            let result = if self.has_left { Err(NxMessageError::NotReachable) } else { answer(&request) };
            self.held.push(NxResponse { number: request.number, result });
        }
        !self.held.is_empty()
    }

    fn next_request(&mut self) -> Option<NxRequest> {
        let UnitSignals(signals) = &self.signals;
        if !is_given(&signals.requests) {
            return None;
        }
        let request = self.requests.try_recv().ok()?;
        look_again(&signals.requests);
        Some(request)
    }

    /// The unit loses its power, or restarts: requests that it has not answered yet are never executed. Those that
    /// wait are refused now; those that come later are refused by its next [`Self::answer`].
    pub fn leave(&mut self) {
        self.has_left = true;
        self.answer(|_| Err(NxMessageError::NotReachable));
        self.has_left = true;
        self.send();
    }

    /// Sends the responses. Those for which the CPU Unit has no room yet wait in their order.
    pub fn send(&mut self) {
        while !self.held.is_empty() {
            match self.responses.try_send(self.held.remove(0)) {
                // Release: who sees it also finds the response.
                Ok(()) => self.signals.0.responses.store(true, Ordering::Release),
                Err(TrySendError::Full(response)) => return self.held.insert(0, response),
                Err(TrySendError::Disconnected(_)) => return self.held.clear(),
            }
        }
    }
}

/// Both ends. All the memory that they ever use is allocated here.
pub(crate) fn connect() -> (UnitMessages, CpuMessages) {
    let (ask, requests) = sync_channel(REQUESTS_MAX);
    let (responses, hear) = sync_channel(REQUESTS_MAX);
    let signals = Arc::new(Signals::default());
    let unit = UnitMessages {
        requests,
        responses,
        held: ArrayVec::new(),
        has_left: false,
        signals: UnitSignals(Arc::clone(&signals)),
    };
    (unit, CpuMessages { requests: ask, responses: hear, signals })
}

/// Takes a signal. A signal that nobody has given costs a look at a line of the cache that nobody writes.
fn is_given(signal: &AtomicBool) -> bool {
    signal.load(Ordering::Relaxed) && signal.swap(false, Ordering::Acquire)
}

/// There may be more in the queue. The signal that this replaces was meant for what is found then: hence a swap.
fn look_again(signal: &AtomicBool) {
    signal.swap(true, Ordering::Acquire);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn request(number: u32) -> NxRequest {
        NxRequest { number, index: ObjectIndex(0x5000), sub: SubIndex(1), value: None }
    }

    fn echo(request: &NxRequest) -> Result<NxValue, NxMessageError> {
        Ok(request.number.to_le_bytes().into_iter().collect())
    }

    fn received(cpu: &mut CpuMessages) -> Vec<u32> {
        std::iter::from_fn(|| cpu.receive().expect("under power")).map(|response| response.number).collect()
    }

    #[test]
    fn a_response_is_not_seen_before_it_is_sent() {
        let (mut unit, mut cpu) = connect();
        cpu.send(request(1)).expect("room");
        assert!(unit.answer(echo));
        assert_eq!(cpu.receive(), Ok(None));
        unit.send();
        assert_eq!(received(&mut cpu), [1]);
        assert!(!unit.answer(echo));
    }

    #[test]
    fn full_queues_lose_nothing_and_keep_the_order() {
        let (mut unit, mut cpu) = connect();
        let limit = REQUESTS_MAX as u32;
        for round in 0..3 {
            for number in 0..limit {
                assert_eq!(cpu.send(request(round * limit + number)), Ok(()));
            }
            assert_eq!(cpu.send(request(99)), Err(NotSent::Full));
            assert!(unit.answer(echo));
            unit.send();
        }
        assert_eq!(received(&mut cpu), (0..limit).collect::<Vec<_>>());
        unit.send();
        assert_eq!(received(&mut cpu), (limit..2 * limit).collect::<Vec<_>>());
        unit.answer(echo);
        unit.send();
        assert_eq!(received(&mut cpu), (2 * limit..3 * limit).collect::<Vec<_>>());
    }

    #[test]
    fn a_unit_that_has_left_executes_no_request_of_the_time_before_its_return() {
        let (mut unit, mut cpu) = connect();
        cpu.send(request(1)).expect("room");
        unit.leave();
        let refused = |number| Ok(Some(NxResponse { number, result: Err(NxMessageError::NotReachable) }));
        assert_eq!(cpu.receive(), refused(1));
        cpu.send(request(2)).expect("room");
        assert_eq!(cpu.receive(), Ok(None), "the unit does nothing");
        unit.answer(|request| panic!("executed: {request:?}"));
        unit.send();
        assert_eq!(cpu.receive(), refused(2));
        cpu.send(request(3)).expect("room");
        unit.answer(echo);
        unit.send();
        assert_eq!(cpu.receive().expect("reachable").expect("a response").result, echo(&request(3)));
    }

    #[test]
    fn only_a_request_that_is_given_up_counts_as_discarded() {
        let (unit, mut cpu) = connect();
        for number in 0..REQUESTS_MAX as u32 {
            cpu.send(request(number)).expect("room");
        }
        assert_eq!(cpu.send(request(99)), Err(NotSent::Full));
        assert!(!unit.take_discarded(), "it can be sent later");
        cpu.discard();
        assert_eq!((unit.take_discarded(), unit.take_discarded()), (true, false));
    }

    #[test]
    fn a_unit_that_no_longer_exists_is_not_reachable() {
        let (unit, mut cpu) = connect();
        drop(unit);
        assert_eq!(cpu.send(request(1)), Err(NotSent::NotReachable));
        assert_eq!(cpu.receive(), Err(NxMessageError::NotReachable));
    }
}
