//! One datagram along a stretch of the line: who is meant, what is read and written, what counts.

use core::ops::Range;

use esc::{Access, Esc, Passage};
use time::{Duration, Instant};
use wire::{Command, Datagram};

use crate::index::{Index, WALKS_PER_FIND};
use crate::positions::{Gathered, Positions};

/// From one processing unit to the next: forwarding and 100BASE-TX PHYs, the order of magnitude of a real ESC.
const HOP: Duration = Duration::from_nanos(500);
/// From the processing unit of the last ESC to its closed port 1.
const TURN: Duration = Duration::from_nanos(100);

/// The ESCs that a frame passes, the first one at `now`, each next one a hop later (reference 1.4, 1.5).
pub(crate) struct Stretch<'a> {
    /// The position of the first one in the line.
    pub(crate) first: usize,
    pub(crate) escs: &'a mut [Esc],
    pub(crate) index: &'a mut Index,
    /// Those at which something takes effect at the end of the frame, of those that a datagram found by the index.
    pub(crate) waiting: Gathered<'a>,
    /// A datagram went through all of them, and some of them wait: each has to be asked.
    pub(crate) walked: bool,
    pub(crate) now: Instant,
}

/// What adds up along the line.
#[derive(Default)]
struct Passed {
    events: u16,
    count: u16,
}

impl Stretch<'_> {
    /// Passes a datagram through the processing units: of all ESCs, or of those that it means.
    #[inline]
    pub(crate) fn pass(&mut self, datagram: &mut Datagram<'_>) {
        let passed = match datagram.header.command {
            Command::Other(_) => return,
            Command::Lrd | Command::Lwr | Command::Lrw => self.pass_logical(datagram),
            command => self.pass_physical(command, datagram),
        };
        datagram.header.events |= passed.events;
        datagram.working_counter = datagram.working_counter.wrapping_add(passed.count);
    }

    #[inline]
    fn pass_logical(&mut self, datagram: &mut Datagram<'_>) -> Passed {
        let address = datagram.header.logical_address();
        let data = &mut *datagram.data;
        let bytes = u64::from(address)..u64::from(address) + data.len() as u64;
        match datagram.header.command {
            Command::Lrd => self.mapping(bytes, |esc, now| u16::from(esc.logical_read(address, data, now))),
            Command::Lwr => self.mapping(bytes, |esc, now| u16::from(esc.logical_write(address, data, now))),
            _ => self
                .mapping(bytes, |esc, now| read_write_increment(esc.logical_read_write(address, data, now))),
        }
    }

    #[inline]
    fn pass_physical(&mut self, command: Command, datagram: &mut Datagram<'_>) -> Passed {
        let address = datagram.header.address;
        if command.increments_position() {
            datagram.header.address = address.wrapping_add(self.escs.len() as u16);
        }
        let mut memory = Memory { offset: datagram.header.offset, data: &mut *datagram.data };
        match command {
            Command::Aprd => self.at(address, |esc, now| memory.read(esc, now)),
            Command::Apwr => self.at(address, |esc, now| memory.write(esc, now)),
            Command::Aprw => self.at(address, |esc, now| memory.read_write(esc, now)),
            Command::Fprd => self.answering(address, |esc, now| memory.read(esc, now)),
            Command::Fpwr => self.answering(address, |esc, now| memory.write(esc, now)),
            Command::Fprw => self.answering(address, |esc, now| memory.read_write(esc, now)),
            Command::Brd => self.walk(|_, esc, now| memory.read_or(esc, now)),
            Command::Bwr => self.walk(|_, esc, now| memory.write(esc, now)),
            Command::Brw => self.walk(|_, esc, now| memory.read_or_write(esc, now)),
            Command::Armw => self.walk(|number, esc, now| {
                memory.read_or_else_write(address.wrapping_add(number) == 0, esc, now)
            }),
            Command::Frmw => {
                self.walk(|_, esc, now| memory.read_or_else_write(esc.answers_to(address), esc, now))
            }
            _ => Passed { events: self.events(), count: 0 },
        }
    }

    /// What the frame has written takes effect, as far as its ESCs wait for that; those are touched. Whether
    /// registers are among it.
    #[inline]
    pub(crate) fn end_of_frame(&mut self, touched: &mut Positions) -> bool {
        if self.walked {
            return self.end_at_all(touched);
        }
        !self.waiting.is_empty() && self.end_at_waiting(touched)
    }

    #[inline]
    fn end_at_all(&mut self, touched: &mut Positions) -> bool {
        if !self.waiting.is_empty() {
            self.waiting.clear();
        }
        let way = self.way();
        let (mut registers_written, mut members) = (false, Gathered::new(touched));
        for (number, esc) in self.escs.iter_mut().enumerate() {
            if esc.awaits_end_of_frame() {
                let position = self.first + number;
                if esc.end_of_frame(&way.passage(number)) {
                    self.index.has_changed(position);
                    registers_written = true;
                }
                members.insert(position);
            }
        }
        members.finish();
        registers_written
    }

    #[inline(never)]
    fn end_at_waiting(&mut self, touched: &mut Positions) -> bool {
        let way = self.way();
        let mut registers_written = false;
        while let Some(mut waiting) = self.waiting.take_word() {
            touched.insert_word(waiting);
            while let Some(position) = waiting.take_first() {
                let number = position - self.first;
                if self.escs[number].end_of_frame(&way.passage(number)) {
                    self.index.has_changed(position);
                    registers_written = true;
                }
            }
        }
        registers_written
    }

    #[inline]
    fn way(&self) -> Way {
        Way { arrival: self.now, hops: 2 * (self.escs.len() as u64 - 1) }
    }

    /// Every ESC takes part, with its number in the stretch.
    #[inline]
    fn walk(&mut self, mut visit: impl FnMut(u16, &mut Esc, Instant) -> u16) -> Passed {
        let (mut passed, mut waits, mut arrival) = (Passed::default(), false, self.now);
        for (number, esc) in self.escs.iter_mut().enumerate() {
            let increment = visit(number as u16, esc, arrival);
            passed.count = passed.count.wrapping_add(increment);
            passed.events |= esc.masked_events();
            waits |= esc.awaits_end_of_frame();
            arrival += HOP;
        }
        self.walked |= waits;
        passed
    }

    /// The ESC at the auto-increment address takes part.
    #[inline]
    fn at(&mut self, address: u16, mut visit: impl FnMut(&mut Esc, Instant) -> u16) -> Passed {
        let count = self.visit(self.first + usize::from(address.wrapping_neg()), &mut visit);
        Passed { events: self.events(), count }
    }

    /// The ESCs that answer to a station address take part.
    #[inline]
    fn answering(&mut self, address: u16, mut visit: impl FnMut(&mut Esc, Instant) -> u16) -> Passed {
        let (mut count, mut from) = (0u16, self.first);
        while let Some(position) = self.index.answering(address, from) {
            count = count.wrapping_add(self.visit(position, &mut visit));
            from = position + 1;
        }
        Passed { events: self.events(), count }
    }

    /// The ESCs that map some of these logical bytes take part.
    #[inline]
    fn mapping(&mut self, bytes: Range<u64>, mut visit: impl FnMut(&mut Esc, Instant) -> u16) -> Passed {
        let length = self.escs.len();
        if length > WALKS_PER_FIND && self.index.find_mapping(bytes, self.first..self.first + length) {
            return self.found(visit);
        }
        self.walk(|_, esc, now| visit(esc, now))
    }

    /// The ESCs that the index has found take part.
    #[inline(never)]
    fn found(&mut self, mut visit: impl FnMut(&mut Esc, Instant) -> u16) -> Passed {
        let mut count = 0u16;
        while let Some(position) = self.index.take_found() {
            count = count.wrapping_add(self.visit(position, &mut visit));
        }
        Passed { events: self.events(), count }
    }

    /// One ESC takes part: what it adds to the working counter. A position beyond the stretch adds nothing.
    #[inline]
    fn visit(&mut self, position: usize, visit: &mut impl FnMut(&mut Esc, Instant) -> u16) -> u16 {
        let number = position - self.first;
        let Some(esc) = self.escs.get_mut(number) else { return 0 };
        let increment = visit(esc, self.now + HOP * number as u64);
        if esc.awaits_end_of_frame() {
            self.waiting.insert(position);
        }
        increment
    }

    /// What the ESCs put into the event field, those that did not take part too.
    #[inline]
    fn events(&mut self) -> u16 {
        self.index.events(self.escs, self.first)
    }
}

