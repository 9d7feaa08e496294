//! A master, a user and hardware that do anything: after each of many random operations the reports of the unit
//! are consistent. The numbers are the same in every run.

use std::path::Path;

use ectwin::{AlState, Duration, EventLevel, EventLog, Fault, FrameFate, Io, Setup, Twin};
use nx_ect101::{ErrorLog, Event, NonVolatileMemory, layout};
use wire::{Command, FrameBuilder};

use crate::stage::{INPUTS_BYTES, OUTPUTS_BYTES, SYSTEM_TIME_NS};

const RUNS: u64 = 10;
const OPERATIONS: u32 = 2_000;
const UNIT_FILES: [&str; 4] = [
    "",
    "io_allocation.m_to_c.uints = 4\nio_allocation.c_to_m.uints = 6",
    "timing = \"fast\"\nio_allocation.m_to_c.uints = [\"6000:02\"]\nio_allocation.c_to_m.uints = 6",
    "id_switch = 0\nevent_levels.39170000 = \"observation\"\nio_allocation.m_to_c.uints = 4\n\
     io_allocation.c_to_m.uints = 6",
];
const REGISTERS: [u16; 20] = [
    0x0010, 0x0040, 0x0120, 0x0134, 0x0200, 0x0204, 0x0400, 0x0420, 0x0440, 0x0500, 0x0502, 0x0508, 0x0600,
    0x0800, 0x0806, 0x0810, 0x0816, 0x081E, 0x0981, 0x09A0,
];
const AL_CONTROLS: [u8; 18] = [
    0x00, 0x01, 0x02, 0x03, 0x04, 0x05, 0x08, 0x11, 0x12, 0x13, 0x14, 0x18, 0x1F, 0x21, 0x31, 0x32, 0x34,
    0x38,
];
const INDEXES: [u16; 20] = [
    0x1018, 0x10E0, 0x10F3, 0x10F8, 0x1601, 0x1603, 0x1A01, 0x1BFE, 0x1C12, 0x1C13, 0x1C32, 0x2002, 0x2003,
    0x2004, 0x2100, 0x3000, 0x3001, 0x6000, 0x7002, 0x9999,
];
const SDO_COMMANDS: [u8; 12] = [0x40, 0x50, 0x23, 0x27, 0x2B, 0x2F, 0x21, 0x31, 0x60, 0x00, 0x80, 0xE0];

/// SplitMix64.
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mixed = (self.0 ^ self.0 >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ mixed >> 31
    }

    fn below(&mut self, limit: usize) -> usize {
        (self.next() % limit as u64) as usize
    }

    fn bytes(&mut self, count: usize) -> Vec<u8> {
        (0..count).map(|_| self.next() as u8).collect()
    }

    fn of<T: Copy>(&mut self, values: &[T]) -> T {
        values[self.below(values.len())]
    }
}

struct Hostile {
    twin: Twin,
    dice: Dice,
    counter: u8,
    injected: Vec<Fault>,
}

/// The actions of the master.
impl Hostile {
    fn send(&mut self, mut frame: Vec<u8>) {
        let fate = self.twin.frame(&mut frame);
        assert_ne!(fate, FrameFate::CrossedOver, "there is no second port");
    }

    fn write(&mut self, offset: u16, data: &[u8]) {
        self.send(FrameBuilder::new().physical(Command::Apwr, 0, offset, data).finish());
    }

    fn read(&mut self, offset: u16, length_bytes: usize) {
        self.send(FrameBuilder::new().physical(Command::Aprd, 0, offset, &vec![0; length_bytes]).finish());
    }

    fn run_for_ms(&mut self, milliseconds: u64) {
        self.twin.run_for(Duration::from_millis(milliseconds));
    }

    fn send_rubbish(&mut self) {
        let length_bytes = self.dice.below(1518);
        let frame = self.dice.bytes(length_bytes);
        self.send(frame);
    }

    fn send_damaged(&mut self) {
        let (length_bytes, offset) = (1 + self.dice.below(40), self.dice.below(0x3000) as u16);
        let data = self.dice.bytes(length_bytes);
        let command = self.dice.of(&[Command::Apwr, Command::Aprd, Command::Bwr, Command::Brd]);
        let mut frame = FrameBuilder::new().physical(command, 0, offset, &data).finish();
        let at = 12 + self.dice.below(frame.len() - 12);
        frame[at] = self.dice.next() as u8;
        self.send(frame);
    }

