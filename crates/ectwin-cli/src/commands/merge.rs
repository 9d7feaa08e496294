//! `ectwin merge RESULT.jsonl…`: merges the parts of a campaign, if none of its cases is missing or duplicate, or those of
//! a search.

mod again;
mod contradiction;
mod place;
mod refused;
mod searches;

use std::collections::BTreeMap;
use std::mem;
use std::path::{Path, PathBuf};

use ectwin::user_files::{Lines, Unreadable, Wanted};

use super::replay::{
    CASES_MAX, CaseResult, FailedCases, JunitReport, Partition, Totals, Verdict, case_count, failed_case,
    with_warnings,
};
use crate::cli::MergeArgs;
use crate::failure::Failure;
use crate::file_problem::{FileProblem, FileProblems};
use crate::later_output::{LaterOutput, WholeOut};
use crate::output::People;
use crate::overwrite::{self, Output};
use again::ResultsAgain;
use contradiction::Seeds;
use place::Place;
use refused::refused;

/// Maximum number of cases in one line of a message.
const NAMED_CASES: usize = 8;

/// Reports the failed cases and the totals.
pub(crate) fn run(args: &MergeArgs) -> Result<(), Failure> {
    if let Some(path) = &args.junit {
        overwrite::refuse(&[Output { option: "--junit", path }], &args.results)?;
    }
    if searches::are_searches(&args.results) {
        return searches::run(args);
    }
    let found = read_all(&args.results)?.complete()?;
    let people = People::beside(args.junit.as_deref());
    let mut again = ResultsAgain::new(&args.results);
    let mut failed_cases = FailedCases::default();
    match &args.junit {
        Some(path) => report(path, &found, &mut again, &mut failed_cases, people)?,
        None => {
            for place in found.places.iter().filter(|place| place.verdict == Verdict::Failed) {
                print(&again.read(place)?, &mut failed_cases, people)?;
            }
        }
    }
    people.print_cases(&failed_cases.others())?;
    let Totals { cases, failed, warned, .. } = found.totals;
    let (ok, warned) = (cases - failed, with_warnings(warned));
    people.print_line(format_args!("{}: {ok} ok, {failed} failed{warned}", case_count(cases)))?;
    if failed == 0 { Ok(()) } else { Err(Failure::CasesFailed) }
}

/// Writes all results as JUnit, and prints the failed ones.
fn report(
    path: &Path,
    found: &Found,
    again: &mut ResultsAgain<'_>,
    failed_cases: &mut FailedCases,
    people: People,
) -> Result<(), Failure> {
    let unwritable = |source| Failure::Unwritable { path: path.to_owned(), source };
    let file = LaterOutput::open_whole(path)?.begin_whole().map_err(unwritable)?;
    let mut report = JunitReport::begin(file, "ectwin replay", found.totals).map_err(unwritable)?;
    for place in &found.places {
        let result = again.read(place)?;
        report.take(&result).map_err(unwritable)?;
        print(&result, failed_cases, people)?;
    }
    report.end().and_then(WholeOut::complete).map_err(unwritable)
}

/// Prints a failed result; of very many only the first ones.
fn print(result: &CaseResult, failed_cases: &mut FailedCases, people: People) -> Result<(), Failure> {
    match result.verdict {
        Verdict::Passed => Ok(()),
        Verdict::Failed if !failed_cases.is_in_full(result) => Ok(()),
        Verdict::Failed => people.print_cases(&failed_case(result)),
    }
}

/// Reads file after file. Lines that are not results are reported, the first of them in full; one more ends the
/// reading.
fn read_all(paths: &[PathBuf]) -> Result<Merged<'_>, Failure> {
    let (mut merged, mut problems) = (Merged::new(paths), FileProblems::default());
    let mut seeds = Seeds::default();
    for (file, path) in paths.iter().enumerate() {
        let read =
            read_file(path, |result, start| merged.take(result, file, start), &mut seeds, &mut problems);
        match read {
            Ok(()) => {}
            Err(NotMerged::Unreadable(error)) => {
                let message = format!("cannot read {}: {error}", path.display());
                problems.push(FileProblem::of_file(&message, &error.help()));
            }
            Err(NotMerged::TooManyProblems) => {
                problems.stop();
                break;
            }
            // A damaged file is reported first: its missing results may be the reason.
            Err(NotMerged::Contrary(_)) if !problems.is_empty() => break,
            Err(NotMerged::Contrary(failure)) => return Err(failure),
        }
    }
    if problems.is_empty() { Ok(merged) } else { Err(Failure::BadFile(problems)) }
}

/// Why the reading of a file ends early.
enum NotMerged {
    Unreadable(Unreadable),
    TooManyProblems,
    /// A result that contradicts another one.
    Contrary(Failure),
}

fn read_file(
    path: &Path,
    mut take: impl FnMut(CaseResult, u64) -> Result<(), Failure>,
    seeds: &mut Seeds,
    problems: &mut FileProblems,
) -> Result<(), NotMerged> {
    let mut lines = Lines::open(path, Wanted::Results).map_err(NotMerged::Unreadable)?;
    while let Some(line) = lines.next_line().map_err(NotMerged::Unreadable)? {
        match result_of(line.bytes, seeds) {
            Ok(result) => take(result, line.start).map_err(NotMerged::Contrary)?,
            Err(_) if problems.is_full() => return Err(NotMerged::TooManyProblems),
            Err(reason) => problems.push(no_result(path, line.number, line.bytes, &reason)),
        }
    }
    Ok(())
}

