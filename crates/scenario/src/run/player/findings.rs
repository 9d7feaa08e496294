//! What a play finds although no expectation fails: expectations that the state before them fulfils, faults that meet no
//! frame, orders that the master has given up and nobody has looked at, steps that come too late.

use std::collections::BTreeMap;

use time::Instant;

use super::verdict::Origin;
use crate::model::{Condition, Trigger};
use crate::run::master::{GivenUp, OrderNumber};
use crate::run::scenario::WrittenStep;
use crate::run::warning::Warning;

/// The findings of a play so far.
pub(super) struct Findings<'a> {
    /// Expectations with `within`, by their addresses.
    within: BTreeMap<usize, Within<'a>>,
    /// The steps that have begun faults of frames, and the numbers of these.
    faults: Vec<(&'a WrittenStep, u32)>,
    /// The steps that have given orders to the master.
    orders: BTreeMap<OrderNumber, &'a WrittenStep>,
    /// The conditions of fulfilled expectations, and when they were.
    looked: Vec<(&'a Condition, Instant)>,
    late: Vec<Warning>,
}

/// The executions of an expectation with `within`.
struct Within<'a> {
    step: &'a WrittenStep,
    /// The first of the orders directly before the next execution, and whether the condition was true before all of them.
    orders: Option<(&'a WrittenStep, bool)>,
    /// The first of the orders before the last execution that the state before them has fulfilled.
    before: Option<&'a WrittenStep>,
    /// An execution was fulfilled by something that came.
    tests_something: bool,
}

impl<'a> Findings<'a> {
    pub(super) const fn new() -> Self {
        Self {
            within: BTreeMap::new(),
            faults: Vec::new(),
            orders: BTreeMap::new(),
            looked: Vec::new(),
            late: Vec::new(),
        }
    }

    /// Before an order the condition of an expectation behind it is true, or not.
    pub(super) fn before_order(
        &mut self,
        order: &'a WrittenStep,
        expectation: &'a WrittenStep,
        is_true: bool,
    ) {
        let orders = &mut self.within(expectation).orders;
        let (first, was_true) = orders.unwrap_or((order, true));
        *orders = Some((first, was_true && is_true));
    }

    /// An expectation looks for the first time.
    pub(super) fn first_look(&mut self, expectation: &'a WrittenStep, is_true: bool) {
        let within = self.within(expectation);
        match within.orders.take() {
            Some((first, true)) if is_true => within.before = Some(first),
            Some(_) | None => within.tests_something = true,
        }
    }

    fn within(&mut self, step: &'a WrittenStep) -> &mut Within<'a> {
        let address = core::ptr::from_ref(step).addr();
        self.within.entry(address).or_insert(Within {
            step,
            orders: None,
            before: None,
            tests_something: false,
        })
    }

    /// A step has begun a fault of frames.
    pub(super) fn fault(&mut self, step: &'a WrittenStep, number: u32) {
        self.faults.push((step, number));
    }

    /// An expectation is fulfilled.
    pub(super) fn fulfilled(&mut self, condition: &'a Condition, now: Instant) {
        self.looked.push((condition, now));
    }

    /// A step has given this order to the master.
    pub(super) fn order(&mut self, step: &'a WrittenStep, number: OrderNumber) {
        self.orders.insert(number, step);
    }

    /// A step or a group begins to wait for its time.
    pub(super) fn begin(&mut self, Origin { line, text }: Origin<'_>, trigger: &Trigger, now: Instant) {
        let (Trigger::At(at), now) = (trigger, now.saturating_since(Instant::ZERO)) else { return };
        if now <= *at || self.late.iter().any(|late| (late.line, late.text.as_str()) == (line, text)) {
            return;
        }
        let message = format!(
            "it is due at {at} and comes at {now}, because the steps before it have lasted until then; `after` is a time after the step before"
        );
        self.late.push(Warning { line, text: text.to_owned(), message });
    }

    /// All of them.
    pub(super) fn warnings(&self, has_met: impl Fn(u32) -> bool, given_up: &[GivenUp]) -> Vec<Warning> {
        let mut warnings = self.late.clone();
        warnings.extend(self.within.values().filter_map(Within::warning));
        warnings.extend(self.idle_faults(has_met));
        warnings.extend(given_up.iter().filter_map(|given_up| self.unseen(given_up)));
        warnings
    }

    /// The steps none of whose faults has met a frame.
    fn idle_faults(&self, has_met: impl Fn(u32) -> bool) -> Vec<Warning> {
        let mut steps: BTreeMap<usize, (&WrittenStep, bool)> = BTreeMap::new();
        for (step, number) in &self.faults {
            let (_, is_met) = steps.entry(core::ptr::from_ref(*step).addr()).or_insert((step, false));
            *is_met |= has_met(*number);
        }
        let idle = steps.into_values().filter(|(_, is_met)| !is_met);
        idle.map(|(step, _)| warning(step, NO_FRAME.to_owned())).collect()
    }

    /// An order that the master has given up, if no later expectation looks at its result.
    fn unseen(&self, given_up: &GivenUp) -> Option<Warning> {
        if self.is_looked_at(given_up) {
            return None;
        }
        let GivenUp { at, order, reason, .. } = given_up;
        let (step, at) = (self.orders.get(order.as_ref()?)?, at.saturating_since(Instant::ZERO));
        let message = format!(
            "the master has given it up at {at} ({reason}), and no expectation looks at that; such as `the master has given up again`, or the state of the unit"
        );
        Some(warning(step, message))
    }

    fn is_looked_at(&self, GivenUp { at, unit, .. }: &GivenUp) -> bool {
        let mut later = self.looked.iter().filter(|(_, looked)| looked >= at);
        later.any(|(condition, _)| looks_at_order(condition, *unit))
    }
}

const NO_FRAME: &str = "no frame has met it: none of its kind was sent in its time, or its numbers select none; the trace shows the frames";

fn warning(step: &WrittenStep, message: String) -> Warning {
    Warning { line: step.line, text: step.text.clone(), message }
}

/// Whether a condition is about the result of an order to this unit.
fn looks_at_order(condition: &Condition, unit: usize) -> bool {
    if !condition.parts().is_empty() {
        return condition.parts().iter().any(|part| looks_at_order(part, unit));
    }
    let is_of_all = matches!(
        condition,
        Condition::MasterGaveUp
            | Condition::MasterGaveUpAgain
            | Condition::SdoRefused { unit: None, .. }
            | Condition::SdoGave { unit: None, .. }
            | Condition::SdoTaken { unit: None }
            | Condition::RegisterGave { .. }
            | Condition::MailboxGave { .. }
            | Condition::MailboxSilent
    );
    is_of_all || condition.clone().unit_words().is_some_and(|words| words.set().has(unit))
}

impl Within<'_> {
    fn warning(&self) -> Option<Warning> {
        let order = self.before.filter(|_| !self.tests_something)?;
        let message = format!(
            "it was true before the order `{}` already, so it tests nothing; `for` checks that something stays true, and `has recorded … again` that an event comes again",
            order.text
        );
        Some(warning(self.step, message))
    }
}
