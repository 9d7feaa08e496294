//! A master that exchanges process data, one unit, and the channels on which the unit reports its events.

use std::cell::{Cell, RefCell};
use std::convert::Infallible;
use std::time::Duration;

use ectwin::{EventCode, Io, Live, Setup, Twin};
use ethercrab::std::ethercat_now;
use ethercrab::subdevice_group::{Op, PreOp};
use ethercrab::{Command, DefaultLock, MainDevice, SubDeviceGroup};

use crate::patient_master;

const AL_STATUS: u16 = 0x0130;
const AL_STATUS_CODE: u16 = 0x0134;
/// SyncManager 1, status: bit 3 is set while a message of the unit is in its mailbox at 0x1200.
const MAILBOX_STATUS: u16 = 0x080D;
const MAILBOX_FULL: u8 = 1 << 3;
const MAILBOX: u16 = 0x1200;
const MAILBOX_BYTES: usize = 400;

/// Number of ticks of 1 ms after which an expected event has occurred, on a host with other load.
const PATIENCE_TICKS: usize = 1000;
/// Number of ticks of 1 ms after which an unexpected event would have occurred.
const STILL_TICKS: usize = 50;

pub(crate) type Group<S> = SubDeviceGroup<2, 512, DefaultLock, S>;

/// An emergency message: its error code, error register and event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Emergency {
    pub(crate) code: u16,
    pub(crate) register: u8,
    pub(crate) event: EventCode,
}

fn ticks() -> tokio::time::Interval {
    tokio::time::interval(Duration::from_millis(1))
}

pub(crate) struct Stage {
    pub(crate) master: MainDevice<'static>,
    pub(crate) live: Live,
    /// From the newest cycle: ethercrab locks its image during a cycle.
    inputs: RefCell<Vec<u8>>,
    cycles: Cell<usize>,
}

impl Stage {
    /// A unit at its factory setting, whose CPU Unit runs no program.
    pub(crate) fn power_on() -> Self {
        let (frames_tx, frames_rx, pdu_loop) = patient_master::frames();
        let setup =
            Setup::from_toml("model = \"nx-ect101\"\nstart_up = \"0ms\"").unwrap().program(|_: &mut Io| {});
        let live = Twin::power_on([setup]).serve_ethercrab(frames_tx, frames_rx).unwrap();
        let master = patient_master::master(pdu_loop, 0);
        Self { master, live, inputs: RefCell::default(), cycles: Cell::default() }
    }

    /// Takes the unit to PRE-OP through INIT, which acknowledges an error.
    pub(crate) async fn pre_op(&self) -> Group<PreOp> {
        self.master.init_single_group::<2, 512>(ethercat_now).await.unwrap()
    }

    pub(crate) async fn op(&self) -> Group<Op> {
        patient_master::into_op(self.pre_op().await, &self.master).await
    }

    /// AL status and AL status code, independent of addresses.
    pub(crate) async fn al(&self) -> (u16, u16) {
        let status = Command::brd(AL_STATUS).receive(&self.master).await.unwrap();
        (status, Command::brd(AL_STATUS_CODE).receive(&self.master).await.unwrap())
    }

    /// The same, once the state is no longer `before`.
    pub(crate) async fn al_after(&self, before: u16) -> (u16, u16) {
        let mut ticks = ticks();
        for _ in 0..PATIENCE_TICKS {
            ticks.tick().await;
            let al = self.al().await;
            if al.0 != before {
                return al;
            }
        }
        panic!("AL status stays {before:#06X}");
    }

    /// Runs `body` with an exchange of process data every millisecond in parallel, each with the expected
    /// working counter.
    pub(crate) async fn while_exchanging<T>(&self, group: &Group<Op>, body: impl Future<Output = T>) -> T {
        let before = self.cycles.get();
        let value = tokio::select! {
            value = body => value,
            never = self.exchange(group) => match never {},
        };
        assert!(self.cycles.get() > before, "no process data beside it");
        value
    }

    async fn exchange(&self, group: &Group<Op>) -> Infallible {
        let unit = group.subdevice(&self.master, 0).unwrap();
        let mut ticks = ticks();
        loop {
            ticks.tick().await;
            assert_eq!(group.tx_rx(&self.master).await.unwrap().working_counter, 3);
            self.inputs.replace(unit.inputs_raw().to_vec());
            self.cycles.set(self.cycles.get() + 1);
        }
    }

    /// Waits until the inputs have the expected value.
    pub(crate) async fn wait_for_inputs(&self, is_wanted: impl Fn(&[u8]) -> bool) {
        let (mut ticks, before) = (ticks(), self.cycles.get());
        for _ in 0..PATIENCE_TICKS {
            ticks.tick().await;
            if self.cycles.get() > before && is_wanted(&self.inputs.borrow()) {
                return;
            }
        }
        panic!("inputs {:02X?}", self.inputs.borrow());
    }

    /// The only emergency. ethercrab reads the mailbox only for its own SDOs, so the application reads it.
    pub(crate) async fn emergency(&self, group: &Group<Op>) -> Emergency {
        let mut ticks = ticks();
        for _ in 0..PATIENCE_TICKS {
            ticks.tick().await;
            if let Some(emergency) = self.look_for_emergency(group).await {
                return emergency;
            }
        }
        panic!("no emergency");
    }

    pub(crate) async fn expect_no_emergency(&self, group: &Group<Op>) {
        let mut ticks = ticks();
        for _ in 0..STILL_TICKS {
            ticks.tick().await;
            assert_eq!(self.look_for_emergency(group).await, None);
        }
    }

    async fn look_for_emergency(&self, group: &Group<Op>) -> Option<Emergency> {
        let unit = group.subdevice(&self.master, 0).unwrap();
        if unit.register_read::<u8>(MAILBOX_STATUS).await.unwrap() & MAILBOX_FULL == 0 {
            return None;
        }
        let message: [u8; MAILBOX_BYTES] = unit.register_read(MAILBOX).await.unwrap();
        // Mailbox type CoE, CoE service 1.
        assert_eq!((message[5] & 0x0F, message[7] >> 4), (3, 1), "{:02X?}", &message[..16]);
        Some(Emergency {
            code: u16::from_le_bytes([message[8], message[9]]),
            register: message[10],
            event: EventCode(u32::from_le_bytes(message[12..16].try_into().unwrap())),
        })
    }

    /// 10F3:01 to :04.
    pub(crate) async fn history<S>(&self, group: &SubDeviceGroup<2, 512, DefaultLock, S>) -> [u8; 4]
    where
        S: ethercrab::subdevice_group::HasPdi,
    {
        let unit = group.subdevice(&self.master, 0).unwrap();
        let mut flags = [0; 4];
        for (sub, flag) in (1_u8..).zip(&mut flags) {
            *flag = unit.sdo_read(0x10F3, sub).await.unwrap();
        }
        flags
    }
}
