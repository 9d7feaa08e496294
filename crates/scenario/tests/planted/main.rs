//! Planted bugs: the shipped searches find them, and cut them down to a few steps.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

mod bugs;
mod spoiled;

use std::path::Path;

use bugs::Planted;
use plant::UnitFile;
use scenario::{Failure, Found, Recording, Scenario};

/// The unit of the shipped searches.
const UNIT: &str = "model = \"nx-ect101\"\nid_switch = 5";
/// If this variable is set, the searches have their full length.
const FULL: &str = "ECTWIN_PLANTED";
const SEEDS_MAX: u64 = 1_000;
const STEPS_MAX: usize = 5;

fn text(file: &str) -> String {
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/search").join(format!("{file}.toml"));
    std::fs::read_to_string(path).expect("a shipped search")
}

fn scenario(text: &str) -> Scenario {
    Scenario::parse(text, |name| Err(name.to_owned())).expect("a right scenario")
}

fn with_bug(text: &str, planted: &'static Planted) -> Scenario {
    let mut scenario = scenario(text);
    let unit = UnitFile::parse_with(&[&planted.model], UNIT).expect("a right unit");
    scenario.units[0].file = unit;
    scenario
}

fn search(planted: &'static Planted) -> Option<(u64, Found)> {
    let text = text(planted.file);
    let scenario = with_bug(&text, planted);
    let search = scenario.searched();
    (1..=SEEDS_MAX).find_map(|seed| Some((seed, search.reduce(&text, &search.seed(seed))?)))
}

/// Number of seeds of a search without a bug, an even one.
fn seeds() -> u64 {
    if std::env::var_os(FULL).is_some() { SEEDS_MAX } else { 10 }
}

/// A part of the seeds of a search without a bug: each part is a test of its own, so that none takes long.
#[derive(Clone, Copy)]
enum Half {
    First,
    Second,
}

/// Ends if the search finds anything in a unit without a bug.
fn finds_nothing(file: &str, half: Half) {
    let (text, count) = (text(file), seeds() / 2);
    let first = match half {
        Half::First => 1,
        Half::Second => 1 + count,
    };
    if let Some(found) = scenario(&text).search(&text, first, count) {
        panic!("{file}, seed {}: {}\n{}", found.seed, found.failure, found.text);
    }
}

/// The tests of each shipped search with a unit without a bug.
macro_rules! without_a_bug {
    ($($search:ident $file:literal,)*) => {
        mod without_a_bug {
            $(mod $search {
                use crate::{Half, finds_nothing};

                #[test]
                fn the_first_seeds_find_nothing() {
                    finds_nothing($file, Half::First);
                }

                #[test]
                fn the_other_seeds_find_nothing() {
                    finds_nothing($file, Half::Second);
                }
            })*
        }
    };
}

without_a_bug! {
    diagnosis "diagnosis",
    mapping "mapping",
    messages "messages",
    start_up "start-up",
    two_causes "two-causes",
    unit "unit",
}

/// Ends unless the search finds the bug, cuts it down, and has written a file that only a unit with the bug fails.
fn is_found(planted: &'static Planted) {
    let (seed, found) = search(planted).expect("the bug within the seeds");
    let Planted { name, file, .. } = planted;
    let Found { steps, steps_before, failure, text, .. } = &found;
    println!("| {name} | `{file}.toml` | {seed} | {steps} of {steps_before} | `{}` |", failure.text);
    assert!(*steps <= STEPS_MAX, "{text}");
    // The lines are those of the written file.
    let same = |failure: &Failure| (failure.text.clone(), failure.panicked_at.clone());
    let written = with_bug(text, planted);
    let again = written.replay(written.seed, Recording::new(false, false)).failure.expect("the bug");
    assert_eq!(same(&again), same(failure), "{text}");
    let right = scenario(text);
    assert_eq!(right.replay(right.seed, Recording::new(false, false)).failure, None, "{text}");
}
