//! When steps happen: their order, repetitions, the steps of the dice.

use core::ops::Range;

use time::Duration;
use toml::Spanned;

use super::entries::StepEntry;
use super::reader::Reader;
use crate::model::Trigger;
use crate::run::RandomPart;

/// Most repetitions of a step, and most steps of the dice.
const STEPS_MAX: u64 = 10_000;

impl Reader<'_> {
    /// Times from the beginning that run backwards, or behind the limit, can never be.
    pub(crate) fn check_order(
        &mut self,
        trigger: &Trigger,
        reached: &mut Duration,
        limit: Duration,
        span: Range<usize>,
    ) {
        let at = match trigger {
            Trigger::At(at) if *at < *reached => {
                let message =
                    format!("{at} lies before the step in front of it, which is not before {reached}");
                return self.refuse(span, message, "steps happen in the order of the file");
            }
            Trigger::At(at) => *at,
            Trigger::After(after) | Trigger::About(after, _) => *reached + *after,
            Trigger::AtOnce | Trigger::When(_) => *reached,
        };
        *reached = at;
        if at > limit {
            self.refuse(span, format!("{at} lies behind the limit of {limit}"), "set `limit = \"…\"` higher");
        }
    }

    /// `{ random = 12, within = "1s" }`: steps that the dice write.
    pub(crate) fn random(
        &mut self,
        entry: &StepEntry,
        span: Range<usize>,
        place: usize,
        random: &mut Option<RandomPart>,
    ) {
        let (Some(count), Some(within)) = (&entry.random, &entry.within) else {
            return self.refuse(
                span,
                "`random` needs the time that its steps take together",
                "such as `within = \"1s\"`",
            );
        };
        if random.is_some() {
            return self.refuse(span, "a scenario has one `random` step", "");
        }
        if !(1..=STEPS_MAX).contains(count.get_ref()) {
            return self.refuse(count.span(), format!("`random` is 1 to {STEPS_MAX} steps"), "");
        }
        let Some(within) = self.duration(within) else { return };
        let count = *count.get_ref() as usize;
        *random = Some(RandomPart { place, count, span: within, line: self.line(span.start), bytes: span });
    }

    /// How often a step happens once more, and when.
    pub(crate) fn repetition(&mut self, entry: &StepEntry, span: Range<usize>) -> Option<(u64, Trigger)> {
        match (&entry.repeat, &entry.every) {
            (None, None) if entry.jitter.is_none() => None,
            (Some(times), Some(every)) => {
                if !(1..=STEPS_MAX).contains(times.get_ref()) {
                    self.refuse(times.span(), format!("`repeat` is 1 to {STEPS_MAX} times"), "");
                    return None;
                }
                let every = self.duration(every)?;
                let jitter = entry.jitter.as_ref().map(|jitter| self.duration(jitter));
                let trigger = match jitter.unwrap_or(Some(Duration::ZERO))? {
                    jitter if jitter > every => {
                        self.refuse(
                            span,
                            format!("a jitter of {jitter} is more than the period of {every}"),
                            "",
                        );
                        return None;
                    }
                    Duration::ZERO => Trigger::After(every),
                    jitter => Trigger::About(every, jitter),
                };
                Some((*times.get_ref() - 1, trigger))
            }
            _ => {
                self.refuse(span, "`repeat` and `every` belong together, and `jitter` to both", "");
                None
            }
        }
    }

    pub(crate) fn line(&self, at: usize) -> usize {
        self.lines.line(at)
    }

    pub(crate) fn cycle(&mut self, text: &Spanned<String>) -> Option<Duration> {
        let cycle = self.duration(text)?;
        if cycle.is_zero() {
            self.refuse(text.span(), "a cycle of 0 never ends", "such as `cycle = \"1ms\"`");
        }
        Some(cycle)
    }

    pub(crate) fn duration(&mut self, text: &Spanned<String>) -> Option<Duration> {
        let duration = text.get_ref().parse();
        if let Err(error) = &duration {
            self.refuse(text.span(), format!("`{}`: {error}", text.get_ref()), "");
        }
        duration.ok()
    }
}
