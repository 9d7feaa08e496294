//! Steps: whether they are possible, one after the other, and refer to existing names.

use time::Duration;

use super::maker::Maker;
use super::ordered::Ordered;
use super::problem::{Part, StepPart};
use super::programs::{Lasting, loads};
use super::reach::{Subject, line_of, missing_cable, subject};
use super::written::Written;
use crate::model::{
    Condition, Expectation, LOGIC_DEPTH_MAX, LineOrder, Mode, Order, Repetition, ScriptStep, Step, Trigger,
};
use crate::run::{PlayedStep, RandomPart, WrittenStep};
use crate::words::Spoken;

/// Maximum number of repetitions of a step, and of random steps.
pub(super) const STEPS_MAX: u64 = 10_000;

/// The executable steps, and the position of the random ones.
#[derive(Default)]
pub(super) struct ReadySteps {
    pub(super) steps: Vec<PlayedStep>,
    pub(super) random: Vec<RandomPart>,
    /// The earliest time of the next step.
    reached: Duration,
}

/// Where a step is.
#[derive(Clone, Copy)]
pub(super) struct Place {
    /// Its number among all steps and groups, from 0.
    pub(super) at: usize,
    /// The earliest time at which it is due.
    pub(super) reached: Duration,
    /// Number of groups around it.
    pub(super) depth: usize,
    /// One of them is repeated.
    pub(super) is_repeated: bool,
}

/// Whether steps can be checked against units and programs.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Ground {
    /// All of them are correct.
    Firm,
    /// A unit or a program has mistakes, so it is unknown which names exist.
    Missing,
}

