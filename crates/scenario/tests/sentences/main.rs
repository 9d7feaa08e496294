//! Every sentence of the public tables is in a scenario that passes and in one that must fail.
//!
//! The tables determine the list: a sentence without a row here fails this test.

mod acts;
mod conditions;
mod cpu;
mod line;
mod master;
mod messages;
mod raw;
mod rows;
mod unit;

use rows::{ConditionRow, OrderRow};
use scenario::model::{Condition, CpuOrder, LineOrder, MasterOrder, UnitOrder};
use scenario::words::{ACTS, QUANTITIES, Spoken, row_of};

/// The sentences of a table without a row.
fn missing<T: Spoken>(rows: &[&str]) -> Vec<&'static str> {
    let patterns: Vec<&str> = rows
        .iter()
        .map(|text| match row_of(T::SENTENCES, text) {
            Some(sentence) => sentence.pattern,
            None => panic!("`{text}` is no sentence of its table"),
        })
        .collect();
    T::SENTENCES.iter().map(|sentence| sentence.pattern).filter(|known| !patterns.contains(known)).collect()
}

fn all_are_right(outcomes: impl Iterator<Item = Result<(), String>>) {
    let wrong: Vec<String> = outcomes.filter_map(Result::err).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

fn orders<T: Spoken>(key: &str, rows: &[OrderRow]) {
    let sentences: Vec<&str> = rows.iter().map(|row| row.sentence).collect();
    assert_eq!(missing::<T>(&sentences), [""; 0], "sentences of `{key}` without a row");
    all_are_right(rows.iter().map(|row| row.try_out(key)));
}

#[test]
fn each_order_of_the_master_does_what_it_says() {
    orders::<MasterOrder>("master", &[master::rows(), messages::orders(), raw::orders()].concat());
}

#[test]
fn each_order_to_a_unit_does_what_it_says() {
    orders::<UnitOrder>("unit", &unit::rows());
}

#[test]
fn each_order_to_a_cpu_unit_does_what_it_says() {
    orders::<CpuOrder>("cpu", &cpu::rows());
}

#[test]
fn each_order_to_the_line_does_what_it_says() {
    orders::<LineOrder>("line", &line::rows());
}

/// Only a bug of a model makes the first one fail and the second one hold: the planted bugs of `tests/planted` do.
const ORACLES: [&str; 2] =
    ["the diagnosis of unit 1 is consistent", "the diagnosis of unit 1 is contradictory"];

#[test]
fn each_condition_holds_and_fails() {
    let rows =
        [conditions::rows(), messages::conditions(), raw::conditions(), acts::acts(), acts::conditions()]
            .concat();
    let sentences: Vec<&str> = rows.iter().map(|row| row.sentence).chain(ORACLES).collect();
    assert_eq!(missing::<Condition>(&sentences), [""; 0], "conditions without a row");
    all_are_right(rows.iter().map(ConditionRow::try_out));
}

#[test]
fn each_act_of_a_master_has_a_row() {
    let rows = acts::acts();
    assert_eq!(rows.len(), ACTS.len(), "one row for each");
    for (act, row) in ACTS.iter().zip(&rows) {
        let verb = act.pattern.split_whitespace().next().unwrap_or_default();
        assert!(row.sentence.contains(verb), "{} is not {}", row.sentence, act.pattern);
    }
}

#[test]
fn each_quantity_has_a_value_that_passes_and_fails() {
    let rows = conditions::quantities();
    let begins_with = |pattern: &str, row: &&ConditionRow| {
        let first: Vec<&str> = pattern.split_whitespace().take_while(|word| !word.starts_with('{')).collect();
        row.sentence.starts_with(&first.join(" "))
    };
    assert_eq!(rows.len(), QUANTITIES.len(), "one row for each");
    for (quantity, row) in QUANTITIES.iter().zip(&rows) {
        assert!(begins_with(quantity.pattern, &row), "{} is not {}", row.sentence, quantity.pattern);
    }
    all_are_right(rows.iter().map(ConditionRow::try_out));
}
