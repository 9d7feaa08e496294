//! What the orders of steps have changed so far, as far as it is known: cables, power, the causes of faults.

use std::collections::{BTreeMap, BTreeSet};

/// What the orders of the steps so far have changed. None: it is not known.
#[derive(Default)]
pub(super) struct Standing {
    /// Something may have changed without a trace: what is not noted here is not known.
    is_blurred: bool,
    /// Cables that steps have plugged or unplugged, by their positions; at the beginning all are plugged.
    plugged: BTreeMap<usize, bool>,
    /// Units that steps have switched; at the beginning all have power.
    powered: BTreeMap<usize, bool>,
    /// The same of their CPU Units.
    cpus: BTreeMap<usize, bool>,
    /// The causes of faults; at the beginning there are none.
    pub(super) faults: BTreeMap<(usize, String), bool>,
    /// CPU Units whose mode steps have changed; at the beginning all are in RUN mode.
    running: BTreeMap<usize, bool>,
    /// CPU Units whose I/O refreshing and whose tasks steps have stopped or started.
    refreshing: BTreeMap<usize, bool>,
    tasks: BTreeMap<usize, bool>,
    /// A step has begun a fault of frames since the last `be quiet`.
    pub(super) has_frame_fault: bool,
    /// A step has stopped the process data.
    pub(super) is_stopped: bool,
    /// The variables that steps have forced.
    pub(super) forced: BTreeSet<String>,
}

/// A part of what orders change.
#[derive(Clone, Copy)]
pub(super) enum Switch {
    Cable,
    Unit,
    Cpu,
    Run,
    Refreshing,
    Task,
}

impl Standing {
    /// From now on nothing is known.
    pub(super) fn forget(&mut self) {
        *self = Self { is_blurred: true, ..Self::default() };
    }

    /// Whether all is known that steps have changed.
    pub(super) const fn is_known(&self) -> bool {
        !self.is_blurred
    }

    const fn of(&mut self, switch: Switch) -> &mut BTreeMap<usize, bool> {
        match switch {
            Switch::Cable => &mut self.plugged,
            Switch::Unit => &mut self.powered,
            Switch::Cpu => &mut self.cpus,
            Switch::Run => &mut self.running,
            Switch::Refreshing => &mut self.refreshing,
            Switch::Task => &mut self.tasks,
        }
    }

    pub(super) fn is_on(&mut self, switch: Switch, at: usize) -> Option<bool> {
        let at_first = (!self.is_blurred).then_some(true);
        self.of(switch).get(&at).copied().or(at_first)
    }

    pub(super) fn is_there(&self, at: usize, fault: &str) -> Option<bool> {
        let at_first = (!self.is_blurred).then_some(false);
        self.faults.get(&(at, fault.to_owned())).copied().or(at_first)
    }

    /// Sets a switch of all these positions. Whether that does something, or may do it.
    pub(super) fn set(&mut self, switch: Switch, positions: &[usize], on: bool) -> bool {
        // Units that do not exist are refused elsewhere.
        let mut does_something = positions.is_empty();
        for at in positions {
            does_something |= self.is_on(switch, *at) != Some(on);
            self.of(switch).insert(*at, on);
        }
        does_something
    }
}
