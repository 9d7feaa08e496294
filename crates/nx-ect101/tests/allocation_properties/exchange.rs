//! The exchange plan, byte by byte.

use nx_ect101::{Direction, Verdict};
use proptest::prelude::*;

use crate::CASES;
use crate::configurations::{Settings, any_settings, unequal_settings};
use crate::model::{ENTRY_BYTES, pdo, status_bytes};

/// The contents of an image before the plan was applied.
const UNTOUCHED: u8 = 0xEE;

/// The position of entry k of each data set in the CPU Unit's image: one data set after the other.
fn io_offset(settings: &Settings, way: usize, set: usize, entry: usize) -> usize {
    io_bytes(settings, way, set) + entry * ENTRY_BYTES[set]
}

/// Bytes of the first `sets` data sets.
fn io_bytes(settings: &Settings, way: usize, sets: usize) -> usize {
    (0..sets).map(|set| settings.io[way][set].len() * ENTRY_BYTES[set]).sum()
}

/// The position of entry k of each data set in the SyncManager: in the order of the assignment, status in between.
fn pdo_offset(settings: &Settings, way: usize, set: usize, entry: usize) -> usize {
    let before = settings.assigned[way].iter().take_while(|&&index| index != pdo(way, set));
    before.map(|&index| pdo_bytes(settings, way, index)).sum::<usize>() + entry * ENTRY_BYTES[set]
}

fn pdo_bytes(settings: &Settings, way: usize, index: u16) -> usize {
    let set = (0..3).find(|&set| pdo(way, set) == index);
    set.map_or(status_bytes(index), |set| settings.pdo[way][set].len() * ENTRY_BYTES[set])
}

/// Lengths of the CPU Unit's image and of the SyncManager.
fn lengths(settings: &Settings, way: usize) -> (usize, usize) {
    let io = io_bytes(settings, way, 3);
    let pdo = settings.assigned[way].iter().map(|&index| pdo_bytes(settings, way, index)).sum();
    (io, pdo)
}

/// Entries that exist on both sides.
fn common(settings: &Settings, way: usize, set: usize) -> usize {
    let assigned = settings.assigned[way].contains(&pdo(way, set));
    let pdo = if assigned { settings.pdo[way][set].len() } else { 0 };
    settings.io[way][set].len().min(pdo)
}

/// The expected image after a plan of `way`.
fn expected(settings: &Settings, way: usize, from: &[u8], length: usize) -> Vec<u8> {
    let mut image = vec![UNTOUCHED; length];
    for set in 0..3 {
        for entry in 0..common(settings, way, set) {
            let (io, pdo) = (io_offset(settings, way, set, entry), pdo_offset(settings, way, set, entry));
            let (source, target) = if way == 0 { (pdo, io) } else { (io, pdo) };
            let bytes = ENTRY_BYTES[set];
            image[target..target + bytes].copy_from_slice(&from[source..source + bytes]);
        }
    }
    image
}

fn pattern(length: usize, seed: u8) -> Vec<u8> {
    (0..length).map(|at| (at % 251) as u8 ^ (at / 251) as u8 ^ seed).collect()
}

/// Applies the plan of `way` to a pattern.
fn applied(verdict: &Verdict, way: usize, from: &[u8], length: usize) -> Vec<u8> {
    let mut image = vec![UNTOUCHED; length];
    verdict.plan.copies(Direction::ALL[way]).apply(from, &mut image);
    image
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(CASES / 4))]

    #[test]
    fn a_plan_moves_every_byte_that_both_sides_have_and_nothing_else(
        settings in unequal_settings(),
        seed in any::<u8>(),
    ) {
        let verdict = settings.configuration().check();
        for way in 0..2 {
            let (io, pdo) = lengths(&settings, way);
            let (from, to) = if way == 0 { (pdo, io) } else { (io, pdo) };
            let from = pattern(from, seed);
            prop_assert_eq!(applied(&verdict, way, &from, to), expected(&settings, way, &from, to));
            let told = verdict.data_sets.iter().filter(|set| set.data_set.direction == Direction::ALL[way]);
            for (set, told) in told.enumerate() {
                prop_assert_eq!(told.exchanged_entries, common(&settings, way, set));
            }
        }
    }

    #[test]
    fn a_plan_stays_within_both_images_and_is_empty_when_nothing_can_be_exchanged(settings in any_settings()) {
        let configuration = settings.configuration();
        let verdict = configuration.check();
        let stops = verdict.findings.iter().any(|finding| !["combination", "matched"].contains(&finding.rule.id()));
        for direction in Direction::ALL {
            let io = configuration.io.layout(direction).size_bytes();
            let pdo = nx_ect101::pdo_settings::size_bytes(&configuration.pdo, direction);
            let (from, to) = if direction == Direction::MToC { (pdo, io) } else { (io, pdo) };
            for copy in verdict.plan.copies(direction).copies() {
                prop_assert!(copy.from + copy.length_bytes <= from && copy.to + copy.length_bytes <= to);
            }
            prop_assert!(!stops || verdict.plan.copies(direction).copies().is_empty());
        }
        let exchanged: usize = verdict.data_sets.iter().map(|set| set.exchanged_bytes()).sum();
        let moved = Direction::ALL.into_iter().flat_map(|direction| verdict.plan.copies(direction).copies());
        prop_assert_eq!(exchanged, moved.map(|copy| copy.length_bytes).sum::<usize>());
    }
}
