//! The world of a scenario: units, CPU Units, line and master in virtual time, and who watches them.

use device::{Device, Network, Start, Unit};
use esc::Port;
use nx_ect101::{
    EventCode, IndicatorCauses, Indicators, NxEct101, Pattern, PortCondition, UnitSettings,
    device_config_with,
};
use plc::{CpuSettings, CpuUnit, Io};
use segment::FrameFate;
use time::{Duration, Instant};
use wire::{AlStatus, AlStatusCode, ObjectIndex, SdoAbort, SubIndex};

use crate::expectation::{CURRENT, StateName, codes};
use crate::line::{Delayed, Line};
use crate::master::{Master, Sent};
use crate::orders::{CpuOrder, FrameFault, LineOrder, UnitOrder};
use crate::recorded::Recorded;
use crate::recording::Recording;
use crate::scenario::{Scenario, UnitSource};
use crate::sentence::IndicatorName;

/// The system time of the CPU Units at the beginning: 2026-01-01 00:00:00 UTC.
pub(crate) const SYSTEM_TIME_NS: u64 = 1_767_225_600_000_000_000;
/// Marks the frames of the recorded master.
const RECORDED: u64 = 1 << 63;
/// Length of a working counter, the end of a frame that is not padded.
const WORKING_COUNTER_BYTES: usize = 2;

/// Everything that a scenario moves.
pub(crate) struct World {
    network: Network<NxEct101>,
    cpus: Vec<Cpu>,
    line: Line,
    master: Master,
    recorded: Recorded,
    now: Instant,
    /// Cable `n` is in front of the unit at position `n`.
    cables: Vec<bool>,
    watched: Vec<Watched>,
    recording: Recording,
}

struct Cpu {
    unit: CpuUnit,
    is_running: bool,
}

/// What the watcher has seen of a unit last.
#[derive(Default)]
struct Watched {
    status: AlStatus,
    code: AlStatusCode,
    recorded: Vec<EventCode>,
    is_off: bool,
}

impl World {
    /// Gives power to the units of a scenario.
    pub(crate) fn power_on(scenario: &Scenario, seed: u64, recording: Recording) -> Self {
        let now = Instant::ZERO;
        let mut cpus = Vec::new();
        let units = scenario.units.iter().map(|source| {
            let (config, unit, cpu) = powered(source, now);
            cpus.push(Cpu { unit: cpu, is_running: true });
            (config, unit)
        });
        let network = Network::power_on(units.collect::<Vec<_>>(), now);
        let count = network.len();
        let watched = (0..count).map(|_| Watched::default()).collect();
        let mut cables = vec![true; count];
        cables.push(false);
        let mut world = Self {
            network,
            cpus,
            line: Line::new(seed),
            master: Master::new(count, scenario.cycle),
            recorded: Recorded::new(scenario.recorded.clone()),
            now,
            cables,
            watched,
            recording,
        };
        world.happen();
        world
    }

    pub(crate) fn now(&self) -> Instant {
        self.now
    }

    pub(crate) fn count(&self) -> usize {
        self.network.len()
    }

    pub(crate) const fn master(&self) -> &Master {
        &self.master
    }

    pub(crate) const fn recorded_master(&self) -> &Recorded {
        &self.recorded
    }

    pub(crate) fn recording(&mut self) -> &mut Recording {
        &mut self.recording
    }

    pub(crate) fn into_recording(self) -> Recording {
        self.recording
    }

    /// When something happens next.
    pub(crate) fn deadline(&self) -> Instant {
        let cpus = self.cpus.iter().filter(|cpu| cpu.is_running).map(|cpu| cpu.unit.deadline());
        let cpus = cpus.min().unwrap_or(Instant::NEVER);
        let masters = self.master.deadline().min(self.recorded.deadline());
        self.network.deadline().min(cpus).min(self.line.deadline()).min(masters)
    }

    /// Lets time pass to `to`, at which something happens or not.
    pub(crate) fn advance(&mut self, to: Instant) {
        self.now = self.now.max(to);
        self.happen();
    }

    /// Everything that is due now, in the one order: CPU Units, units, late frames, master.
    fn happen(&mut self) {
        let now = self.now;
        for cpu in self.cpus.iter_mut().filter(|cpu| cpu.is_running && cpu.unit.deadline() <= now) {
            cpu.unit.cycle(now);
        }
        self.network.poll(now);
        while let Some(Delayed { ticket, mut frame, .. }) = self.line.due(now) {
            self.pass(ticket, &mut frame, &[]);
        }
        for sent in self.master.send(now) {
            self.transmit(sent);
        }
        while let Some((number, frame)) = self.recorded.send(now) {
            self.transmit(Sent { ticket: RECORDED | number as u64, kind: crate::FrameKind::Any, frame });
        }
        self.watch();
    }

