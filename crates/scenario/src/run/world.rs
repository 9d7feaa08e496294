//! The world of a scenario: units, CPU Units, line and master in virtual time, and their observer.

mod cpus;
mod frames;
mod indicators;
mod looks;
mod orders;
mod plugged;
mod variables;

use coe_kit::indicators::Pattern;
use device::Network;
use plant::line::LineFaults;
use plant::{PowerConditions, Powered};
use time::{Duration, Instant};
use unit_model::{EventCode, ModelUnit, PowerOn};
use wire::{AlStatus, AlStatusCode};

use super::dice::{Dice, dice_of_phases};
use super::ledger::{Ledger, emergency_code};
use super::master::{Master, Sent, Ticket};
use super::programs::{LoadedProgram, SiiImage};
use super::recorded::Recorded;
use super::recording::Recording;
use super::scenario::{Replacement, Scenario, UnitSource};
use crate::model::StateName;

use cpus::{Cpu, Cpus};

/// The complete state of a running scenario.
pub(crate) struct World {
    network: Network<Box<dyn ModelUnit>>,
    cpus: Cpus,
    line: LineFaults<Ticket>,
    master: Master,
    recorded: Recorded,
    now: Instant,
    watched: Vec<Watched>,
    /// The programs that steps load into CPU Units.
    programs: Vec<LoadedProgram>,
    images: Vec<SiiImage>,
    replacements: Vec<Replacement>,
    seed: u64,
    calendar_ns: u64,
    recording: Recording,
}

/// The state of a unit at the observer's last check.
#[derive(Default)]
struct Watched {
    status: AlStatus,
    code: AlStatusCode,
    recorded: Vec<EventCode>,
    /// The pattern of each indicator, in the order of the unit's model.
    patterns: Vec<Pattern>,
    /// Its diagnosis history, as these events say.
    ledger: Ledger,
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
            cpus.push(Cpu::running(cpu));
            (config, unit)
        });
        let network = Network::power_on(units.collect::<Vec<_>>(), now);
        let count = network.len();
        let watched = (0..count).map(|_| Watched::default()).collect();
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
            cpus: Cpus::new(cpus),
            line: LineFaults::new(seed),
            master,
            recorded,
            now,
            watched,
            programs: scenario.programs.clone(),
            images: scenario.images.clone(),
            replacements: scenario.replacements.clone(),
            seed,
            calendar_ns,
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
        self.cpus.cycle(now, |at, cpu| cpu.period(now, |words| tell_of_cpu(recording, now, at, words)));
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

    /// Records the changes.
    fn watch(&mut self) {
        while let Some((at, device, _)) = self.network.take_changed() {
            let (status, code) = (device.al_status(), device.al_status_code());
            let unit = device.unit_mut();
            let watched = &mut self.watched[at];
            while let Some(event) = unit.take_event() {
                let name = unit.model().event(event).map_or("", |event| event.name);
                self.recording.tell(
                    self.now,
                    &format!("unit {}", at + 1),
                    &format!("records {event} {name}"),
                );
                watched.recorded.push(event);
                self.recording.meets(|met| met.event(unit.model(), event));
                if let Some(code) = emergency_code(unit.model(), event) {
                    watched.ledger.record(code);
                }
            }
            if (status, code) != (watched.status, watched.code) {
                self.recording.meets(|met| met.status(watched.status, status, code));
                (watched.status, watched.code) = (status, code);
                let words = state_words(status, code);
                self.recording.tell(self.now, &format!("unit {}", at + 1), &format!("is in {words}"));
            }
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

/// A unit with its CPU Unit, according to its file. Phases that are left out are random.
fn powered(source: &UnitSource, mut dice: Dice, now: Instant, calendar_ns: u64) -> Powered {
    let file = &source.file;
    let refresh_phase = dice.phase(file.section().refresh_period().unwrap_or(Duration::ZERO));
    let program = source.program.start();
    // A CONFIGURATION sets the period, whatever the unit file says.
    let own_period = program.task_period().filter(|period| !period.is_zero());
    let task_period = own_period.unwrap_or(file.cpu().task_period.value);
    let conditions = PowerConditions {
        unit: PowerOn { refresh_phase, ..PowerOn::default() },
        task_phase: dice.phase(task_period),
        system_time_ns: Some(calendar_ns.saturating_add(now.as_nanos())),
    };
    file.power_on(now, &conditions, program)
}

fn tell_of_cpu(recording: &mut Recording, now: Instant, at: usize, words: &str) {
    recording.tell(now, &format!("cpu {}", at + 1), words);
}

pub(crate) fn state_words(status: AlStatus, code: AlStatusCode) -> String {
    let state = StateName(status.state);
    if status.error { format!("{state} with AL status code {:#06X}", code.0) } else { state.to_string() }
}

/// Maximum pause without any event.
pub(crate) const QUIET_STEP: Duration = Duration::from_secs(1);
