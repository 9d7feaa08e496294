//! The world of a scenario: units, CPU Units, line and master in virtual time, and their observer.

mod frames;
mod indicators;
mod supply;

use std::collections::BTreeSet;

use device::Network;
use plant::line::{LineFaults, LineRefusal};
use plant::{HappeningKind, Observer, Powered};
use plc::{CpuEvent, CpuUnit, CpuUnits};
use time::{Duration, Instant};
use unit_model::{Model, ModelUnit};

use super::bench::{Bench, Masters, state_words};
use super::dice::dice_of_phases;
use super::master::{Master, Sent, Ticket};
use super::met::Met;
use super::recorded::Recorded;
use super::recording::Recording;
use super::records::Records;
use super::scenario::{Brought, Scenario, UnitSource};
use super::witness::Witness;
use crate::model::{CpuOrder, LineOrder, UnitOrder};
use supply::{SeededSupply, powered};

/// The complete state of a running scenario.
pub(crate) struct World {
    network: Network<Box<dyn ModelUnit>>,
    cpus: CpuUnits,
    line: LineFaults<Ticket>,
    master: Master,
    recorded: Recorded,
    now: Instant,
    observer: Observer,
    records: Vec<Records>,
    witness: Witness,
    brought: Brought,
    supply: SeededSupply,
    /// The numbers of the faults that a frame has met.
    met_faults: BTreeSet<u32>,
    recording: Recording,
}

impl World {
    /// Powers on the units of a scenario.
    pub(crate) fn power_on(scenario: &Scenario, seed: u64, recording: Recording) -> Self {
        let now = Instant::ZERO;
        let calendar_ns = scenario.calendar.as_nanos();
        let recording = recording.beginning_at(calendar_ns);
        let mut cpus = Vec::new();
        let units = (1..).zip(&scenario.units).map(|(participant, source)| {
            let Powered { config, unit, cpu } =
                powered(source, dice_of_phases(seed, participant), now, calendar_ns);
            cpus.push(cpu);
            (config, unit)
        });
        let network = Network::power_on(units.collect::<Vec<_>>(), now);
        let count = network.len();
        let phase = scenario.cycle_phase.unwrap_or_else(|| dice_of_phases(seed, 0).phase(scenario.cycle));
        let devices: Vec<_> = scenario.units.iter().map(UnitSource::known_device).collect();
        let described = devices.iter().map(|device| &device.description);
        let recorded = Recorded::new(scenario.recorded.clone(), described);
        let master = Master::new(devices, scenario.cycle, phase);
        let master = match &scenario.master {
            Some(program) => master.with_program(program.clone(), now),
            None => master,
        };
        let mut world = Self {
            network,
            cpus: CpuUnits::new(cpus),
            line: LineFaults::new(seed),
            master,
            recorded,
            now,
            observer: Observer::new(count),
            records: (0..count).map(|_| Records::default()).collect(),
            witness: Witness::default(),
            brought: scenario.brought.clone(),
            supply: SeededSupply { seed, calendar_ns },
            met_faults: BTreeSet::new(),
            recording,
        };
        world.recording.meets(Met::begins);
        world.happen();
        world
    }

    pub(crate) fn now(&self) -> Instant {
        self.now
    }