impl Maker<'_> {
    pub(super) fn steps(
        &mut self,
        steps: Vec<ScriptStep>,
        written: Vec<Written>,
        limit: Duration,
        ground: Ground,
    ) -> ReadySteps {
        let mut ready = ReadySteps::default();
        self.loads = loads(&steps);
        self.ordered = Ordered::by(&steps);
        self.limit = limit;
        let mut written = written.into_iter();
        for step in steps {
            let place = Place { at: self.entries, reached: ready.reached, depth: 0, is_repeated: false };
            if let ScriptStep::Random(random) = step {
                self.entries += 1;
                self.forget_standing();
                if let Some(written) = written.next() {
                    self.random(place.at, random, written, ground, &mut ready);
                }
            } else if let Some((step, reached)) = self.entry(step, &mut written, place, ground) {
                ready.steps.push(step);
                ready.reached = reached;
            }
        }
        ready
    }

    /// The executable form of a step or a group, and the earliest time of its end; none if it has none.
    pub(super) fn entry(
        &mut self,
        step: ScriptStep,
        written: &mut dyn Iterator<Item = Written>,
        place: Place,
        ground: Ground,
    ) -> Option<(PlayedStep, Duration)> {
        let own = written.next()?;
        let at = self.entries;
        self.entries += 1;
        let mut place = Place { at, ..place };
        match step {
            ScriptStep::Random(_) => {
                let message = "random steps are not in a group: `search` writes those of a seed in one place of the file";
                self.refuse(
                    Part::Step(at, StepPart::Whole),
                    message,
                    "place `random` beside the group, such as between two groups",
                );
                None
            }
            ScriptStep::Group(group) => {
                self.check_moment(&mut place, &group.trigger);
                let (group, reached) = self.group(group, own, written, place, ground)?;
                self.forget_standing();
                Some((PlayedStep::Group(group), reached))
            }
            ScriptStep::Step(mut step) => {
                self.check_moment(&mut place, &step.trigger);
                if let Some(repetition) = step.repetition {
                    self.check_repetition(at, repetition);
                }
                let problems = self.problems.len();
                self.check_step(at, &mut step, ground);
                let is_right = self.problems.len() == problems;
                if place.depth == 0 && ground == Ground::Firm && is_right {
                    self.check_does_something(&step.order, Part::Step(at, StepPart::Order));
                }
                let Written { line, text, .. } = own;
                if place.depth == 0 && ground == Ground::Firm {
                    self.warn_if_idle(&step.order, line, &text);
                }
                Some((PlayedStep::Step(WrittenStep { step, line, text }), place.reached))
            }
        }
    }

    /// Times from the start that run backwards, or are after the limit, are impossible.
    fn check_moment(&mut self, place: &mut Place, trigger: &Trigger) {
        let Place { at, reached, is_repeated, .. } = place;
        let part = Part::Step(*at, StepPart::Whole);
        let limit = self.limit;
        let moment = match trigger {
            Trigger::At(_) if *is_repeated => {
                let message = "`at` is a time from the beginning, and a repeated group has several rounds";
                return self.refuse(part, message, "`after` is a time after the step before");
            }
            Trigger::At(moment) if *moment < *reached => {
                let message =
                    format!("{moment} is before the previous step, which is not earlier than {reached}");
                return self.refuse(part, message, "steps happen in the order of the file");
            }
            Trigger::At(moment) => *moment,
            Trigger::After(after) => *reached + *after,
            Trigger::AtOnce | Trigger::When(_) => *reached,
        };
        *reached = moment;
        if moment > limit {
            let message = format!("{moment} is after the limit of {limit}");
            self.refuse(part, message, "set `limit = \"…\"` higher");
        }
    }

    pub(super) fn check_repetition(&mut self, at: usize, Repetition { times, every, jitter }: Repetition) {
        if !(1..=STEPS_MAX).contains(&times) {
            let message = format!("`repeat` is 1 to {STEPS_MAX} times");
            self.refuse(Part::Step(at, StepPart::Count), message, "");
        }
        if every.is_zero() {
            let help = "such as `every = \"10ms\"`";
            self.refuse(Part::Step(at, StepPart::Whole), "a period of 0 repeats nothing in time", help);
        }
        if jitter > every {
            let message = format!("a jitter of {jitter} is more than the period of {every}");
            self.refuse(Part::Step(at, StepPart::Whole), message, "");
        }
    }

    pub(super) fn check_when(&mut self, condition: &mut Condition, at: usize, ground: Ground) {
        self.condition(condition, Part::Step(at, StepPart::When), ground, Lasting::Step);
    }

    fn check_step(&mut self, at: usize, step: &mut Step, ground: Ground) {
        if let Trigger::When(condition) = &mut step.trigger {
            self.check_when(condition, at, ground);
        }
        let part = Part::Step(at, StepPart::Order);
        match &mut step.order {
            Order::Expect(expectation) => {
                let problems = self.problems.len();
                let Expectation { condition, mode } = expectation;
                self.condition(condition, part, ground, Lasting::of(mode));
                self.check_mode(at, mode, ground);
                // What a wrong condition says of every state is unknown.
                if self.problems.len() == problems {
                    self.check_can_change(&expectation.condition, &expectation.mode, part);
                    self.check_can_fail(at, expectation);
                }
            }
            order @ (Order::Master(_) | Order::Unit(_) | Order::Cpu(_) | Order::Line(_)) => {
                self.order(order, part, ground);
            }
        }
    }

    fn check_mode(&mut self, at: usize, mode: &mut Mode, ground: Ground) {
        match mode {
            Mode::Until(until) | Mode::NeverUntil(until) => {
                self.condition(until, Part::Step(at, StepPart::Until), ground, Lasting::Step);
            }
            Mode::While(condition) => {
                self.condition(condition, Part::Step(at, StepPart::While), ground, Lasting::ToTheEnd);
            }
            Mode::For(span) if span.is_zero() => {
                let help = "a time above 0, such as `for = \"100ms\"`; without `for` it is checked once";
                self.refuse(Part::Step(at, StepPart::For), "a `for` of 0 checks nothing that lasts", help);
            }
            Mode::Now | Mode::Within(_) | Mode::Never | Mode::For(_) => {}
        }
    }

    pub(super) fn order(&mut self, order: &mut Order, part: Part, ground: Ground) -> Option<()> {
        match order {
            Order::Master(order) => {
                self.said(order, part)?;
                self.check_addressee(order, part)?;
            }
            Order::Unit(order) => self.said(order, part)?,
            Order::Cpu(order) => self.said(order, part)?,
            Order::Line(order) => {
                self.check_line(order, part)?;
                self.said(order, part)?;
            }
            Order::Expect(_) => {}
        }
        if ground == Ground::Missing {
            return None;
        }
        self.check_units(order.unit_words(), part)?;
        match order {
            Order::Cpu(order) => {
                self.check_words_of_cpu(order, part)?;
                self.check_inputs(order, part)?;
                self.check_variables(order, part)
            }
            Order::Unit(order) => {
                self.check_words_of_order(order, part)?;
                self.unit_files(order, part)
            }
            Order::Master(order) => {
                self.check_sdo(order, part)?;
                self.check_raw(order, part)?;
                self.check_outputs(order, part)
            }
            Order::Line(order) => {
                self.check_mailbox_frames(order, part)?;
                self.check_cable(order, part)
            }
            Order::Expect(_) => Some(()),
        }
    }

    fn check_cable(&mut self, order: &LineOrder, part: Part) -> Option<()> {
        let units = self.units.len();
        let Some(cable) = missing_cable(order, units) else { return Some(()) };
        let help = format!("{}; each cable has the number of the unit behind it", line_of(units));
        self.refuse(part, format!("{cable} does not exist"), help);
        None
    }

    pub(super) fn condition(
        &mut self,
        condition: &mut Condition,
        part: Part,
        ground: Ground,
        lasting: Lasting,
    ) -> Option<()> {
        self.check_depth(condition, part)?;
        self.said(condition, part)?;
        self.check_master_is_there(condition, part)?;
        if ground == Ground::Missing {
            return None;
        }
        self.condition_there(condition, part, lasting)
    }

    /// Whether what a condition is about exists, in each of its parts.
    pub(super) fn condition_there(
        &mut self,
        condition: &mut Condition,
        part: Part,
        lasting: Lasting,
    ) -> Option<()> {
        match condition {
            Condition::Not(inner) => return self.condition_there(inner, part, lasting),
            Condition::AllOf(inner) | Condition::AnyOf(inner) => {
                // The mistakes of all parts are reported.
                let there: Vec<_> =
                    inner.iter_mut().map(|inner| self.condition_there(inner, part, lasting)).collect();
                return there.into_iter().collect();
            }
            _ => {}
        }
        self.check_units(condition.unit_words(), part)?;
        match subject(condition) {
            Subject::Controller(controller) => self.check_controller(controller, condition, part, lasting)?,
            // Without frames all of them are sent, and no answer differs.
            Subject::Capture if !self.has_capture => {
                let help = "name one: `capture = \"….pcapng\"`";
                self.refuse(part, "the scenario has no capture", help);
                return None;
            }
            Subject::Units | Subject::Variable | Subject::Master | Subject::Capture | Subject::Parts => {}
        }
        if matches!(condition, Condition::Cycles { at_least: 0 }) {
            let message = "0 cycles are done at the beginning too, so it always holds";
            self.refuse(part, message, "a number from 1, such as `100 cycles are done`");
            return None;
        }
        if let Condition::Value { of, test } = condition {
            self.check_value(of, test, part, lasting)?;
        }
        self.check_words_of_condition(condition, part)?;
        self.check_can_come(condition, part)?;
        self.check_process_data(condition, part)?;
        self.check_reports(condition, part)?;
        self.resolve(condition, part)?;
        if lasting == Lasting::ToTheEnd {
            self.value_lasts(condition, part);
        }
        Some(())
    }

    /// A value has not changed yet when its step begins.
    pub(super) fn check_can_change(&mut self, condition: &Condition, mode: &Mode, part: Part) {
        let is_checked_at_once = match mode {
            Mode::Now | Mode::For(_) | Mode::Until(_) => true,
            Mode::Within(_) | Mode::Never | Mode::NeverUntil(_) | Mode::While(_) => false,
        };
        if is_checked_at_once && condition.needs_a_change() {
            let message = "no value has changed when the step begins, so it can never hold";
            self.refuse(part, message, "give it time, such as `within = \"100ms\"`");
        }
    }

    /// Refuses conditions that are nested too deep.
    fn check_depth(&mut self, condition: &Condition, part: Part) -> Option<()> {
        let depth = condition.depth();
        if depth > LOGIC_DEPTH_MAX {
            let message =
                format!("conditions are nested {depth} deep, and at most {LOGIC_DEPTH_MAX} are read");
            self.refuse(part, message, "`all of` and `any of` take any number of conditions side by side");
            return None;
        }
        Some(())
    }

    /// Refuses values without a sentence: a byte above 255, an unknown fault, an empty list.
    fn said<T: Spoken>(&mut self, value: &T, part: Part) -> Option<()> {
        match T::from_sentence(&value.sentence()) {
            Ok(_) => Some(()),
            Err(problem) => {
                self.refuse(part, problem.message, problem.help);
                None
            }
        }
    }
}