    fn transmit(&mut self, sent: Sent) {
        let Sent { ticket, kind, mut frame } = sent;
        let faults = self.line.faults(kind);
        for fault in &faults {
            match *fault {
                FrameFault::Lose => {
                    return self.recording.lost(self.now, &frame, "lost on the way to the units");
                }
                FrameFault::Delay(duration) => {
                    self.recording.note(self.now, &format!("a frame is delayed by {duration}"));
                    return self.line.delay(Delayed { at: self.now + duration, ticket, frame });
                }
                FrameFault::Truncate(length_bytes) => frame.truncate(length_bytes.max(14)),
                _ => {}
            }
        }
        if faults.contains(&FrameFault::Duplicate) {
            let mut first = frame.clone();
            self.pass(ticket, &mut first, &[]);
        }
        self.pass(ticket, &mut frame, &faults);
    }

    /// A frame passes the units, and its answer comes back, if it does.
    fn pass(&mut self, ticket: u64, frame: &mut [u8], faults: &[FrameFault]) {
        let comment = comment(faults);
        self.recording.sent(self.now, frame, comment);
        let corrupted = faults.iter().find_map(|fault| match fault {
            FrameFault::Corrupt(cable) => Some(*cable),
            _ => None,
        });
        let fate = match corrupted {
            Some(cable) => self.network.segment_mut().corrupted_frame(self.now, frame, cable),
            None => self.network.frame(self.now, frame),
        };
        self.network.poll(self.now);
        if fate != FrameFate::Returned {
            return;
        }
        if faults.contains(&FrameFault::LoseAnswer) {
            return self.recording.lost(self.now, frame, "its answer is lost on the way to the master");
        }
        if faults.contains(&FrameFault::WorkingCounter) {
            lower_working_counter(frame);
        }
        self.recording.returned(self.now, frame, comment);
        match ticket & !RECORDED {
            number if number != ticket => self.recorded.receive(number as usize, frame),
            _ => self.master.receive(ticket, frame, self.now),
        }
    }

    /// Writes down what has changed.
    fn watch(&mut self) {
        for at in 0..self.network.len() {
            let Some(device) = self.network.device_mut(at) else { continue };
            let (status, code) = (device.al_status(), device.al_status_code());
            let occurred = device.unit_mut().take_occurred();
            let watched = &mut self.watched[at];
            for &event in &occurred {
                let name = nx_ect101::Event::find(event).map_or("", |event| event.name.as_str());
                self.recording.tell(
                    self.now,
                    &format!("unit {}", at + 1),
                    &format!("records {event} {name}"),
                );
            }
            watched.recorded.extend(occurred);
            if (status, code) != (watched.status, watched.code) {
                (watched.status, watched.code) = (status, code);
                let words = state_words(status, code);
                self.recording.tell(self.now, &format!("unit {}", at + 1), &format!("is in {words}"));
            }
        }
        for words in self.master.take_story() {
            self.recording.tell(self.now, "master", &words);
        }
    }
}

/// Orders.
impl World {
    pub(crate) fn master_mut(&mut self) -> &mut Master {
        &mut self.master
    }

    pub(crate) fn unit_order(&mut self, order: &UnitOrder) {
        match *order {
            UnitOrder::Restart(units) => self.each(units, |world, at| world.start(at, Start::Restart)),
            UnitOrder::CyclePower(units) => self.each(units, |world, at| world.start(at, Start::PowerOn)),
            UnitOrder::PowerOff(units) => self.each(units, Self::power_off),
            UnitOrder::PowerOn(units) => self.each(units, |world, at| world.start(at, Start::PowerOn)),
            UnitOrder::ResetErrors(units) => self.each_unit(units, NxEct101::reset_errors),
            UnitOrder::ClearLog(units, log) => self.each_unit(units, |unit| unit.clear_event_log(log)),
            UnitOrder::SetIdSwitch(at, id) => {
                self.each_unit(crate::UnitSet::One(at), |unit| unit.set_id_switch(id));
            }
            UnitOrder::SpoilSii(at, word) => self.spoil_sii(at, word),
            UnitOrder::Inject(units, fault) => self.each_unit(units, |unit| unit.inject(fault)),
            UnitOrder::Remove(units, fault) => self.each_unit(units, |unit| unit.remove(fault)),
        }
        self.happen();
    }

