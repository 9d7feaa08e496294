//! Random steps: how many, in which time, and what they are drawn from.

use plant::notation::FromOne;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use time::Duration;

/// Random steps, instead of this one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RandomSteps {
    /// Their number, 1 to 10,000.
    pub count: u64,
    /// Their maximum duration together.
    pub within: Duration,
    /// What they are drawn from; none: the everyday pool, in which every sentence has the same weight.
    pub draws: Option<Draws>,
}

/// What random steps are drawn from.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Draws {
    /// Names of groups of the [pool](crate::pool), and own sentences.
    pub from: Vec<String>,
    /// The weight of each of them, from 1; empty: 1 for each.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub weights: Vec<u64>,
}

/// The value of `random`: a number, or a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct RandomForm {
    pub(crate) steps: u64,
    pub(crate) draws: Option<Draws>,
}

/// The keys of the table.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RandomTable {
    steps: u64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    from: Option<Vec<String>>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    weights: Vec<u64>,
}

impl From<RandomTable> for RandomForm {
    fn from(RandomTable { steps, from, weights }: RandomTable) -> Self {
        let draws = match (from, weights.is_empty()) {
            (None, true) => None,
            (from, _) => Some(Draws { from: from.unwrap_or_default(), weights }),
        };
        Self { steps, draws }
    }
}

impl Serialize for RandomForm {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Some(Draws { from, weights }) = self.draws.clone() else {
            return self.steps.serialize(serializer);
        };
        RandomTable { steps: self.steps, from: Some(from), weights }.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for RandomForm {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NumberOrTable)
    }
}

struct NumberOrTable;

/// The words for what `random` is.
pub(crate) const EXPECTED: &str =
    "a number of steps, or a table such as { steps = 30, from = [\"line\", \"sdo\"] }";

impl<'de> serde::de::Visitor<'de> for NumberOrTable {
    type Value = RandomForm;

    fn expecting(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        formatter.write_str(EXPECTED)
    }

    fn visit_u64<E: serde::de::Error>(self, steps: u64) -> Result<RandomForm, E> {
        Ok(RandomForm { steps, draws: None })
    }

    fn visit_i64<E: serde::de::Error>(self, steps: i64) -> Result<RandomForm, E> {
        let steps = FromOne { expected: EXPECTED, number: Some }.visit_i64(steps)?;
        Ok(RandomForm { steps, draws: None })
    }

    fn visit_map<A: serde::de::MapAccess<'de>>(self, map: A) -> Result<RandomForm, A::Error> {
        RandomTable::deserialize(serde::de::value::MapAccessDeserializer::new(map)).map(RandomForm::from)
    }
}
