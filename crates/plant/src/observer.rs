//! The observer of a line: it compares each unit that may have changed with what it knew, and reports the differences.
//!
//! It is called by code that runs a line, after each step, in virtual time and in real time alike. It allocates at the
//! beginning only.

mod indicators;
mod known;
mod mapping;

use device::{Device, Network};
use esc::Esc;
use time::{Duration, Instant};
use unit_model::ModelUnit;

use crate::happening::{Happening, HappeningKind};
use known::Known;

/// The slaves of a line.
type Units = Network<Box<dyn ModelUnit>>;

/// A master that has sent no frame for this time is gone.
pub const MASTER_GONE_AFTER: Duration = Duration::from_millis(1_000);
/// Each unit's indicators are compared once in this time.
const INDICATORS_AGAIN: Duration = Duration::from_millis(50);

/// What is known of a line and its units.
#[derive(Debug)]
pub struct Observer {
    units: Vec<Known>,
    /// The time of the last frame of the master; none: there is no master.
    last_frame: Option<Instant>,
    /// Whose indicators are compared next, and when.
    next_indicators: (usize, Instant),
}

impl Observer {
    /// Nothing is known of so many units: the first look reports what differs from a unit in INIT without a link.
    #[must_use]
    pub fn new(units: usize) -> Self {
        let units = (0..units).map(|_| Known::default()).collect();
        Self { units, last_frame: None, next_indicators: (0, Instant::ZERO) }
    }

    /// An observer that begins with this line as it is. What has happened before is not reported.
    #[must_use]
    pub fn beginning_with(units: &mut Units, now: Instant) -> Self {
        let mut observer = Self::new(units.len());
        for position in 0..units.len() {
            if let Some((device, esc)) = units.slave_mut(position) {
                observer.unit(now, position, device, esc, |_| ());
            }
            observer.indicators(now, position, units, |_| ());
        }
        observer
    }

    /// Another unit has taken this place: nothing is known of it.
    pub fn is_replaced(&mut self, position: usize) {
        if let Some(known) = self.units.get_mut(position) {
            *known = Known::default();
        }
    }

    /// Compares a unit that may have changed: first its events, then its state, then the rest.
    pub fn unit(
        &mut self,
        now: Instant,
        position: usize,
        device: &mut Device<Box<dyn ModelUnit>>,
        esc: &Esc,
        mut report: impl FnMut(Happening),
    ) {
        let Some(known) = self.units.get_mut(position) else { return };
        known.compare(now, device, esc, |kind| report(of_unit(now, position, kind)));
    }

    /// Compares the indicators of a unit.
    pub fn indicators(
        &mut self,
        now: Instant,
        position: usize,
        units: &Units,
        mut report: impl FnMut(Happening),
    ) {
        let Some(known) = self.units.get_mut(position) else { return };
        indicators::compare(now, position, units, &mut known.patterns, |kind| {
            report(of_unit(now, position, kind));
        });
    }

    /// Compares the indicators of the unit whose turn it is, if it is time for it: every unit has its turn within 50 ms.
    pub fn next_indicators(&mut self, now: Instant, units: &Units, report: impl FnMut(Happening)) {
        let (position, due) = self.next_indicators;
        if now < due || units.is_empty() {
            return;
        }
        let pause_ns = INDICATORS_AGAIN.as_nanos() / units.len() as u64;
        self.next_indicators = ((position + 1) % units.len(), now + Duration::from_nanos(pause_ns));
        self.indicators(now, position, units, report);
    }

    /// A frame of the master has arrived.
    #[inline]
    pub fn frame(&mut self, now: Instant, mut report: impl FnMut(Happening)) {
        if self.last_frame.replace(now).is_none() {
            report(of_line(now, HappeningKind::Master { present: true }));
        }
    }

    /// Checks whether the master is gone.
    #[inline]
    pub fn master(&mut self, now: Instant, mut report: impl FnMut(Happening)) {
        if now >= self.deadline() {
            self.last_frame = None;
            report(of_line(now, HappeningKind::Master { present: false }));
        }
    }

    /// When [`Observer::master`] is to be called at the latest.
    #[inline]
    #[must_use]
    pub fn deadline(&self) -> Instant {
        self.last_frame.map_or(Instant::NEVER, |last| last + MASTER_GONE_AFTER)
    }
}

/// Something that concerns the whole line.
#[must_use]
pub const fn of_line(at: Instant, kind: HappeningKind) -> Happening {
    Happening { at, position: None, kind }
}

fn of_unit(at: Instant, position: usize, kind: HappeningKind) -> Happening {
    Happening { at, position: u16::try_from(position).ok(), kind }
}
