//! What random steps are drawn from, after it was checked with the units.

use crate::pool::{Drawing, KnownUnit};
use crate::run::Dice;

/// The groups and the own sentences of one `random`, and the units that they are about.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct ReadyDraws {
    pub(crate) units: Vec<KnownUnit>,
    /// Not empty.
    pub(crate) draws: Vec<Draw>,
}

/// A group, or an own sentence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Draw {
    pub(crate) weight: u64,
    /// Not empty.
    pub(crate) rows: Vec<DrawnRow>,
}

/// A sentence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct DrawnRow {
    pub(crate) weight: u64,
    pub(crate) key: &'static str,
    pub(crate) sentence: String,
    /// Positions of the units that it can be about; not empty.
    pub(crate) positions: Vec<usize>,
}

/// How often a value is drawn again before it is given up.
const TRIES: u32 = 100;

impl ReadyDraws {
    /// The key and the sentence of one step.
    pub(crate) fn sentence(&self, dice: &mut Dice) -> (&'static str, String) {
        for _ in 0..TRIES {
            let draw = weighted(&self.draws, |draw| draw.weight, dice);
            let row = weighted(&draw.rows, |row| row.weight, dice);
            if let Some(text) = row.text(&self.units, dice) {
                return (row.key, text);
            }
        }
        // No unit lost anything since its sentences were tried.
        unreachable!("a sentence that was tried with its units has values")
    }
}

impl DrawnRow {
    /// The sentence with its values.
    fn text(&self, units: &[KnownUnit], dice: &mut Dice) -> Option<String> {
        let position = self.positions[dice.below(self.positions.len() as u64) as usize];
        Drawing::new(dice, units, position)?.sentence(&self.sentence)
    }
}

/// One of a list, by its weight. A list without any weight gives its first one.
fn weighted<'t, T>(list: &'t [T], weight: impl Fn(&T) -> u64, dice: &mut Dice) -> &'t T {
    let total: u64 = list.iter().map(&weight).sum();
    let mut rest = dice.below(total.max(1));
    let chosen = list.iter().find(|one| {
        let weight = weight(one);
        let is_it = rest < weight;
        rest = rest.saturating_sub(weight);
        is_it
    });
    chosen.unwrap_or(&list[0])
}
