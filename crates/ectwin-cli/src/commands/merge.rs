//! `ectwin merge RESULT.jsonl…`: merges the parts of a campaign, if none of its cases is missing or duplicate.

use std::collections::BTreeMap;
use std::mem;
use std::path::{Path, PathBuf};

use ectwin::user_files::{Lines, Unreadable, Wanted};

use super::replay::{CASES_MAX, CaseResult, Partition, Verdict, case_count, failure_story, junit_report};
use crate::cli::MergeArgs;
use crate::failure::Failure;
use crate::file_problem::{FileProblem, FileProblems};
use crate::output::{self, People};
use crate::overwrite::{self, Output};

/// Maximum number of cases in one line of a message.
const NAMED_CASES: usize = 8;

/// Reports the failed cases and the totals.
pub(crate) fn run(args: &MergeArgs) -> Result<(), Failure> {
    if let Some(path) = &args.junit {
        overwrite::refuse(&[Output { option: "--junit", path }], &args.results)?;
    }
    let kept = if args.junit.is_some() { Kept::All } else { Kept::Failed };
    let (results, all) = read_all(&args.results, kept)?.complete()?;
    let people = People::beside(args.junit.as_deref());
    let failed = results.iter().filter(|result| result.verdict == Verdict::Failed);
    for result in failed.clone() {
        let told = format!("FAILED  {}: {}\n{}", result.file, result.title, failure_story(result));
        people.print_text(&told)?;
    }
    if let Some(path) = &args.junit {
        output::write(Some(path), junit_report(&results)?.as_bytes())?;
    }
    let failed = failed.count() as u64;
    people.print_line(format_args!("{}: {} ok, {failed} failed", case_count(all), all - failed))?;
    if failed == 0 { Ok(()) } else { Err(Failure::CasesFailed) }
}

/// Reads file after file. Lines that are not results are reported, the first of them in full; one more ends the
/// reading.
fn read_all(paths: &[PathBuf], kept: Kept) -> Result<Merged<'_>, Failure> {
    let (mut merged, mut problems) = (Merged::new(paths, kept), FileProblems::default());
    for (file, path) in paths.iter().enumerate() {
        let read = read_file(path, |result| merged.take(result, file), &mut problems);
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
    mut take: impl FnMut(CaseResult) -> Result<(), Failure>,
    problems: &mut FileProblems,
) -> Result<(), NotMerged> {
    let mut lines = Lines::open(path, Wanted::Results).map_err(NotMerged::Unreadable)?;
    while let Some((number, line)) = lines.next_line().map_err(NotMerged::Unreadable)? {
        match result_of(line) {
            Ok(result) => take(result).map_err(NotMerged::Contrary)?,
            Err(_) if problems.is_full() => return Err(NotMerged::TooManyProblems),
            Err(reason) => problems.push(no_result(path, number, line, &reason)),
        }
    }
    Ok(())
}

fn result_of(line: &[u8]) -> Result<CaseResult, String> {
    let result: CaseResult = serde_json::from_slice(line).map_err(|error| error.to_string())?;
    let is_case = (1..=result.cases).contains(&result.case) && result.cases <= CASES_MAX;
    if is_case && result.partition.has(result.case) {
        Ok(result)
    } else {
        Err(format!("case {} of {} in part {} cannot be", result.case, result.cases, result.partition))
    }
}

fn no_result(path: &Path, number: usize, line: &[u8], reason: &str) -> FileProblem {
    let help = "each line comes from `ectwin replay --json`; a job that was killed may have left half a line";
    let message = format!("this line is no result: {reason}");
    FileProblem::in_line(path, number, &String::from_utf8_lossy(line), &message, help)
}

/// Which results are kept until the end; for all others only their presence is recorded.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kept {
    Failed,
    All,
}

/// The results of one campaign, in the order of reading.
struct Merged<'a> {
    paths: &'a [PathBuf],
    kept: Kept,
    campaign: Option<Campaign>,
    /// For each case the number of its file, from 1; 0: none so far.
    files: Vec<u32>,
    results: Vec<CaseResult>,
}

/// The common values of all parts of a campaign, and the first file with them.
struct Campaign {
    fingerprint: String,
    cases: u64,
    parts: u64,
    file: usize,
}

impl<'a> Merged<'a> {
    const fn new(paths: &'a [PathBuf], kept: Kept) -> Self {
        Self { paths, kept, campaign: None, files: Vec::new(), results: Vec::new() }
    }

    /// Adds a result of the file at this position.
    fn take(&mut self, mut result: CaseResult, file: usize) -> Result<(), Failure> {
        let fingerprint = mem::take(&mut result.campaign);
        let own = Campaign { fingerprint, cases: result.cases, parts: result.partition.count(), file };
        match &self.campaign {
            Some(first) if !first.is_that_of(&own) => {
                let (first, other) = (self.path(first.file), self.path(file));
                let message = format!("{first} and {other} are not of one campaign");
                return Err(refused(&message, "run all parts by one version, with the same files and seeds"));
            }
            Some(_) => {}
            None => {
                self.files = vec![0; own.cases as usize];
                self.campaign = Some(own);
            }
        }
        self.note(result.case, file)?;
        if self.kept == Kept::All || result.verdict == Verdict::Failed {
            self.results.push(result);
        }
        Ok(())
    }

    /// The case is present.
    fn note(&mut self, case: u64, file: usize) -> Result<(), Failure> {
        let Some(place) = self.files.get_mut(case as usize - 1) else {
            unreachable!("case {case} is one of its campaign");
        };
        match mem::replace(place, file as u32 + 1) {
            0 => Ok(()),
            other => {
                let (one, two) = (self.path(other as usize - 1), self.path(file));
                let message = format!("case {case} is there twice: in {one} and in {two}");
                Err(refused(&message, "give each part once"))
            }
        }
    }

    fn path(&self, file: usize) -> String {
        self.paths.get(file).map(|path| path.display().to_string()).unwrap_or_default()
    }

    /// The kept results, in the order of their cases, and the number of all, if none is missing.
    fn complete(mut self) -> Result<(Vec<CaseResult>, u64), Failure> {
        let Some(Campaign { cases, parts, .. }) = self.campaign else {
            return Err(refused("there is no result in these files", "each part writes its own by `--json`"));
        };
        let missing: Vec<u64> =
            (1..).zip(&self.files).filter(|(_, file)| **file == 0).map(|(case, _)| case).collect();
        if !missing.is_empty() {
            return Err(lacking(&missing, cases, parts));
        }
        self.results.sort_unstable_by_key(|result| result.case);
        Ok((self.results, cases))
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
    refused(&told.join("; "), "run the missing parts again, each by its `--partition`")
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

fn refused(message: &str, help: &str) -> Failure {
    Failure::Refused { message: message.to_owned(), help: help.to_owned() }
}
