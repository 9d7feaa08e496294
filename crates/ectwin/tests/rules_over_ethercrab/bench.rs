//! A master, a unit and its CPU Unit, and the view of both sides of an exchange.

use std::time::Duration;

use ectwin::{Io, Live, Setup, Twin};
use ethercrab::std::ethercat_now;
use ethercrab::subdevice_group::{Op, PreOp};
use ethercrab::{DefaultLock, MainDevice, SubDeviceGroup};

use crate::patient_master;

/// 0x1A00 before the data sets.
const STATUS_BYTES: usize = 2;
const AL_CONTROL: u16 = 0x0120;
const AL_STATUS: u16 = 0x0130;
const AL_STATUS_CODE: u16 = 0x0134;

/// Number of cycles of 1 ms after which an expected event has occurred, on a host with other load.
const PATIENCE_CYCLES: usize = 1000;
/// Number of cycles of 1 ms after which an unexpected event would have occurred: an I/O response takes about 10.
const STILL_CYCLES: usize = 100;

pub(crate) type Group<S> = SubDeviceGroup<2, 4096, DefaultLock, S>;

/// An object that a master writes completely: 0 to subindex 0, the elements, their number.
#[derive(Clone, Debug)]
pub(crate) enum Setting {
    Mapping(u16, Vec<u32>),
    Assignment(u16, &'static [u16]),
}

/// Entry `sub` of data set `number`, 1 for UINT arrays, 2 for BYTE arrays, 3 for UDINT; `base` 0x7000 or 0x6000.
pub(crate) fn entry(base: u32, number: u16, sub: u8) -> u32 {
    let bits = [240, 80, 32][usize::from(number) - 1];
    (base + u32::from(number) - 1) << 16 | u32::from(sub) << 8 | bits
}

pub(crate) fn rx(number: u16, subs: impl IntoIterator<Item = u8>) -> Setting {
    Setting::Mapping(0x1600 + number, subs.into_iter().map(|sub| entry(0x7000, number, sub)).collect())
}

pub(crate) fn tx(number: u16, subs: impl IntoIterator<Item = u8>) -> Setting {
    Setting::Mapping(0x1A00 + number, subs.into_iter().map(|sub| entry(0x6000, number, sub)).collect())
}

pub(crate) const fn assign_rx(pdos: &'static [u16]) -> Setting {
    Setting::Assignment(0x1C12, pdos)
}

pub(crate) const fn assign_tx(pdos: &'static [u16]) -> Setting {
    Setting::Assignment(0x1C13, pdos)
}

/// The flags that show both sides whether data are exchanged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Flags {
    /// Bits 1 and 2 of NX Unit Status: Data … Valid, as the master sees them.
    pub(crate) nx_unit_status: u8,
    /// Bits 1 and 2 of EtherCAT Slave Status: the same, as the CPU Unit sees them.
    pub(crate) slave_status: u16,
    pub(crate) io_data_active: bool,
    pub(crate) unit_error: bool,
}

pub(crate) const EXCHANGING: Flags =
    Flags { nx_unit_status: 0b110, slave_status: 0b110, io_data_active: true, unit_error: false };
/// Sizes that do not match are an error, but data are exchanged.
pub(crate) const MISMATCHED: Flags = Flags { unit_error: true, ..EXCHANGING };
pub(crate) const NOT_REFRESHED: Flags =
    Flags { nx_unit_status: 0, slave_status: 0, io_data_active: false, unit_error: true };

/// One cycle, as both sides saw it.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Seen {
    pub(crate) flags: Flags,
    /// Data at the CPU Unit.
    pub(crate) outputs: Vec<u8>,
    /// Data sets at the master.
    pub(crate) inputs: Vec<u8>,
}

/// A byte of data, never 0.
pub(crate) fn output(place: usize) -> u8 {
    (place % 100) as u8 + 1
}

pub(crate) fn input(place: usize) -> u8 {
    output(place) + 100
}

/// An image of which `moved_bytes` have arrived; the other bytes have their default.
pub(crate) fn image(octet: fn(usize) -> u8, moved_bytes: usize, length_bytes: usize) -> Vec<u8> {
    (0..length_bytes).map(|place| if place < moved_bytes { octet(place) } else { 0 }).collect()
}

