//! The units on which an order has its effect.

use core::ops::Range;

use super::outcome::Outcome;
use crate::model::{UnitSet, WhichUnit};

/// The units on which an order has its effect.
#[derive(Clone, Debug)]
pub(super) enum Reach<'a> {
    /// Those that it names.
    Units(&'a UnitSet),
    /// Those at these positions.
    Places(Range<usize>),
}

impl Reach<'_> {
    pub(super) const ALL: Self = Self::behind(0);

    /// The unit at this position, and all behind it.
    pub(super) const fn behind(position: usize) -> Self {
        Self::Places(position..usize::MAX)
    }

    pub(super) const fn one(unit: &WhichUnit) -> Self {
        let at = unit.position();
        Self::Places(at..at.saturating_add(1))
    }

    pub(super) fn has(&self, unit: &WhichUnit) -> bool {
        self.overlaps(&UnitSet::One(unit.clone()))
    }

    /// Whether it has one of these units.
    pub(super) fn overlaps(&self, units: &UnitSet) -> bool {
        match self {
            Self::Units(own) => own.overlaps(units),
            Self::Places(places) => units.positions(places.end).any(|at| places.contains(&at)),
        }
    }

    /// Whether it has all of these units.
    fn covers(&self, units: &UnitSet) -> bool {
        match (self, units) {
            (Self::Units(UnitSet::All), _) => true,
            (Self::Units(_), UnitSet::All) => false,
            (Self::Units(own), units) => units.positions(usize::MAX).all(|at| own.has(at)),
            (Self::Places(places), UnitSet::All) => *places == (0..usize::MAX),
            (Self::Places(places), units) => units.positions(usize::MAX).all(|at| places.contains(&at)),
        }
    }

    /// What becomes of a condition that holds if it does of each of these units.
    pub(super) fn decides(&self, units: &UnitSet, is_true: bool) -> Outcome {
        match is_true {
            true if self.covers(units) => Outcome::True,
            false if self.overlaps(units) => Outcome::False,
            true | false => Outcome::Open,
        }
    }
}
