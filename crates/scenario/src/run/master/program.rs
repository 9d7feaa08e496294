//! The master's own user program in Structured Text: a task that runs after each process data cycle.

use core::task::Poll;

use ::master::Direction;
use coe_kit::pdo::PdoSettings;
use plc::{ProgramEvent, STATEMENT_BUDGET_DEFAULT};
use st::{Alarm, External, Host, Instance, NX_OBJECT_BYTES_MAX, NxCallNumber, NxFault, Problems};
use time::{Duration, Instant};
use wire::AlState;

use super::process_data::ProcessData;
use super::states::States;
use super::variables::{MasterVariables, NODE_ADDRESS_MAX, Node, Place, Source};

/// A master has no NX bus, so there is no unit of any number.
const NO_NX_UNIT: NxFault = NxFault::of(NxFault::OUT_OF_RANGE);

/// A byte for each node address in `_EC_PDSlavTbl` and `_EC_MBXSlavTbl`.
const TABLE_BYTES: usize = NODE_ADDRESS_MAX as usize;

/// The user program of the master, read and checked.
#[derive(Clone, Debug)]
pub struct MasterProgram {
    /// Its files, as named in the scenario.
    pub name: String,
    /// Period of the task; none: that of the process data, synchronous with them.
    pub task_period: Option<Duration>,
    instance: Instance,
    bindings: Vec<Binding>,
    nodes: Vec<Node>,
}

/// A variable of the master that the program uses.
#[derive(Clone, Debug)]
struct Binding {
    external: External,
    source: Source,
}

impl MasterProgram {
    /// Reads and checks a program for these units.
    pub(crate) fn compile(
        name: &str,
        sources: st::Sources,
        variables: &MasterVariables,
        nodes: Vec<Node>,
        task_period: Option<Duration>,
    ) -> Result<Self, Problems> {
        let program = st::compile(sources, &variables.globals)?;
        let task_period = program.period_ns().map(Duration::from_nanos).or(task_period);
        let bindings = program.externals().iter().map(|external| Binding {
            source: variables.sources[external.global],
            external: external.clone(),
        });
        let bindings = bindings.collect();
        Ok(Self { name: name.to_owned(), task_period, instance: program.start(), bindings, nodes })
    }

    /// The program with all its variables.
    pub(crate) const fn instance(&self) -> &Instance {
        &self.instance
    }
}

/// The program in operation.
#[derive(Debug)]
pub(crate) struct Task {
    program: MasterProgram,
    /// The position of each binding's entry; none while its slave has no process data.
    places: Vec<Option<Place>>,
    next: Instant,
    /// Start of its last period.
    last: Option<Instant>,
    is_due: bool,
    /// Buffer for the bytes of a variable.
    bytes: Vec<u8>,
    /// The last value of each binding: a value that the program cannot write and that has not changed is not
    /// loaded again.
    taken: Vec<Vec<u8>>,
}

impl Task {
    pub(crate) fn new(program: MasterProgram, now: Instant) -> Self {
        let places = vec![None; program.bindings.len()];
        let taken = vec![Vec::with_capacity(TABLE_BYTES); program.bindings.len()];
        let bytes = Vec::with_capacity(TABLE_BYTES);
        Self { program, places, next: now, last: None, is_due: false, bytes, taken }
    }

    /// The master restarts: variables with RETAIN are kept.
    pub(crate) fn restart(mut self, now: Instant) -> Self {
        self.program.instance.restart();
        Self::new(self.program, now)
    }

    pub(crate) const fn deadline(&self) -> Instant {
        self.next
    }

    pub(crate) fn value(&self, name: &str) -> Option<String> {
        self.program.instance.value(name)
    }

    /// A cycle of the process data begins, and with it the period of a task without a separate period.
    pub(crate) fn in_step(&mut self, now: Instant) {
        if self.program.task_period.is_none() {
            self.next = now;
        }
    }

    /// Whether its period begins now; it executes its scan when the frames of this time have returned.
    pub(crate) fn begin(&mut self, now: Instant, cycle: Duration) -> bool {
        if self.next <= now {
            // Process data may start at a time at which it has already executed its scan.
            self.is_due = self.last != Some(now);
            self.last = Some(now);
            self.next = now + self.program.task_period.unwrap_or(cycle);
        }
        self.is_due
    }

    /// A slave has process data from now on, at the positions in these settings.
    pub(crate) fn open(&mut self, unit: usize, settings: &PdoSettings) {
        let Some(node) = self.program.nodes.iter().find(|node| node.unit == unit) else { return };
        for (place, binding) in self.places.iter_mut().zip(&self.program.bindings) {
            if binding.source.unit() == Some(unit) {
                *place = binding.source.place(&node.device, settings);
            }
        }
    }

