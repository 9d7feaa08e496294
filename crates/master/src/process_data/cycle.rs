//! The cyclic exchange: datagrams over the logical address space, in as few frames as possible.

use core::ops::Range;

use time::{Duration, Instant};
use wire::{AlStatus, Command, DATAGRAM_OVERHEAD_BYTES};

use super::image::{Bits, Image, copy};
use super::layout::{Layout, Place};
use crate::access::{Address, word};
use crate::flight::Sender;
use crate::load::Load;
use crate::registers;
use crate::settings::Direction;

/// Bytes of all datagrams of one frame.
const FRAME_BYTES_MAX: usize = 1_498;
/// Most data of one datagram.
const DATAGRAM_BYTES_MAX: usize = FRAME_BYTES_MAX - DATAGRAM_OVERHEAD_BYTES;
const AL_STATUS_BYTES: u16 = 2;

/// Which commands carry process data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Commands {
    /// LRW.
    Lrw,
    /// LRW where a datagram has both directions in it, LWR and LRD where it has one.
    Fitting,
    /// LWR for outputs, LRD for inputs.
    Separate,
}

/// Which AL status is read with each cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StatusRead {
    /// None.
    Never,
    /// That of all slaves together, by BRD.
    Broadcast,
    /// That of each slave, by FPRD or APRD.
    EachSlave,
}

/// How process data are exchanged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Exchange {
    /// From one cycle to the next.
    pub period: Duration,
    /// Where in the period a cycle begins, counted from time 0.
    pub phase: Duration,
    /// Which commands carry them.
    pub commands: Commands,
    /// Which AL status is read besides.
    pub status: StatusRead,
    /// The first logical address.
    pub origin: u32,
}

/// One datagram of the cycle.
#[derive(Clone, Debug)]
struct CyclicDatagram {
    content: Content,
    /// The working counter of this cycle; none before the answer.
    working_counter: Option<u16>,
}

#[derive(Clone, Debug)]
enum Content {
    /// Process data of these places, from this byte of the logical address space on.
    ProcessData {
        command: Command,
        first_byte: usize,
        length_bytes: usize,
        places: Range<usize>,
        expected: u16,
    },
    /// AL status of all slaves together.
    Status,
    /// AL status of one slave.
    StatusOf { address: Address, slave: usize },
}

/// What the present cycle has come to so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CycleReport {
    /// Cycles that were sent so far.
    pub cycles: u64,
    /// The working counters of all process data that came back, added up.
    pub working_counter: u16,
    /// What they add up to when every slave that exchanges process data takes part.
    pub expected: u16,
    /// Datagrams of process data that did not come back.
    pub lost: u16,
    /// How many slaves have answered with their AL status, where it is read by BRD, and the OR of it.
    pub status: Option<(u16, AlStatus)>,
}

/// The exchange, running or not.
#[derive(Debug)]
pub(crate) struct Cycle {
    pub(crate) exchange: Exchange,
    places: Vec<Place>,
    datagrams: Vec<CyclicDatagram>,
    /// The datagrams of each frame.
    frames: Vec<Range<usize>>,
    /// The frame that leaves next; behind the last one the cycle is sent.
    next_frame: usize,
    next: Instant,
    cycles: u64,
    /// How many slaves have answered with their AL status, and the OR of it.
    status: Option<(u16, AlStatus)>,
}

impl Cycle {
    pub(crate) const fn new(exchange: Exchange) -> Self {
        Self {
            exchange,
            places: Vec::new(),
            datagrams: Vec::new(),
            frames: Vec::new(),
            next_frame: usize::MAX,
            next: Instant::NEVER,
            cycles: 0,
            status: None,
        }
    }

    pub(crate) const fn deadline(&self) -> Instant {
        self.next
    }

    /// Begins at once, if it does not run.
    pub(crate) fn begin(&mut self, now: Instant) {
        self.next = self.next.min(now);
    }

    pub(crate) const fn stop(&mut self) {
        self.next = Instant::NEVER;
        self.next_frame = usize::MAX;
    }

    /// The first moment behind `now` that lies on the phase.
    fn after(&self, now: Instant) -> Instant {
        let first = Instant::ZERO + self.exchange.phase;
        if now < first {
            return first;
        }
        let passed = now.saturating_since(first).as_nanos();
        let period = self.exchange.period.as_nanos().max(1);
        first + self.exchange.period * (passed / period + 1)
    }

