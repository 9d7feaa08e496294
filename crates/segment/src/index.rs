//! Who answers to an address: found without a walk along the line.

use core::ops::Range;

use esc::{Changes, Esc};

use crate::positions::Positions;

/// Up to this many ESCs at once find their places in a table one by one; more than that are sorted in.
const FEW: usize = 8;
/// A walk along the line passes as many ESCs as this in the time in which the index finds one.
pub(crate) const WALKS_PER_FIND: usize = 4;

/// Station addresses, logical addresses and event fields of a line. What slaves do to their ESCs is followed up by
/// [`Index::settle`] before the next frame, what a frame does by [`Index::has_changed`] at its end. Nothing is
/// allocated after [`Index::new`].
#[derive(Clone, Debug)]
pub(crate) struct Index {
    stations: Table<Station>,
    mappings: Table<Mapped>,
    /// For each mapping the highest end of it and of those before, so that they are found by bisection.
    ends: Vec<u64>,
    /// ESCs that put something into the event field of datagrams, and maybe some that do not any more. Data that a
    /// frame reads or writes clear events; only registers and the application raise some.
    raising: Positions,
    /// The ESC that changed first since the last follow-up: mostly there is one.
    changed: Option<usize>,
    /// Those that changed after it.
    changed_too: Positions,
    /// There are such.
    are_many: bool,
    /// Logical bytes for which a walk was the shorter way: the same frame comes in each cycle.
    walked: Range<u64>,
    /// The mapping behind those that were found last: mostly the next datagram begins there.
    next_mapping: usize,
    /// For the moment: ESCs whose addresses change, or that a datagram means.
    some: Positions,
}

/// An address that an ESC answers to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Station {
    address: u16,
    position: usize,
}

/// Logical bytes that an FMMU maps, end excluded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Mapped {
    start: u64,
    end: u64,
    position: usize,
}

impl Index {
    pub(crate) fn new(escs: &[Esc]) -> Self {
        let fmmus = escs.iter().map(|esc| usize::from(esc.fmmu_count())).sum();
        let mut index = Self {
            stations: Table::with_capacity(2 * escs.len()),
            mappings: Table::with_capacity(fmmus),
            ends: Vec::with_capacity(fmmus),
            raising: Positions::new(escs.len()),
            changed: None,
            changed_too: Positions::new(escs.len()),
            are_many: false,
            walked: 0..0,
            next_mapping: 0,
            some: Positions::new(escs.len()),
        };
        (0..escs.len()).for_each(|position| index.has_changed(position));
        index
    }

    /// An ESC may have other addresses or events than before.
    #[inline]
    pub(crate) fn has_changed(&mut self, position: usize) {
        if *self.changed.get_or_insert(position) != position {
            self.changed_too.insert(position);
            self.are_many = true;
        }
    }

    /// Follows up what has changed. Whether frames may take another path than before.
    #[inline]
    pub(crate) fn settle(&mut self, escs: &mut [Esc]) -> bool {
        match self.changed {
            None => false,
            Some(position) => self.settle_from(position, escs),
        }
    }

    #[inline]
    fn settle_from(&mut self, position: usize, escs: &mut [Esc]) -> bool {
        self.changed = None;
        let is_known = |esc: &Esc| esc.masked_events() == 0 && !esc.has_changes();
        (self.are_many || !escs.get(position).is_some_and(is_known)) && self.follow_up(escs, position)
    }

    #[inline(never)]
    fn follow_up(&mut self, escs: &mut [Esc], position: usize) -> bool {
        let mut changes = self.changes_of(escs, position);
        while let Some(mut others) = self.changed_too.take_word() {
            while let Some(position) = others.take_first() {
                changes |= self.changes_of(escs, position);
            }
        }
        self.are_many = false;
        if changes.addresses || changes.mappings {
            self.sort_in(escs, changes);
        }
        changes.ports
    }

    fn changes_of(&mut self, escs: &mut [Esc], position: usize) -> Changes {
        let Some(esc) = escs.get_mut(position) else { return Changes::NONE };
        if esc.masked_events() != 0 {
            self.raising.insert(position);
        }
        let changes = esc.take_changes();
        if changes.addresses || changes.mappings {
            self.some.insert(position);
        }
        changes
    }