    /// One scan, if its period has begun: reads the inputs of the slaves, and writes the outputs for the next
    /// cycle. None if it is not due.
    pub(crate) fn scan(
        &mut self,
        now: Instant,
        data: &mut ProcessData,
        states: &States,
    ) -> Option<Vec<ProgramEvent>> {
        if !core::mem::take(&mut self.is_due) {
            return None;
        }
        self.take_in(data, states);
        let mut host = MasterHost::default();
        let now_ns = now.saturating_since(Instant::ZERO).as_nanos();
        let result = self.program.instance.scan(now_ns, STATEMENT_BUDGET_DEFAULT, &mut host);
        self.give_out(data);
        let program = self.program.instance.program();
        let failed = result
            .err()
            .and_then(|stopped| ProgramEvent::of_stopped(&stopped, program, STATEMENT_BUDGET_DEFAULT));
        Some(host.told.into_iter().chain(failed).collect())
    }

    fn take_in(&mut self, data: &ProcessData, states: &States) {
        let Self { program, places, bytes, taken, .. } = self;
        let MasterProgram { instance, bindings, nodes, .. } = program;
        for ((binding, place), taken) in bindings.iter().zip(places).zip(taken) {
            bytes.clear();
            match binding.source {
                Source::ProcessDataTable => table(bytes, nodes, states, |node, state| {
                    state == AlState::Op && data.is_exchanging(node.unit)
                }),
                Source::MailboxTable => table(bytes, nodes, states, |node, state| {
                    node.device.description.mailbox.is_some()
                        && matches!(state, AlState::PreOp | AlState::SafeOp | AlState::Op)
                }),
                Source::Entry { unit, direction: Direction::Outputs, .. } => {
                    let Some(place) = *place else { continue };
                    place.take(data.outputs(unit), bytes);
                }
                Source::Entry { unit, .. } | Source::InputBit { unit, .. } => {
                    let Some(place) = *place else { continue };
                    place.take(data.inputs(unit), bytes);
                }
            }
            if binding.external.written || taken != bytes {
                instance.load(&binding.external, bytes);
                taken.clone_from(bytes);
            }
        }
    }

    fn give_out(&mut self, data: &mut ProcessData) {
        let Self { program: MasterProgram { instance, bindings, .. }, places, bytes, .. } = self;
        for (binding, place) in bindings.iter().zip(places) {
            if let (Source::Entry { unit, .. }, Some(place), true) =
                (binding.source, *place, binding.external.written)
            {
                bytes.clear();
                bytes.resize(binding.external.size_bytes(), 0);
                instance.store(&binding.external, bytes);
                data.set_outputs(unit, place.start / 8, bytes);
            }
        }
    }
}

/// An element for each node address, from 1 on; FALSE for those without a slave.
fn table(bytes: &mut Vec<u8>, nodes: &[Node], states: &States, is_set: impl Fn(&Node, AlState) -> bool) {
    bytes.resize(TABLE_BYTES, 0);
    for node in nodes {
        let is_set = states.state(node.unit).is_some_and(|state| is_set(node, state));
        let element = usize::from(node.address).checked_sub(1).and_then(|at| bytes.get_mut(at));
        if let Some(element) = element {
            *element = is_set.into();
        }
    }
}

/// The environment of the program.
#[derive(Default)]
struct MasterHost {
    told: Vec<ProgramEvent>,
}

impl Host for MasterHost {
    fn nx_read(&mut self, _: u16, _: u16, _: u8) -> Result<NxCallNumber, NxFault> {
        Err(NO_NX_UNIT)
    }

    fn nx_write(&mut self, _: u16, _: u16, _: u8, _: &[u8]) -> Result<NxCallNumber, NxFault> {
        Err(NO_NX_UNIT)
    }

    fn nx_result(
        &mut self,
        _: NxCallNumber,
        _: &mut [u8; NX_OBJECT_BYTES_MAX],
    ) -> Poll<Result<usize, NxFault>> {
        Poll::Ready(Err(NO_NX_UNIT))
    }

    fn nx_forget(&mut self, _: NxCallNumber) {}

    fn set_alarm(&mut self, alarm: Alarm) {
        self.told.push(alarm.into());
    }

    fn reset_alarm(&mut self, code: u16) {
        self.told.push(ProgramEvent::UserDefinedErrorsReset { code });
    }
}
