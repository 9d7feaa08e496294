//! Random steps: their number, and what they are drawn from, tried with each unit.

use user_file::{counted, did_you_mean, nearest};

use super::maker::Maker;
use super::problem::{Part, StepPart};
use super::steps::{Ground, ReadySteps, STEPS_MAX};
use super::unit_names::UnitNames;
use super::written::Written;
use crate::model::{Disturbance, Draws, LineOrder, Order, RandomSteps};
use crate::pool::{Drawing, GROUPS, Group, KnownUnit, MARKS};
use crate::random::{Draw, DrawnRow, ReadyDraws, order};
use crate::run::{Dice, RandomPart};

/// Number of drawn sentences with which a row is tried.
const TRIALS: usize = 32;
/// Maximum weight.
const WEIGHT_MAX: u64 = 1_000_000;
/// The keys of orders.
const KEYS: [&str; 4] = ["master", "unit", "cpu", "line"];

impl Maker<'_> {
    pub(super) fn random(
        &mut self,
        at: usize,
        random: RandomSteps,
        written: Written,
        ground: Ground,
        ready: &mut ReadySteps,
    ) {
        let part = Part::Step(at, StepPart::Count);
        if !(1..=STEPS_MAX).contains(&random.count) {
            let message = format!("`random` is 1 to {STEPS_MAX} steps");
            return self.refuse(part, message, "");
        }
        let draws = match random.draws {
            None => self.everyday(part, ground),
            Some(draws) => match self.draws(&draws, part, ground) {
                Some(draws) => Some(draws),
                None => return,
            },
        };
        ready.random.push(RandomPart {
            place: ready.steps.len(),
            count: random.count as usize,
            span: random.within,
            line: written.line,
            bytes: written.bytes,
            draws,
        });
    }

    /// What steps without `from` are drawn from. None: from the whole everyday pool, for any of the units, if all of them can
    /// carry out all of it; seeds in scenario files depend on what is drawn then.
    fn everyday(&mut self, part: Part, ground: Ground) -> Option<ReadyDraws> {
        const EVERYDAY: &str = "everyday";
        if ground == Ground::Missing {
            return None;
        }
        let rows = self.rows(EVERYDAY, part)?;
        let units: Vec<KnownUnit> =
            self.units.iter().map(|unit| KnownUnit::of(unit.file.section())).collect();
        // One unit of each kind represents the others.
        let kinds: Vec<usize> =
            (0..units.len()).filter(|&position| !units[..position].contains(&units[position])).collect();
        let can_all =
            rows.iter().all(|row| kinds.iter().all(|&kind| self.is_possible(row, &units, kind, part)));
        if can_all {
            return None;
        }
        self.draws(&Draws { from: vec![EVERYDAY.to_owned()], weights: Vec::new() }, part, ground)
    }

    /// None if something is wrong, or if it is unknown which units there are.
    fn draws(&mut self, draws: &Draws, part: Part, ground: Ground) -> Option<ReadyDraws> {
        let Draws { from, weights } = draws;
        if from.is_empty() {
            self.refuse(part, "`from` is an empty list", "such as `from = [\"line\", \"unit\"]`");
            return None;
        }
        if !weights.is_empty() && weights.len() != from.len() {
            let (weights, from) = (counted(weights.len(), "weight"), counted(from.len(), "entry"));
            let message = format!("`weights` has {weights}, and `from` has {from}");
            self.refuse(part, message, "`weights` has one for each entry of `from`, in the same order");
            return None;
        }
        if let Some(weight) = weights.iter().find(|weight| !(1..=WEIGHT_MAX).contains(*weight)) {
            self.refuse(part, format!("a weight of {weight}, expected 1 to {WEIGHT_MAX}"), "");
            return None;
        }
        let rows: Vec<Option<Vec<DrawnRow>>> = from.iter().map(|from| self.rows(from, part)).collect();
        let rows: Vec<Vec<DrawnRow>> = rows.into_iter().collect::<Option<_>>()?;
        if ground == Ground::Missing {
            return None;
        }
        let units: Vec<KnownUnit> =
            self.units.iter().map(|unit| KnownUnit::of(unit.file.section())).collect();
        let weights = weights.iter().copied().chain(core::iter::repeat(1));
        let mut ready = Vec::new();
        for ((from, rows), weight) in from.iter().zip(rows).zip(weights) {
            let rows = rows.into_iter().filter_map(|row| self.with_units(row, &units, part)).collect();
            ready.push(self.drawn(from, rows, weight, part)?);
        }
        self.fault_names.may_have_ended();
        Some(ReadyDraws { units, draws: ready })
    }

    fn drawn(&mut self, from: &str, rows: Vec<DrawnRow>, weight: u64, part: Part) -> Option<Draw> {
        if rows.is_empty() {
            let message = format!("no unit of this scenario has anything for `{from}`");
            self.refuse(part, message, "take it away, or add a unit that has it");
            return None;
        }
        Some(Draw { weight, rows })
    }

    /// The sentences of a group, or the own sentence.
    fn rows(&mut self, from: &str, part: Part) -> Option<Vec<DrawnRow>> {
        let row = |key, sentence: &str, weight| DrawnRow {
            weight,
            key,
            sentence: sentence.to_owned(),
            positions: Vec::new(),
        };
        if let Some(group) = Group::named(from) {
            return Some(
                group.rows().map(|pooled| row(pooled.key, pooled.sentence, pooled.weight)).collect(),
            );
        }
        match order_of(from) {
            Some((_, Order::Line(LineOrder::Disturb(Disturbance { name: Some(name), .. })))) => {
                let message =
                    format!("`{from}`: a fault that is drawn has no name, because it can be drawn again");
                self.refuse(part, message, format!("leave `called {name}` out; `be quiet` ends all faults"));
                None
            }
            Some((_, Order::Line(LineOrder::End { name }))) if self.fault_names.of(&name).is_none() => {
                self.refuse_end(&name, part);
                None
            }
            Some((key, mut order)) => {
                if let Err((message, help)) = UnitNames::of(&self.units).number(order.unit_words()) {
                    self.refuse(part, message, help);
                    return None;
                }
                Some(vec![row(key, from, 1)])
            }
            None => {
                self.refuse(
                    part,
                    format!("`{from}` is neither a group of the pool nor a sentence"),
                    way_out(from),
                );
                None
            }
        }
    }

    /// The row with the units that can carry it out; none if there are none.
    fn with_units(&mut self, row: DrawnRow, units: &[KnownUnit], part: Part) -> Option<DrawnRow> {
        let positions: Vec<usize> =
            (0..units.len()).filter(|&position| self.is_possible(&row, units, position, part)).collect();
        (!positions.is_empty()).then_some(DrawnRow { positions, ..row })
    }

    /// Whether the checks of steps accept the sentence for this unit.
    fn is_possible(&mut self, row: &DrawnRow, units: &[KnownUnit], position: usize, part: Part) -> bool {
        let mut dice = Dice::new(position as u64);
        (0..TRIALS).all(|_| {
            let text = Drawing::new(&mut dice, units, position).and_then(|mut it| it.sentence(&row.sentence));
            let Some(Ok(mut order)) = text.map(|text| order(row.key, &text)) else { return false };
            if UnitNames::of(&self.units).number(order.unit_words()).is_err() {
                return false;
            }
            let (problems, fault_names) = (self.problems.len(), self.fault_names.clone());
            // A fault that has ended before a step may be at work before another seed's step.
            self.fault_names.may_have_ended();
            let _ = self.order(&mut order, part, Ground::Firm);
            let is_right = self.problems.len() == problems;
            self.problems.truncate(problems);
            self.fault_names = fault_names;
            is_right
        })
    }
}

