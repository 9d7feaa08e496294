//! The lines of a trace that differ from the golden trace, by the longest common subsequence.

/// Most pairs of lines that are compared; beyond it, all lines between the first and the last difference differ.
const TABLE_CELLS_MAX: usize = 16_000_000;

/// A line that only one of two traces has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TraceDifference {
    /// The golden trace has it, with this number, from 1.
    Missing {
        /// Its number in the golden trace.
        number: usize,
        /// Its text, without its end.
        line: String,
    },
    /// The trace of the replay has it, with this number, from 1.
    Added {
        /// Its number in the trace of the replay.
        number: usize,
        /// Its text, without its end.
        line: String,
    },
}

impl core::fmt::Display for TraceDifference {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Missing { number, line } => write!(formatter, "-{number:>6}  {line}"),
            Self::Added { number, line } => write!(formatter, "+{number:>6}  {line}"),
        }
    }
}

/// All lines of two traces that differ, in the order of the traces.
#[must_use]
pub fn trace_differences(golden: &str, seen: &str) -> Vec<TraceDifference> {
    let [golden, seen] = [golden, seen].map(|trace| trace.split_inclusive('\n').collect::<Vec<_>>());
    let start = golden.iter().zip(&seen).take_while(|(one, other)| one == other).count();
    let (old, new) = (&golden[start..], &seen[start..]);
    let end = old.iter().rev().zip(new.iter().rev()).take_while(|(one, other)| one == other).count();
    let (old, new) = (&old[..old.len() - end], &new[..new.len() - end]);
    let text = |line: &str| visible(line);
    let edits = edits(old, new).into_iter();
    let difference = |edit| match edit {
        Edit::Remove(at) => TraceDifference::Missing { number: start + at + 1, line: text(old[at]) },
        Edit::Add(at) => TraceDifference::Added { number: start + at + 1, line: text(new[at]) },
    };
    edits.map(difference).collect()
}

/// A line with its unusual end and its invisible characters.
fn visible(line: &str) -> String {
    match line.strip_suffix('\n') {
        Some(text) if !text.ends_with('\r') => text.replace('\u{feff}', r"\u{feff}"),
        Some(text) => text.escape_debug().to_string(),
        None => format!("{line} (without the end of the line)"),
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Edit {
    /// Of the old lines.
    Remove(usize),
    /// Of the new lines.
    Add(usize),
}

/// The edits that make the new lines of the old ones: the fewest, unless the table for them is too large.
fn edits(old: &[&str], new: &[&str]) -> Vec<Edit> {
    let (mut removed, mut added) = (0, 0);
    let mut edits = Vec::new();
    if old.len().saturating_mul(new.len()) <= TABLE_CELLS_MAX {
        let common = Common::of(old, new);
        while removed < old.len() && added < new.len() {
            if old[removed] == new[added] {
                (removed, added) = (removed + 1, added + 1);
            } else if common.from(removed + 1, added) >= common.from(removed, added + 1) {
                edits.push(Edit::Remove(removed));
                removed += 1;
            } else {
                edits.push(Edit::Add(added));
                added += 1;
            }
        }
    }
    edits.extend((removed..old.len()).map(Edit::Remove));
    edits.extend((added..new.len()).map(Edit::Add));
    edits
}

/// The number of lines that can stay, from each pair of lines to the end.
struct Common {
    lengths: Vec<u32>,
    columns: usize,
}

impl Common {
    fn of(old: &[&str], new: &[&str]) -> Self {
        let columns = new.len() + 1;
        let mut common = Self { lengths: vec![0; (old.len() + 1) * columns], columns };
        for (row, one) in old.iter().enumerate().rev() {
            for (column, other) in new.iter().enumerate().rev() {
                let length = if one == other {
                    common.from(row + 1, column + 1) + 1
                } else {
                    common.from(row + 1, column).max(common.from(row, column + 1))
                };
                common.lengths[row * columns + column] = length;
            }
        }
        common
    }

    fn from(&self, row: usize, column: usize) -> u32 {
        self.lengths[row * self.columns + column]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn differences(golden: &str, seen: &str) -> Vec<String> {
        trace_differences(golden, seen).iter().map(TraceDifference::to_string).collect()
    }

    #[test]
    fn every_line_that_only_one_trace_has_is_there_with_its_number() {
        assert!(differences("a\nb\n", "a\nb\n").is_empty());
        assert_eq!(
            differences("a\nb\nc\nd\n", "a\nx\nc\ny\nd\n"),
            ["-     2  b", "+     2  x", "+     4  y"]
        );
        assert_eq!(differences("", "a\n"), ["+     1  a"]);
        assert_eq!(differences("a\na\nb\n", "a\nb\n"), ["-     2  a"]);
        assert_eq!(differences("a\nb\na\n", "a\n").len(), 2);
    }

    #[test]
    fn lines_that_look_alike_show_what_is_different() {
        assert_eq!(differences("a\r\n", "a\n"), [r"-     1  a\r", "+     1  a"]);
        assert_eq!(differences("\u{feff}a\n", "a\n"), [r"-     1  \u{feff}a", "+     1  a"]);
        assert_eq!(differences("a", "a\n"), ["-     1  a (without the end of the line)", "+     1  a"]);
    }

    #[test]
    fn traces_that_differ_everywhere_cost_no_endless_time() {
        let lines = |letter: char| (0..9_000).map(|line| format!("{letter}{line}\n")).collect::<String>();
        assert_eq!(trace_differences(&lines('a'), &lines('b')).len(), 18_000);
    }
}
