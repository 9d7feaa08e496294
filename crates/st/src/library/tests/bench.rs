//! Calls functions of the library as the machine does.

use core::task::Poll;

use crate::elementary::Elementary;
use crate::fault::Fault;
use crate::host::{Alarm, Host, NX_OBJECT_BYTES_MAX, NoHost, NxCallNumber, NxFault};
use crate::library::{Call, function};
use crate::memory::Memory;
use crate::memory::Slot;
use crate::scan::{Budget, Scan};
use crate::types::STRING_CHARACTERS_MAX;

/// Slots of each text of the bench, and of its result.
const TEXT_SLOTS: Slot = 250;
const RESULT: Slot = 3 * TEXT_SLOTS;

pub(super) struct Bench {
    pub(super) memory: Memory,
    pub(super) budget: u64,
    /// The arguments that are ULINTs, as in a [`Call`].
    pub(super) ulints: u64,
}

impl Bench {
    pub(super) fn new() -> Self {
        Self { memory: Memory::new(vec![0; 4 * TEXT_SLOTS as usize]), budget: u64::MAX, ulints: 0 }
    }

    pub(super) fn call(
        &mut self,
        name: &str,
        elementary: Elementary,
        arguments: &[u64],
    ) -> Result<u64, Fault> {
        self.call_with(&mut NoHost, name, elementary, arguments)
    }

    pub(super) fn call_with(
        &mut self,
        host: &mut dyn Host,
        name: &str,
        elementary: Elementary,
        arguments: &[u64],
    ) -> Result<u64, Fault> {
        let mut scan = Scan {
            memory: &mut self.memory,
            layouts: &[],
            host,
            now_ns: 77,
            budget: Budget::new(self.budget),
            steps: 0,
        };
        let ulints = self.ulints;
        let text = (RESULT, STRING_CHARACTERS_MAX as u16);
        let run = function(name).unwrap_or_else(|| panic!("no function {name}")).0.run;
        run(&mut Call { scan: &mut scan, arguments, elementary, ulints, text })
    }

    /// Stores a text in the memory, as an argument.
    pub(super) fn text(&mut self, place: Slot, text: &[u8]) -> u64 {
        let slot = place * TEXT_SLOTS;
        self.memory.put_text(slot, STRING_CHARACTERS_MAX as u16, text).unwrap();
        slot.into()
    }

    /// The text that a function returned.
    pub(super) fn given(&self, result: Result<u64, Fault>) -> Result<Vec<u8>, Fault> {
        result.map(|slot| self.memory.text(slot as Slot).to_vec())
    }
}

/// Calls a function that has only values as arguments and result.
pub(super) fn call(name: &str, elementary: Elementary, arguments: &[u64]) -> Result<u64, Fault> {
    Bench::new().call(name, elementary, arguments)
}

/// A host with one NX object, which answers when the test permits it.
#[derive(Default)]
pub(super) struct Recorder {
    pub(super) alarms: Vec<Alarm>,
    pub(super) resets: Vec<u16>,
    /// The last request: unit, index, subindex, and the value of a write.
    pub(super) asked: Vec<(u16, u16, u8, Option<Vec<u8>>)>,
    /// The error with which the next call is refused.
    pub(super) refusal: Option<NxFault>,
    /// The available answers, by the numbers of their calls.
    pub(super) answers: Vec<(NxCallNumber, Result<Vec<u8>, NxFault>)>,
    /// The calls that were dropped.
    pub(super) forgotten: Vec<NxCallNumber>,
}

impl Recorder {
    fn ask(&mut self, unit: u16, index: u16, sub: u8, value: Option<&[u8]>) -> Result<NxCallNumber, NxFault> {
        self.asked.push((unit, index, sub, value.map(<[u8]>::to_vec)));
        self.refusal.map_or(Ok(self.asked.len() as u64), Err)
    }
}

impl Host for Recorder {
    fn nx_read(&mut self, unit: u16, index: u16, sub: u8) -> Result<NxCallNumber, NxFault> {
        self.ask(unit, index, sub, None)
    }

    fn nx_write(&mut self, unit: u16, index: u16, sub: u8, value: &[u8]) -> Result<NxCallNumber, NxFault> {
        self.ask(unit, index, sub, Some(value))
    }

    fn nx_result(
        &mut self,
        call: NxCallNumber,
        value: &mut [u8; NX_OBJECT_BYTES_MAX],
    ) -> Poll<Result<usize, NxFault>> {
        let Some(place) = self.answers.iter().position(|(number, _)| *number == call) else {
            return Poll::Pending;
        };
        let (_, answer) = self.answers.remove(place);
        Poll::Ready(answer.map(|octets| {
            value[..octets.len()].copy_from_slice(&octets);
            octets.len()
        }))
    }

    fn nx_forget(&mut self, call: NxCallNumber) {
        self.forgotten.push(call);
    }

    fn set_alarm(&mut self, alarm: Alarm) {
        self.alarms.push(alarm);
    }

    fn reset_alarm(&mut self, code: u16) {
        self.resets.push(code);
    }
}
