//! Reading and writing NX objects from a user program, like NX_ReadObj and NX_WriteObj.
//!
//! A call is sent at the end of a task period, and its result arrives at the start of a later one. Until then
//! it is pending. No call waits: a program checks again in its next scan.

use core::task::Poll;

use nx_bus::{CpuMessages, NotSent, NxMessageError, NxRequest, NxValue, REQUESTS_MAX};
use wire::{ObjectIndex, SubIndex};

/// Reads and writes NX objects of one unit.
#[derive(Clone, Debug, Default)]
pub struct NxObjectClient {
    calls: [Call; REQUESTS_MAX],
    last_number: u32,
    /// Some calls may have to be sent: without them no task period looks for one.
    has_made: bool,
    /// A call that waited for room was dropped; the bus does not know yet.
    has_discarded: bool,
}

/// A call that has been made: it identifies the result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NxCall {
    place: usize,
    number: u32,
}

/// Why a call is not made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NxCallRefused {
    /// [`REQUESTS_MAX`] calls are in progress, or their results have not been taken.
    TooManyCalls,
    /// The value is longer than any NX object.
    ValueTooLong,
}

/// The state of one call.
#[derive(Clone, Debug, Default)]
enum Call {
    /// There is no call.
    #[default]
    Free,
    /// It is sent at the end of this task period.
    Made(NxRequest),
    /// There was no room in the queue to the unit: it is sent later.
    Waiting(NxRequest),
    /// It has been sent to the unit.
    Sent { number: u32 },
    /// The result has arrived.
    Done { number: u32, result: Result<NxValue, NxMessageError> },
}

impl NxObjectClient {
    /// Reads an NX object, as NX_ReadObj.
    ///
    /// # Errors
    /// [`NxCallRefused::TooManyCalls`].
    pub fn read(&mut self, index: ObjectIndex, sub: SubIndex) -> Result<NxCall, NxCallRefused> {
        self.call(index, sub, None)
    }

    /// Writes an NX object, as NX_WriteObj; `value` is little endian.
    ///
    /// # Errors
    /// [`NxCallRefused::TooManyCalls`]; [`NxCallRefused::ValueTooLong`] beyond 200 bytes.
    pub fn write(
        &mut self,
        index: ObjectIndex,
        sub: SubIndex,
        value: &[u8],
    ) -> Result<NxCall, NxCallRefused> {
        let value = NxValue::try_from(value).map_err(|_| NxCallRefused::ValueTooLong)?;
        self.call(index, sub, Some(value))
    }

    /// The result of a call, once: the value that was read, empty after a write, or why the unit refused it.
    /// Pending until it has arrived; always pending after it has been taken.
    pub fn take(&mut self, call: NxCall) -> Poll<Result<NxValue, NxMessageError>> {
        match self.calls.get_mut(call.place) {
            Some(place @ Call::Done { .. }) if place.number() == Some(call.number) => {
                match core::mem::take(place) {
                    Call::Done { result, .. } => Poll::Ready(result),
                    _ => Poll::Pending,
                }
            }
            _ => Poll::Pending,
        }
    }

    /// Drops a call: its result will not be used. If it has been sent to a unit with power, it is executed nevertheless.
    pub fn forget(&mut self, call: NxCall) {
        let own = self.calls.get_mut(call.place).filter(|place| place.number() == Some(call.number));
        if let Some(place) = own {
            self.has_discarded |= matches!(place, Call::Waiting(_));
            *place = Call::Free;
        }
    }

    fn call(
        &mut self,
        index: ObjectIndex,
        sub: SubIndex,
        value: Option<NxValue>,
    ) -> Result<NxCall, NxCallRefused> {
        let place = self.calls.iter().position(|call| matches!(call, Call::Free));
        let place = place.ok_or(NxCallRefused::TooManyCalls)?;
        self.last_number = self.last_number.wrapping_add(1);
        let number = self.last_number;
        self.calls[place] = Call::Made(NxRequest { number, index, sub, value });
        self.has_made = true;
        Ok(NxCall { place, number })
    }

