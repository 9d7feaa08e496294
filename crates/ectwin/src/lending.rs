//! What a line needs to be lent to orders, in both times.

use plant::line::{ActiveFault, LineRefusal};
use scenario::model::{LineOrder, Order, UnitOrder};
use scenario::{LineHands, Notes};
use time::Instant;

use crate::disturbed::{Disturbed, Units};

/// The place whose unit an order replaces by another one.
pub(crate) fn replaced_place(order: &Order) -> Option<usize> {
    match order {
        Order::Unit(UnitOrder::Replace { unit, .. }) => Some(unit.position()),
        _ => None,
    }
}

/// The faults of the line, and of its frames.
impl LineHands for Disturbed {
    fn order(&mut self, now: Instant, order: &LineOrder, network: &mut Units) -> Result<(), LineRefusal> {
        self.order(now, order, network)
    }

    fn each_active(&self, now: Instant, show: &mut dyn FnMut(ActiveFault<'_>)) {
        self.active(now).for_each(show);
    }
}

/// What an order does in addition to its effect is not taken down.
pub(crate) struct NoNotes;

impl Notes for NoNotes {
    fn tell(&mut self, _: Instant, _: &str, _: &str) {}
}
