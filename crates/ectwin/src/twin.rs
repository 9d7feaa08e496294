//! A line of units in virtual time: frame in, frame out, and access to the units' internal side.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use device::{Device, Network};
use link::{FrameFate, Responder};
use plant::line::{ActiveFault, LineOrder, LineRefusal};
use plant::{HappeningKind, Observer, Powered};
use plc::CpuUnits;
#[cfg(any(feature = "modbus", feature = "opcua"))]
use plc::outside::{self, OutsideEnd};
use scenario::model::Order;
use scenario::{Bench, Brought, KnownLine, Lent, Notes, Records, Refused, Witness};
use storage::ChangesLost;
use time::{Duration, Instant};
use unit_model::ModelUnit;

use crate::disturbed::Disturbed;
use crate::happenings::{Happenings, Observed, Reporter, UnitName};
use crate::lending::{NoNotes, replaced_place};
use crate::memory_file::Keeper;
use crate::supply::Supply;
use crate::unit_side::UnitSide;
use crate::watched_program::WatchedProgram;
use crate::{Setup, SetupError};

/// Units with power, in the order of the chain, with their CPU Units.
///
/// Time advances only through [`Twin::run_for`], or with the master of [`Twin::connect`]. The same calls produce the
/// same bytes, on every machine. In real time [`Twin::serve`] answers a link.
#[derive(Debug)]
pub struct Twin {
    line: Line,
    cpus: CpuUnits,
    programs: Vec<(usize, WatchedProgram)>,
    error_reset: ErrorReset,
    names: Vec<UnitName>,
    reporter: Option<Reporter>,
    known: KnownLine,
    supply: Supply,
    now: Instant,
}

/// The parts of a twin, for code that runs it in real time.
pub(crate) struct Parts {
    pub(crate) line: Line,
    pub(crate) cpus: CpuUnits,
    /// User programs in files, with the positions of their units.
    pub(crate) programs: Vec<(usize, WatchedProgram)>,
    pub(crate) error_reset: ErrorReset,
    /// Who gets the reports of the CPU Units too, if anybody does.
    pub(crate) reporter: Option<Reporter>,
    /// What orders and conditions are checked against.
    pub(crate) known: KnownLine,
    pub(crate) supply: Supply,
}

/// A flag that is set from outside to reset the errors of all NX Bus Function Modules.
pub(crate) type ErrorReset = Arc<AtomicBool>;

impl Twin {
    /// Powers on one unit, according to its unit file.
    ///
    /// # Errors
    /// The mistakes in the text, with their places.
    pub fn from_toml(unit_file: &str) -> Result<Self, SetupError> {
        Ok(Self::power_on([Setup::from_toml(unit_file)?]))
    }

    /// Powers on a line of units, starting with the one next to the master.
    #[must_use]
    pub fn power_on(setups: impl IntoIterator<Item = Setup>) -> Self {
        let mut twin = Self::power_on_for_run(setups);
        twin.poll(twin.now);
        twin
    }

    /// Powers on a line of units for [`crate::Runtime`]: work that is due immediately, such as the first scan of
    /// each program, waits for it.
    #[must_use]
    pub fn power_on_for_run(setups: impl IntoIterator<Item = Setup>) -> Self {
        let now = Instant::ZERO;
        let (mut units, mut cpus, mut keepers) = (Vec::new(), Vec::new(), Vec::new());
        let (mut programs, mut names) = (Vec::new(), Vec::new());
        let (mut sources, mut supply) = (Vec::new(), Supply::default());
        for (position, mut setup) in setups.into_iter().enumerate() {
            sources.push(setup.source());
            supply = setup.supply();
            programs.extend(setup.watched_program().map(|program| (position, program)));
            names.push(setup.unit_name());
            let (Powered { config, unit, cpu }, writer) = setup.power_on(now);
            units.push((config, unit));
            cpus.push(cpu);
            keepers.push(writer.map(Keeper::new));
        }
        let records = units.iter().map(|_| Records::with_fixed_room()).collect();
        let line = Line {
            network: Network::power_on(units, now),
            disturbed: Disturbed::new(),
            records,
            keepers,
            witness: Witness::default(),
            observed: None,
        };
        let (cpus, known, error_reset) =
            (CpuUnits::new(cpus), KnownLine::new(sources), ErrorReset::default());
        Self { line, cpus, programs, error_reset, names, reporter: None, known, supply, now }
    }

