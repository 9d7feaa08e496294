//! The places of the parts of a scenario in its file: kept separately from the typed values, for messages.

use core::ops::Range;

use crate::ready::{Part, StepPart};

/// Bytes of a file.
pub(super) type Span = Range<usize>;

/// The places of a file.
#[derive(Default)]
pub(super) struct Places {
    pub(super) limit: Span,
    pub(super) cycle: Span,
    pub(super) cycle_phase: Span,
    pub(super) units: Vec<Span>,
    pub(super) master: MasterPlaces,
    pub(super) steps: Vec<StepPlaces>,
}

/// The places of the master's keys in a file.
#[derive(Default)]
pub(super) struct MasterPlaces {
    pub(super) program: Span,
    pub(super) device_names: Span,
    pub(super) task_period: Span,
}

/// The places of a step.
#[derive(Default)]
pub(super) struct StepPlaces {
    pub(super) whole: Span,
    /// The order or the expectation.
    pub(super) order: Span,
    pub(super) when: Span,
    pub(super) until: Span,
    pub(super) r#while: Span,
    /// The time of `for`.
    pub(super) span: Span,
    /// The repetition: `repeat` or `random`.
    pub(super) count: Span,
}

impl Places {
    /// The place of a part.
    pub(super) fn of(&self, part: Part) -> Span {
        match part {
            Part::Script => 0..0,
            Part::Limit => self.limit.clone(),
            Part::Cycle => self.cycle.clone(),
            Part::CyclePhase => self.cycle_phase.clone(),
            Part::Unit(at) => self.units.get(at).cloned().unwrap_or_default(),
            Part::MasterProgram => self.master.program.clone(),
            Part::DeviceNames => self.master.device_names.clone(),
            Part::TaskPeriod => self.master.task_period.clone(),
            Part::Step(at, part) => self.steps.get(at).map(|step| step.of(part)).unwrap_or_default(),
        }
    }
}

impl StepPlaces {
    fn of(&self, part: StepPart) -> Span {
        match part {
            StepPart::Whole => self.whole.clone(),
            StepPart::Order => self.order.clone(),
            StepPart::When => self.when.clone(),
            StepPart::Until => self.until.clone(),
            StepPart::While => self.r#while.clone(),
            StepPart::For => self.span.clone(),
            StepPart::Count => self.count.clone(),
        }
    }
}