    /// Makes datagrams and frames for all places; `addresses` are those of all slaves, in their order.
    pub(crate) fn arrange(
        &mut self,
        layout: &Layout,
        separate: bool,
        addresses: impl Iterator<Item = Address>,
    ) {
        self.places = layout.places().to_vec();
        self.places.sort_by_key(|place| place.start);
        let commands = if separate { Commands::Separate } else { self.exchange.commands };
        self.datagrams = process_data(&self.places, commands);
        match self.exchange.status {
            StatusRead::Never => {}
            StatusRead::Broadcast => self.datagrams.push(CyclicDatagram::new(Content::Status)),
            StatusRead::EachSlave => {
                let of = |(slave, address)| CyclicDatagram::new(Content::StatusOf { address, slave });
                self.datagrams.extend(addresses.enumerate().map(of));
            }
        }
        self.frames = frames(&self.datagrams);
        self.next_frame = usize::MAX;
    }

    /// Sets the working counters that are right: those of slaves that take part.
    pub(crate) fn expect(&mut self, takes_part: impl Fn(usize) -> bool) {
        for datagram in &mut self.datagrams {
            if let Content::ProcessData { command, places, expected, .. } = &mut datagram.content {
                *expected = expected_counter(*command, &self.places[places.clone()], &takes_part);
            }
        }
    }

    /// Begins the next cycle if it is due.
    pub(crate) fn next_cycle(&mut self, now: Instant) -> bool {
        if self.next > now {
            return false;
        }
        self.cycles += 1;
        self.next = self.after(now);
        self.next_frame = 0;
        self.status = None;
        self.datagrams.iter_mut().for_each(|datagram| datagram.working_counter = None);
        true
    }

    pub(crate) fn report(&self) -> CycleReport {
        let mut report = CycleReport { cycles: self.cycles, status: self.status, ..CycleReport::default() };
        for datagram in &self.datagrams {
            if let Content::ProcessData { expected, .. } = datagram.content {
                report.expected = report.expected.saturating_add(expected);
                match datagram.working_counter {
                    Some(counter) => report.working_counter = report.working_counter.saturating_add(counter),
                    None => report.lost += 1,
                }
            }
        }
        report
    }

    /// Loads the next frame of this cycle, if one is left.
    pub(crate) fn load(&mut self, images: &[Image], load: &mut Load) {
        let Some(frame) = self.frames.get(self.next_frame).cloned() else { return };
        self.next_frame += 1;
        for number in frame {
            self.load_datagram(number, images, load);
        }
    }

    fn load_datagram(&self, number: usize, images: &[Image], load: &mut Load) {
        let sender = Sender::Cycle(number);
        match &self.datagrams[number].content {
            Content::ProcessData { command, first_byte, length_bytes, places, .. } => {
                let address = self.exchange.origin.wrapping_add(*first_byte as u32);
                let data = load.logical(sender, *command, address, *length_bytes);
                for place in &self.places[places.clone()] {
                    fill(data, *first_byte, place, images);
                }
            }
            Content::Status => load.read(sender, Address::All, registers::AL_STATUS, AL_STATUS_BYTES),
            Content::StatusOf { address, .. } => {
                load.read(sender, *address, registers::AL_STATUS, AL_STATUS_BYTES)
            }
        }
    }

    /// Takes what came back for a datagram; the AL status of a slave, if it was that.
    pub(crate) fn answer(
        &mut self,
        number: usize,
        (working_counter, data): (u16, &[u8]),
        images: &mut [Image],
    ) -> Option<(usize, AlStatus)> {
        let datagram = self.datagrams.get_mut(number)?;
        datagram.working_counter = Some(working_counter);
        match &datagram.content {
            Content::ProcessData { first_byte, places, .. } => {
                for place in &self.places[places.clone()] {
                    take(data, *first_byte, place, images);
                }
                None
            }
            Content::Status => {
                self.status = Some((working_counter, AlStatus::from_bits(word(data))));
                None
            }
            Content::StatusOf { slave, .. } => {
                (working_counter > 0).then(|| (*slave, AlStatus::from_bits(word(data))))
            }
        }
    }
}

impl CyclicDatagram {
    const fn new(content: Content) -> Self {
        Self { content, working_counter: None }
    }

    const fn length_bytes(&self) -> usize {
        match self.content {
            Content::ProcessData { length_bytes, .. } => length_bytes,
            Content::Status | Content::StatusOf { .. } => AL_STATUS_BYTES as usize,
        }
    }
}

/// Places that share bytes, or one alone: what goes into one datagram as far as it fits.
#[derive(Clone, Debug)]
struct Cluster {
    places: Range<usize>,
    bytes: Range<usize>,
    has_outputs: bool,
    has_inputs: bool,
}

impl Cluster {
    fn of(number: usize, place: &Place) -> Self {
        Self {
            places: number..number + 1,
            bytes: place.start / 8..place.end().div_ceil(8),
            has_outputs: place.direction == Direction::Outputs,
            has_inputs: place.direction == Direction::Inputs,
        }
    }

    fn add(&mut self, other: &Self) {
        self.places.end = other.places.end;
        self.bytes.end = self.bytes.end.max(other.bytes.end);
        self.has_outputs |= other.has_outputs;
        self.has_inputs |= other.has_inputs;
    }

