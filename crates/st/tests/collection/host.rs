//! The environment of a program of the collection: there are no NX objects, and alarms are recorded.

use core::task::Poll;

use st::{Alarm, Host, NX_OBJECT_BYTES_MAX, NoHost, NxCallNumber, NxFault};

#[derive(Default)]
pub(crate) struct Recorder {
    /// `alarm 5 1 2` and `reset 5`.
    pub(crate) told: Vec<String>,
}

impl Host for Recorder {
    fn nx_read(&mut self, unit: u16, index: u16, sub: u8) -> Result<NxCallNumber, NxFault> {
        NoHost.nx_read(unit, index, sub)
    }

    fn nx_write(&mut self, unit: u16, index: u16, sub: u8, value: &[u8]) -> Result<NxCallNumber, NxFault> {
        NoHost.nx_write(unit, index, sub, value)
    }

    fn nx_result(
        &mut self,
        call: NxCallNumber,
        value: &mut [u8; NX_OBJECT_BYTES_MAX],
    ) -> Poll<Result<usize, NxFault>> {
        NoHost.nx_result(call, value)
    }

    fn nx_forget(&mut self, call: NxCallNumber) {
        NoHost.nx_forget(call);
    }

    fn set_alarm(&mut self, alarm: Alarm) {
        self.told.push(format!("alarm {} {} {}", alarm.code, alarm.info_1, alarm.info_2));
    }

    fn reset_alarm(&mut self, code: u16) {
        self.told.push(format!("reset {code}"));
    }
}
