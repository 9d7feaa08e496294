//! The services of the CPU Unit for a program in Structured Text.

use core::task::Poll;

use arrayvec::ArrayVec;
use nx_bus::REQUESTS_MAX;
use st::{Alarm, Host, NX_OBJECT_BYTES_MAX, NxCallNumber, NxFault};
use wire::{ObjectIndex, SubIndex};

use crate::NxMessageError;
use crate::io::Io;
use crate::nx_object_client::{NxCall, NxCallRefused, NxObjectClient};
use crate::program_event::ProgramEvent;

/// The calls of a program that are in progress.
#[derive(Clone, Debug, Default)]
pub(super) struct PendingCalls {
    calls: ArrayVec<(NxCallNumber, NxCall), REQUESTS_MAX>,
    last_number: NxCallNumber,
}

impl PendingCalls {
    fn add(&mut self, call: NxCall) -> NxCallNumber {
        self.last_number += 1;
        // The client has no more calls than this can hold.
        let _ = self.calls.try_push((self.last_number, call));
        self.last_number
    }

    /// Ensures that no number of the previous program is used again.
    pub(super) const fn go_on_from(&mut self, before: &Self) {
        self.last_number = before.last_number;
    }

    /// Drops all of them: their program starts again.
    pub(super) fn forget(&mut self, client: &mut NxObjectClient) {
        for (_, call) in self.calls.drain(..) {
            client.forget(call);
        }
    }
}

/// The CPU Unit during a scan.
pub(super) struct IoHost<'a> {
    pub(super) io: &'a mut Io,
    pub(super) unit_number: u8,
    pub(super) calls: &'a mut PendingCalls,
}

impl IoHost<'_> {
    fn call(
        &mut self,
        unit: u16,
        make: impl FnOnce(&mut NxObjectClient) -> Result<NxCall, NxCallRefused>,
    ) -> Result<NxCallNumber, NxFault> {
        if unit != u16::from(self.unit_number) {
            return Err(NxFault::of(NxFault::OUT_OF_RANGE));
        }
        match make(self.io.nx_objects()) {
            Ok(call) => Ok(self.calls.add(call)),
            Err(NxCallRefused::TooManyCalls) => Err(NxFault::of(NxFault::RESOURCES_EXCEEDED)),
            Err(NxCallRefused::ValueTooLong) => Err(NxFault::of(NxFault::INCORRECT_LENGTH)),
        }
    }
}

impl Host for IoHost<'_> {
    fn nx_read(&mut self, unit: u16, index: u16, sub: u8) -> Result<NxCallNumber, NxFault> {
        self.call(unit, |client| client.read(ObjectIndex(index), SubIndex(sub)))
    }

    fn nx_write(&mut self, unit: u16, index: u16, sub: u8, value: &[u8]) -> Result<NxCallNumber, NxFault> {
        self.call(unit, |client| client.write(ObjectIndex(index), SubIndex(sub), value))
    }

    fn nx_result(
        &mut self,
        number: NxCallNumber,
        value: &mut [u8; NX_OBJECT_BYTES_MAX],
    ) -> Poll<Result<usize, NxFault>> {
        let Some(place) = self.calls.calls.iter().position(|(own, _)| *own == number) else {
            return Poll::Pending;
        };
        let Poll::Ready(result) = self.io.nx_objects().take(self.calls.calls[place].1) else {
            return Poll::Pending;
        };
        self.calls.calls.remove(place);
        Poll::Ready(result.map_err(fault_of).map(|octets| {
            value[..octets.len()].copy_from_slice(&octets);
            octets.len()
        }))
    }

    fn nx_forget(&mut self, number: NxCallNumber) {
        let place = self.calls.calls.iter().position(|(own, _)| *own == number);
        if let Some((_, call)) = place.map(|place| self.calls.calls.remove(place)) {
            self.io.nx_objects().forget(call);
        }
    }

    fn reset_nx_bus(&mut self) -> Result<(), NxFault> {
        self.io.reset_nx_bus();
        Ok(())
    }

    fn nx_bus_is_reset(&self) -> bool {
        !self.io.nx_bus_reset.is_pending()
    }

    fn set_alarm(&mut self, alarm: Alarm) {
        self.io.report(alarm.into());
    }

    fn reset_alarm(&mut self, code: u16) {
        self.io.report(ProgramEvent::UserDefinedErrorsReset { code });
    }

    fn ends_scan(&self) -> bool {
        self.io.ends_scan()
    }
}

/// The pin values of the instruction for a refusal. The manual of the unit does not define ErrorIDEx: the
/// values are the SDO abort codes of the same refusals, which EtherCAT engineers know.
const fn fault_of(error: NxMessageError) -> NxFault {
    let error_id = match error {
        NxMessageError::LengthMismatch { .. } => NxFault::INCORRECT_LENGTH,
        _ => NxFault::MESSAGE_ERROR,
    };
    NxFault { error_id, error_id_ex: error.sdo_abort().0 }
}
