//! Process data of all slaves: their places in the logical address space, their values, and the cycle.

mod datagrams;
mod exchange;
mod image;
mod layout;

use core::ops::Range;

use time::{Duration, Instant};
use wire::{AlStatus, Command, FrameBuilder};

use crate::access::{Address, Answer, word};
use crate::channels::FmmuSettings;
use crate::settings::SlaveSettings;

use datagrams::{Content, CyclicDatagram};
use image::Image;
use layout::{Layout, Place};

pub use exchange::{Commands, CycleReport, Exchange, Grouping, StatusRead};

/// The cyclic exchange with all slaves. It sends nothing itself: at its deadline a cycle begins, whose frames
/// are loaded one after the other and whose answers are passed in, datagram by datagram.
#[derive(Debug)]
pub struct ProcessData {
    exchange: Exchange,
    layout: Layout,
    /// The places in the order of their addresses.
    places: Vec<Place>,
    images: Vec<Image>,
    datagrams: Vec<CyclicDatagram>,
    /// The datagrams of each frame.
    frames: Vec<Range<usize>>,
    /// The frame that is loaded next; after the last one the cycle has been sent.
    next_frame: usize,
    next: Instant,
    /// No cycle begins until [`ProcessData::start`].
    is_stopped: bool,
    cycles: u64,
    status: Option<(u16, AlStatus)>,
    slaves: Vec<Participant>,
}

/// A slave and its part in the exchange.
#[derive(Debug)]
struct Participant {
    address: Address,
    is_open: bool,
    separate_commands: bool,
}

impl ProcessData {
    /// An exchange with slaves at these addresses, which have no process data yet.
    #[must_use]
    pub fn new(exchange: Exchange, addresses: impl IntoIterator<Item = Address>) -> Self {
        let participant = |address| Participant { address, is_open: false, separate_commands: false };
        let slaves: Vec<Participant> = addresses.into_iter().map(participant).collect();
        Self {
            exchange,
            layout: Layout::default(),
            images: slaves.iter().map(|_| Image::default()).collect(),
            places: Vec::new(),
            datagrams: Vec::new(),
            frames: Vec::new(),
            next_frame: usize::MAX,
            next: Instant::NEVER,
            is_stopped: false,
            cycles: 0,
            status: None,
            slaves,
        }
    }

    /// The settings of the exchange.
    #[must_use]
    pub const fn exchange(&self) -> Exchange {
        self.exchange
    }

