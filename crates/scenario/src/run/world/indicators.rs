//! The indicators of the units in the trace: a line for each change of patterns.

use coe_kit::indicators::Pattern;

use super::World;

impl World {
    /// Records the indicators whose patterns have changed. Without a trace they are not looked at.
    pub(super) fn watch_indicators(&mut self) {
        if !self.recording.has_trace() {
            return;
        }
        for at in 0..self.network.len() {
            let bench = self.bench();
            let names = bench.unit(at).model().indicators();
            let patterns = names.iter().map(|name| bench.pattern(at, name).unwrap_or_default());
            let patterns: Vec<Pattern> = patterns.collect();
            let before = self.watched.get(at).map_or(&[][..], |watched| &watched.patterns);
            if patterns == before {
                continue;
            }
            let is_news =
                |place: usize, pattern: Pattern| before.get(place).copied().unwrap_or_default() != pattern;
            let news = names
                .iter()
                .zip(&patterns)
                .enumerate()
                .filter(|(place, (_, pattern))| is_news(*place, **pattern));
            let words: Vec<String> =
                news.map(|(_, (name, pattern))| format!("{name} is {}", pattern.id())).collect();
            if !words.is_empty() {
                self.recording.tell(self.now, &format!("unit {}", at + 1), &words.join(", "));
            }
            if let Some(watched) = self.watched.get_mut(at) {
                watched.patterns = patterns;
            }
        }
    }
}
