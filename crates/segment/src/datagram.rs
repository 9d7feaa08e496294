//! One datagram along a stretch of the line: who is meant, what is read and written, what counts.

use core::ops::Range;

use esc::{Access, Esc, Passage};
use time::{Duration, Instant};
use wire::{Command, Datagram};

use crate::index::Index;
use crate::positions::{Positions, Word};
use crate::waiting::Waiting;

/// The ESCs that a frame passes, the first one at `now`, each next one a hop later (reference 1.4, 1.5).
pub(crate) struct Stretch<'a> {
    /// The position of the first one in the line.
    pub(crate) first: usize,
    pub(crate) escs: &'a mut [Esc],
    pub(crate) index: &'a mut Index,
    pub(crate) waiting: &'a mut Waiting,
    pub(crate) now: Instant,
    pub(crate) hop: Duration,
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
        let command = datagram.header.command;
        let logical = datagram.header.logical_address();
        let address = datagram.header.address;
        if command.increments_position() {
            datagram.header.address = address.wrapping_add(self.escs.len() as u16);
        }
        let mut memory = Memory { offset: datagram.header.offset, data: &mut *datagram.data };
        let bytes = u64::from(logical)..u64::from(logical) + memory.data.len() as u64;
        let passed = match command {
            Command::Other(_) => return,
            Command::Nop => Passed { events: self.events(), count: 0 },
            Command::Aprd => self.at(address, |esc, now| memory.read(esc, now)),
            Command::Apwr => self.at(address, |esc, now| memory.write(esc, now)),
            Command::Aprw => self.at(address, |esc, now| memory.read_write(esc, now)),
            Command::Fprd => self.answering(address, |esc, now| memory.read(esc, now)),
            Command::Fpwr => self.answering(address, |esc, now| memory.write(esc, now)),
            Command::Fprw => self.answering(address, |esc, now| memory.read_write(esc, now)),
            Command::Brd => self.walk(|_, esc, now| memory.read_or(esc, now)),
            Command::Bwr => self.walk(|_, esc, now| memory.write(esc, now)),
            Command::Brw => self.walk(|_, esc, now| memory.read_or_write(esc, now)),
            Command::Lrd => {
                self.mapping(bytes, |esc, now| u16::from(esc.logical_read(logical, memory.data, now)))
            }
            Command::Lwr => {
                self.mapping(bytes, |esc, now| u16::from(esc.logical_write(logical, memory.data, now)))
            }
            Command::Lrw => self.mapping(bytes, |esc, now| {
                read_write_increment(esc.logical_read_write(logical, memory.data, now))
            }),
            Command::Armw => self.walk(|number, esc, now| {
                memory.read_or_else_write(address.wrapping_add(number) == 0, esc, now)
            }),
            Command::Frmw => {
                self.walk(|_, esc, now| memory.read_or_else_write(esc.answers_to(address), esc, now))
            }
        };
        datagram.header.events |= passed.events;
        datagram.working_counter = datagram.working_counter.wrapping_add(passed.count);
    }

    /// What the frame has written takes effect, as far as its ESCs wait for that; those are touched. Whether
    /// registers are among it.
    #[inline]
    pub(crate) fn end_of_frame(&mut self, turn: Duration, touched: &mut Positions) -> bool {
        let walked = core::mem::take(&mut self.waiting.walked);
        if core::mem::take(&mut self.waiting.found) {
            if !walked {
                return self.end_at_found(turn, touched);
            }
            self.waiting.some.clear();
        }
        walked && self.end_at_all(turn, touched)
    }

    #[inline]
    fn end_at_all(&mut self, turn: Duration, touched: &mut Positions) -> bool {
        let mut back = self.hop * self.escs.len().saturating_sub(1) as u64;
        let (turned, mut arrival) = (self.now + back + turn, self.now);
        let (mut registers_written, mut members) = (false, Word::at(self.first));
        for (position, esc) in (self.first..).zip(self.escs.iter_mut()) {
            if esc.awaits_end_of_frame() {
                if esc.end_of_frame(&Passage { arrival, returned_out: turned + back }) {
                    self.index.has_changed(position);
                    registers_written = true;
                }
                touched.gather(&mut members, position);
            }
            arrival += self.hop;
            back = back - self.hop;
        }
        touched.insert_word(members);
        registers_written
    }

    fn end_at_found(&mut self, turn: Duration, touched: &mut Positions) -> bool {
        let hops = |hops: usize| self.hop * hops as u64;
        let behind = self.escs.len().saturating_sub(1);
        let (mut registers_written, mut from) = (false, self.first);
        while let Some(position) = self.waiting.some.next(from) {
            from = position + 1;
            let number = position - self.first;
            let arrival = self.now + hops(number);
            let returned_out = self.now + hops(behind) + turn + hops(behind - number);
            if self.escs[number].end_of_frame(&Passage { arrival, returned_out }) {
                self.index.has_changed(position);
                registers_written = true;
            }
        }
        touched.take_all(&mut self.waiting.some);
        registers_written
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
            arrival += self.hop;
        }
        self.waiting.walked |= waits;
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
        if !self.index.find_mapping(bytes, self.first..self.first + self.escs.len()) {
            return self.walk(|_, esc, now| visit(esc, now));
        }
        self.found(visit)
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
        let increment = visit(esc, self.now + self.hop * number as u64);
        if esc.awaits_end_of_frame() {
            self.waiting.some.insert(position);
            self.waiting.found = true;
        }
        increment
    }

    /// What the ESCs put into the event field, those that did not take part too.
    #[inline]
    fn events(&mut self) -> u16 {
        self.index.events(self.escs, self.first)
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
