//! The values that the arms of a CASE have taken: an arm is refused that has a value of an arm above.

use std::collections::BTreeMap;

/// Ranges of values, each from its first value to its last. They do not overlap, so that the search for a value
/// looks at one of them: a CASE may have as many labels as the source has room for.
#[derive(Debug, Default)]
pub(super) struct CaseLabels {
    ranges: BTreeMap<i128, i128>,
}

impl CaseLabels {
    /// Whether one of the values `from..=to` is taken.
    pub(super) fn has_any(&self, from: i128, to: i128) -> bool {
        self.last_until(to).is_some_and(|(_, last)| from <= last)
    }

    /// Takes the values `from..=to`; some may have been taken before, as an arm may repeat its own values.
    pub(super) fn take(&mut self, mut from: i128, mut to: i128) {
        while let Some((first, last)) = self.last_until(to).filter(|(_, last)| from <= *last) {
            self.ranges.remove(&first);
            (from, to) = (from.min(first), to.max(last));
        }
        self.ranges.insert(from, to);
    }

    /// The last range that begins at `to` or before it.
    fn last_until(&self, to: i128) -> Option<(i128, i128)> {
        self.ranges.range(..=to).next_back().map(|(first, last)| (*first, *last))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_is_taken_if_any_range_has_it() {
        let ranges = [(5, 7), (0, 0), (20, 29), (9, 11), (6, 10), (-3, -3), (25, 26), (30, 30)];
        let mut labels = CaseLabels::default();
        for taken in 0..ranges.len() {
            for from in -5..35 {
                for to in from..35 {
                    let expected = ranges[..taken].iter().any(|(first, last)| from <= *last && *first <= to);
                    assert_eq!(labels.has_any(from, to), expected, "{from}..{to} of {:?}", &ranges[..taken]);
                }
            }
            labels.take(ranges[taken].0, ranges[taken].1);
        }
        assert_eq!(labels.ranges.len(), 5, "overlapping ranges are one: {labels:?}");
    }
}
