//! Single accesses to a line and single dialogues with it, without a master, in virtual time.

use time::{Duration, Instant};
use wire::{FrameBuilder, Returned, returned_datagrams};

use crate::access::{Access, Address, Answer, Dialogue, Progress};
use crate::connected::Line;

/// Time between two reads of a status, if no time passes before an access.
const POLL_PERIOD: Duration = Duration::from_micros(100);

/// A line that is accessed datagram by datagram: for sequences that a [`crate::Master`] never uses, such as a state without
/// its set-up. It knows no slaves, and repeats nothing that was lost.
///
/// ```
/// use master::{Address, DirectAccess, Line};
/// use time::{Duration, Instant};
///
/// /// A line without slaves: every frame comes back as it was sent.
/// struct Loop;
///
/// impl Line for Loop {
///     fn frame(&mut self, _now: Instant, _frame: &mut [u8]) -> bool {
///         true
///     }
///
///     fn poll(&mut self, _now: Instant) {}
///
///     fn deadline(&self) -> Instant {
///         Instant::NEVER
///     }
/// }
///
/// let mut access = DirectAccess::new(Loop, Instant::ZERO);
/// assert_eq!(access.write(Address::Position(0), 0x0120, &[0x02, 0x00]), 0, "no slave has accepted it");
/// access.run_for(Duration::from_millis(1));
/// ```
#[derive(Debug)]
pub struct DirectAccess<L> {
    /// The line.
    pub line: L,
    /// Time that passes before each access; zero at first.
    pub pace: Duration,
    now: Instant,
}

impl<L: Line> DirectAccess<L> {
    /// Accesses a line from `now` on.
    #[must_use]
    pub const fn new(line: L, now: Instant) -> Self {
        Self { line, pace: Duration::ZERO, now }
    }

    /// The present time.
    #[must_use]
    pub const fn now(&self) -> Instant {
        self.now
    }

    /// Advances the time; work that becomes due is done at its time.
    pub fn run_for(&mut self, duration: Duration) {
        self.run_to(self.now + duration);
    }

    /// Advances the time to `end`, unless that has passed.
    pub fn run_to(&mut self, end: Instant) {
        while self.line.deadline() <= end {
            self.now = self.now.max(self.line.deadline());
            self.line.poll(self.now);
        }
        self.now = self.now.max(end);
        self.line.poll(self.now);
    }

    /// Sends any frame at the present time; returns its datagrams, none if it does not come back.
    pub fn pass(&mut self, frame: &mut [u8]) -> Vec<Returned> {
        let comes_back = self.line.frame(self.now, frame);
        self.line.poll(self.now);
        if comes_back { returned_datagrams(frame) } else { Vec::new() }
    }

    /// Reads bytes. Zeros with working counter 0 if no slave has this address, or the frame does not come back.
    pub fn read(&mut self, address: Address, offset: u16, length_bytes: u16) -> (Vec<u8>, u16) {
        let returned = self.access(address, &Access::Read { offset, length_bytes });
        returned.map_or_else(
            || (vec![0; length_bytes.into()], 0),
            |returned| (returned.data, returned.working_counter),
        )
    }

    /// Writes bytes; returns the number of slaves that have accepted them.
    pub fn write(&mut self, address: Address, offset: u16, data: &[u8]) -> u16 {
        let returned = self.access(address, &Access::Write { offset, data });
        returned.map_or(0, |returned| returned.working_counter)
    }

    /// Executes a dialogue; returns whether it was complete within `patience`.
    pub fn execute(
        &mut self,
        address: Address,
        dialogue: &mut (impl Dialogue + ?Sized),
        patience: Duration,
    ) -> bool {
        let end = self.now + patience;
        while self.now <= end {
            let returned = self.access(address, &dialogue.access());
            let answer = returned
                .as_ref()
                .map(|returned| Answer { working_counter: returned.working_counter, data: &returned.data });
            let progress = dialogue.answer(answer);
            if progress == Progress::Done {
                return true;
            }
            if self.pace.is_zero() && (progress == Progress::Later || returned.is_none()) {
                self.run_for(POLL_PERIOD);
            }
        }
        false
    }

    fn access(&mut self, address: Address, access: &Access<'_>) -> Option<Returned> {
        self.run_for(self.pace);
        let mut frame = FrameBuilder::new();
        access.add_to(&mut frame, address);
        self.pass(&mut frame.finish()).into_iter().next()
    }
}
