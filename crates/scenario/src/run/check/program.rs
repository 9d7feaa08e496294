//! Conditions of user programs: their variables, and what they have told.

use super::{Seen, holds, is_text};
use crate::model::{Condition, Controller};
use crate::run::story::Story;
use crate::run::world::World;

impl Condition {
    pub(super) fn check_program(&self, of: Controller, world: &World) -> Result<(), Seen> {
        if let Self::ProgramVariable { name, value, .. } = self {
            return is_text(world.program_variable(of, name), value);
        }
        match world.told(of) {
            Some(story) => self.check_story(story),
            None => Err(format!("{of} is not there")),
        }
    }

    fn check_story(&self, story: &Story) -> Result<(), Seen> {
        match self {
            Self::UserDefinedError { code, times, .. } => {
                let (seen, stands) = story.alarm(*code);
                holds(times.map_or(stands, |times| seen == times), || story.alarm_words())
            }
            Self::NoUserDefinedError(_) => holds(!story.has_alarms(), || story.alarm_words()),
            Self::TaskOverrun { seen, .. } => {
                let overruns = story.overruns();
                holds((overruns > 0) == *seen, || format!("there were {overruns} overruns"))
            }
            Self::ProgramError { position, .. } => {
                let is_there = story.errors().iter().any(|trouble| {
                    position.is_none_or(|position| position == (trouble.line, trouble.column))
                });
                holds(is_there, || story.error_words())
            }
            Self::NoProgramError(_) => holds(story.errors().is_empty(), || story.error_words()),
            _ => Ok(()),
        }
    }
}