    /// Takes the responses that have arrived. An image that is taken after them is at least as new.
    pub(crate) fn receive(&mut self, bus: &mut CpuMessages) {
        loop {
            match bus.receive() {
                Ok(None) => return,
                Ok(Some(response)) => self.finish(response.number, response.result),
                Err(error) => return self.fail_sent(error),
            }
        }
    }

    /// Sends the calls that were made, the oldest first.
    pub(crate) fn send(&mut self, bus: &mut CpuMessages) {
        if core::mem::take(&mut self.has_discarded) {
            bus.discard();
        }
        if self.has_made {
            self.send_made(bus);
            self.has_made = self.oldest_made().is_some();
        }
    }

    fn send_made(&mut self, bus: &mut CpuMessages) {
        while let Some(place) = self.oldest_made() {
            let (Call::Made(request) | Call::Waiting(request)) = core::mem::take(&mut self.calls[place])
            else {
                return;
            };
            let number = request.number;
            self.calls[place] = match bus.send(request.clone()) {
                Ok(()) => Call::Sent { number },
                Err(NotSent::NotReachable) => {
                    Call::Done { number, result: Err(NxMessageError::NotReachable) }
                }
                Err(NotSent::Full) => {
                    self.calls[place] = Call::Waiting(request);
                    return;
                }
            };
        }
    }

    fn oldest_made(&self) -> Option<usize> {
        let made = self.calls.iter().enumerate().filter_map(|(place, call)| match call {
            // Numbers wrap, so the oldest is the one with the greatest distance to the last.
            Call::Made(request) | Call::Waiting(request) => {
                Some((self.last_number.wrapping_sub(request.number), place))
            }
            _ => None,
        });
        made.max().map(|(_, place)| place)
    }

    fn finish(&mut self, number: u32, result: Result<NxValue, NxMessageError>) {
        let sent =
            self.calls.iter_mut().find(|call| matches!(call, Call::Sent { number: n } if *n == number));
        if let Some(call) = sent {
            *call = Call::Done { number, result };
        }
    }

    fn fail_sent(&mut self, error: NxMessageError) {
        for call in &mut self.calls {
            if let Call::Sent { number } = *call {
                *call = Call::Done { number, result: Err(error) };
            }
        }
    }
}

impl Call {
    const fn number(&self) -> Option<u32> {
        match self {
            Self::Free => None,
            Self::Made(request) | Self::Waiting(request) => Some(request.number),
            Self::Sent { number } | Self::Done { number, .. } => Some(*number),
        }
    }
}

#[cfg(test)]
mod tests {
    use device::{Exchange, PortLinks, RefreshCause, Unit};
    use nx_ect101::{NxEct101, UnitSettings};
    use time::Instant;
    use wire::AlState;

    use super::*;

    const SERIAL: (ObjectIndex, SubIndex) = (ObjectIndex(0x1000), SubIndex(7));

    fn refresh(unit: &mut NxEct101) {
        let (cause, links) = (RefreshCause::Period, PortLinks::default());
        let exchange = Exchange { cause, state: AlState::Init, links, outputs: None, inputs: &mut [] };
        unit.refresh(Instant::ZERO, exchange);
    }

    #[test]
    fn a_result_comes_once() {
        let (mut unit, mut bus) = NxEct101::power_on(&UnitSettings::default());
        let mut client = NxObjectClient::default();
        let call = client.read(SERIAL.0, SERIAL.1).expect("room");
        client.send(&mut bus.messages);
        client.receive(&mut bus.messages);
        assert_eq!(client.take(call), Poll::Pending);
        refresh(&mut unit);
        client.receive(&mut bus.messages);
        let value = [1, 0, 0, 0].into_iter().collect();
        assert_eq!(client.take(call), Poll::Ready(Ok(value)));
        assert_eq!(client.take(call), Poll::Pending);
    }