/// The order of a sentence, with values that every unit has, and its key.
fn order_of(sentence: &str) -> Option<(&'static str, Order)> {
    let unit = KnownUnit::example();
    let mut dice = Dice::new(0);
    let text = Drawing::new(&mut dice, core::slice::from_ref(&unit), 0)?.any_sentence(sentence)?;
    KEYS.into_iter().find_map(|key| Some((key, order(key, &text).ok()?)))
}

/// Whether a word is written as the marks are, and is none.
fn is_unknown_mark(word: &str) -> bool {
    word.starts_with('<') && word.ends_with('>') && !MARKS.iter().any(|mark| mark.word == word)
}

/// The nearest mark if there is a wrong one; else the nearest group of one word, or the nearest sentence of the pool of several.
fn way_out(from: &str) -> String {
    if let Some(word) = from.split_whitespace().find(|word| is_unknown_mark(word)) {
        let marks: Vec<&str> = MARKS.iter().map(|mark| mark.word).collect();
        let meant =
            nearest(word, &marks).map_or_else(|| format!("the marks are {}", marks.join(", ")), did_you_mean);
        return format!("`{word}` is no mark: {meant}");
    }
    let groups: Vec<&str> = GROUPS.iter().map(|group| group.name).collect();
    let near = if from.contains(' ') {
        let sentences = GROUPS.iter().flat_map(|group| group.rows().map(|row| row.sentence));
        nearest(from, &sentences.collect::<Vec<_>>())
    } else {
        nearest(from, &groups)
    };
    near.map_or_else(
        || format!("the groups are {}; a sentence has `#` for a unit, `@` for a cable", groups.join(", ")),
        did_you_mean,
    )
}