    const fn has_both(&self) -> bool {
        self.has_outputs && self.has_inputs
    }
}

/// Joins neighbours as long as `may_join` allows.
fn join(clusters: Vec<Cluster>, may_join: impl Fn(&Cluster, &Cluster) -> bool) -> Vec<Cluster> {
    let mut joined: Vec<Cluster> = Vec::new();
    for cluster in clusters {
        match joined.last_mut() {
            Some(last) if may_join(last, &cluster) => last.add(&cluster),
            _ => joined.push(cluster),
        }
    }
    joined
}

/// The datagrams of all places, which are in the order of their addresses.
fn process_data(places: &[Place], commands: Commands) -> Vec<CyclicDatagram> {
    let alone = places.iter().enumerate().map(|(number, place)| Cluster::of(number, place)).collect();
    let sharing = join(alone, |last, next| next.bytes.start < last.bytes.end);
    let fitting = join(sharing, |last, next| {
        let length_bytes = next.bytes.end - last.bytes.start;
        let same_way = last.has_outputs == next.has_outputs && !last.has_both();
        length_bytes <= DATAGRAM_BYTES_MAX && (same_way || commands != Commands::Separate)
    });
    fitting.iter().flat_map(|cluster| datagrams_of(cluster, commands)).collect()
}

/// The datagrams of a cluster: one, but for an area that is longer than a datagram.
fn datagrams_of(cluster: &Cluster, commands: Commands) -> impl Iterator<Item = CyclicDatagram> {
    let command = match commands {
        Commands::Lrw => Command::Lrw,
        Commands::Fitting | Commands::Separate if cluster.has_both() => Command::Lrw,
        Commands::Fitting | Commands::Separate if cluster.has_outputs => Command::Lwr,
        Commands::Fitting | Commands::Separate => Command::Lrd,
    };
    let Cluster { places, bytes, .. } = cluster.clone();
    bytes.clone().step_by(DATAGRAM_BYTES_MAX).map(move |first_byte| {
        let length_bytes = (bytes.end - first_byte).min(DATAGRAM_BYTES_MAX);
        CyclicDatagram::new(Content::ProcessData {
            command,
            first_byte,
            length_bytes,
            places: places.clone(),
            expected: 0,
        })
    })
}

/// Puts datagrams into frames, in their order.
fn frames(datagrams: &[CyclicDatagram]) -> Vec<Range<usize>> {
    let mut frames: Vec<Range<usize>> = Vec::new();
    let mut room_bytes = 0;
    for (number, datagram) in datagrams.iter().enumerate() {
        let needed_bytes = DATAGRAM_OVERHEAD_BYTES + datagram.length_bytes();
        match frames.last_mut() {
            Some(frame) if needed_bytes <= room_bytes => frame.end = number + 1,
            _ => {
                frames.push(number..number + 1);
                room_bytes = FRAME_BYTES_MAX;
            }
        }
        room_bytes -= needed_bytes;
    }
    frames
}

/// What a datagram counts when all slaves that take part answer; two areas of one slave count once.
fn expected_counter(command: Command, places: &[Place], takes_part: impl Fn(usize) -> bool) -> u16 {
    let mut counter = 0;
    let mut last = None;
    for place in places.iter().filter(|place| takes_part(place.slave)) {
        if last.replace((place.slave, place.direction)) != Some((place.slave, place.direction)) {
            counter += match (command, place.direction) {
                (Command::Lrw, Direction::Outputs) => 2,
                (Command::Lrw | Command::Lrd, Direction::Inputs) | (Command::Lwr, Direction::Outputs) => 1,
                _ => 0,
            };
        }
    }
    counter
}

/// The bits of a place that are in a datagram: where they begin in the image of the slave, how many they are, and where
/// they begin in the datagram.
fn within(place: &Place, first_byte: usize, length_bytes: usize) -> (Bits, usize) {
    let datagram = 8 * first_byte..8 * (first_byte + length_bytes);
    let (start, end) = (place.start.max(datagram.start), place.end().min(datagram.end));
    let bits = Bits { start: place.image_start + (start - place.start), count: end.saturating_sub(start) };
    (bits, start - datagram.start)
}

/// Outputs go out; inputs go as they came last, so that those of a slave that does not answer stay.
fn fill(data: &mut [u8], first_byte: usize, place: &Place, images: &[Image]) {
    let (bits, at) = within(place, first_byte, data.len());
    if let Some(image) = images.get(place.slave) {
        copy(image.of(place.direction), bits, data, at);
    }
}

fn take(data: &[u8], first_byte: usize, place: &Place, images: &mut [Image]) {
    let (bits, at) = within(place, first_byte, data.len());
    if let (Some(image), Direction::Inputs) = (images.get_mut(place.slave), place.direction) {
        copy(data, Bits { start: at, count: bits.count }, &mut image.inputs, bits.start);
    }
}
