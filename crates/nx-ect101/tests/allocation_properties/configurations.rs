//! Random settings of both sides: correct ones, ones that violate one rule, and any.

use nx_ect101::unit_file::EntryAddress;
use nx_ect101::{Configuration, DataSetKind, Direction, IoAllocation, IoEntry, pdo_settings};
use proptest::prelude::*;
use proptest::sample::Index;
use wire::{ObjectIndex, SubIndex};

use crate::model::{MAXIMUM, io_entry, pdo, pdo_entry};

/// Index and subindex.
pub(crate) type Address = (u16, u8);

/// Both sides by direction (0 is master to CPU Unit) and data set.
#[derive(Clone, Debug)]
pub(crate) struct Settings {
    pub(crate) io: [[Vec<Address>; 3]; 2],
    pub(crate) pdo: [[Vec<Address>; 3]; 2],
    pub(crate) assigned: [Vec<u16>; 2],
}

impl Settings {
    /// Entries 1 to the count on both sides, all data sets with entries and all status assigned.
    fn of(io: [[u8; 3]; 2], pdo_counts: [[u8; 3]; 2]) -> Self {
        let list = |index, count| (1..=count).map(|sub| (index, sub)).collect::<Vec<_>>();
        let sides = |counts: [[u8; 3]; 2], index: fn(usize, usize) -> u16| {
            [0, 1].map(|way| [0, 1, 2].map(|set| list(index(way, set), counts[way][set])))
        };
        let assigned = [0, 1].map(|way| {
            (0..3).filter(|&set| pdo_counts[way][set] > 0).map(|set| pdo(way, set)).collect::<Vec<_>>()
        });
        let [rx, tx] = assigned;
        let tx = [vec![0x1A00], tx, vec![0x1BFE]].concat();
        Self { io: sides(io, io_entry), pdo: sides(pdo_counts, pdo_entry), assigned: [rx, tx] }
    }

    pub(crate) fn configuration(&self) -> Configuration {
        let mut io = IoAllocation::empty();
        let mut settings = pdo_settings::factory();
        for (way, direction) in Direction::ALL.into_iter().enumerate() {
            for (set, kind) in DataSetKind::ALL.into_iter().enumerate() {
                let entry =
                    |&(index, sub): &Address| IoEntry { index: ObjectIndex(index), sub: SubIndex(sub) };
                io.allocate(direction, kind, self.io[way][set].iter().map(entry).collect());
                let address =
                    |&(index, sub): &Address| EntryAddress { index: ObjectIndex(index), sub: SubIndex(sub) };
                let entries = self.pdo[way][set].iter().map(|entry| pdo_settings::entry_at(address(entry)));
                settings.map(ObjectIndex(pdo(way, set)), entries);
            }
            settings.assign(direction.assignment(), self.assigned[way].iter().copied().map(ObjectIndex));
        }
        Configuration { io, pdo: settings }
    }
}

/// Counts of three data sets that together fit into 1,200 bytes, with room for a mistake.
fn small_counts() -> impl Strategy<Value = [u8; 3]> + Clone {
    [0..=20u8, 0..=9u8, 0..=31u8]
}

/// Counts of 1,200 bytes, the maximum that is exchanged.
fn full_counts() -> impl Strategy<Value = [u8; 3]> + Clone {
    prop::sample::select(vec![[40, 0, 0], [38, 2, 10], [36, 10, 5]])
}

/// Settings that satisfy all rules.
pub(crate) fn right_settings() -> impl Strategy<Value = Settings> {
    let counts = || prop_oneof![9 => small_counts(), 1 => full_counts()];
    [counts(), counts()].prop_map(|counts| Settings::of(counts, counts))
}

/// Counts of one side that satisfy the rules of that side.
pub(crate) fn unequal_settings() -> impl Strategy<Value = Settings> {
    let sides = [small_counts(), small_counts(), small_counts(), small_counts()];
    sides.prop_map(|[a, b, c, d]| Settings::of([a, b], [c, d]))
}

/// Settings with any number of mistakes, including none.
pub(crate) fn any_settings() -> impl Strategy<Value = Settings> {
    let many = [0..=42u8, 0..=12u8, 0..=34u8];
    let counts = prop_oneof![4 => small_counts(), 1 => many, 1 => full_counts()];
    let sides = [counts.clone(), counts.clone(), counts.clone(), counts];
    let settings = (sides, any::<[bool; 2]>()).prop_map(|([a, b, c, d], [same_rx, same_tx])| {
        Settings::of([a, b], [if same_rx { a } else { c }, if same_tx { b } else { d }])
    });
    (settings, prop::collection::vec(slip(), 0..4)).prop_map(|(mut settings, slips)| {
        slips.iter().for_each(|slip| slip.make(&mut settings));
        settings
    })
}

