//! Forced values, compared with a simple model, for any actions of program, master, modes and users.

use std::sync::Arc;
use std::sync::atomic::{AtomicU16, Ordering};
use std::sync::mpsc::{Receiver, channel};

use nx_bus::{SlaveStatus, UnitEnd, UnitHeader};

use super::*;
use crate::{Target, VariableAccess, VariableError};

/// UINTs 01, BYTES 01 and UDINT 01 in each direction.
const IMAGE_BYTES: usize = 44;

#[derive(Clone, Debug)]
enum Step {
    /// The unit publishes its data, all bytes equal, and this status; and whether its I/O data is active.
    Publish(u8, u16, bool),
    /// From now on the program fills the whole image with this, or leaves it unchanged.
    ProgramFills(Option<u8>),
    Cycle,
    SetMode(OperatingMode),
    Load,
    /// A target by its number, and the value.
    Write(usize, u8),
    /// The whole image from outside, by the raw bytes.
    WriteRaw(u8),
    Force(usize, u8),
    Release(usize),
    ReleaseAll,
}

fn steps() -> impl Strategy<Value = Vec<Step>> {
    let mode = prop_oneof![Just(OperatingMode::Run), Just(OperatingMode::Program)];
    let step = prop_oneof![
        1 => any::<(u8, u16, bool)>().prop_map(|(fill, status, active)| Step::Publish(fill, status, active)),
        1 => any::<Option<u8>>().prop_map(Step::ProgramFills),
        3 => Just(Step::Cycle),
        1 => mode.prop_map(Step::SetMode),
        1 => Just(Step::Load),
        2 => (any::<usize>(), any::<u8>()).prop_map(|(target, fill)| Step::Write(target, fill)),
        1 => any::<u8>().prop_map(Step::WriteRaw),
        4 => (any::<usize>(), any::<u8>()).prop_map(|(target, fill)| Step::Force(target, fill)),
        2 => any::<usize>().prop_map(Step::Release),
        1 => Just(Step::ReleaseAll),
    ];
    prop::collection::vec(step, 1..60)
}

/// Bits, and which of them are forced, handled one by one.
#[derive(Clone)]
struct Bits(Vec<(bool, Option<bool>)>);

impl Bits {
    fn zeros(bytes: usize) -> Self {
        Self(vec![(false, None); bytes * 8])
    }

    fn see(&self, range: core::ops::Range<usize>) -> Vec<u8> {
        let byte = |bits: &[(bool, Option<bool>)]| {
            bits.iter().rev().fold(0, |byte, bit| byte << 1 | u8::from(bit.1.unwrap_or(bit.0)))
        };
        self.0[range].chunks(8).map(byte).collect()
    }

    /// Writes the bits that are not forced.
    fn write(&mut self, range: core::ops::Range<usize>, value: &[u8]) {
        for (at, bit) in self.0[range].iter_mut().enumerate().filter(|(_, bit)| bit.1.is_none()) {
            bit.0 = value[at / 8] >> (at % 8) & 1 == 1;
        }
    }

    fn force(&mut self, range: core::ops::Range<usize>, value: &[u8]) {
        for (at, bit) in self.0[range].iter_mut().enumerate() {
            bit.1 = Some(value[at / 8] >> (at % 8) & 1 == 1);
        }
    }

    /// The forced values remain until they are written.
    fn release(&mut self, range: core::ops::Range<usize>) {
        for bit in &mut self.0[range] {
            bit.0 = bit.1.take().unwrap_or(bit.0);
        }
    }
}

/// One place with a name: its bits are in one of the three parts of the model.
struct Place {
    target: Target,
    part: usize,
    bits: core::ops::Range<usize>,
    access: VariableAccess,
}