    fn write_register(&mut self) {
        let (register, length_bytes) = (self.dice.of(&REGISTERS), 1 + self.dice.below(16));
        let data = self.dice.bytes(length_bytes);
        self.write(register, &data);
    }

    fn send_sdo(&mut self, command: u8, index: u16, sub: u8, data: &[u8]) {
        self.counter = self.counter % 7 + 1;
        let ([l0, l1], [i0, i1]) = ((6 + data.len() as u16).to_le_bytes(), index.to_le_bytes());
        let mut message = vec![l0, l1, 0, 0, 0, self.counter << 4 | 3, 0, 0x20, command, i0, i1, sub];
        message.extend(data);
        message.resize(usize::from(layout::MAILBOX_BYTES), 0);
        self.write(layout::MAILBOX_RECEIVE_START, &message);
        self.run_for_ms(3);
        self.read(layout::MAILBOX_SEND_START, usize::from(layout::MAILBOX_BYTES));
    }

    fn send_any_sdo(&mut self) {
        let (command, index) = (self.dice.of(&SDO_COMMANDS), self.dice.of(&INDEXES));
        let sub = self.dice.below(0x28) as u8;
        let value = self.dice.below(0x28) as u8;
        let data = self.dice.of(&[*b"elcl", [1, 0, 0, 0], [0; 4], [value, 0, 0, 0]]);
        self.send_sdo(command, index, sub, &data);
    }

    /// Correct operations once, so that higher states than INIT are reached.
    fn go_to_op(&mut self) {
        let sync_managers = [
            (layout::MAILBOX_RECEIVE_START, layout::MAILBOX_BYTES, layout::MAILBOX_RECEIVE_CONTROL),
            (layout::MAILBOX_SEND_START, layout::MAILBOX_BYTES, layout::MAILBOX_SEND_CONTROL),
            (layout::OUTPUTS_START, OUTPUTS_BYTES, layout::OUTPUTS_CONTROL),
            (layout::INPUTS_START, INPUTS_BYTES - 1, layout::INPUTS_CONTROL),
        ];
        self.write(0x0120, &[0x11, 0]);
        for (at, (start, length_bytes, control)) in (0x0800..).step_by(8).zip(sync_managers) {
            let ([s0, s1], [l0, l1]) = (start.to_le_bytes(), length_bytes.to_le_bytes());
            self.write(at + 6, &[0]);
            self.write(at, &[s0, s1, l0, l1, control, 0, 1, 0]);
        }
        self.write(0x0120, &[0x12, 0]);
        self.send_sdo(0x2B, 0x10F3, 5, &[1, 0, 0, 0]);
        for state in [0x14, 0x18] {
            self.write(0x0120, &[state, 0]);
            self.write(layout::OUTPUTS_START, &[7; OUTPUTS_BYTES as usize]);
            self.run_for_ms(2);
        }
    }
}

/// The actions of the others.
impl Hostile {
    fn inject(&mut self) {
        let fault = self.dice.of(&Fault::ALL);
        self.injected.push(fault);
        self.twin.unit(0).inject(fault);
    }

    fn remove(&mut self) {
        let fault = self.dice.of(&Fault::ALL);
        self.injected.retain(|&injected| injected != fault);
        self.twin.unit(0).remove(fault);
    }

    /// All causes disappear, and the unit starts.
    fn heal(&mut self) {
        self.injected.clear();
        let mut unit = self.twin.unit(0);
        Fault::ALL.into_iter().for_each(|fault| unit.remove(fault));
        unit.cpu().set_io_refreshing(true);
        unit.cycle_power();
    }

    fn do_anything(&mut self) {
        match self.dice.below(100) {
            0..=2 => self.send_rubbish(),
            3..=7 => self.send_damaged(),
            8..=17 => self.write_register(),
            18..=37 => {
                let state = self.dice.of(&AL_CONTROLS);
                self.write(0x0120, &[state, 0]);
            }
            38..=45 => self.go_to_op(),
            46..=67 => self.send_any_sdo(),
            68..=74 => self.write(layout::OUTPUTS_START, &[9; OUTPUTS_BYTES as usize]),
            75 => self.inject(),
            76..=78 => self.remove(),
            79 => self.heal(),
            80 => b"RES".iter().for_each(|byte| self.write(0x0040, &[*byte])),
            81..=88 => self.do_beside(),
            _ => {
                let microseconds = self.dice.of(&[10, 100, 1_000, 5_000, 50_000, 150_000]);
                self.twin.run_for(Duration::from_micros(microseconds));
            }
        }
    }