/// A change that may violate a rule.
#[derive(Clone, Debug)]
enum Slip {
    Swap(Place, Index, Index),
    Remove(Place, Index),
    Insert(Place, Index, Address),
    /// This number of neighbours.
    Replace(Place, Index, usize, Address),
    Assign(bool, Index, u16),
    Unassign(bool, Index),
    SwapAssigned(bool, Index, Index),
}

/// A list of entries: I/O side or not, direction, data set.
type Place = (bool, bool, usize);

fn slip() -> impl Strategy<Value = Slip> {
    let place = || (any::<bool>(), any::<bool>(), 0..3usize);
    let indexes = vec![0x6000, 0x6001, 0x6002, 0x7000, 0x7001, 0x7002, 0x5555];
    let address = prop_oneof![
        8 => (prop::sample::select(indexes), prop_oneof![0..=42u8, Just(1u8)]),
        1 => Just((0, 0)),
    ];
    let pdos = vec![0, 0x1601, 0x1602, 0x1603, 0x1A00, 0x1A01, 0x1A02, 0x1A03, 0x1BFE, 0x1BFF, 0x1600];
    prop_oneof![
        (place(), any::<Index>(), any::<Index>()).prop_map(|(place, a, b)| Slip::Swap(place, a, b)),
        (place(), any::<Index>()).prop_map(|(place, at)| Slip::Remove(place, at)),
        (place(), any::<Index>(), address.clone())
            .prop_map(|(place, at, entry)| Slip::Insert(place, at, entry)),
        (place(), any::<Index>(), 1..4usize, address)
            .prop_map(|(place, at, count, entry)| Slip::Replace(place, at, count, entry)),
        (any::<bool>(), any::<Index>(), prop::sample::select(pdos))
            .prop_map(|(way, at, pdo)| Slip::Assign(way, at, pdo)),
        (any::<bool>(), any::<Index>()).prop_map(|(way, at)| Slip::Unassign(way, at)),
        (any::<bool>(), any::<Index>(), any::<Index>()).prop_map(|(way, a, b)| Slip::SwapAssigned(way, a, b)),
    ]
}

impl Slip {
    fn make(&self, settings: &mut Settings) {
        match self {
            Self::Swap(place, a, b) => swap(settings.list(*place), a, b),
            Self::Remove(place, at) => remove(settings.list(*place), at),
            Self::Insert(place, at, entry) => insert(settings.list(*place), at, *entry),
            Self::Replace(place, at, count, entry) => {
                let list = settings.list(*place);
                let at = at.index(list.len() + 1);
                list.iter_mut().skip(at).take(*count).for_each(|element| *element = *entry);
            }
            Self::Assign(way, at, pdo) => insert(&mut settings.assigned[usize::from(*way)], at, *pdo),
            Self::Unassign(way, at) => remove(&mut settings.assigned[usize::from(*way)], at),
            Self::SwapAssigned(way, a, b) => swap(&mut settings.assigned[usize::from(*way)], a, b),
        }
    }
}

impl Settings {
    fn list(&mut self, (io, way, set): Place) -> &mut Vec<Address> {
        let sides = if io { &mut self.io } else { &mut self.pdo };
        &mut sides[usize::from(way)][set]
    }
}

fn swap<T>(list: &mut [T], a: &Index, b: &Index) {
    if !list.is_empty() {
        list.swap(a.index(list.len()), b.index(list.len()));
    }
}

fn remove<T>(list: &mut Vec<T>, at: &Index) {
    if !list.is_empty() {
        list.remove(at.index(list.len()));
    }
}

fn insert<T>(list: &mut Vec<T>, at: &Index, element: T) {
    list.insert(at.index(list.len() + 1), element);
}

/// Settings that violate one rule, and its event.
pub(crate) struct Break {
    pub(crate) settings: Settings,
    pub(crate) event: u32,
}

