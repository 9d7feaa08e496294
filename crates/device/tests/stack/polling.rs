//! A poll looks only at slaves that may have something to do; a line in which every slave is looked at does the same.

use crate::bench::{Bench, Digital8, config};
use device::{Action, DeviceConfig, OutputsBeforeOp, Start, SyncMode};
use proptest::prelude::*;
use time::Duration;
use wire::{AlStatusCode, Command, FrameBuilder};

/// Slaves of the line, which differ in what they follow.
const SLAVES: usize = 4;

/// Something that happens to the line.
#[derive(Clone, Debug)]
enum Step {
    /// A datagram to one slave.
    Write {
        position: usize,
        offset: u16,
        data: Vec<u8>,
    },
    Read {
        position: usize,
        offset: u16,
        length_bytes: usize,
    },
    /// Outputs and inputs of all slaves.
    Cycle {
        outputs: [u8; SLAVES],
    },
    /// Time passes, from deadline to deadline.
    Run {
        micros: u64,
    },
    Restart {
        position: usize,
    },
    PowerOff {
        position: usize,
    },
    Cable {
        number: usize,
        plugged: bool,
    },
    /// The unit wants to show a fault; the stack asks it with its next poll.
    Fault {
        position: usize,
    },
}

fn step() -> impl Strategy<Value = Step> {
    let write = |offset: u16, data: Vec<u8>| {
        (0..SLAVES).prop_map(move |position| Step::Write { position, offset, data: data.clone() })
    };
    let request = prop::sample::select(vec![1u8, 2, 4, 8, 0x11, 0x14, 0x18]);
    let position = 0..SLAVES;
    let activation = (position.clone(), 0u8..2).prop_map(|(position, on)| Step::Write {
        position,
        offset: 0x0816,
        data: vec![on],
    });
    prop_oneof![
        6 => (position.clone(), request).prop_map(|(position, request)| Step::Write {
            position,
            offset: 0x0120,
            data: vec![request, 0],
        }),
        6 => any::<[u8; SLAVES]>().prop_map(|outputs| Step::Cycle { outputs }),
        6 => (1u64..150_000).prop_map(|micros| Step::Run { micros }),
        1 => activation,
        1 => write(0x0040, b"R".to_vec()),
        1 => write(0x0040, b"E".to_vec()),
        1 => write(0x0040, b"S".to_vec()),
        1 => write(0x0420, vec![1, 0]),
        1 => write(0x0420, vec![0, 0]),
        2 => (position.clone(), 0u16..0x0F80, 1usize..40)
            .prop_map(|(position, offset, length_bytes)| Step::Read { position, offset, length_bytes }),
        1 => position.clone().prop_map(|position| Step::Restart { position }),
        1 => position.clone().prop_map(|position| Step::PowerOff { position }),
        1 => (0..=SLAVES, any::<bool>()).prop_map(|(number, plugged)| Step::Cable { number, plugged }),
        1 => position.prop_map(|position| Step::Fault { position }),
    ]
}

fn line() -> Bench {
    let sync_modes: [&[SyncMode]; SLAVES] =
        [&[SyncMode::FreeRun], &[SyncMode::EndOfFrame], &[SyncMode::SmSynchronous], &[SyncMode::FreeRun]];
    let limit = OutputsBeforeOp::Within(Duration::from_millis(20));
    let outputs_before_op = [limit, OutputsBeforeOp::NotRequired, limit, OutputsBeforeOp::NotRequired];
    let units = sync_modes.into_iter().zip(outputs_before_op).map(|(sync_modes, outputs_before_op)| {
        (DeviceConfig { sync_modes, outputs_before_op, ..config() }, Digital8::default())
    });
    let mut bench = Bench::of(units);
    for position in 0..SLAVES {
        let address = (position as u16).wrapping_neg();
        for (offset, mut data) in [
            (0x0600, vec![0, 0, 0, 0, 1, 0, 0, 7, 0x00, 0x10, 0, 2, 1, 0, 0, 0]),
            (0x0610, vec![0, 0, 0, 0, 1, 0, 0, 7, 0x00, 0x11, 0, 1, 1, 0, 0, 0]),
        ] {
            data[0] = position as u8;
            bench.exchange(FrameBuilder::new().physical(Command::Apwr, address, offset, &data));
        }
    }
    bench.write(0x0810, &[0x00, 0x10, 1, 0, 0x64, 0, 1, 0]);
    bench.write(0x0818, &[0x00, 0x11, 1, 0, 0x20, 0, 1, 0]);
    bench
}

/// A line, and whether every slave of it is looked at with every poll.
struct Side {
    bench: Bench,
    looks_at_all: bool,
}