    pub(crate) fn cpu_order(&mut self, order: &CpuOrder) {
        let now = self.now;
        match order {
            CpuOrder::SetMode(units, mode) => self.each_cpu(*units, |cpu| cpu.unit.set_mode(*mode)),
            CpuOrder::SetIoRefreshing(units, on) => {
                self.each_cpu(*units, |cpu| cpu.unit.set_io_refreshing(*on));
            }
            CpuOrder::SetTaskRunning(units, on) => self.each_cpu(*units, |cpu| cpu.is_running = *on),
            CpuOrder::JumpTime(units, ahead) => {
                self.each_cpu(*units, |cpu| cpu.unit.jump_system_time(*ahead))
            }
            CpuOrder::SetInputs(at, bytes) => self.each_cpu(crate::UnitSet::One(*at), |cpu| {
                for (input, byte) in cpu.unit.io_mut().c_to_m_mut().iter_mut().zip(bytes) {
                    *input = *byte;
                }
            }),
        }
        self.advance(now);
    }

    pub(crate) fn line_order(&mut self, order: &LineOrder) {
        match *order {
            LineOrder::Disturb(disturbance) => self.line.disturb(disturbance),
            LineOrder::Quiet => self.line.quiet(),
            LineOrder::Cable { number, plugged } => {
                if let Some(cable) = self.cables.get_mut(number) {
                    *cable = plugged;
                    self.connect(number);
                }
            }
        }
    }

    fn each(&mut self, units: crate::UnitSet, order: impl Fn(&mut Self, usize)) {
        units.positions(self.count()).for_each(|at| order(self, at));
    }

    fn each_unit(&mut self, units: crate::UnitSet, mut order: impl FnMut(&mut NxEct101)) {
        for at in units.positions(self.count()) {
            if let Some(device) = self.network.device_mut(at) {
                order(device.unit_mut());
            }
        }
    }

    fn each_cpu(&mut self, units: crate::UnitSet, mut order: impl FnMut(&mut Cpu)) {
        let positions = units.positions(self.cpus.len());
        self.cpus.get_mut(positions).unwrap_or_default().iter_mut().for_each(&mut order);
    }

    fn spoil_sii(&mut self, at: usize, word: u16) {
        let Some((_, esc)) = self.network.slave_mut(at) else { return };
        let first = usize::from(word) * 2;
        if let Some(bytes) = esc.sii_image_mut().get_mut(first..first + 2) {
            bytes.iter_mut().for_each(|byte| *byte = !*byte);
        }
    }

    fn power_off(&mut self, at: usize) {
        self.network.power_off(at, self.now);
        self.watched[at].is_off = true;
        self.recording.tell(self.now, &format!("unit {}", at + 1), "is switched off");
    }

    fn start(&mut self, at: usize, start: Start) {
        self.watched[at].is_off = false;
        self.network.restart(at, self.now, start);
        self.connect(at);
        self.connect(at + 1);
    }

    /// A cable carries frames if it is plugged in and both its ends have power.
    fn connect(&mut self, cable: usize) {
        let is_on =
            |at: Option<usize>| at.and_then(|at| self.watched.get(at)).is_none_or(|unit| !unit.is_off);
        let plugged = self.cables.get(cable).copied().unwrap_or(false);
        let carries = plugged && is_on(Some(cable)) && is_on(cable.checked_sub(1));
        self.network.segment_mut().set_cable(cable, carries);
    }
}

/// Looks.
impl World {
    /// The unit at a position that the scenario has been checked for.
    pub(crate) fn unit(&self, at: usize) -> &NxEct101 {
        self.device(at).unit()
    }

    fn device(&self, at: usize) -> &Device<NxEct101> {
        match self.network.device(at) {
            Some(device) => device,
            None => panic!("the scenario names unit {}, and was checked", at + 1),
        }
    }

    pub(crate) fn io(&self, at: usize) -> &Io {
        self.cpus[at].unit.io()
    }

    pub(crate) fn al_status(&self, at: usize) -> (AlStatus, AlStatusCode) {
        (self.device(at).al_status(), self.device(at).al_status_code())
    }

    pub(crate) fn state_words(&self, at: usize) -> String {
        let (status, code) = self.al_status(at);
        state_words(status, code)
    }

    pub(crate) fn recorded(&self, at: usize) -> &[EventCode] {
        &self.watched[at].recorded
    }

    pub(crate) fn recorded_words(&self, at: usize) -> String {
        let recorded = self.recorded(at);
        if recorded.is_empty() {
            "nothing is recorded".to_owned()
        } else {
            format!("recorded: {}", codes(recorded))
        }
    }

