//! The datagrams of one cycle: for the logical address space, as few as possible, in as few frames as possible.

use core::ops::Range;

use wire::{Command, DATAGRAM_OVERHEAD_BYTES, FrameBuilder};

use super::exchange::{Commands, Exchange, Grouping, StatusRead};
use super::image::{Bits, Image, copy};
use super::layout::Place;
use crate::access::{Access, Address, DATAGRAM_BYTES_MAX};
use crate::registers;
use crate::settings::Direction;

/// Maximum length of all datagrams of one frame in bytes.
const FRAME_BYTES_MAX: usize = DATAGRAM_BYTES_MAX + DATAGRAM_OVERHEAD_BYTES;
const AL_STATUS_BYTES: u16 = 2;

/// One datagram of the cycle.
#[derive(Clone, Debug)]
pub(crate) struct CyclicDatagram {
    pub(crate) content: Content,
    /// The working counter of this cycle; none before the answer.
    pub(crate) working_counter: Option<u16>,
}

/// The contents of a datagram.
#[derive(Clone, Debug)]
pub(crate) enum Content {
    /// Process data of these places, from this byte of the logical address space on.
    ProcessData {
        command: Command,
        first_byte: usize,
        length_bytes: usize,
        places: Range<usize>,
        /// The slaves to which they belong, each once.
        slaves: Vec<usize>,
        expected: u16,
    },
    /// AL status of all slaves together.
    Status,
    /// AL status of one slave.
    StatusOf { address: Address, slave: usize },
}

/// The datagrams of a cycle; `places` are in the order of their addresses, `addresses` in that of the slaves.
pub(crate) fn datagrams(places: &[Place], exchange: &Exchange, addresses: &[Address]) -> Vec<CyclicDatagram> {
    let mut datagrams = process_data(places, exchange);
    match exchange.status {
        StatusRead::Never => {}
        StatusRead::Broadcast => datagrams.push(CyclicDatagram::new(Content::Status)),
        StatusRead::EachSlave => {
            let of = |(slave, &address)| CyclicDatagram::new(Content::StatusOf { address, slave });
            datagrams.extend(addresses.iter().enumerate().map(of));
        }
    }
    datagrams
}

impl CyclicDatagram {
    const fn new(content: Content) -> Self {
        Self { content, working_counter: None }
    }

    /// Its command and the length of its data.
    pub(crate) const fn shape(&self) -> (Command, usize) {
        let command = match &self.content {
            Content::ProcessData { command, .. } => *command,
            Content::Status => Command::Brd,
            Content::StatusOf { address, .. } => {
                address
                    .command(&Access::Read { offset: registers::AL_STATUS, length_bytes: AL_STATUS_BYTES })
                    .0
            }
        };
        (command, self.length_bytes())
    }

    /// Puts it into a frame, with the contents of the images.
    pub(crate) fn load(&self, frame: &mut FrameBuilder, origin: u32, places: &[Place], images: &[Image]) {
        match &self.content {
            Content::ProcessData { command, first_byte, length_bytes, places: range, .. } => {
                let [a0, a1, a2, a3] = origin.wrapping_add(*first_byte as u32).to_le_bytes();
                let (low, high) = (u16::from_le_bytes([a0, a1]), u16::from_le_bytes([a2, a3]));
                let data = frame.add_zeros(*command, low, high, *length_bytes as u16);
                for place in &places[range.clone()] {
                    fill(data, *first_byte, place, images);
                }
            }
            Content::Status => load_status(frame, Address::All),
            Content::StatusOf { address, .. } => load_status(frame, *address),
        }
    }

    /// Stores the received inputs.
    pub(crate) fn take(&self, data: &[u8], places: &[Place], images: &mut [Image]) {
        if let Content::ProcessData { first_byte, places: range, .. } = &self.content {
            for place in &places[range.clone()] {
                take(data, *first_byte, place, images);
            }
        }
    }

    /// Sets the expected working counter: that of the slaves that take part.
    pub(crate) fn expect(&mut self, all: &[Place], takes_part: impl Fn(usize) -> bool) {
        if let Content::ProcessData { command, places, expected, .. } = &mut self.content {
            *expected = expected_counter(*command, &all[places.clone()], takes_part);
        }
    }

    const fn length_bytes(&self) -> usize {
        match self.content {
            Content::ProcessData { length_bytes, .. } => length_bytes,
            Content::Status | Content::StatusOf { .. } => AL_STATUS_BYTES as usize,
        }
    }
}

/// Places that share bytes, or a single place: they form one datagram if they fit.
#[derive(Clone, Debug)]
struct Cluster {
    places: Range<usize>,
    bytes: Range<usize>,
    /// The slave to which they belong; none: several slaves.
    slave: Option<usize>,
    has_outputs: bool,
    has_inputs: bool,
}