impl Side {
    fn lend(&mut self) {
        if self.looks_at_all {
            (0..SLAVES).for_each(|position| drop(self.bench.network.slave_mut(position)));
        }
    }

    fn frame(&mut self, frame: FrameBuilder) -> Vec<u8> {
        let mut frame = frame.finish();
        self.bench.network.frame(self.bench.now, &mut frame);
        self.lend();
        self.bench.network.poll(self.bench.now);
        frame
    }

    /// Does a step: what came back, or at which moments something was due.
    fn act(&mut self, step: &Step) -> Vec<u8> {
        let now = self.bench.now;
        let address = |position: &usize| (*position as u16).wrapping_neg();
        match step {
            Step::Write { position, offset, data } => {
                self.frame(FrameBuilder::new().physical(Command::Apwr, address(position), *offset, data))
            }
            Step::Read { position, offset, length_bytes } => {
                let data = vec![0; *length_bytes];
                self.frame(FrameBuilder::new().physical(Command::Aprd, address(position), *offset, &data))
            }
            Step::Cycle { outputs } => self.frame(FrameBuilder::new().logical(Command::Lrw, 0, outputs)),
            Step::Run { micros } => self.run_for(Duration::from_micros(*micros)),
            Step::Restart { position } => {
                self.bench.network.restart(*position, now, Start::Restart);
                Vec::new()
            }
            Step::PowerOff { position } => {
                self.bench.network.power_off(*position, now);
                Vec::new()
            }
            Step::Cable { number, plugged } => {
                self.bench.network.set_cable(*number, *plugged);
                Vec::new()
            }
            Step::Fault { position } => {
                if let Some(device) = self.bench.network.device_mut(*position) {
                    device.unit_mut().actions.push_back(Action::Fault(AlStatusCode(0x8001)));
                    device.unit_mut().actions.push_back(Action::FaultEnded);
                }
                Vec::new()
            }
        }
    }

    fn run_for(&mut self, duration: Duration) -> Vec<u8> {
        let (end, mut moments) = (self.bench.now + duration, Vec::new());
        loop {
            self.lend();
            let deadline = self.bench.network.deadline();
            if deadline > end {
                break;
            }
            self.bench.now = deadline.max(self.bench.now);
            moments.extend(self.bench.now.as_nanos().to_le_bytes());
            self.lend();
            self.bench.network.poll(self.bench.now);
        }
        self.bench.now = end;
        moments
    }

    /// All that a master or an application can see of the line.
    fn picture(&mut self) -> (Vec<u8>, Vec<String>) {
        let mut registers = vec![0; SLAVES * 0x1200];
        for (position, registers) in registers.chunks_exact_mut(0x1200).enumerate() {
            if let Some(esc) = self.bench.network.esc(position) {
                esc.look(0, registers, self.bench.now);
            }
        }
        let device = |position| format!("{:?}", self.bench.network.device(position));
        (registers, (0..SLAVES).map(device).collect())
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn slaves_that_are_not_looked_at_have_nothing_to_do(steps in prop::collection::vec(step(), 1..60)) {
        let (mut few, mut all) = (
            Side { bench: line(), looks_at_all: false },
            Side { bench: line(), looks_at_all: true },
        );
        for step in &steps {
            prop_assert_eq!(few.act(step), all.act(step), "{:?}", step);
            all.lend();
            prop_assert_eq!(few.bench.network.deadline(), all.bench.network.deadline(), "{:?}", step);
            let (few, all) = (few.picture(), all.picture());
            prop_assert!(few.0 == all.0, "registers after {:?}", step);
            prop_assert_eq!(few.1, all.1, "{:?}", step);
        }
    }
}

/// Code that stores EEPROMs looks only at slaves that have changed.
#[test]
fn a_slave_has_changed_when_the_master_has_written_its_eeprom() {
    let mut bench = line();
    let changed = |bench: &mut Bench| {
        let next = || bench.network.take_changed().map(|(position, ..)| position);
        core::iter::from_fn(next).collect::<Vec<_>>()
    };
    let command = |bench: &mut Bench, position: u16, command: [u8; 2]| {
        let data = [&command[..], &[8, 0, 0, 0, 0xFE, 0xCA]].concat();
        bench.exchange(FrameBuilder::new().physical(Command::Apwr, position.wrapping_neg(), 0x0502, &data));
    };
    changed(&mut bench);
    command(&mut bench, 1, [0x00, 0x01]);
    assert_eq!(changed(&mut bench), [], "it is read");
    command(&mut bench, 2, [0x01, 0x02]);
    assert_eq!(changed(&mut bench), [2], "it is written");
    assert_eq!(changed(&mut bench), [], "once");
}
