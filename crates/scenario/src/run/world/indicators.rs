//! The indicators of the units in the trace: a line for each change of patterns.

use plant::HappeningKind;

use super::World;

impl World {
    /// Records the indicators whose patterns have changed. Without a trace they are not looked at.
    pub(super) fn watch_indicators(&mut self) {
        if !self.recording.has_trace() {
            return;
        }
        let Self { network, observer, recording, now, .. } = self;
        for at in 0..network.len() {
            let Some(names) = network.device(at).map(|device| device.unit().model().indicators()) else {
                return;
            };
            let mut news = Vec::new();
            observer.indicators(*now, at, network, |happening| {
                if let HappeningKind::Indicator { place, pattern } = happening.kind
                    && let Some(name) = names.get(usize::from(place))
                {
                    news.push(format!("{name} is {}", pattern.id()));
                }
            });
            if !news.is_empty() {
                recording.tell(*now, &format!("unit {}", at + 1), &news.join(", "));
            }
        }
    }
}