    /// Enters those whose addresses or mappings are others than before.
    fn sort_in(&mut self, escs: &[Esc], changes: Changes) {
        if changes.addresses {
            self.stations.replace(&self.some, escs, |position, esc| {
                esc.answering_addresses().map(move |address| Station { address, position })
            });
        }
        if changes.mappings {
            self.mappings.replace(&self.some, escs, |position, esc| {
                esc.mapped_bytes().map(move |bytes| Mapped { start: bytes.start, end: bytes.end, position })
            });
            let mut highest = 0;
            self.ends.clear();
            self.ends.extend(self.mappings.entries.iter().map(|mapped| {
                highest = mapped.end.max(highest);
                highest
            }));
        }
        self.some.clear();
        self.walked = 0..0;
    }

    /// The first ESC from a position on that answers to a station address.
    pub(crate) fn answering(&self, address: u16, position: usize) -> Option<usize> {
        let from = self.stations.place_of(&Station { address, position });
        let station = self.stations.entries.get(from)?;
        (station.address == address).then_some(station.position)
    }

    /// Finds the ESCs of this stretch of the line that map some of these logical bytes, for [`Index::take_found`].
    /// False if a walk along the stretch is the shorter way.
    #[inline]
    pub(crate) fn find_mapping(&mut self, bytes: Range<u64>, stretch: Range<usize>) -> bool {
        bytes != self.walked && self.bisect(bytes, stretch)
    }

    fn bisect(&mut self, bytes: Range<u64>, stretch: Range<usize>) -> bool {
        let from = self.first_ending_after(bytes.start);
        let behind = self.mappings.entries.get(from..).unwrap_or_default();
        let most = stretch.len() / WALKS_PER_FIND;
        let count = behind.iter().take(most + 1).take_while(|mapped| mapped.start < bytes.end).count();
        if count > most {
            self.walked = bytes;
            return false;
        }
        for mapped in &behind[..count] {
            if mapped.end > bytes.start && stretch.contains(&mapped.position) {
                self.some.insert(mapped.position);
            }
        }
        self.next_mapping = from + count;
        true
    }

    /// The first mapping that, or one before it, ends after this logical byte.
    fn first_ending_after(&self, byte: u64) -> usize {
        let next = self.next_mapping;
        let is_passed = |end: &u64| *end <= byte;
        let is_next = next.checked_sub(1).is_none_or(|last| self.ends.get(last).is_some_and(is_passed))
            && !self.ends.get(next).is_some_and(is_passed);
        if is_next { next } else { self.ends.partition_point(is_passed) }
    }

    /// Takes the first of the ESCs that were found.
    pub(crate) fn take_found(&mut self) -> Option<usize> {
        let position = self.some.next(0)?;
        self.some.remove(position);
        Some(position)
    }

    /// What these ESCs, which begin at `first`, put into the event field of a datagram.
    #[inline]
    pub(crate) fn events(&mut self, escs: &[Esc], first: usize) -> u16 {
        if self.raising.is_empty() { 0 } else { self.raised(escs, first) }
    }

    fn raised(&mut self, escs: &[Esc], first: usize) -> u16 {
        let (mut events, mut from) = (0, first);
        while let Some(position) = self.raising.next(from) {
            from = position + 1;
            match escs.get(position - first).map(Esc::masked_events) {
                None => break,
                Some(0) => self.raising.remove(position),
                Some(raised) => events |= raised,
            }
        }
        events
    }
}

/// Entries of ESCs, sorted.
#[derive(Clone, Debug)]
struct Table<E> {
    entries: Vec<E>,
}

/// What belongs to one ESC.
trait Entry: Copy + Ord {
    fn position(&self) -> usize;
}

impl Entry for Station {
    fn position(&self) -> usize {
        self.position
    }
}

impl Entry for Mapped {
    fn position(&self) -> usize {
        self.position
    }
}

impl<E: Entry> Table<E> {
    fn with_capacity(entries: usize) -> Self {
        Self { entries: Vec::with_capacity(entries) }
    }

    /// The place of the first entry that is not before this one.
    fn place_of(&self, entry: &E) -> usize {
        self.entries.partition_point(|other| other < entry)
    }

    /// Replaces the entries of some ESCs.
    fn replace<'e, I: Iterator<Item = E> + 'e>(
        &mut self,
        some: &Positions,
        escs: &'e [Esc],
        entries_of: impl Fn(usize, &'e Esc) -> I,
    ) {
        self.entries.retain(|entry| !some.contains(entry.position()));
        let are_few = some.iter().nth(FEW).is_none();
        for position in some.iter() {
            let Some(esc) = escs.get(position) else { continue };
            for entry in entries_of(position, esc) {
                let at = self.entries.len();
                let at = if are_few { self.place_of(&entry) } else { at };
                self.entries.insert(at, entry);
            }
        }
        if !are_few {
            self.entries.sort_unstable();
        }
    }
}