/// All variables of the images and of the status word, and every element, from the rows of the manual.
fn places(io: &Io) -> Vec<Place> {
    let mut places = Vec::new();
    let mut add = |name: &str, part, first_bit: usize, bits: usize, elements: u16, access| {
        let id = io.find(name).expect(name);
        places.push(Place { target: id.into(), part, bits: first_bit..first_bit + bits, access });
        for element in 0..elements {
            let size = bits / usize::from(elements);
            let start = first_bit + size * usize::from(element);
            places.push(Place { target: id.element(element), part, bits: start..start + size, access });
        }
    };
    for (part, way, access) in
        [(0, "M_to_C", VariableAccess::ReadOnly), (1, "C_to_M", VariableAccess::ReadWrite)]
    {
        add(&format!("N1_UINTs_01_{way}"), part, 0, 240, 15, access);
        add(&format!("N1_BYTES_01_{way}"), part, 240, 80, 10, access);
        add(&format!("N1_UDINT_01_{way}"), part, 320, 32, 0, access);
    }
    add("N1_EtherCAT_Slave_Status", 2, 0, 16, 0, VariableAccess::ReadOnly);
    add("N1_Data_from_EtherCAT_Master_to_CPU_Unit_Valid", 2, 1, 1, 0, VariableAccess::ReadOnly);
    add("N1_OUT_Port_Link_ON", 2, 7, 1, 0, VariableAccess::ReadOnly);
    add("N1_Ready_to_Write_Message_Data_to_EtherCAT_Master", 2, 9, 1, 0, VariableAccess::ReadOnly);
    places
}

/// What the program sees in a scan: data M to C and the status word.
type Seen = (Vec<u8>, u16);

struct Run {
    unit: UnitEnd,
    cpu: CpuUnit,
    places: Vec<Place>,
    fill: Arc<AtomicU16>,
    seen: Receiver<Seen>,
    seen_to: std::sync::mpsc::Sender<Seen>,
    /// M to C, C to M, status word.
    model: [Bits; 3],
    published: Option<(Vec<u8>, u16)>,
    program_fills: Option<u8>,
}

const NO_FILL: u16 = 0x100;
const WHOLE: core::ops::Range<usize> = 0..IMAGE_BYTES * 8;

impl Run {
    fn new() -> Self {
        let mut allocation = IoAllocation::empty();
        for direction in Direction::ALL {
            DataSetKind::ALL.into_iter().for_each(|kind| allocation.select(direction, kind, 1));
        }
        let variables = DeviceVariables::of(nx_ect101::variable_table("N1", 1, &allocation));
        let (unit, bus) = nx_bus::connect(variables.unit().m_to_c_bytes, variables.unit().c_to_m_bytes);
        let (fill, (seen_to, seen)) = (Arc::new(AtomicU16::new(NO_FILL)), channel());
        let program = program(&fill, &seen_to);
        let cpu = CpuUnit::power_on(Instant::ZERO, CpuSettings::default(), variables, bus, program);
        let model = [Bits::zeros(IMAGE_BYTES), Bits::zeros(IMAGE_BYTES), Bits::zeros(2)];
        let places = places(cpu.io());
        let published = None;
        Self { unit, cpu, places, fill, seen, seen_to, model, published, program_fills: None }
    }

    /// The value of a place, with all of its bytes equal to `fill`.
    fn value(place: &Place, fill: u8) -> Vec<u8> {
        match place.bits.len() {
            1 => vec![fill & 1],
            bits => vec![fill; bits / 8],
        }
    }