    /// Begins to record what happens from now on, also when the twin answers a link: states, events, emergencies, SDOs, links,
    /// faults, reports of CPU Units, which [`plc::CpuUnit::take_events`] has too. Whoever was recording before gets no more records.
    pub fn observe(&mut self) -> Happenings {
        let observer = Observer::beginning_with(&mut self.line.network, self.now);
        let (happenings, observed, reporter) = Happenings::of(self.names.clone(), observer, self.now);
        self.line.observed = Some(observed);
        self.cpus.each(|_, cpu| cpu.observe());
        self.reporter = Some(reporter);
        happenings
    }

    /// Sends one Ethernet frame, without FCS, to the line at the present time; the answer replaces it.
    pub fn frame(&mut self, frame: &mut [u8]) -> FrameFate {
        let fate = self.line.frame(self.now, frame);
        self.line.poll(self.now);
        fate
    }

    /// Takes the next answer that came without a frame: the faults of the line made it late, or it is the second one of
    /// its frame. At most 4,096 of them wait.
    pub fn take_late_answer(&mut self) -> Option<Vec<u8>> {
        self.line.disturbed.take_answer()
    }

    pub(crate) const fn line_mut(&mut self) -> &mut Line {
        &mut self.line
    }

    pub(crate) const fn known_mut(&mut self) -> &mut KnownLine {
        &mut self.known
    }

    /// Lends everything that orders act on and conditions look at.
    pub(crate) fn with_bench<T>(&mut self, brought: &Brought, act: impl FnOnce(&mut Bench<'_>) -> T) -> T {
        let Self { line, cpus, supply, now, .. } = self;
        let done = act(&mut line.bench(cpus, brought, supply, &mut NoNotes, *now));
        line.witness(*now);
        done
    }

    /// Carries out an order that has been checked.
    pub(crate) fn carry_out(&mut self, order: &Order, brought: &Brought) -> Result<(), Refused> {
        let Self { line, cpus, supply, now, .. } = self;
        line.carry_out(cpus, order, brought, supply, &mut NoNotes, *now)
    }

    /// Another unit takes this place: it has no memory file, and its program no watched files.
    pub(crate) fn will_be_replaced(&mut self, position: usize) {
        self.programs.retain(|(other, _)| *other != position);
        self.line.keep();
        finish_replaced(self.line.take_keeper(position));
    }

    /// Advances virtual time; work that becomes due is done at its time.
    pub fn run_for(&mut self, duration: Duration) {
        self.run_to(self.now + duration);
    }

    /// Advances virtual time to `end`; nothing happens if that has passed.
    pub(crate) fn run_to(&mut self, end: Instant) {
        while self.deadline() <= end {
            self.now = self.now.max(self.deadline());
            self.poll(self.now);
        }
        self.now = self.now.max(end);
    }

    /// The present time, counted from power-on.
    #[must_use]
    pub const fn now(&self) -> Instant {
        self.now
    }

    /// Number of units.
    #[must_use]
    pub fn len(&self) -> usize {
        self.cpus.len()
    }

    /// Whether there are no units.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.cpus.is_empty()
    }

    /// The internal side of the unit at `position`, counted from the master.
    ///
    /// # Panics
    /// If there is no such unit.
    pub fn unit(&mut self, position: usize) -> UnitSide<'_> {
        self.line.unit(&mut self.cpus, position, self.now)
    }

    /// Attaches a gateway for runtimes on other threads to each CPU Unit, in the order of the line.
    #[cfg(any(feature = "modbus", feature = "opcua"))]
    pub(crate) fn connect_outside(&mut self) -> Vec<OutsideEnd> {
        let mut ends = Vec::with_capacity(self.cpus.len());
        self.cpus.each(|_, cpu| {
            let (program, end) = outside::connect(cpu.io().variables());
            cpu.attach(Box::new(program));
            ends.push(end);
        });
        ends
    }

    /// Lets [`crate::Runtime`] reset the errors of all NX Bus Function Modules, and of their units, whenever this
    /// flag is set, for example by a signal handler.
    pub fn reset_errors_on(&mut self, flag: Arc<AtomicBool>) {
        self.error_reset = flag;
    }

    pub(crate) fn into_parts(self) -> Parts {
        let Self { line, cpus, programs, error_reset, names: _, reporter, known, supply, now: _ } = self;
        Parts { line, cpus, programs, error_reset, reporter, known, supply }
    }

    fn poll(&mut self, now: Instant) {
        let Self { line, cpus, reporter, .. } = self;
        cpus.cycle(now, |position, cpu| {
            cpu.cycle(now);
            reporter.iter().for_each(|reporter| reporter.cpu(position, cpu, now));
        });
        line.poll(now);
    }

    pub(crate) fn deadline(&self) -> Instant {
        self.line.deadline().min(self.cpus.deadline())
    }
}

