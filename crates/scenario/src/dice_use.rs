//! Whether the seed of a scenario decides anything: a scenario in which it does not gives the same bytes with each seed.
//!
//! The seed is used for random steps, for the jitter of repetitions, for random faults of frames, and for the phases that
//! the files leave out. Where it is not sure that a random number has no effect, the scenario counts as one with dice.

use crate::model::{Delay, LineOrder, Members, Order, Step};
use crate::run::{PlayedStep, Scenario, UnitSource, WrittenStep};

impl Scenario {
    /// Whether its replay may depend on the seed.
    #[must_use]
    pub fn has_dice(&self) -> bool {
        let units =
            self.units.iter().chain(self.brought.replacements.iter().map(|replacement| &replacement.source));
        !self.random.is_empty()
            || self.cycle_phase.is_none()
            || units.into_iter().any(UnitSource::has_dice)
            || self.steps.iter().any(PlayedStep::has_dice)
    }
}

impl UnitSource {
    /// Whether its phases are random, or values of its variables.
    fn has_dice(&self) -> bool {
        let section = self.file.section();
        let has_refresh_phase = section.refresh_period().is_some() && !section.names_refresh_phase();
        has_refresh_phase || self.file.cpu().task_phase.is_none() || self.file.behaviours().is_random()
    }
}

impl PlayedStep {
    fn has_dice(&self) -> bool {
        match self {
            Self::Step(step) => step.has_dice(),
            Self::Group(group) => {
                let has_jitter = match &group.members {
                    Members::Repeat { repetition, steps: _ } => !repetition.jitter.is_zero(),
                    Members::Sequence(_) | Members::Together(_) => false,
                };
                has_jitter || group.members.sequences().iter().flatten().any(Self::has_dice)
            }
        }
    }
}

impl WrittenStep {
    fn has_dice(&self) -> bool {
        let Step { trigger: _, order, repetition } = &self.step;
        let has_jitter = repetition.is_some_and(|repetition| !repetition.jitter.is_zero());
        has_jitter || has_random_fault(order)
    }
}

fn has_random_fault(order: &Order) -> bool {
    match order {
        Order::Line(LineOrder::Disturb(disturbance)) => {
            disturbance.frames.choice.is_random() || disturbance.fault.delay().is_some_and(Delay::is_random)
        }
        Order::Line(
            LineOrder::Unplug { .. } | LineOrder::Plug { .. } | LineOrder::End { .. } | LineOrder::BeQuiet,
        )
        | Order::Master(_)
        | Order::Unit(_)
        | Order::Cpu(_)
        | Order::Expect(_) => false,
    }
}

#[cfg(test)]
mod tests {
    use crate::{Recording, Scenario};

    const PHASES: &str = "cycle_phase = \"0us\"\n\
        units = [{ model = \"nx-ect101\", refresh_phase = \"0us\", cpu.task_phase = \"0us\" }]\n";

    fn scenario(head: &str, step: &str) -> Scenario {
        let text = format!(
            "title = \"t\"\n{head}steps = [\n{{ master = \"take unit 1 to OP\" }},\n{step},\n\
             {{ after = \"500ms\", expect = \"the master has nothing to do\" }} ]\n"
        );
        Scenario::parse(&text, |_| Err(String::new())).unwrap_or_else(|errors| panic!("{errors}"))
    }

    #[test]
    fn a_phase_a_jitter_and_a_random_fault_are_dice() {
        let fixed = "{ line = \"lose the next 3 frames\" }";
        assert!(!scenario(PHASES, fixed).has_dice());
        for head in [
            PHASES.replace("cycle_phase = \"0us\"\n", ""),
            PHASES.replace(" refresh_phase = \"0us\",", ""),
            PHASES.replace(", cpu.task_phase = \"0us\"", ""),
        ] {
            assert!(scenario(&head, fixed).has_dice(), "{head}");
        }
        for step in [
            "{ line = \"lose 5 % of the frames\" }",
            "{ line = \"lose 5 per mille of the frames\" }",
            "{ line = \"delay all frames by 1ms to 3ms\" }",
            "{ line = \"be quiet\", repeat = 3, every = \"5ms\", jitter = \"1ms\" }",
            "{ random = { steps = 2 }, within = \"20ms\" }",
            "{ repeat = 3, every = \"5ms\", jitter = \"1ms\", steps = [{ line = \"be quiet\" }] }",
            "{ together = [{ line = \"lose 5 % of the frames\" }, { line = \"be quiet\" }] }",
        ] {
            assert!(scenario(PHASES, step).has_dice(), "{step}");
        }
        assert!(!scenario(PHASES, "{ line = \"delay all frames by 1ms\" }").has_dice());
        assert!(!scenario(PHASES, "{ line = \"be quiet\", repeat = 3, every = \"5ms\" }").has_dice());
    }

    #[test]
    fn without_dice_each_seed_gives_the_same_bytes() {
        let replay = |head: &str, seed| {
            let report = scenario(head, "{ line = \"lose the next 3 frames\" }")
                .replay(seed, Recording::new(true, true));
            (report.recording.trace().map(str::to_owned), report.recording.into_capture())
        };
        let same = |head: &str| (2..10).all(|seed| replay(head, seed) == replay(head, 1));
        assert!(same(PHASES));
        assert!(!same(&PHASES.replace("cycle_phase = \"0us\"\n", "")));
    }
}