    #[test]
    fn calls_reach_the_unit_in_the_order_in_which_they_were_made() {
        let (mut unit, mut bus) = NxEct101::power_on(&UnitSettings::default());
        let mut client = NxObjectClient::default();
        let message = |fill: u8| [fill; 200];
        let (index, sub) = (ObjectIndex(0x5001), SubIndex(1));
        let first = client.write(index, sub, &message(1)).expect("room");
        client.send(&mut bus.messages);
        refresh(&mut unit);
        client.receive(&mut bus.messages);
        // The place of the first call is free again: a later call takes it.
        let second = client.write(index, sub, &message(2)).expect("room");
        assert_eq!(client.take(first), Poll::Ready(Ok(NxValue::new())));
        let third = client.read(index, sub).expect("room");
        assert_ne!(second.place, third.place);
        client.send(&mut bus.messages);
        refresh(&mut unit);
        client.receive(&mut bus.messages);
        assert_eq!(client.take(second), Poll::Ready(Err(NxMessageError::NotReady)));
        assert_eq!(client.take(third), Poll::Ready(Ok(message(1).into_iter().collect())));
    }

    #[test]
    fn too_much_at_once_is_refused() {
        let mut client = NxObjectClient::default();
        let (index, sub) = SERIAL;
        assert_eq!(client.write(index, sub, &[0; 201]), Err(NxCallRefused::ValueTooLong));
        for _ in 0..REQUESTS_MAX {
            client.read(index, sub).expect("room");
        }
        assert_eq!(client.read(index, sub), Err(NxCallRefused::TooManyCalls));
    }

    #[test]
    fn a_call_that_waits_for_room_is_discarded_only_when_it_is_dropped() {
        let (unit, mut bus) = nx_bus::connect(0, 0);
        let mut client = NxObjectClient::default();
        for _ in 0..REQUESTS_MAX {
            let call = client.read(SERIAL.0, SERIAL.1).expect("room");
            client.send(&mut bus.messages);
            client.forget(call);
        }
        let waiting = client.read(SERIAL.0, SERIAL.1).expect("room");
        client.send(&mut bus.messages);
        assert!(!unit.messages.take_discarded(), "it is sent later");
        client.forget(waiting);
        let never_sent = client.read(SERIAL.0, SERIAL.1).expect("room");
        client.forget(never_sent);
        client.send(&mut bus.messages);
        assert!(unit.messages.take_discarded());
        client.send(&mut bus.messages);
        assert!(!unit.messages.take_discarded(), "once");
    }

    #[test]
    fn a_call_that_waits_for_room_is_sent_later() {
        let (mut unit, mut bus) = NxEct101::power_on(&UnitSettings::default());
        let mut client = NxObjectClient::default();
        for _ in 0..REQUESTS_MAX {
            let call = client.read(SERIAL.0, SERIAL.1).expect("room");
            client.send(&mut bus.messages);
            client.forget(call);
        }
        let waiting = client.read(SERIAL.0, SERIAL.1).expect("room");
        client.send(&mut bus.messages);
        for _ in 0..2 {
            refresh(&mut unit);
            client.receive(&mut bus.messages);
            client.send(&mut bus.messages);
        }
        assert!(matches!(client.take(waiting), Poll::Ready(Ok(_))));
    }

    #[test]
    fn a_unit_that_no_longer_exists_answers_nothing_and_leaves_no_call_pending() {
        let (unit_end, mut bus) = nx_bus::connect(0, 0);
        let mut client = NxObjectClient::default();
        let sent = client.read(SERIAL.0, SERIAL.1).expect("room");
        client.send(&mut bus.messages);
        drop(unit_end);
        let made = client.read(SERIAL.0, SERIAL.1).expect("room");
        client.send(&mut bus.messages);
        client.receive(&mut bus.messages);
        for call in [sent, made] {
            assert_eq!(client.take(call), Poll::Ready(Err(NxMessageError::NotReachable)));
        }
    }
}
