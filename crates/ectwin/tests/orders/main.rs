//! Every sentence for units, CPU Units and the line works in virtual time and in real time, and every sentence of the
//! scripted master is refused there. The tables of sentences determine the list: a sentence without a row fails.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

mod conditions;
mod places;
mod refusals;
mod rows;

use std::collections::BTreeSet;

use ectwin::link::memory::{MemoryPort, pair};
use ectwin::scenario::model::{CpuOrder, LineOrder, UnitOrder};
use ectwin::scenario::words::{Spoken, row_of};
use ectwin::{Duration, Live, NotHeld, Refused, Twin};

use places::Files;
use rows::Row;

/// A program with the variables that the examples of conditions name.
const PROGRAM: &str =
    "VAR counter, Scans : UINT; END_VAR\ncounter := N1_UINTs_01_M_to_C[0];\nScans := Scans + 1;\n";

/// Enough for every effect; only a failure waits for it.
const SOON: Duration = Duration::from_millis(10_000);

/// Two units; the first one has a program.
fn twin() -> Twin {
    let first = ectwin::Setup::from_toml("model = \"nx-ect101\"\nname = \"N1\"").unwrap();
    let first = first.structured_text(PROGRAM).unwrap();
    let second = ectwin::Setup::from_toml("model = \"nx-ect101\"\nname = \"N2\"").unwrap();
    Twin::power_on([first, second])
}

/// The same in real time; the port is the master's end of the link.
fn live() -> (Live, MemoryPort) {
    let (port, masters_end) = pair();
    (twin().serve(port).unwrap(), masters_end)
}

/// A line in one of both times.
enum Line {
    Virtual(Box<Twin>),
    Real(Live, #[expect(dead_code, reason = "the link is open as long as it is there")] MemoryPort),
}

impl Line {
    fn both() -> [Self; 2] {
        let (live, port) = live();
        [Self::Virtual(Box::new(twin())), Self::Real(live, port)]
    }

    fn apply(&mut self, order: &str) -> Result<(), Refused> {
        match self {
            Self::Virtual(twin) => twin.apply(order),
            Self::Real(live, _) => live.apply(order),
        }
    }

    fn holds(&mut self, condition: &str) -> Result<bool, Refused> {
        match self {
            Self::Virtual(twin) => twin.holds(condition),
            Self::Real(live, _) => live.holds(condition),
        }
    }

    fn expect(&mut self, condition: &str, within: Duration) -> Result<(), NotHeld> {
        match self {
            Self::Virtual(twin) => twin.expect(condition, within),
            Self::Real(live, _) => live.expect(condition, within),
        }
    }

    fn faults(&mut self) -> usize {
        match self {
            Self::Virtual(twin) => twin.faults().len(),
            Self::Real(live, _) => live.faults().len(),
        }
    }
}

/// Each row, in both times; and the table has no sentence without a row.
fn all_work<T: Spoken>(rows: &[Row], files: &Files) {
    let pattern = |sentence: &str| match row_of(T::SENTENCES, sentence) {
        Some(row) => row.pattern,
        None => panic!("`{sentence}` is no sentence of its table"),
    };
    let rows: Vec<_> = rows.iter().map(|row| (files.in_place(row.sentence), row)).collect();
    let there: BTreeSet<&str> = rows.iter().map(|(sentence, _)| pattern(sentence)).collect();
    let missing: Vec<_> =
        T::SENTENCES.iter().map(|row| row.pattern).filter(|known| !there.contains(known)).collect();
    assert_eq!(missing, [""; 0], "sentences without a row");
    for (sentence, row) in &rows {
        for mut line in Line::both() {
            works(&mut line, sentence, row);
        }
    }
}

fn works(line: &mut Line, sentence: &str, row: &Row) {
    for step in row.before {
        match step.strip_prefix("expect ") {
            Some(condition) => {
                line.expect(condition, SOON).unwrap_or_else(|seen| panic!("{sentence}: {seen}"))
            }
            None => line.apply(step).unwrap_or_else(|refused| panic!("{sentence}: {step}: {refused}")),
        }
    }
    if let Some(effect) = row.effect {
        assert_eq!(line.holds(effect), Ok(false), "`{effect}` before `{sentence}`");
    }
    line.apply(sentence).unwrap_or_else(|refused| panic!("{sentence}: {refused}"));
    if let Some(effect) = row.effect {
        line.expect(effect, SOON).unwrap_or_else(|seen| panic!("{sentence}: {seen}"));
    }
    assert_eq!(line.faults(), row.faults, "faults of the line after `{sentence}`");
}

#[test]
fn each_order_to_a_unit_works_in_both_times() {
    all_work::<UnitOrder>(rows::UNIT, &Files::new());
}

#[test]
fn each_order_to_a_cpu_unit_works_in_both_times() {
    all_work::<CpuOrder>(rows::CPU, &Files::new());
}

#[test]
fn each_order_to_the_line_works_in_both_times() {
    all_work::<LineOrder>(rows::LINE, &Files::new());
}