    /// At the CPU Unit's side.
    fn do_beside(&mut self) {
        let (choice, id_switch) = (self.dice.below(6), self.dice.below(4) as u8);
        let log = self.dice.of(&[EventLog::System, EventLog::Access, EventLog::None]);
        let mut unit = self.twin.unit(0);
        match choice {
            0 => unit.restart(),
            1 => unit.cycle_power(),
            2 => unit.reset_errors(),
            3 => unit.clear_event_log(log),
            4 => unit.set_id_switch(id_switch),
            _ => unit.cpu().set_io_refreshing(id_switch != 0),
        }
    }
}

/// The conditions that must hold.
impl Hostile {
    fn check(&mut self) {
        let unit = self.twin.unit(0);
        let [observations, minor_faults] =
            [EventLevel::Observation, EventLevel::MinorFault].map(|level| unit.current_errors(level));
        assert!(observations.len() + minor_faults.len() <= 10);
        let status = unit.error_status();
        assert_eq!(status & !0x30, 0);
        assert!(status & 0x10 != 0 || observations.is_empty(), "{status:02X}");
        assert!(status & 0x20 != 0 || minor_faults.is_empty(), "{status:02X}");
        assert!(status == 0 || observations.len() + minor_faults.len() > 0, "{status:02X}");
        check_log(unit.error_log());
        let (al_status, code) = (unit.al_status(), unit.al_status_code());
        let is_code = Event::of_al_status_code(code).next().is_some();
        assert!(!al_status.error || is_code, "{al_status:?} {code:?}");
        assert!(al_status.error || al_status.device_id_loaded || code.0 == 0, "{al_status:?} {code:?}");
        self.check_stop();
    }

    /// A fault that is detected immediately takes the unit to INIT with a code, whatever else is present.
    fn check_stop(&mut self) {
        let stops = |fault: &Fault| matches!(fault, Fault::Processing | Fault::ClockNotSynchronized);
        if self.injected.iter().any(stops) {
            self.run_for_ms(2);
            let unit = self.twin.unit(0);
            let status = unit.al_status();
            assert_eq!((status.state, status.error), (AlState::Init, true), "{:?}", self.injected);
        }
    }
}

fn check_log(log: &ErrorLog) {
    assert_eq!(log.system.newest == 0, log.system.is_empty());
    assert_eq!(log.history().last(), log.record_at(log.system.newest));
    assert!(
        log.system.is_full()
            || log.system.newest == 0
            || usize::from(log.system.newest) == 5 + log.system.len()
    );
    assert!(log.history().is_sorted_by_key(|record| record.time_ns), "time goes back");
    let is_logged = |event| Event::find(event).is_some_and(|event| event.logged);
    assert!(log.system.iter().all(|record| is_logged(record.event)));
}

#[test]
fn whatever_happens_what_the_unit_tells_goes_together() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("hostile");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder for temporary files");
    for (run, unit_file) in (0..RUNS).zip(UNIT_FILES.into_iter().cycle()) {
        let text = format!("model = \"nx-ect101\"\nstart_up = \"0ms\"\nstorage = \"{run}.nvm\"\n{unit_file}");
        let setup = Setup::from_toml(&text).expect("a right file").with_storage(&folder).expect("a folder");
        let setup = setup.program(|_: &mut Io| {}).system_time_ns(SYSTEM_TIME_NS);
        let twin = Twin::power_on([setup]);
        let mut hostile = Hostile { twin, dice: Dice(run), counter: 0, injected: Vec::new() };
        for _ in 0..OPERATIONS {
            hostile.do_anything();
            hostile.check();
        }
        hostile.heal();
        hostile.run_for_ms(2);
        let log = hostile.twin.unit(0).error_log().clone();
        drop(hostile);
        let bytes = std::fs::read(folder.join(format!("{run}.nvm"))).expect("stored");
        let stored = NonVolatileMemory::decode(&bytes).expect("a memory that a unit can have");
        assert_eq!(stored.error_log(), &log, "run {run}");
    }
}
