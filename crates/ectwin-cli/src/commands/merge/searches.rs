//! The parts of a search: each failure once, with its first seed, as a search of all seeds finds it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use ectwin::user_files::{Lines, Wanted};
use serde::Deserialize;

use super::refused::refused;
use crate::cli::MergeArgs;
use crate::commands::replay::{Partition, Spool};
use crate::commands::search::{EndLine, EndedBy, FoundLine, SearchId, SearchLine};
use crate::failure::Failure;
use crate::file_problem::{FileProblem, FileProblems};
use crate::output::People;

/// Most failures that are kept: of each part, those of different lines.
const FAILURES_MAX: usize = 100_000;

/// Whether the first line of these files is of a search.
pub(super) fn are_searches(paths: &[PathBuf]) -> bool {
    #[derive(Deserialize)]
    struct Kind {
        search: Option<String>,
    }
    let first_line = |path: &PathBuf| {
        let mut lines = Lines::open(path, Wanted::Results).ok()?;
        let line = lines.next_line().ok()??;
        Some(serde_json::from_slice::<Kind>(line.bytes).is_ok_and(|kind| kind.search.is_some()))
    };
    paths.iter().find_map(first_line).unwrap_or_default()
}

/// Reports the failures and the totals of all parts.
pub(super) fn run(args: &MergeArgs) -> Result<(), Failure> {
    let Searched { found, end, by_budget } = read_all(&args.results)?.complete()?;
    let people = People::beside(args.junit.as_deref());
    let mut junit = args.junit.as_deref().map(|path| Spool::open(path, "ectwin search")).transpose()?;
    for (number, line) in (1..).zip(&found) {
        people.print_cases(&line.story())?;
        if let Some(junit) = &mut junit {
            junit.take(&line.clone().test_case(number, (end.of.partition, end.of_part())))?;
        }
    }
    if let Some(mut junit) = junit {
        if found.is_empty() {
            junit.take(&end.test_case())?;
        }
        let not_ended: Vec<_> = by_budget.iter().filter_map(EndLine::not_ended).collect();
        junit.close(&not_ended)?;
    }
    people.print_line(end.totals())?;
    for part in &by_budget {
        let EndLine { of: SearchId { partition, .. }, tried, .. } = part;
        people.print_line(format_args!(
            "part {partition}: --budget has ended it after {tried} of {} runs",
            part.of_part()
        ))?;
    }
    if found.is_empty() { Ok(()) } else { Err(Failure::CasesFailed) }
}

fn read_all(paths: &[PathBuf]) -> Result<Read, Failure> {
    let (mut read, mut problems) = (Read::default(), FileProblems::default());
    for path in paths {
        let unreadable = |error| Failure::Unreadable { path: path.clone(), source: error };
        let mut lines = Lines::open(path, Wanted::Results).map_err(unreadable)?;
        while let Some(line) = lines.next_line().map_err(unreadable)? {
            let taken = line_of(line.bytes).and_then(|line| read.take(line));
            if let Err(reason) = taken {
                if problems.is_full() {
                    problems.stop();
                    return Err(Failure::BadFile(problems));
                }
                let text = String::from_utf8_lossy(line.bytes);
                let message = format!("this line is not of the search: {reason}");
                let help = "the lines must be as `ectwin search --json` has written them, for all parts of one search";
                problems.push(FileProblem::in_line(path, line.number, &text, &message, help));
            }
        }
    }
    if problems.is_empty() { Ok(read) } else { Err(Failure::BadFile(problems)) }
}

fn line_of(bytes: &[u8]) -> Result<SearchLine, String> {
    #[derive(Deserialize)]
    struct Kind {
        ended_by: Option<String>,
    }
    let told = |error: serde_json::Error| error.to_string();
    let kind: Kind = serde_json::from_slice(bytes).map_err(told)?;
    match kind.ended_by {
        Some(_) => serde_json::from_slice(bytes).map(SearchLine::End).map_err(told),
        None => serde_json::from_slice(bytes).map(SearchLine::Found).map_err(told),
    }
}

/// The lines of all parts.
#[derive(Default)]
struct Read {
    of: Option<SearchId>,
    found: Vec<FoundLine>,
    ends: BTreeMap<Partition, EndLine>,
}

/// All parts as one.
struct Searched {
    found: Vec<FoundLine>,
    end: EndLine,
    /// The parts with seeds that were not tried.
    by_budget: Vec<EndLine>,
}

