//! A program that sends every message of the master back to it (manual, A-5), for tests of masters.

use core::task::Poll;

use nx_bus::NxValue;
use wire::{ObjectIndex, SubIndex};

use crate::echo::Echo;
use crate::io::Io;
use crate::nx_object_client::NxCall;
use crate::program::Program;

const MESSAGE: SubIndex = SubIndex(1);
const FROM_MASTER: ObjectIndex = ObjectIndex(0x5000);
const TO_MASTER: ObjectIndex = ObjectIndex(0x5001);

/// Copies the data like [`Echo`], and sends each message from the master back to it: one after the other, in
/// order, without omissions.
#[derive(Clone, Debug, Default)]
pub struct MessageEcho {
    step: Step,
}

#[derive(Clone, Debug, Default)]
enum Step {
    #[default]
    AwaitMessage,
    Reading(NxCall),
    AwaitRoom(NxValue),
    Writing(NxCall, NxValue),
}

impl Program for MessageEcho {
    fn scan(&mut self, io: &mut Io) {
        Echo.scan(io);
        self.step = core::mem::take(&mut self.step).next(io);
    }

    fn end(&mut self, io: &mut Io) {
        if let Step::Reading(call) | Step::Writing(call, _) = core::mem::take(&mut self.step) {
            io.nx_objects().forget(call);
        }
    }
}

impl Step {
    fn next(self, io: &mut Io) -> Self {
        let status = io.status();
        let client = io.nx_objects();
        match self {
            Self::AwaitMessage if status.new_message => {
                client.read(FROM_MASTER, MESSAGE).map_or(Self::AwaitMessage, Self::Reading)
            }
            Self::AwaitMessage => Self::AwaitMessage,
            Self::Reading(call) => match client.take(call) {
                Poll::Pending => Self::Reading(call),
                Poll::Ready(Ok(message)) => Self::AwaitRoom(message),
                Poll::Ready(Err(_)) => Self::AwaitMessage,
            },
            Self::AwaitRoom(message) if status.ready_to_write_message => {
                match client.write(TO_MASTER, MESSAGE, &message) {
                    Ok(call) => Self::Writing(call, message),
                    Err(_) => Self::AwaitRoom(message),
                }
            }
            Self::AwaitRoom(message) => Self::AwaitRoom(message),
            Self::Writing(call, message) => match client.take(call) {
                Poll::Pending => Self::Writing(call, message),
                Poll::Ready(Ok(_)) => Self::AwaitMessage,
                Poll::Ready(Err(_)) => Self::AwaitRoom(message),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use nx_bus::REQUESTS_MAX;
    use nx_ect101::{IoAllocation, variable_table};

    use super::*;
    use crate::device_variables::DeviceVariables;

    #[test]
    fn a_program_that_is_replaced_leaves_no_call_behind() {
        let mut io = Io::new(DeviceVariables::of(variable_table("N1", 1, &IoAllocation::factory())));
        for _ in 0..=REQUESTS_MAX {
            let call = io.nx_objects().read(FROM_MASTER, MESSAGE).expect("room");
            MessageEcho { step: Step::Reading(call) }.end(&mut io);
            let call = io.nx_objects().write(TO_MASTER, MESSAGE, &[0; 200]).expect("room");
            MessageEcho { step: Step::Writing(call, NxValue::new()) }.end(&mut io);
        }
    }
}
