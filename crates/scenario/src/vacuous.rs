//! Expectations that test nothing: the scenario passes although the expectation is turned into its contrary, or whatever
//! the orders before it do.
//!
//! | expectation | contrary |
//! |---|---|
//! | now | the condition is false now |
//! | `within` a time | it is false at every time until this time has passed, the end included |
//! | `for` a time | it is false at some time before this time has passed |
//! | `never` | it is true at some time before the end |
//! | `while` another holds | at some time before the end the other one is true and it is false |
//! | `until` another is true | it is false at every time until the other one is true |
//! | `never`, `until` another is true | it is true at every time until the other one is true |
//!
//! A fulfilled expectation fulfils its contrary too only if it was not looked at. `within` tests nothing also if the
//! condition has been true from before the orders directly before it until the expectation: the state from before the
//! orders fulfils it. If the player knows that an order ends the condition, it waits until the condition has been false,
//! and the expectation counts. This is looked for outside of groups.
//!
//! A replay with one contrary is the same until the time of its step.

use time::Duration;

use crate::model::{Condition, Expectation, Mode, Order, Step, Trigger};
use crate::run::{PlayedStep, Recording, Scenario, WrittenStep, each_step, ends, is_work, play};

/// The expectations of a scenario, and those among them that test nothing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Vacuity {
    /// Number of expectations.
    pub expectations: usize,
    /// Those whose contrary is fulfilled too, in the order of the steps.
    pub vacuous: Vec<VacuousStep>,
}

/// An expectation that tests nothing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VacuousStep {
    /// Its line in the file, from 1.
    pub line: usize,
    /// Its sentence.
    pub text: String,
}

impl Scenario {
    /// Replays the scenario, which must pass with this seed, once for each expectation, with the contrary of this one.
    #[must_use]
    pub fn vacuity(&self, seed: u64) -> Vacuity {
        let steps = self.all_steps(seed);
        let mut vacuity = Vacuity::default();
        for (place, step) in each_step(&steps).into_iter().enumerate() {
            let Order::Expect(expectation) = &step.step.order else { continue };
            vacuity.expectations += 1;
            let mut turned = steps.clone();
            set_expectation(&mut turned, place, &contrary(expectation));
            let is_vacuous =
                !self.fails_in(step, &turned, seed) || self.is_fulfilled_before(step, &steps, seed);
            if is_vacuous {
                vacuity.vacuous.push(VacuousStep { line: step.line, text: step.text.clone() });
            }
        }
        vacuity
    }

    /// Whether the condition of an expectation with `within` is true before the orders directly before it, and after them.
    fn is_fulfilled_before(&self, step: &WrittenStep, steps: &[PlayedStep], seed: u64) -> bool {
        let Order::Expect(Expectation { condition, mode: Mode::Within(_) }) = &step.step.order else {
            return false;
        };
        let is_it =
            |entry: &PlayedStep| matches!(entry, PlayedStep::Step(other) if core::ptr::eq(other, step));
        let Some(place) = steps.iter().position(is_it) else { return false };
        let Some(first) = first_order_before(place, steps) else { return false };
        let orders = each_step(steps.get(first..place).unwrap_or_default());
        if orders
            .iter()
            .any(|order| ends(&order.step.order, condition) || is_work(&order.step.order, condition))
        {
            return false;
        }
        let now = Order::Expect(Expectation { condition: condition.clone(), mode: Mode::Now });
        let mut turned = steps.to_vec();
        let Some(PlayedStep::Step(order)) = turned.get_mut(first) else { return false };
        let trigger = core::mem::replace(&mut order.step.trigger, Trigger::AtOnce);
        let before = Step { trigger, order: now.clone(), repetition: None };
        if let Some(PlayedStep::Step(step)) = turned.get_mut(place) {
            step.step.order = now;
        }
        let before = WrittenStep { step: before, line: step.line, text: step.text.clone() };
        turned.insert(first, PlayedStep::Step(before));
        !self.fails_in(step, &turned, seed)
    }

    /// Whether the replay of these steps fails in this one. One that fails in a later step has passed this one.
    fn fails_in(&self, step: &WrittenStep, steps: &[PlayedStep], seed: u64) -> bool {
        let report = play(self, steps, seed, Recording::new(false, false));
        report.failure.is_some_and(|failure| (failure.line, &failure.text) == (step.line, &step.text))
    }
}

/// Replaces the expectation of the step at this place among all steps.
fn set_expectation(entries: &mut [PlayedStep], place: usize, expectation: &Expectation) {
    fn set(entries: &mut [PlayedStep], left: &mut usize, expectation: &Expectation) {
        for entry in entries {
            match entry {
                PlayedStep::Step(step) => {
                    if *left == 0 {
                        step.step.order = Order::Expect(expectation.clone());
                    }
                    *left = left.wrapping_sub(1);
                }
                PlayedStep::Group(group) => {
                    group.members.sequences_mut().iter_mut().for_each(|steps| set(steps, left, expectation));
                }
            }
        }
    }
    let mut left = place;
    set(entries, &mut left, expectation);
}