/// One rule to violate, in one direction and on one side.
#[derive(Clone, Copy, Debug)]
pub(crate) enum BreakOf {
    /// 5-3-1: the data set with this number is only on one side; the other one replaces it there.
    Combination { way: usize, set: usize },
    /// 5-3-2.
    Total { io: bool, way: usize },
    /// 5-3-3.
    Type { io: bool, way: usize, set: usize },
    /// 5-3-4.
    Order { io: bool, way: usize, set: usize },
    /// 5-3-5.
    Matched { way: usize, set: usize },
    /// 5-3-6.
    SyncManagerOrder { way: usize },
    /// 7-5-4, footnote.
    UnitStatus,
    /// 7-5-4, maximum entries.
    Maximum { io: bool, way: usize },
}

pub(crate) fn any_break() -> impl Strategy<Value = BreakOf> {
    let (io, way, set) = (any::<bool>, || 0..2usize, || 0..3usize);
    prop_oneof![
        (way(), set()).prop_map(|(way, set)| BreakOf::Combination { way, set }),
        (io(), way()).prop_map(|(io, way)| BreakOf::Total { io, way }),
        (io(), way(), set()).prop_map(|(io, way, set)| BreakOf::Type { io, way, set }),
        (io(), way(), set()).prop_map(|(io, way, set)| BreakOf::Order { io, way, set }),
        (way(), set()).prop_map(|(way, set)| BreakOf::Matched { way, set }),
        way().prop_map(|way| BreakOf::SyncManagerOrder { way }),
        Just(BreakOf::UnitStatus),
        (io(), way()).prop_map(|(io, way)| BreakOf::Maximum { io, way }),
    ]
}

impl BreakOf {
    /// Violates the rule in correct settings; the changed direction initially has 5, 4 and 3 entries.
    pub(crate) fn of(self, right: Settings) -> Break {
        let five_four_three = Settings::of([[5, 4, 3]; 2], [[5, 4, 3]; 2]);
        let mut settings = right;
        let broken = self.way();
        settings.io[broken] = five_four_three.io[broken].clone();
        settings.pdo[broken] = five_four_three.pdo[broken].clone();
        settings.assigned[broken] = five_four_three.assigned[broken].clone();
        let event = self.make(&mut settings);
        Break { settings, event }
    }

    fn way(self) -> usize {
        match self {
            Self::Combination { way, .. }
            | Self::Total { way, .. }
            | Self::Type { way, .. }
            | Self::Order { way, .. }
            | Self::Matched { way, .. }
            | Self::SyncManagerOrder { way }
            | Self::Maximum { way, .. } => way,
            Self::UnitStatus => 1,
        }
    }

    fn make(self, settings: &mut Settings) -> u32 {
        match self {
            Self::Combination { way, set } => {
                settings.assigned[way].retain(|&index| index != pdo(way, set));
                [0x3917_0000, 0x3916_0000][way]
            }
            Self::Total { io, way } => {
                *settings.list((io, way == 1, 0)) = (1..=40).map(|sub| (own(io, way, 0), sub)).collect();
                [[0x392C_0000, 0x392D_0000], [0x391D_0000, 0x391C_0000]][usize::from(io)][way]
            }
            Self::Type { io, way, set } => {
                settings.list((io, way == 1, set))[1] = (own(io, way, (set + 1) % 3), 1);
                [[0x391E_0000, 0x391F_0000], [0x391B_0000, 0x391A_0000]][usize::from(io)][way]
            }
            Self::Order { io, way, set } => {
                settings.list((io, way == 1, set)).swap(0, 2);
                [[0x3914_0000, 0x3915_0000], [0x3919_0000, 0x3913_0000]][usize::from(io)][way]
            }
            Self::Matched { way, set } => {
                settings.pdo[way][set].pop();
                [0x3917_0000, 0x3916_0000][way]
            }
            Self::SyncManagerOrder { way } => {
                settings.assigned[way].swap(0, 1);
                [0x392E_0000, 0x392F_0000][way]
            }
            Self::UnitStatus => {
                settings.assigned[1].retain(|&index| index != 0x1A00);
                0x3509_0000
            }
            Self::Maximum { io, way } => {
                *settings.list((io, way == 1, 1)) =
                    (1..=MAXIMUM[1] + 1).map(|sub| (own(io, way, 1), sub)).collect();
                [[0x350A_0000, 0x3509_0000], [0x391B_0000, 0x391A_0000]][usize::from(io)][way]
            }
        }
    }
}

fn own(io: bool, way: usize, set: usize) -> u16 {
    if io { io_entry(way, set) } else { pdo_entry(way, set) }
}
