//! Failed cases for people: the first ones in full, and of very many the number of the others with their seeds.

use super::result::CaseResult;
use super::story;

/// Most cases in full that failed in the same line of the same file.
const IN_FULL_OF_A_LINE: usize = 3;
/// Most cases in full.
const IN_FULL: usize = 200;
/// Most seeds that are named of the other cases of a line.
const SEEDS_NAMED: usize = 8;
/// Most lines of files with other cases.
const LINES_NAMED: usize = 500;

/// The failed cases so far, in the order of their numbers.
#[derive(Default)]
pub(crate) struct FailedCases {
    lines: Vec<FailedLine>,
    in_full: usize,
    /// Cases of further lines, which are only counted.
    beyond: u64,
}

/// The cases that failed in the same line of a file.
struct FailedLine {
    /// The file, with the parameters.
    name: String,
    line: usize,
    in_full: usize,
    others: u64,
    seeds: Vec<u64>,
}

impl FailedCases {
    /// Takes a failed case, and returns whether it is one that is printed in full.
    pub(crate) fn is_in_full(&mut self, result: &CaseResult) -> bool {
        let name = result.named();
        let line = result.failure.as_ref().map_or(0, |failure| failure.line);
        // Cases of one file follow each other.
        let known = self.lines.iter().rposition(|known| known.line == line && known.name == name);
        let place = match known {
            Some(place) => place,
            None if self.lines.len() == LINES_NAMED => {
                self.beyond += 1;
                return false;
            }
            None => {
                self.lines.push(FailedLine { name, line, in_full: 0, others: 0, seeds: Vec::new() });
                self.lines.len() - 1
            }
        };
        let Some(failed) = self.lines.get_mut(place) else { return true };
        if failed.in_full < IN_FULL_OF_A_LINE && self.in_full < IN_FULL {
            failed.in_full += 1;
            self.in_full += 1;
            return true;
        }
        failed.others += 1;
        if failed.seeds.len() < SEEDS_NAMED {
            failed.seeds.push(result.seed);
        }
        false
    }

    /// The lines of the cases that are not printed in full; empty if there are none.
    pub(crate) fn others(&self) -> String {
        let lines = self.lines.iter().filter(|line| line.others > 0);
        let mut words: String = lines.map(FailedLine::words).collect();
        if self.beyond > 0 {
            words.push_str(&format!("FAILED  and {} of other lines\n", story::more_cases(self.beyond)));
        }
        words
    }
}

impl FailedLine {
    fn words(&self) -> String {
        let mut seeds: Vec<String> = self.seeds.iter().map(u64::to_string).collect();
        if self.others > self.seeds.len() as u64 {
            seeds.push("…".to_owned());
        }
        let (name, seeds) = (&self.name, seeds.join(", "));
        format!("FAILED  {name}:{}: {}, seeds {seeds}\n", self.line, story::more_cases(self.others))
    }
}

#[cfg(test)]
mod tests {
    use super::super::partition::Partition;
    use super::super::result::{FailedStep, Verdict};
    use super::*;

    fn failed(file: &str, line: usize, seed: u64) -> CaseResult {
        CaseResult {
            case: seed,
            cases: 1,
            partition: Partition::WHOLE,
            campaign: String::new(),
            file: file.to_owned(),
            parameters: None,
            command: None,
            frames: Vec::new(),
            met: None,
            title: String::new(),
            seed,
            verdict: Verdict::Failed,
            failure: Some(FailedStep {
                line,
                step: String::new(),
                at_ns: 0,
                seen: String::new(),
                panicked_at: None,
            }),
            warnings: Vec::new(),
            virtual_ns: 0,
            cycles: 0,
            differences: Vec::new(),
            trace_differences: Vec::new(),
            trace: None,
        }
    }

    #[test]
    fn of_each_line_the_first_cases_are_in_full_and_the_others_are_counted() {
        let mut cases = FailedCases::default();
        let in_full = (1..=20).filter(|&seed| cases.is_in_full(&failed("a", 5, seed))).count();
        assert!(cases.is_in_full(&failed("a", 6, 21)) && cases.is_in_full(&failed("b", 5, 1)));
        assert_eq!(in_full, 3);
        assert_eq!(cases.others(), "FAILED  a:5: 17 more cases, seeds 4, 5, 6, 7, 8, 9, 10, 11, …\n");
    }

    #[test]
    fn of_very_many_lines_the_first_are_in_full_and_the_last_are_counted() {
        let mut cases = FailedCases::default();
        let in_full = (1..=600).filter(|&line| cases.is_in_full(&failed("a", line, 1))).count();
        let others = cases.others();
        assert_eq!((in_full, others.lines().count()), (200, 301));
        assert!(others.starts_with("FAILED  a:201: 1 more case, seeds 1\n"), "{others}");
        assert!(others.ends_with("FAILED  and 100 more cases of other lines\n"), "{others}");
    }
}