    pub(crate) fn current_errors(&self, at: usize) -> Vec<EventCode> {
        let unit = self.unit(at);
        CURRENT.iter().flat_map(|&level| unit.current_errors(level)).map(|error| error.event).collect()
    }

    pub(crate) fn object(
        &mut self,
        at: usize,
        index: ObjectIndex,
        sub: SubIndex,
    ) -> Result<Vec<u8>, SdoAbort> {
        let missing = SdoAbort::OBJECT_DOES_NOT_EXIST;
        let objects =
            self.network.device_mut(at).and_then(|device| device.unit_mut().objects()).ok_or(missing)?;
        let entry = objects.table().entry(index, sub).ok_or(missing)?;
        let mut value = vec![0; entry.size_bytes()];
        objects.read(index, sub, &mut value).map(|()| value)
    }

    pub(crate) fn registers(&self, at: usize, offset: u16, length_bytes: usize) -> Vec<u8> {
        let mut bytes = vec![0; length_bytes];
        if let Some(esc) = self.network.esc(at) {
            esc.look(offset, &mut bytes);
        }
        bytes
    }

    pub(crate) fn inputs(&self, at: usize) -> &[u8] {
        self.master.inputs(at)
    }

    pub(crate) fn working_counter(&self, at: usize) -> Option<u16> {
        self.master.working_counter(at)
    }

    pub(crate) fn indicator(&self, at: usize, name: IndicatorName) -> Pattern {
        let indicators = self.indicators(at);
        match name {
            IndicatorName::Run => indicators.run,
            IndicatorName::Err => indicators.err,
            IndicatorName::LinkIn => indicators.la_in,
            IndicatorName::LinkOut => indicators.la_out,
            IndicatorName::TsGreen => indicators.ts_green,
            IndicatorName::TsRed => indicators.ts_red,
        }
    }

    fn indicators(&self, at: usize) -> Indicators {
        let (status, code) = self.al_status(at);
        let unit = self.unit(at);
        let port = |port| {
            let activity = self.network.segment().port_activity(at, port);
            activity.map_or(PortCondition::NoLink, |activity| {
                PortCondition::new(activity.link, activity.is_active(self.now))
            })
        };
        Indicators::of(&IndicatorCauses {
            power: !self.watched[at].is_off,
            nx: unit.nx_condition(),
            state: status.state,
            al_error: status.error.then_some(code),
            esc_error: unit.faults().any(|fault| fault == nx_ect101::Fault::Esc),
            in_port: port(Port::In),
            out_port: port(Port::Out),
        })
    }
}

/// A unit with its CPU Unit, as its file says.
fn powered(source: &UnitSource, now: Instant) -> (device::DeviceConfig, NxEct101, CpuUnit) {
    let settings = UnitSettings::from_unit_file(&source.file);
    let (unit, bus) = NxEct101::power_on(&settings);
    let config = device_config_with(&settings, unit.memory().sii_image().to_vec());
    let cpu =
        CpuSettings { system_time_ns: Some(SYSTEM_TIME_NS), ..CpuSettings::from_unit_file(&source.file) };
    let program = source.program.start();
    (config, unit, CpuUnit::power_on(now, cpu, bus, program))
}

pub(crate) fn state_words(status: AlStatus, code: AlStatusCode) -> String {
    let state = StateName(status.state);
    if status.error { format!("{state} with AL status code {:#06X}", code.0) } else { state.to_string() }
}

/// What a capture says beside a frame.
fn comment(faults: &[FrameFault]) -> Option<&'static str> {
    faults.first().map(|fault| match fault {
        FrameFault::Lose => "lost",
        FrameFault::LoseAnswer => "fault: its answer gets lost",
        FrameFault::Delay(_) => "fault: delayed",
        FrameFault::Duplicate => "fault: it comes twice",
        FrameFault::Truncate(_) => "fault: it is cut short",
        FrameFault::Corrupt(_) => "fault: a bit error on its way",
        FrameFault::WorkingCounter => "fault: the working counter of its answer is one too low",
    })
}

fn lower_working_counter(frame: &mut [u8]) {
    let Some(at) = frame.len().checked_sub(WORKING_COUNTER_BYTES) else { return };
    if let Some([low, high]) = frame.get_mut(at..) {
        let lowered = u16::from_le_bytes([*low, *high]).saturating_sub(1);
        [*low, *high] = lowered.to_le_bytes();
    }
}

/// Longest pause in which nothing at all happens.
pub(crate) const QUIET_STEP: Duration = Duration::from_secs(1);
