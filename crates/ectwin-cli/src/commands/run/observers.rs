//! Several observers of frames as one.

use link::{Observer, Seen};
use time::Instant;

/// Observers that see the same frames, one after the other.
#[derive(Default)]
pub(crate) struct Observers<'a>(Vec<&'a mut dyn Observer>);

impl<'a> Observers<'a> {
    /// Adds one, if there is one.
    pub(crate) fn add<O: Observer>(&mut self, observer: Option<&'a mut O>) {
        self.0.extend(observer.map(|observer| observer as &mut dyn Observer));
    }

    /// All of them; none if there are none, so that no frame is copied for them.
    pub(crate) fn as_one(&mut self) -> Option<&mut (dyn Observer + '_)> {
        if self.0.is_empty() { None } else { Some(self as &mut dyn Observer) }
    }
}

impl Observer for Observers<'_> {
    fn frame(&mut self, seen: Seen<'_>) {
        self.0.iter_mut().for_each(|observer| observer.frame(seen));
    }

    fn late_answer(&mut self, answered: Instant, answer: &[u8]) {
        self.0.iter_mut().for_each(|observer| observer.late_answer(answered, answer));
    }
}
