//! The lines of a client, from pieces of any length. A line that is too long is skipped, and never kept.

use std::collections::VecDeque;

use crate::messages::LINE_BYTES_MAX;

/// The lines that have been received, and the beginning of the next one.
#[derive(Debug, Default)]
pub(super) struct Lines {
    /// What has been received and not taken.
    bytes: VecDeque<u8>,
    /// Bytes of it that have no end of line in them.
    searched: usize,
    /// Whether the rest of the present line is skipped.
    skips: bool,
    has_ended: bool,
}

/// The next line.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Line {
    /// Without its end.
    Whole(Vec<u8>),
    /// It is longer than a request may be. The rest of it is skipped.
    TooLong,
}

impl Lines {
    /// A piece has been received.
    pub(super) fn add(&mut self, piece: &[u8]) {
        self.bytes.extend(piece);
    }

    /// Nothing more will be received: what there is after the last end of line is a line too.
    pub(super) const fn end(&mut self) {
        self.has_ended = true;
    }

    /// Bytes that wait.
    pub(super) fn waiting_bytes(&self) -> usize {
        self.bytes.len()
    }

    /// Whether there may be a line to take.
    pub(super) fn has_line(&self) -> bool {
        self.searched < self.bytes.len() || (self.has_ended && !self.skips && !self.bytes.is_empty())
    }

    /// Takes the next line; none: more has to be received first.
    pub(super) fn next(&mut self) -> Option<Line> {
        loop {
            let end = self.bytes.iter().skip(self.searched).position(|byte| *byte == b'\n');
            let Some(length_bytes) = end.map(|end| end + self.searched) else { return self.unended() };
            self.searched = 0;
            let is_too_long = length_bytes > LINE_BYTES_MAX;
            let line: Vec<u8> = self.bytes.drain(..=length_bytes).take(length_bytes).collect();
            match (std::mem::take(&mut self.skips), is_too_long) {
                (true, _) => {}
                (false, true) => return Some(Line::TooLong),
                // An empty line asks for nothing: people press the key.
                (false, false) if line.iter().all(u8::is_ascii_whitespace) => {}
                (false, false) => return Some(Line::Whole(line)),
            }
        }
    }

    /// The present line has no end yet.
    fn unended(&mut self) -> Option<Line> {
        self.searched = self.bytes.len();
        if self.skips || self.searched > LINE_BYTES_MAX {
            self.bytes.clear();
            self.searched = 0;
            return (!std::mem::replace(&mut self.skips, true)).then_some(Line::TooLong);
        }
        if self.has_ended && self.searched > 0 {
            self.searched = 0;
            let line: Vec<u8> = std::mem::take(&mut self.bytes).into();
            return (!line.iter().all(u8::is_ascii_whitespace)).then_some(Line::Whole(line));
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn taken(lines: &mut Lines) -> Vec<Line> {
        std::iter::from_fn(|| lines.next()).collect()
    }

    fn whole(text: &str) -> Line {
        Line::Whole(text.into())
    }

    #[test]
    fn lines_come_from_pieces_and_the_last_one_needs_no_end() {
        let mut lines = Lines::default();
        lines.add(b"on");
        assert_eq!(taken(&mut lines), []);
        lines.add(b"e\n\n \ntwo\r\nthr");
        assert_eq!(taken(&mut lines), [whole("one"), whole("two\r")]);
        lines.add(b"ee");
        lines.end();
        assert_eq!(taken(&mut lines), [whole("three")]);
        assert_eq!(taken(&mut lines), []);
    }

    #[test]
    fn a_line_of_ten_megabytes_is_one_mistake_and_takes_no_room() {
        let mut lines = Lines::default();
        let mut seen = Vec::new();
        for _ in 0..10_000_000 / 50_000 {
            lines.add(&[b'x'; 50_000]);
            seen.extend(taken(&mut lines));
            assert!(lines.waiting_bytes() <= LINE_BYTES_MAX);
        }
        lines.add(b"\nnext\n");
        seen.extend(taken(&mut lines));
        assert_eq!(seen, [Line::TooLong, whole("next")]);
    }

    #[test]
    fn the_longest_line_is_read() {
        let mut lines = Lines::default();
        lines.add(&[b'x'; LINE_BYTES_MAX]);
        lines.add(b"\n");
        assert!(matches!(lines.next(), Some(Line::Whole(line)) if line.len() == LINE_BYTES_MAX));
        lines.add(&[b'x'; LINE_BYTES_MAX + 1]);
        lines.add(b"\n");
        assert_eq!(taken(&mut lines), [Line::TooLong]);
    }

    proptest! {
        #[test]
        fn pieces_do_not_matter(text in "[ab\n]{0,60}", sizes in proptest::collection::vec(1..9_usize, 1..60)) {
            let mut lines = Lines::default();
            let mut seen = Vec::new();
            let mut rest = text.as_bytes();
            for size in sizes.into_iter().chain([usize::MAX]) {
                let (piece, after) = rest.split_at(size.min(rest.len()));
                lines.add(piece);
                seen.extend(taken(&mut lines));
                rest = after;
            }
            lines.end();
            seen.extend(taken(&mut lines));
            let expected: Vec<Line> = text.split('\n').filter(|line| !line.is_empty()).map(whole).collect();
            prop_assert_eq!(seen, expected);
        }
    }
}
