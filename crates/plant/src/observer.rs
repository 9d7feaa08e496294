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
pub use indicators::port_condition;
use known::Known;
pub use mapping::of as mappings;

/// The slaves of a line.
type Units = Network<Box<dyn ModelUnit>>;

/// A master that has sent no frame for this time is gone.
pub const MASTER_GONE_AFTER: Duration = Duration::from_millis(1_000);
/// Each unit's indicators are compared once in this time, while they can change.
const INDICATORS_AGAIN: Duration = Duration::from_millis(50);
/// Turns in this time at most: on a longer line, several units have the same turn.
const TURNS_MAX: usize = 10;
/// After the last frame and the last change, indicators can change for the time that a port counts as active after a
/// frame. Then each is compared once more.
const INDICATORS_CHANGE_FOR: Duration = Duration::from_millis(150);

/// What is known of a line and its units.
#[derive(Debug)]
pub struct Observer {
    units: Vec<Known>,
    /// The time of the last frame of the master; none: there is no master.
    last_frame: Option<Instant>,
    /// Whose indicators are compared next, and when.
    next_indicators: (usize, Instant),
    /// The last frame or change of a unit.
    last_news: Instant,
}

impl Observer {
    /// Nothing is known of so many units: the first look reports what differs from a unit in INIT without a link.
    #[must_use]
    pub fn new(units: usize) -> Self {
        let units = (0..units).map(|_| Known::default()).collect();
        Self { units, last_frame: None, next_indicators: (0, Instant::ZERO), last_news: Instant::ZERO }
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
        observer.next_indicators.1 = now;
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
        self.last_news = now;
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

    /// Compares the indicators of all units whose turn has come: every unit has its turn within 50 ms.
    pub fn next_indicators(&mut self, now: Instant, units: &Units, mut report: impl FnMut(Happening)) {
        let (first, due) = self.next_indicators;
        if now < due || units.is_empty() {
            return;
        }
        let turns = units.len().min(TURNS_MAX);
        let pause_ns = INDICATORS_AGAIN.as_nanos() / turns as u64;
        let late_ns = now.saturating_since(due).as_nanos();
        let have_come = 1 + late_ns / pause_ns;
        let have_come = usize::try_from(have_come).unwrap_or(turns).min(turns);
        let count = (units.len().div_ceil(turns) * have_come).min(units.len());
        self.next_indicators =
            ((first + count) % units.len(), now + Duration::from_nanos(pause_ns - late_ns % pause_ns));
        for position in (first..first + count).map(|position| position % units.len()) {
            self.indicators(now, position, units, &mut report);
        }
    }

    /// A frame of the master has arrived.
    #[inline]
    pub fn frame(&mut self, now: Instant, mut report: impl FnMut(Happening)) {
        self.last_news = now;
        if self.last_frame.replace(now).is_none() {
            report(of_line(now, HappeningKind::Master { present: true }));
        }
    }

    /// Checks whether the master is gone.
    #[inline]
    pub fn master(&mut self, now: Instant, mut report: impl FnMut(Happening)) {
        if now >= self.master_is_gone() {
            self.last_frame = None;
            report(of_line(now, HappeningKind::Master { present: false }));
        }
    }

    /// When [`Observer::master`] and [`Observer::next_indicators`] are to be called at the latest.
    #[inline]
    #[must_use]
    pub fn deadline(&self) -> Instant {
        let (_, turn) = self.next_indicators;
        let turn = if turn <= self.last_news + INDICATORS_CHANGE_FOR { turn } else { Instant::NEVER };
        turn.min(self.master_is_gone())
    }

    #[inline]
    fn master_is_gone(&self) -> Instant {
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
