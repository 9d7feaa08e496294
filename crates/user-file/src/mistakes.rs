//! The mistakes in a file: the first ones in full, the others as a number.

/// The number of mistakes of one file, or of one command, that are reported in full.
pub const MISTAKES_MAX: usize = 20;

/// Keeps the first [`MISTAKES_MAX`] mistakes in the order of the file, and counts the rest.
#[derive(Debug)]
pub struct Mistakes<T> {
    /// In the order of their places.
    kept: Vec<(usize, T)>,
    more: usize,
}

impl<T> Default for Mistakes<T> {
    fn default() -> Self {
        Self { kept: Vec::new(), more: 0 }
    }
}

impl<T> Mistakes<T> {
    /// Notes a mistake at this byte. Its text is made only if it is among the first.
    pub fn note(&mut self, at: usize, mistake: impl FnOnce() -> T) {
        let place = self.kept.partition_point(|(known, _)| *known <= at);
        if place >= MISTAKES_MAX {
            self.more += 1;
            return;
        }
        self.kept.insert(place, (at, mistake()));
        if self.kept.len() > MISTAKES_MAX {
            self.kept.pop();
            self.more += 1;
        }
    }

    /// Whether there is none.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.kept.is_empty()
    }

    /// Their number.
    #[must_use]
    pub const fn count(&self) -> usize {
        self.kept.len() + self.more
    }

    /// The first ones, and the number of others.
    #[must_use]
    pub fn into_parts(self) -> (Vec<T>, usize) {
        (self.kept.into_iter().map(|(_, mistake)| mistake).collect(), self.more)
    }
}

/// The line after the reported mistakes; none if these are all.
#[must_use]
pub fn and_more(count: usize) -> Option<String> {
    (count > 0).then(|| format!("and {count} more"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_of_the_file_are_kept_whatever_the_order_they_are_found_in() {
        let mut mistakes = Mistakes::default();
        for at in (0..100).rev() {
            mistakes.note(at, || at);
        }
        assert_eq!(mistakes.into_parts(), ((0..MISTAKES_MAX).collect(), 100 - MISTAKES_MAX));
    }

    #[test]
    fn mistakes_at_one_place_stay_in_the_order_they_are_found_in() {
        let mut mistakes = Mistakes::default();
        for number in 0..3 {
            mistakes.note(7, || number);
        }
        assert_eq!(mistakes.into_parts(), (vec![0, 1, 2], 0));
    }

    #[test]
    fn words_are_found_for_those_that_are_told_only() {
        let mut worded = 0;
        let mut mistakes = Mistakes::default();
        for at in 0..1_000 {
            mistakes.note(at, || worded += 1);
        }
        assert_eq!(worded, MISTAKES_MAX);
        assert_eq!([and_more(0), and_more(980)], [None, Some("and 980 more".to_owned())]);
    }
}