impl Cluster {
    fn of(number: usize, place: &Place) -> Self {
        Self {
            places: number..number + 1,
            bytes: place.start / 8..place.end().div_ceil(8),
            slave: Some(place.slave),
            has_outputs: place.direction == Direction::Outputs,
            has_inputs: place.direction == Direction::Inputs,
        }
    }

    fn add(&mut self, other: &Self) {
        self.places.end = other.places.end;
        self.bytes.end = self.bytes.end.max(other.bytes.end);
        self.slave = self.slave.filter(|_| self.slave == other.slave);
        self.has_outputs |= other.has_outputs;
        self.has_inputs |= other.has_inputs;
    }

    const fn has_both(&self) -> bool {
        self.has_outputs && self.has_inputs
    }
}

/// Joins neighbours if `may_join` permits it.
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

/// The datagrams of all places.
fn process_data(places: &[Place], exchange: &Exchange) -> Vec<CyclicDatagram> {
    let alone = places.iter().enumerate().map(|(number, place)| Cluster::of(number, place)).collect();
    let sharing = join(alone, |last, next| next.bytes.start < last.bytes.end);
    let fitting = join(sharing, |last, next| {
        let length_bytes = next.bytes.end - last.bytes.start;
        let same_way = last.has_outputs == next.has_outputs && !last.has_both();
        let may_mix = exchange.commands != Commands::Separate;
        let same_slave = last.slave.is_some() && last.slave == next.slave;
        length_bytes <= DATAGRAM_BYTES_MAX
            && (same_way || may_mix)
            && (same_slave || exchange.grouping == Grouping::Filled)
    });
    fitting.iter().flat_map(|cluster| datagrams_of(cluster, exchange.commands, places)).collect()
}

/// The datagrams of a cluster: one, unless an area is longer than a datagram.
fn datagrams_of(
    cluster: &Cluster,
    commands: Commands,
    all: &[Place],
) -> impl Iterator<Item = CyclicDatagram> {
    let command = match commands {
        Commands::Lrw => Command::Lrw,
        Commands::Fitting | Commands::Separate if cluster.has_both() => Command::Lrw,
        Commands::Fitting | Commands::Separate if cluster.has_outputs => Command::Lwr,
        Commands::Fitting | Commands::Separate => Command::Lrd,
    };
    let Cluster { places, bytes, .. } = cluster.clone();
    let mut slaves: Vec<usize> = all[places.clone()].iter().map(|place| place.slave).collect();
    slaves.sort_unstable();
    slaves.dedup();
    bytes.clone().step_by(DATAGRAM_BYTES_MAX).map(move |first_byte| {
        let length_bytes = (bytes.end - first_byte).min(DATAGRAM_BYTES_MAX);
        CyclicDatagram::new(Content::ProcessData {
            command,
            first_byte,
            length_bytes,
            places: places.clone(),
            slaves: slaves.clone(),
            expected: 0,
        })
    })
}

/// Puts datagrams into frames, in their order.
pub(crate) fn frames(datagrams: &[CyclicDatagram]) -> Vec<Range<usize>> {
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

/// The expected working counter of a datagram if all slaves that take part answer; two areas of one slave count once.
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

fn load_status(frame: &mut FrameBuilder, address: Address) {
    let access = Access::Read { offset: registers::AL_STATUS, length_bytes: AL_STATUS_BYTES };
    access.add_to(frame, address);
}

/// The bits of a place that are in a datagram: their start in the image of the slave, their number, and their
/// start in the datagram.
fn within(place: &Place, first_byte: usize, length_bytes: usize) -> (Bits, usize) {
    let datagram = 8 * first_byte..8 * (first_byte + length_bytes);
    let (start, end) = (place.start.max(datagram.start), place.end().min(datagram.end));
    let bits = Bits { start: place.image_start + (start - place.start), count: end.saturating_sub(start) };
    (bits, start - datagram.start)
}

/// Outputs are sent; inputs are sent as last received, so that those of a slave that does not answer are unchanged.
fn fill(data: &mut [u8], first_byte: usize, place: &Place, images: &[Image]) {
    let (bits, at) = within(place, first_byte, data.len());
    if let Some(image) = images.get(place.slave) {
        copy(image.way(place.direction), bits, data, at);
    }
}

fn take(data: &[u8], first_byte: usize, place: &Place, images: &mut [Image]) {
    let (bits, at) = within(place, first_byte, data.len());
    if let (Some(image), Direction::Inputs) = (images.get_mut(place.slave), place.direction) {
        copy(data, Bits { start: at, count: bits.count }, &mut image.inputs, bits.start);
    }
}
