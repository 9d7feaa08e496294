//! Lists of steps with groups: their form in a file, and all of them in their order.

use serde::{Deserialize, Serialize};

use super::step::ScriptStep;

/// A sequence of `together`: a list of steps, or one step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub(crate) enum Branch {
    /// Several steps.
    List(Vec<ScriptStep>),
    /// One step.
    One(Box<ScriptStep>),
}

impl Branch {
    pub(crate) fn steps(self) -> Vec<ScriptStep> {
        match self {
            Self::List(steps) => steps,
            Self::One(step) => vec![*step],
        }
    }
}

/// All entries of a list of steps in their order, each group before its own steps.
pub(crate) fn in_order(steps: &[ScriptStep]) -> Vec<&ScriptStep> {
    let mut entries = Vec::new();
    add(steps, &mut entries);
    entries
}

fn add<'s>(steps: &'s [ScriptStep], entries: &mut Vec<&'s ScriptStep>) {
    for step in steps {
        entries.push(step);
        if let ScriptStep::Group(group) = step {
            group.members.sequences().iter().for_each(|steps| add(steps, entries));
        }
    }
}