/// The way of a frame along the stretch and back.
struct Way {
    /// When it arrives at the first ESC.
    arrival: Instant,
    /// From there to the last one and back.
    hops: u64,
}

impl Way {
    /// When it passes an ESC, by the number in the stretch.
    #[inline]
    fn passage(&self, number: usize) -> Passage {
        let after = |hops: u64| Duration::from_nanos(HOP.as_nanos() * hops);
        let number = number as u64;
        Passage {
            arrival: self.arrival + after(number),
            returned_out: self.arrival + (after(self.hops - number) + TURN),
        }
    }
}

/// A physical address with the data of a datagram.
struct Memory<'d> {
    offset: u16,
    data: &'d mut [u8],
}

/// What each access adds to the working counter.
impl Memory<'_> {
    #[inline]
    fn read(&mut self, esc: &mut Esc, now: Instant) -> u16 {
        u16::from(esc.read(self.offset, self.data, now))
    }

    #[inline]
    fn write(&mut self, esc: &mut Esc, now: Instant) -> u16 {
        u16::from(esc.write(self.offset, self.data, now))
    }

    #[inline]
    fn read_write(&mut self, esc: &mut Esc, now: Instant) -> u16 {
        read_write_increment(esc.read_write(self.offset, self.data, now))
    }

    #[inline]
    fn read_or(&mut self, esc: &mut Esc, now: Instant) -> u16 {
        u16::from(esc.read_or(self.offset, self.data, now))
    }

    #[inline]
    fn read_or_write(&mut self, esc: &mut Esc, now: Instant) -> u16 {
        read_write_increment(esc.read_or_write(self.offset, self.data, now))
    }

    /// The multiple write commands: the ESC that is addressed is read, all others are written.
    #[inline]
    fn read_or_else_write(&mut self, is_addressed: bool, esc: &mut Esc, now: Instant) -> u16 {
        if is_addressed { self.read(esc, now) } else { self.write(esc, now) }
    }
}

/// A successful read counts 1, a successful write 2, both 3.
const fn read_write_increment(access: Access) -> u16 {
    access.read as u16 + 2 * access.written as u16
}