/// Stores the last changes of a unit that leaves the line.
pub(crate) fn finish_replaced(keeper: Option<Keeper>) {
    if let Some(Err(ChangesLost { path, source })) = keeper.map(Keeper::finish) {
        tracing::warn!("{}: the last changes are lost: {source}", path.display());
    }
}

/// The units without their CPU Units, for a link.
#[derive(Debug)]
pub(crate) struct Line {
    network: Network<Box<dyn ModelUnit>>,
    /// Its faults.
    disturbed: Disturbed,
    /// What each unit has recorded.
    records: Vec<Records>,
    /// For each unit, who stores its memory in a file, if anybody does.
    keepers: Vec<Option<Keeper>>,
    /// What the master has done, as far as conditions ask for it.
    witness: Witness,
    /// Its observer, if there is one.
    observed: Option<Observed>,
}

impl Line {
    pub(crate) fn unit<'a>(
        &'a mut self,
        cpus: &'a mut CpuUnits,
        position: usize,
        now: Instant,
    ) -> UnitSide<'a> {
        self.is_lent(now);
        UnitSide::of(&mut self.network, cpus, position, now)
    }

    /// Something happens to it at this time, and not by a frame.
    pub(crate) fn is_lent(&mut self, now: Instant) {
        self.observed.iter_mut().for_each(|observed| observed.set_now(now));
    }

    /// Everything that orders act on and conditions look at.
    pub(crate) fn bench<'a>(
        &'a mut self,
        cpus: &'a mut CpuUnits,
        brought: &'a Brought,
        supply: &'a Supply,
        notes: &'a mut dyn Notes,
        now: Instant,
    ) -> Bench<'a> {
        self.is_lent(now);
        let Self { network, disturbed, records, witness, .. } = self;
        Lent { network, cpus, line: disturbed, records, witness, brought, supply, notes, now }.into()
    }

    /// Takes who stores the memory of the unit at this position: it leaves the line, and its changes have been passed on.
    pub(crate) fn take_keeper(&mut self, position: usize) -> Option<Keeper> {
        self.keepers.get_mut(position)?.take()
    }

    /// All units, in the order of the line.
    pub(crate) fn devices(&self) -> impl Iterator<Item = (usize, &Device<Box<dyn ModelUnit>>)> {
        (0..).map_while(|position| Some((position, self.network.device(position)?)))
    }

    /// Lets the units react and late frames pass, and nothing else: [`Line::each_changed`] is to follow.
    pub(crate) fn react(&mut self, now: Instant) {
        self.network.poll(now);
        if self.disturbed.deadline() <= now {
            self.disturbed.poll(now, &mut self.network);
        }
        if let Some(observed) = &mut self.observed {
            observed.time(now, &self.network);
        }
    }

    /// Carries out an order on cables or faults.
    pub(crate) fn order(&mut self, now: Instant, order: &LineOrder) -> Result<(), LineRefusal> {
        self.is_lent(now);
        let done = self.disturbed.order(now, order, &mut self.network);
        self.compare_frame_faults();
        done
    }

    /// Carries out an order that has been checked.
    pub(crate) fn carry_out(
        &mut self,
        cpus: &mut CpuUnits,
        order: &Order,
        brought: &Brought,
        supply: &Supply,
        notes: &mut dyn Notes,
        now: Instant,
    ) -> Result<(), Refused> {
        self.bench(cpus, brought, supply, notes, now).carry_out(order)?;
        let replacement =
            replaced_place(order).and_then(|position| Some((position, brought.unit_at(position)?)));
        if let (Some((position, source)), Some(observed)) = (replacement, &mut self.observed) {
            observed.is_replaced(position, UnitName::of(source.file.section()));
        }
        if let Some(position) = replaced_place(order) {
            self.witness.is_replaced(position);
        }
        self.compare_frame_faults();
        Ok(())
    }

    /// Conditions have been looked at: what the master does from now on is counted, if they ask for it.
    pub(crate) fn witness(&mut self, now: Instant) {
        if self.observed.is_none() && !self.witness.is_idle() {
            let observer = Observer::beginning_with(&mut self.network, now);
            // The counts come from the observer; nobody takes its records.
            let (_, observed, _) = Happenings::of(Vec::new(), observer, now);
            self.observed = Some(observed);
        }
    }

    /// The random faults begin with this seed; all faults and frames that wait are gone.
    pub(crate) fn seed_faults(&mut self, now: Instant, seed: u64) {
        self.is_lent(now);
        self.disturbed.start_again(seed);
        self.compare_frame_faults();
    }

    /// Records the faults of frames that have begun or ended: one may meet its last frame before the next poll.
    fn compare_frame_faults(&mut self) {
        if let Some(observed) = &mut self.observed {
            observed.frame_faults(&self.disturbed);
        }
    }

    /// The faults at work.
    pub(crate) fn faults(&self, now: Instant) -> impl Iterator<Item = ActiveFault<'_>> {
        self.disturbed.active(now)
    }

    pub(crate) const fn disturbed(&self) -> &Disturbed {
        &self.disturbed
    }

    /// Stores the memories that have changed, records what has happened, and shows each unit that may be another than last time. The others are
    /// not looked at.
    pub(crate) fn each_changed(&mut self, mut show: impl FnMut(usize, &Device<Box<dyn ModelUnit>>)) {
        while let Some((position, device, esc)) = self.network.take_changed() {
            if let Some(Some(keeper)) = self.keepers.get_mut(position) {
                keeper.keep(&mut **device.unit_mut(), esc);
            }
            let mut no_records = Records::default();
            let records = self.records.get_mut(position).unwrap_or(&mut no_records);
            match &mut self.observed {
                Some(observed) => observed.unit(position, device, esc, |happening| {
                    if let HappeningKind::Event(recorded) = &happening.kind {
                        records.record(recorded.code);
                    }
                    self.witness.happening(happening);
                }),
                None => {
                    let unit = device.unit_mut();
                    while let Some(event) = unit.take_event() {
                        records.record(event.code);
                    }
                }
            }
            show(position, device);
        }
        self.compare_frame_faults();
    }

    /// Stores the changes, and releases the files. Changes that cannot be stored are lost.
    pub(crate) fn finish(&mut self) -> Vec<ChangesLost> {
        self.keep();
        self.keepers.drain(..).flatten().filter_map(|keeper| keeper.finish().err()).collect()
    }

    /// Stores the memories that have changed.
    fn keep(&mut self) {
        self.each_changed(|_, _| ());
    }
}