/// Why a line is not taken.
enum Wrong {
    NoResult(String),
    Contradiction(String),
}

fn result_of(line: &[u8], seeds: &mut Seeds) -> Result<CaseResult, Wrong> {
    let result: CaseResult =
        serde_json::from_slice(line).map_err(|error| Wrong::NoResult(error.to_string()))?;
    let CaseResult { case, cases, partition, .. } = &result;
    let is_case = (1..=*cases).contains(case) && *cases <= CASES_MAX;
    if !is_case || !partition.has(*case) {
        return Err(Wrong::NoResult(format!("case {case} of {cases} in part {partition} cannot be")));
    }
    match contradiction::of(&result).or_else(|| seeds.contradiction(&result)) {
        None => Ok(result),
        Some(words) => Err(Wrong::Contradiction(words)),
    }
}

fn no_result(path: &Path, number: usize, line: &[u8], wrong: &Wrong) -> FileProblem {
    let (message, help) = match wrong {
        Wrong::NoResult(reason) => (
            format!("this line is not a result: {reason}"),
            "each line must be written by `ectwin replay --json`; a killed job may have left an incomplete line",
        ),
        Wrong::Contradiction(reason) => (
            format!("this line was changed after it was written: {reason}"),
            "run the part again with its `--partition`",
        ),
    };
    FileProblem::in_line(path, number, &String::from_utf8_lossy(line), &message, help)
}

/// The places of all results, in the order of their cases.
struct Found {
    places: Vec<Place>,
    totals: Totals,
}

/// The results of one campaign, in the order of reading.
struct Merged<'a> {
    paths: &'a [PathBuf],
    campaign: Option<Campaign>,
    places: Vec<Place>,
    totals: Totals,
}

/// The common values of all parts of a campaign, and the first file with them.
struct Campaign {
    fingerprint: String,
    cases: u64,
    parts: u64,
    file: usize,
}

impl<'a> Merged<'a> {
    fn new(paths: &'a [PathBuf]) -> Self {
        Self { paths, campaign: None, places: Vec::new(), totals: Totals::default() }
    }

    /// Takes a result of the file at this place.
    fn take(&mut self, mut result: CaseResult, file: usize, start: u64) -> Result<(), Failure> {
        let fingerprint = mem::take(&mut result.campaign);
        let own = Campaign { fingerprint, cases: result.cases, parts: result.partition.count(), file };
        match &self.campaign {
            Some(first) if !first.is_that_of(&own) => {
                let (first, other) = (self.path(first.file), self.path(file));
                let message = format!("{first} and {other} are not of one campaign");
                return Err(refused(&message, "run all parts with the same version, files and seeds"));
            }
            Some(_) => {}
            None => {
                let none = Place { file: 0, verdict: Verdict::Passed, start: 0 };
                self.places = vec![none; own.cases as usize];
                self.campaign = Some(own);
            }
        }
        self.totals.add(&result);
        self.note(result.case, Place { file: file as u32 + 1, verdict: result.verdict, start })
    }

    /// The case is there.
    fn note(&mut self, case: u64, found: Place) -> Result<(), Failure> {
        let Some(place) = self.places.get_mut(case as usize - 1) else {
            unreachable!("case {case} is one of its campaign");
        };
        match mem::replace(place, found).file {
            0 => Ok(()),
            other => {
                let (one, two) = (self.path(other as usize - 1), self.path(found.file as usize - 1));
                let message = format!("case {case} is there twice: in {one} and in {two}");
                Err(refused(&message, "give each part once"))
            }
        }
    }

    fn path(&self, file: usize) -> String {
        self.paths.get(file).map(|path| path.display().to_string()).unwrap_or_default()
    }

    /// The places of the results, if none is missing.
    fn complete(self) -> Result<Found, Failure> {
        let Some(Campaign { cases, parts, .. }) = self.campaign else {
            return Err(refused(
                "there is no result in these files",
                "each part writes its results with `--json`",
            ));
        };
        let missing: Vec<u64> =
            (1..).zip(&self.places).filter(|(_, place)| place.file == 0).map(|(case, _)| case).collect();
        if !missing.is_empty() {
            return Err(lacking(&missing, cases, parts));
        }
        Ok(Found { places: self.places, totals: self.totals })
    }
}

impl Campaign {
    fn is_that_of(&self, other: &Self) -> bool {
        (&self.fingerprint, self.cases, self.parts) == (&other.fingerprint, other.cases, other.parts)
    }
}

/// The parts with missing cases, and these cases.
fn lacking(missing: &[u64], cases: u64, parts: u64) -> Failure {
    let mut by_part: BTreeMap<Partition, Vec<u64>> = BTreeMap::new();
    for &case in missing {
        by_part.entry(Partition::of_case(case, parts)).or_default().push(case);
    }
    let told: Vec<String> = by_part.iter().map(|(part, lacks)| of_part(*part, lacks, cases)).collect();
    refused(&told.join("; "), "run the missing parts again, each with its `--partition`")
}

fn of_part(part: Partition, lacks: &[u64], cases: u64) -> String {
    let has = part.cases_of(cases);
    if lacks.len() as u64 == has {
        return format!("part {part} is missing");
    }
    let mut names: Vec<String> = lacks.iter().take(NAMED_CASES).map(u64::to_string).collect();
    if lacks.len() > NAMED_CASES {
        names.push("…".to_owned());
    }
    format!("part {part} lacks {} of its {has} cases: {}", lacks.len(), names.join(", "))
}