/// The first of the orders directly before a step that is due at once.
fn first_order_before(place: usize, steps: &[PlayedStep]) -> Option<usize> {
    let at_once = |place: usize| match steps.get(place)? {
        PlayedStep::Step(step) => Some((step, step.step.trigger == Trigger::AtOnce)),
        PlayedStep::Group(_) => None,
    };
    let mut first = place;
    while at_once(first).is_some_and(|(_, is_at_once)| is_at_once) {
        let before = first.checked_sub(1);
        let Some((before, (step, _))) = before.and_then(|before| Some((before, at_once(before)?))) else {
            break;
        };
        if matches!(step.step.order, Order::Expect(_)) {
            break;
        }
        first = before;
    }
    (first < place).then_some(first)
}

/// The shortest time.
const NANOSECOND: Duration = Duration::from_nanos(1);

fn contrary(Expectation { condition, mode }: &Expectation) -> Expectation {
    let not = || Condition::Not(Box::new(condition.clone()));
    // Whenever it is true it is true, and it is true at some time.
    let sometimes = |condition: Condition| Expectation { mode: Mode::While(condition.clone()), condition };
    match mode {
        Mode::Now => Expectation { condition: not(), mode: Mode::Now },
        Mode::Within(limit) => Expectation { condition: not(), mode: Mode::For(*limit + NANOSECOND) },
        Mode::For(span) => {
            let limit = Duration::from_nanos(span.as_nanos().saturating_sub(1));
            Expectation { condition: not(), mode: Mode::Within(limit) }
        }
        Mode::Never => sometimes(condition.clone()),
        Mode::While(only) => sometimes(Condition::AllOf(vec![only.clone(), not()])),
        Mode::Until(end) => Expectation { condition: condition.clone(), mode: Mode::NeverUntil(end.clone()) },
        Mode::NeverUntil(end) => Expectation { condition: condition.clone(), mode: Mode::Until(end.clone()) },
    }
}

#[cfg(test)]
mod tests {
    use crate::Scenario;

    use super::*;

    fn scenario(steps: &str) -> Scenario {
        let text = format!(
            "title = \"t\"\nlimit = \"2s\"\nsteps = [\n{{ master = \"take unit 1 to OP\" }},\n{steps}\n]\n"
        );
        Scenario::parse(&text, |_| Err(String::new())).unwrap_or_else(|errors| panic!("{errors}"))
    }

    #[test]
    fn a_within_that_the_state_before_the_orders_fulfils_tests_nothing() {
        let head = "{ after = \"500ms\", expect = \"unit 1 is in OP\" },\n";
        let lines = |steps: &str| {
            let scenario = scenario(&format!("{head}{steps}"));
            assert_eq!(scenario.replay(1, Recording::new(false, false)).failure, None, "{steps}");
            let vacuous = scenario.vacuity(1).vacuous;
            vacuous.iter().map(|step| step.line).collect::<Vec<_>>()
        };
        let within = "{ expect = \"unit 1 is in OP\", within = \"50ms\" }";
        let lose = "{ line = \"lose 1 % of the frames for 10ms\" }";
        assert_eq!(lines(&format!("{lose},\n{within}")), [7]);
        assert_eq!(
            lines(&format!(
                "{{ after = \"1ms\", line = \"be quiet\" }},\n{{ unit = \"reset the errors of unit 1\" }},\n{within}"
            )),
            [8]
        );
        let none: [usize; 0] = [];
        assert_eq!(
            lines("{ line = \"unplug cable 1\" },\n{ expect = \"unit 1 is in OP\", for = \"50ms\" }"),
            none
        );
        assert_eq!(
            lines(
                "{ line = \"unplug cable 1\" },\n{ expect = \"unit 1 is in SAFE-OP with AL status code 0x001B\", within = \"150ms\" }"
            ),
            none
        );
        assert_eq!(
            lines("{ unit = \"restart unit 1\" },\n{ expect = \"unit 1 is in INIT\", within = \"50ms\" }"),
            none
        );
    }

    #[test]
    fn the_contrary_of_each_kind_of_expectation_fails_where_the_expectation_passes() {
        for steps in [
            "{ after = \"500ms\", expect = \"unit 1 is in OP\" }",
            "{ expect = \"unit 1 is in OP\", within = \"500ms\" }",
            "{ after = \"500ms\", expect = \"unit 1 is in OP\", for = \"50ms\" }",
            "{ never = \"unit 1 has recorded 85000000\" },\n{ expect = \"unit 1 is in OP\", within = \"500ms\" }",
            "{ never = \"unit 1 has recorded 85000000\", until = \"unit 1 is in OP\" }",
            "{ when = \"unit 1 is in PRE-OP\", expect = \"unit 1 has no error\", until = \"unit 1 is in OP\" }",
            "{ expect = \"unit 1 has no error\", while = \"unit 1 is in OP\" },\n\
             { expect = \"unit 1 is in OP\", within = \"500ms\" }",
        ] {
            let scenario = scenario(steps);
            let report = scenario.replay(1, Recording::new(false, false));
            assert_eq!(report.failure, None, "{steps}");
            let Vacuity { expectations, vacuous } = scenario.vacuity(1);
            assert!(expectations > 0 && vacuous.is_empty(), "{steps}: {vacuous:?}");
        }
    }
}
