//! The places of the parts of a scenario in its file: kept separately from the typed values, for messages.

use core::ops::Range;
use std::rc::Rc;

use user_file::line_and_column;

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
    /// The prelude in which all this is; none: it is in the scenario.
    pub(super) origin: Option<Rc<Origin>>,
    /// Where the scenario uses the prelude.
    pub(super) used_at: Span,
}

/// A prelude.
pub(super) struct Origin {
    pub(super) path: String,
    pub(super) text: String,
}

impl Places {
    /// The place in a prelude, to be followed by a message; none: the part is in the scenario.
    pub(super) fn in_prelude(&self, part: Part) -> Option<String> {
        let Part::Step(at, place) = part else { return None };
        let step = self.steps.get(at)?;
        let Origin { path, text } = &**step.origin.as_ref()?;
        let (line, column) = line_and_column(text, step.of(place).start);
        Some(format!("{path}:{line}:{column}: "))
    }

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
            Part::Step(at, part) => self.steps.get(at).map(|step| step.in_scenario(part)).unwrap_or_default(),
        }
    }
}

impl StepPlaces {
    /// Its place, or that of `use` if it is in a prelude.
    fn in_scenario(&self, part: StepPart) -> Span {
        if self.origin.is_some() { self.used_at.clone() } else { self.of(part) }
    }

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
