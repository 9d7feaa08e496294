//! Orders that the master has given up.

use time::Instant;

/// The number of an order of a step, from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct OrderNumber(u64);

/// An order that the master has given up.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct GivenUp {
    pub(crate) at: Instant,
    /// The position of the unit.
    pub(crate) unit: usize,
    /// The order; none: the master has done it by itself.
    pub(crate) order: Option<OrderNumber>,
    pub(crate) reason: String,
}

/// The orders so far, and those that were given up.
#[derive(Debug, Default)]
pub(super) struct OrdersGivenUp {
    ordered: u64,
    list: Vec<GivenUp>,
    /// Those before this one are from before the last start of the master.
    start: usize,
    /// Those before this one are from before the orders directly before the present step.
    mark: usize,
}

impl OrdersGivenUp {
    /// A step gives an order.
    pub(super) const fn order(&mut self) {
        self.ordered += 1;
    }

    /// The order that was given last.
    pub(super) fn last(&self) -> Option<OrderNumber> {
        (self.ordered > 0).then_some(OrderNumber(self.ordered))
    }

    pub(super) fn add(&mut self, given_up: GivenUp) {
        self.list.push(given_up);
    }

    /// The master starts: what it has given up is the past.
    pub(super) const fn start(&mut self) {
        self.start = self.list.len();
    }

    pub(super) const fn mark(&mut self) {
        self.mark = self.list.len();
    }

    pub(super) fn all(&self) -> &[GivenUp] {
        &self.list
    }

    /// Whether there is one since the last start.
    pub(super) const fn any(&self) -> bool {
        self.list.len() > self.start
    }

    /// Whether there is one since the mark.
    pub(super) const fn any_again(&self) -> bool {
        self.any() && self.list.len() > self.mark
    }
}