    fn step(&mut self, step: Step) {
        match step {
            Step::Publish(fill, bits, io_data_active) => {
                let status = SlaveStatus::from_bits(bits).bits();
                let header = UnitHeader { status, io_data_active, ..UnitHeader::default() };
                self.unit.m_to_c.publish(header, &[fill; IMAGE_BYTES]);
                self.published = io_data_active.then(|| (vec![fill; IMAGE_BYTES], status));
            }
            Step::ProgramFills(fill) => {
                self.program_fills = fill;
                self.fill.store(fill.map_or(NO_FILL, u16::from), Ordering::Relaxed);
            }
            Step::Cycle => self.cycle(),
            Step::SetMode(mode) => self.cpu.set_mode(mode),
            Step::Load => {
                let loaded = self.cpu.load(program(&self.fill, &self.seen_to));
                assert_eq!(loaded.is_ok(), self.cpu.mode() == OperatingMode::Program);
            }
            Step::WriteRaw(fill) => {
                self.cpu.io_mut().c_to_m_mut().fill(fill);
                self.model[1].write(WHOLE, &[fill; IMAGE_BYTES]);
            }
            Step::ReleaseAll => {
                self.cpu.io_mut().release_all();
                self.model.iter_mut().for_each(|bits| bits.release(0..bits.0.len()));
            }
            Step::Write(at, fill) => self.write(at, fill),
            Step::Force(at, fill) => {
                let place = &self.places[at % self.places.len()];
                let value = Self::value(place, fill);
                self.cpu.io_mut().force(place.target, &value).expect("it fits");
                self.model[place.part].force(place.bits.clone(), &value);
            }
            Step::Release(at) => {
                let place = &self.places[at % self.places.len()];
                self.cpu.io_mut().release(place.target).expect("it is there");
                self.model[place.part].release(place.bits.clone());
            }
        }
    }

    fn write(&mut self, at: usize, fill: u8) {
        let place = &self.places[at % self.places.len()];
        let value = Self::value(place, fill);
        let written = self.cpu.io_mut().write(place.target, &value);
        if place.access == VariableAccess::ReadOnly {
            assert_eq!(written, Err(VariableError::NotWritable));
        } else {
            assert_eq!(written, Ok(()));
            self.model[place.part].write(place.bits.clone(), &value);
        }
    }

    fn cycle(&mut self) {
        self.cpu.cycle(self.cpu.deadline());
        assert_eq!(self.unit.c_to_m.newest().bytes(), self.model[1].see(WHOLE), "what goes out is forced");
        if let Some((data, status)) = &self.published {
            self.model[0].write(WHOLE, data);
            self.model[2].write(0..16, &status.to_le_bytes());
        }
        let seen: Vec<_> = self.seen.try_iter().collect();
        if self.cpu.mode() == OperatingMode::Program {
            assert_eq!(seen, []);
            return;
        }
        // The reserved bits of the word are not flags: a program that reads flags does not see them forced.
        let flags = self.model[2].see(0..16);
        let flags = SlaveStatus::from_bits(u16::from_le_bytes([flags[0], flags[1]])).bits();
        assert_eq!(seen, [(self.model[0].see(WHOLE), flags)], "what the program sees is forced");
        if let Some(fill) = self.program_fills {
            self.model[1].write(WHOLE, &[fill; IMAGE_BYTES]);
        }
    }

    fn compare(&self) {
        let io = self.cpu.io();
        for place in &self.places {
            let expected = self.model[place.part].see(place.bits.clone());
            assert_eq!(io.read(place.target).expect("it is there").to_vec(), expected, "{:?}", place.target);
            let forced = self.model[place.part].0[place.bits.clone()].iter().all(|bit| bit.1.is_some());
            assert_eq!(io.is_forced(place.target), Ok(forced), "{:?}", place.target);
        }
        let listed = io.forced().count();
        let is_any = self.model.iter().any(|bits| bits.0.iter().any(|bit| bit.1.is_some()));
        assert_eq!(listed > 0, is_any);
    }
}

fn program(fill: &Arc<AtomicU16>, seen: &std::sync::mpsc::Sender<Seen>) -> Box<dyn Program + Send> {
    let (fill, seen) = (Arc::clone(fill), seen.clone());
    Box::new(move |io: &mut Io| {
        let _ = seen.send((io.m_to_c().to_vec(), io.status().bits()));
        if let Ok(fill) = u8::try_from(fill.load(Ordering::Relaxed)) {
            io.c_to_m_mut().fill(fill);
        }
    })
}

proptest! {
    #[test]
    fn forced_values_stand_whatever_happens(steps in steps()) {
        let mut run = Run::new();
        for step in steps {
            run.step(step);
            run.compare();
        }
    }
}