    /// Places the process data of these slaves, and removes those of all slaves before. No slave exchanges them yet.
    pub fn place_all<'a>(&mut self, slaves: impl IntoIterator<Item = (usize, &'a SlaveSettings)>) {
        self.layout = Layout::default();
        let slaves: Vec<_> = slaves.into_iter().collect();
        self.layout.place_all(&slaves, self.exchange.grouping);
        for (slave, settings) in slaves {
            self.clear(slave, settings);
        }
        self.arrange();
    }

    /// Places the process data of a slave after all others, instead of its present place.
    pub fn place(&mut self, slave: usize, settings: &SlaveSettings) {
        self.layout.remove(slave);
        self.layout.place_all(&[(slave, settings)], self.exchange.grouping);
        self.clear(slave, settings);
        self.arrange();
    }

    fn clear(&mut self, slave: usize, settings: &SlaveSettings) {
        if let (Some(participant), Some(image)) = (self.slaves.get_mut(slave), self.images.get_mut(slave)) {
            participant.is_open = false;
            participant.separate_commands = settings.separate_commands;
            *image = Image::of(settings);
        }
    }

    /// Whether the process data of a slave have a place that still fits these settings.
    #[must_use]
    pub fn holds(&self, slave: usize, settings: &SlaveSettings) -> bool {
        self.layout.holds(slave, settings)
    }

    /// The FMMUs that map the process data of a slave.
    pub fn fmmus(&self, slave: usize) -> impl Iterator<Item = FmmuSettings> {
        self.layout.fmmus(slave, self.exchange.origin)
    }

    /// Makes datagrams and frames for all places.
    fn arrange(&mut self) {
        self.places = self.layout.places().to_vec();
        self.places.sort_by_key(|place| place.start);
        let separate = self.slaves.iter().any(|slave| slave.separate_commands);
        let commands = if separate { Commands::Separate } else { self.exchange.commands };
        let addresses: Vec<Address> = self.slaves.iter().map(|slave| slave.address).collect();
        let exchange = Exchange { commands, ..self.exchange };
        self.datagrams = datagrams::datagrams(&self.places, &exchange, &addresses);
        self.frames = datagrams::frames(&self.datagrams);
        self.next_frame = usize::MAX;
        self.expect();
    }

    fn expect(&mut self) {
        let Self { datagrams, places, slaves, .. } = self;
        for datagram in datagrams {
            datagram.expect(places, |slave| slaves.get(slave).is_some_and(|slave| slave.is_open));
        }
    }

    /// A slave takes part from now on. Its inputs are zero at first, unless it already takes part.
    pub fn open(&mut self, slave: usize, now: Instant) {
        let (Some(participant), Some(image)) = (self.slaves.get_mut(slave), self.images.get_mut(slave))
        else {
            return;
        };
        if !core::mem::replace(&mut participant.is_open, true) {
            image.inputs.fill(0);
        }
        self.expect();
        self.begin(now);
    }

    /// A slave no longer takes part. Without any slaves the exchange ends.
    pub fn close(&mut self, slave: usize) {
        if let Some(participant) = self.slaves.get_mut(slave) {
            participant.is_open = false;
        }
        self.expect();
        if !self.is_any_open() {
            self.end();
        }
    }

    /// Whether a slave takes part.
    #[must_use]
    pub fn is_open(&self, slave: usize) -> bool {
        self.slaves.get(slave).is_some_and(|participant| participant.is_open)
    }

    /// Whether any slave takes part.
    #[must_use]
    pub fn is_any_open(&self) -> bool {
        self.slaves.iter().any(|participant| participant.is_open)
    }

    /// Whether process data are exchanged.
    #[must_use]
    pub fn is_running(&self) -> bool {
        self.next != Instant::NEVER
    }

    /// A cycle begins now, unless the exchange is stopped.
    pub fn begin(&mut self, now: Instant) {
        if !self.is_stopped {
            self.next = self.next.min(now);
        }
    }

    /// Exchanges with this period. If a slave takes part, a cycle begins now, and the following ones keep its phase.
    pub fn start(&mut self, now: Instant, period: Duration) {
        self.exchange.period = period;
        self.is_stopped = false;
        if self.is_any_open() {
            self.exchange.phase = now.saturating_since(Instant::ZERO);
            self.next = now;
        }
    }

    /// Sends nothing, until [`ProcessData::start`] or [`ProcessData::allow`].
    pub const fn stop(&mut self) {
        self.is_stopped = true;
        self.end();
    }

    /// Slaves that are opened from now on start the exchange again.
    pub const fn allow(&mut self) {
        self.is_stopped = false;
    }

    const fn end(&mut self) {
        self.next = Instant::NEVER;
        self.next_frame = usize::MAX;
    }

    /// When the next cycle begins.
    #[must_use]
    pub const fn deadline(&self) -> Instant {
        self.next
    }

    /// The first time after `now` that is in phase.
    fn after(&self, now: Instant) -> Instant {
        let first = Instant::ZERO + self.exchange.phase;
        if now < first {
            return first;
        }
        let passed = now.saturating_since(first).as_nanos();
        // A cycle of no length would never end.
        let period = self.exchange.period.max(Duration::from_nanos(1));
        first + period * (passed / period.as_nanos() + 1)
    }

    /// Begins the next cycle if it is due. Missing answers of the cycle before it are ignored from now on.
    pub fn next_cycle(&mut self, now: Instant) -> bool {
        if self.next > now {
            return false;
        }
        self.cycles += 1;
        self.next = self.after(now);
        self.next_frame = 0;
        self.status = None;
        self.datagrams.iter_mut().for_each(|datagram| datagram.working_counter = None);
        self.images.iter_mut().for_each(Image::begin_cycle);
        true
    }

    /// Loads the next frame of this cycle; returns the numbers of its datagrams, an empty range if the cycle
    /// has been sent.
    pub fn load(&mut self, frame: &mut FrameBuilder) -> Range<usize> {
        let Some(numbers) = self.frames.get(self.next_frame).cloned() else { return 0..0 };
        self.next_frame += 1;
        for datagram in &self.datagrams[numbers.clone()] {
            datagram.load(frame, self.exchange.origin, &self.places, &self.images);
        }
        numbers
    }

    /// The command of a datagram and the length of its data.
    pub(crate) fn shape(&self, number: usize) -> Option<(Command, usize)> {
        self.datagrams.get(number).map(CyclicDatagram::shape)
    }

    /// Processes the result of a datagram; returns the AL status of a slave, if the datagram reads it.
    pub fn answer(&mut self, number: usize, answer: Answer<'_>) -> Option<(usize, AlStatus)> {
        let datagram = self.datagrams.get_mut(number)?;
        datagram.working_counter = Some(answer.working_counter);
        datagram.take(answer.data, &self.places, &mut self.images);
        match &datagram.content {
            Content::ProcessData { slaves, .. } => {
                for &slave in slaves {
                    if let Some(image) = self.images.get_mut(slave) {
                        image.count(answer.working_counter);
                    }
                }
                None
            }
            Content::Status => {
                self.status = Some((answer.working_counter, AlStatus::from_bits(word(answer.data))));
                None
            }
            Content::StatusOf { slave, .. } => Some((*slave, AlStatus::from_bits(word(answer.taken()?)))),
        }
    }

    /// The present result of the current cycle.
    #[must_use]
    pub fn report(&self) -> CycleReport {
        let mut report = CycleReport { cycles: self.cycles, status: self.status, ..CycleReport::default() };
        for datagram in &self.datagrams {
            if let Content::ProcessData { expected, .. } = datagram.content {
                report.expected = report.expected.saturating_add(expected);
                match datagram.working_counter {
                    Some(counter) => {
                        report.working_counter = report.working_counter.saturating_add(counter);
                    }
                    None => report.lost += 1,
                }
            }
        }
        report
    }

    /// The working counter of each datagram with process data in the current cycle, none if it has not returned, and the
    /// expected one if every slave that exchanges process data takes part.
    pub fn counters(&self) -> impl Iterator<Item = (Option<u16>, u16)> {
        self.datagrams.iter().filter_map(|datagram| {
            let Content::ProcessData { expected, .. } = datagram.content else { return None };
            Some((datagram.working_counter, expected))
        })
    }

    /// The sum of the working counters of the datagrams that carry the process data of a slave, in the present
    /// cycle, or before the first of them returns in the cycle before. None if none of them returned there. If a
    /// datagram also carries process data of other slaves, their part is included.
    #[must_use]
    pub fn working_counter(&self, slave: usize) -> Option<u16> {
        self.images.get(slave)?.working_counter
    }

    /// The outputs for a slave in the next cycle. Areas of fewer than eight bits begin with a byte each.
    #[must_use]
    pub fn outputs(&self, slave: usize) -> &[u8] {
        self.images.get(slave).map_or(&[], |image| &image.outputs)
    }

    /// The same, for changes. Empty for a slave without a place.
    pub fn outputs_mut(&mut self, slave: usize) -> &mut [u8] {
        self.images.get_mut(slave).map_or(&mut [], |image| &mut image.outputs)
    }

    /// The inputs last received from a slave.
    #[must_use]
    pub fn inputs(&self, slave: usize) -> &[u8] {
        self.images.get(slave).map_or(&[], |image| &image.inputs)
    }
}
