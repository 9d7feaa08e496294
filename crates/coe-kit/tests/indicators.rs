//! Patterns over two seconds of virtual time, and the states of RUN, ERR and L/A.
//!
//! The expectations are written by hand from ETG.1300 (reference 9); they do not come from the tables of the crate.

use coe_kit::indicators::{Pattern, PortCondition, err, run};
use proptest::prelude::*;
use time::{Duration, Instant};
use wire::{AlState, AlStatusCode};

/// ETG.1300, two seconds, `#` lit and `.` dark for 50 ms each.
const PATTERNS: &str = "
not_lit      ........................................
lit          ########################################
flickering   #.#.#.#.#.#.#.#.#.#.#.#.#.#.#.#.#.#.#.#.
blinking     ####....####....####....####....####....
single_flash ####....................####............
double_flash ####....####....................####....
flashing_1s  ##########..........##########..........
flashing_2s  ####################....................
";

fn at_ms(millis: u64) -> Instant {
    Instant::ZERO + Duration::from_millis(millis)
}

/// Two seconds of a pattern from `start_ms` on.
fn drawn(pattern: Pattern, start_ms: u64) -> String {
    let lit = |step: u64| pattern.is_lit(at_ms(start_ms + 50 * step));
    (0..40).map(|step| if lit(step) { '#' } else { '.' }).collect()
}

/// C122
#[test]
fn each_pattern_has_the_timing_of_etg_1300() {
    let lines = Pattern::ALL.map(|pattern| format!("{:<12} {}\n", pattern.id(), drawn(pattern, 0)));
    assert_eq!(lines.concat(), PATTERNS.trim_start());
}

#[test]
fn a_pattern_begins_again_after_its_period_and_its_edges_are_exact() {
    let periods = [(Pattern::Flickering, 100), (Pattern::SingleFlash, 1_200), (Pattern::DoubleFlash, 1_600)];
    for (pattern, period_ms) in periods {
        assert_eq!(drawn(pattern, 0), drawn(pattern, 1_000_000 * period_ms));
    }
    let edge = Instant::from_nanos(199_999_999);
    assert!(Pattern::Blinking.is_lit(edge) && !Pattern::Blinking.is_lit(at_ms(200)));
    assert_eq!(Pattern::Blinking.next_change(edge), at_ms(200));
    assert_eq!(Pattern::DoubleFlash.next_change(at_ms(600)), at_ms(1_600));
    assert_eq!([Pattern::Lit, Pattern::NotLit].map(|steady| steady.next_change(edge)), [Instant::NEVER; 2]);
}

#[test]
fn run_shows_the_state() {
    let shown = AlState::ALL.map(|state| format!("{state} {}", run(state).id()));
    let expected = ["INIT not_lit", "PRE-OP blinking", "BOOT flickering", "SAFE-OP single_flash", "OP lit"];
    assert_eq!(shown, expected);
    assert_eq!(run(AlState::Other(5)), Pattern::NotLit, "a state of no standard");
}

#[test]
fn err_shows_what_has_happened() {
    let codes = [0x0011, 0x001A, 0x001B, 0x001E, 0x002D, 0x0032];
    let shown = codes.map(|code| format!("{code:04X} {}", err(Some(AlStatusCode(code))).id()));
    let expected = [
        "0011 blinking",
        "001A single_flash",
        "001B double_flash",
        "001E blinking",
        "002D single_flash",
        "0032 single_flash",
    ];
    assert_eq!(shown, expected);
    assert_eq!(err(None), Pattern::NotLit);
}

#[test]
fn l_a_shows_the_port() {
    let shown = PortCondition::ALL.map(PortCondition::pattern);
    assert_eq!(shown, [Pattern::NotLit, Pattern::Lit, Pattern::Flickering]);
    assert_eq!(PortCondition::new(false, true), PortCondition::NoLink, "frames without a link");
}

proptest! {
    /// An observer that waits for the next change misses none, and no wait ends without a change.
    #[test]
    fn nothing_changes_before_the_next_change(
        pattern in prop::sample::select(&Pattern::ALL[2..]),
        at in 0u64..1 << 62,
        part in 0u64..1_000,
    ) {
        let at = Instant::from_nanos(at);
        let next = pattern.next_change(at);
        prop_assert!(next > at);
        let between = Instant::from_nanos(at.as_nanos() + (next.as_nanos() - 1 - at.as_nanos()) / 1_000 * part);
        let before = Instant::from_nanos(next.as_nanos() - 1);
        prop_assert_eq!([between, before].map(|at| pattern.is_lit(at)), [pattern.is_lit(at); 2]);
        prop_assert_ne!(pattern.is_lit(next), pattern.is_lit(at));
    }
}