impl Read {
    fn take(&mut self, line: SearchLine) -> Result<(), String> {
        let (SearchLine::Found(FoundLine { of, .. }) | SearchLine::End(EndLine { of, .. })) = &line;
        let first = self.of.get_or_insert_with(|| of.clone());
        if (&first.search, first.partition.count()) != (&of.search, of.partition.count()) {
            return Err(
                "it is of another search, by version, files, seeds, --all or number of parts".to_owned()
            );
        }
        match line {
            SearchLine::Found(_) if self.found.len() == FAILURES_MAX => {
                Err(format!("there are more than {FAILURES_MAX} failures"))
            }
            SearchLine::Found(found) => {
                self.found.push(found);
                Ok(())
            }
            SearchLine::End(end) => {
                end_contradiction(&end).map_or(Ok(()), Err)?;
                match self.ends.insert(end.of.partition, end) {
                    None => Ok(()),
                    Some(twice) => Err(format!("part {} is there twice", twice.of.partition)),
                }
            }
        }
    }

    fn complete(self) -> Result<Searched, Failure> {
        let Self { of, mut found, ends } = self;
        let Some(of) = of else {
            return Err(refused(
                "there is no result in these files",
                "each part writes its results with `--json`",
            ));
        };
        let parts =
            (1..=of.partition.count()).filter_map(|number| Partition::new(number, of.partition.count()));
        let missing: Vec<String> = parts
            .filter(|part| !ends.contains_key(part))
            .take(8)
            .map(|part| format!("part {part}"))
            .collect();
        if !missing.is_empty() {
            let message = format!("the search is not complete: the end of {} is missing", missing.join(", "));
            return Err(refused(&message, "run these parts again, each with its `--partition`"));
        }
        for end in ends.values() {
            check_part(end, &found)?;
        }
        let mut ends = ends.into_values();
        let Some(mut end) = ends.next() else { unreachable!("a search has parts, and none is missing") };
        let by_budget = |end: &EndLine| (end.ended_by == EndedBy::Budget).then(|| end.clone());
        let mut ended_by_budget: Vec<EndLine> = by_budget(&end).into_iter().collect();
        for part in ends {
            ended_by_budget.extend(by_budget(&part));
            end.tried = end.tried.saturating_add(part.tried);
            end.variations = end.variations.saturating_add(part.variations);
            end.virtual_ns = end.virtual_ns.saturating_add(part.virtual_ns);
        }
        let first_seed = end.first_seed;
        found.sort_by_key(|line| (line.case, line.seed.wrapping_sub(first_seed)));
        let mut kinds = BTreeSet::new();
        found.retain(|line| {
            let (case, place, number) = line.kind();
            kinds.insert((case, place.map(str::to_owned), number))
        });
        end.failures = found.len() as u64;
        end.ended_by = EndedBy::Seeds;
        end.of.partition = Partition::WHOLE;
        Ok(Searched { found, end, by_budget: ended_by_budget })
    }
}

/// What contradicts itself in the last line of a part.
fn end_contradiction(end: &EndLine) -> Option<String> {
    let (tried, of_part) = (end.tried, end.of_part());
    let is_all = tried == of_part;
    let wrong = match end.ended_by {
        EndedBy::Seeds => !is_all,
        EndedBy::Failure => tried > of_part || end.failures != 1,
        EndedBy::Budget | EndedBy::Signal => tried > of_part,
    };
    wrong.then(|| format!("it says that {tried} of {of_part} runs were tried, and {} failures", end.failures))
}

/// The failures of a part are those that its last line counts, of its seeds.
fn check_part(end: &EndLine, found: &[FoundLine]) -> Result<(), Failure> {
    let part = end.of.partition;
    if end.ended_by == EndedBy::Signal {
        let message = format!("a signal has ended part {part} after {} of {} runs", end.tried, end.of_part());
        return Err(refused(&message, "run this part again with its `--partition`"));
    }
    let own: Vec<&FoundLine> = found.iter().filter(|line| line.of.partition == part).collect();
    if own.len() as u64 != end.failures {
        let message =
            format!("part {part} has {} failures, and its last line says {}", own.len(), end.failures);
        return Err(refused(&message, "run this part again with its `--partition`"));
    }
    let number = |line: &FoundLine| line.seed.wrapping_sub(end.first_seed).wrapping_add(1);
    let is_own = |line: &&&FoundLine| {
        let is_seed = (1..=end.runs).contains(&number(line)) && part.has(number(line));
        is_seed && (1..=end.cases).contains(&line.case)
    };
    match own.iter().find(|line| !is_own(line)) {
        None => Ok(()),
        Some(line) => {
            let message =
                format!("seed {} of case {} is not one of part {part} of this search", line.seed, line.case);
            Err(refused(&message, "leave the lines as they were written"))
        }
    }
}