/// A master and one unit whose CPU Unit runs no program.
pub(crate) struct Bench {
    pub(crate) master: MainDevice<'static>,
    pub(crate) live: Live,
}

impl Bench {
    pub(crate) fn power_on(unit: &str) -> Self {
        let (frames_tx, frames_rx, pdu_loop) = patient_master::frames();
        let setup = Setup::from_toml(unit).unwrap().program(|_: &mut Io| {}).fast();
        let live = Twin::power_on([setup]).serve_ethercrab(frames_tx, frames_rx).unwrap();
        Self { master: patient_master::master(pdu_loop, 10), live }
    }

    /// Takes the unit to PRE-OP through INIT, which acknowledges an error, and writes the settings.
    pub(crate) async fn pre_op(&self, settings: &[Setting]) -> Group<PreOp> {
        let group = self.master.init_single_group::<2, 4096>(ethercat_now).await.unwrap();
        let unit = group.subdevice(&self.master, 0).unwrap();
        for setting in settings {
            match setting {
                Setting::Mapping(object, entries) => unit.sdo_write_array(*object, entries).await.unwrap(),
                Setting::Assignment(object, pdos) => unit.sdo_write_array(*object, pdos).await.unwrap(),
            }
        }
        group
    }

    /// Resets the errors on the way to SAFE-OP, as the ESI requires.
    pub(crate) async fn op(&self, settings: &[Setting]) -> Group<Op> {
        let group = self.pre_op(settings).await;
        let unit = group.subdevice(&self.master, 0).unwrap();
        unit.sdo_write(0x2002, 2, 1_u8).await.unwrap();
        patient_master::into_op(group, &self.master).await
    }

    /// Requests SAFE-OP with the SyncManagers that the mapping requires. Returns AL status and AL status code.
    pub(crate) async fn refused(&self, settings: &[Setting]) -> (u16, u16) {
        let group = self.pre_op(settings).await.into_pre_op_pdi(&self.master).await.unwrap();
        let unit = group.subdevice(&self.master, 0).unwrap();
        // ethercrab's own transition to SAFE-OP waits until its time-out, whatever AL status is.
        unit.register_write(AL_CONTROL, 0x0004_u16).await.unwrap();
        let answered = async {
            loop {
                let status = unit.register_read::<u16>(AL_STATUS).await.unwrap();
                if status != 0x0002 {
                    return status;
                }
            }
        };
        let status = tokio::time::timeout(Duration::from_secs(5), answered).await.unwrap();
        (status, unit.register_read(AL_STATUS_CODE).await.unwrap())
    }

    async fn cycle(&self, group: &Group<Op>) -> Seen {
        group.tx_rx(&self.master).await.unwrap();
        let inputs = group.subdevice(&self.master, 0).unwrap().inputs_raw().to_vec();
        // The new messages of 0x1BFE are after the data sets.
        let (data_sets, nx_unit_status) =
            (inputs[STATUS_BYTES..inputs.len() - 1].to_vec(), inputs[0] & 0b110);
        self.live.look(0, |unit| {
            let io = unit.io();
            let flags = Flags {
                nx_unit_status,
                slave_status: io.status().bits() & 0b110,
                io_data_active: io.io_data_active(),
                unit_error: io.unit_error(),
            };
            Seen { flags, outputs: unit.outputs().to_vec(), inputs: data_sets }
        })
    }

    /// Sets data on both sides and exchanges them until `wanted` is seen, and longer: it must not change.
    pub(crate) async fn expect(&self, name: &str, group: &Group<Op>, wanted: &Seen) {
        let unit = group.subdevice(&self.master, 0).unwrap();
        let outputs = unit.outputs_raw().len();
        unit.outputs_raw_mut().copy_from_slice(&image(output, outputs, outputs));
        self.live.look(0, |unit| unit.set_inputs(&image(input, 1200, 1200)));

        let mut ticks = tokio::time::interval(Duration::from_millis(1));
        let (mut cycles, mut still) = (0, 0);
        while still < STILL_CYCLES {
            ticks.tick().await;
            let seen = self.cycle(group).await;
            assert!(
                seen == *wanted || still == 0 && cycles < PATIENCE_CYCLES,
                "{name}: cycle {cycles}\n  saw {seen:?}\n  not {wanted:?}"
            );
            still += usize::from(seen == *wanted);
            cycles += 1;
        }
    }
}