    /// The units, CPU Units and the line, for orders and conditions.
    pub(crate) fn bench(&mut self) -> Bench<'_> {
        Bench {
            network: &mut self.network,
            cpus: &mut self.cpus,
            line: &mut self.line,
            records: &mut self.records,
            witness: &mut self.witness,
            brought: &self.brought,
            supply: &self.supply,
            notes: &mut self.recording,
            masters: Some(Masters { scripted: &self.master, recorded: &self.recorded }),
            now: self.now,
            without_effect: Vec::new(),
        }
    }

    pub(crate) const fn master(&self) -> &Master {
        &self.master
    }

    pub(crate) const fn master_mut(&mut self) -> &mut Master {
        &mut self.master
    }

    /// Orders are given: what is recorded and given up from now on is new.
    pub(crate) fn mark(&mut self) {
        self.records.iter_mut().for_each(Records::mark);
        self.master.mark();
    }

    /// The number of the fault of frames that began last.
    pub(crate) const fn last_fault(&self) -> u32 {
        self.line.last_number()
    }

    /// Whether a frame has met the fault with this number.
    pub(crate) fn has_met(&self, fault: u32) -> bool {
        self.met_faults.contains(&fault)
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

    /// The time of the next event.
    pub(crate) fn deadline(&self) -> Instant {
        let masters = self.master.deadline().min(self.recorded.deadline());
        self.network.deadline().min(self.cpus.deadline()).min(self.line.deadline()).min(masters)
    }

    /// Advances the time to `to`, with or without an event there.
    pub(crate) fn advance(&mut self, to: Instant) {
        self.now = self.now.max(to);
        self.happen();
    }

    /// Does everything that is due now, in a fixed order: CPU Units, units, late frames, master and its user program.
    fn happen(&mut self) {
        let now = self.now;
        let recording = &mut self.recording;
        self.cpus.cycle(now, |at, cpu| {
            cpu.cycle(now);
            tell_of_cpu(recording, now, at, cpu);
        });
        self.network.poll(now);
        self.pass_late_frames();
        for sent in self.master.send(now) {
            self.transmit(sent);
        }
        self.master.scan(now);
        while let Some((number, frame)) = self.recorded.send(now) {
            self.transmit(Sent { ticket: Ticket::Recorded(number), frame });
        }
        self.watch();
    }

    /// Carries out an action on units.
    pub(crate) fn unit_order(&mut self, order: &UnitOrder) {
        self.bench().unit_order(order);
        if let UnitOrder::Replace { unit, .. } = order {
            self.observer.is_replaced(unit.position());
            self.witness.is_replaced(unit.position());
        }
        self.happen();
    }

    /// Carries out an action on CPU Units.
    pub(crate) fn cpu_order(&mut self, order: &CpuOrder) {
        self.bench().cpu_order(order);
        let (recording, now) = (&mut self.recording, self.now);
        self.cpus.each(|at, cpu| tell_of_cpu(recording, now, at, cpu));
        self.happen();
    }

    /// Carries out an action on the line, if that is possible.
    pub(crate) fn line_order(&mut self, order: &LineOrder) -> Result<(), LineRefusal> {
        self.bench().line_order(order)
    }

    /// Records the changes.
    fn watch(&mut self) {
        let Self { network, observer, records, witness, recording, now, .. } = self;
        while let Some((at, device, esc)) = network.take_changed() {
            let (model, records) = (device.unit().model(), &mut records[at]);
            observer.unit(*now, at, device, esc, |happening| {
                watch_unit(recording, *now, at, model, records, &happening.kind);
                witness.happening(&happening);
            });
        }
        for abort_code in self.master.take_refusals() {
            self.recording.meets(|met| met.refusal(abort_code));
        }
        for words in self.master.take_story() {
            self.recording.tell(self.now, "master", &words);
        }
        self.watch_indicators();
    }
}

/// The trace of what has happened to a unit: its events and its states.
fn watch_unit(
    recording: &mut Recording,
    now: Instant,
    at: usize,
    model: &'static dyn Model,
    records: &mut Records,
    what: &HappeningKind,
) {
    match *what {
        HappeningKind::Event(recorded) => {
            let event = recorded.code;
            let name = model.event(event).map_or("", |event| event.name);
            recording.tell(now, &format!("unit {}", at + 1), &format!("records {event} {name}"));
            recording.meets(|met| met.event(model, event));
            records.record(event);
        }
        HappeningKind::State { before, status, code } => {
            recording.meets(|met| met.status(before, status, code));
            let words = state_words(status, code);
            recording.tell(now, &format!("unit {}", at + 1), &format!("is in {words}"));
        }
        HappeningKind::Power { .. }
        | HappeningKind::Emergency(_)
        | HappeningKind::EmergenciesLost { .. }
        | HappeningKind::Sdo(_)
        | HappeningKind::MessageReceived(_)
        | HappeningKind::MessageSent(_)
        | HappeningKind::Mapping(_)
        | HappeningKind::Link { .. }
        | HappeningKind::Indicator { .. }
        | HappeningKind::Fault { .. }
        | HappeningKind::Carrier { .. }
        | HappeningKind::Master { .. }
        | HappeningKind::FrameFaultEnded { .. } => {}
    }
}

/// The events of a CPU Unit that were not there a task period ago.
fn tell_of_cpu(recording: &mut Recording, now: Instant, at: usize, cpu: &mut CpuUnit) {
    let events: Vec<_> = cpu.take_events().map(|record| record.event).collect();
    let is_new = |event: &&CpuEvent| match event {
        CpuEvent::Program(report) => cpu.reports().is_new(report),
        CpuEvent::ModeChanged(_)
        | CpuEvent::ProgramLoaded
        | CpuEvent::TaskPeriodExceeded { .. }
        | CpuEvent::IoRefreshingStopped
        | CpuEvent::IoRefreshingResumed => true,
    };
    for event in events.iter().filter(is_new) {
        recording.tell(now, &format!("cpu {}", at + 1), &event.to_string());
    }
}

/// Maximum pause without any event.
pub(crate) const QUIET_STEP: Duration = Duration::from_secs(1);