/// Actions on a unit since the last poll of the line are stored too.
impl Drop for Line {
    fn drop(&mut self) {
        self.keep();
    }
}

impl Responder for Line {
    fn frame(&mut self, now: Instant, frame: &mut [u8]) -> FrameFate {
        if let Some(observed) = &mut self.observed {
            observed.frame(now);
        }
        if !self.witness.is_idle() {
            self.witness.frame(now, frame, &self.network);
        }
        let fate = match self.disturbed.is_quiet() {
            true => self.network.frame(now, frame),
            false => self.disturbed.frame(now, frame, &mut self.network),
        };
        if !self.witness.is_idle() && fate == FrameFate::Returned {
            self.witness.answer(frame);
        }
        fate
    }

    fn take_late_answer(&mut self, into: &mut [u8]) -> Option<usize> {
        let answer = self.disturbed.take_answer()?;
        if !self.witness.is_idle() {
            self.witness.answer(&answer);
        }
        let length_bytes = answer.len().min(into.len());
        into.get_mut(..length_bytes)?.copy_from_slice(answer.get(..length_bytes)?);
        Some(length_bytes)
    }

    fn is_disturbed(&self) -> bool {
        !self.disturbed.is_quiet()
    }

    fn poll(&mut self, now: Instant) {
        self.react(now);
        self.keep();
    }

    fn deadline(&self) -> Instant {
        let observed = self.observed.as_ref().map_or(Instant::NEVER, Observed::deadline);
        self.network.deadline().min(self.disturbed.deadline()).min(observed)
    }

    fn carrier(&mut self, now: Instant, present: bool) {
        self.network.set_carrier(present);
        self.observed.iter_mut().for_each(|observed| observed.carrier(now, present));
    }

    fn overlong_frames(&self) -> u64 {
        self.network.segment().overlong_frames()
    }
}
