//! `ectwin merge RESULT.jsonl…`: the parts of a campaign as one, if none of its cases is missing or double.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use ectwin::user_files::{self, Wanted};

use super::replay::{CASES_MAX, CaseResult, Partition, Verdict, case_count, failure_story, junit_report};
use crate::cli::MergeArgs;
use crate::failure::Failure;
use crate::file_problem::{FileProblem, FileProblems};
use crate::output;
use crate::overwrite::{self, Output};

/// Cases that one line of a message names.
const NAMED_CASES: usize = 8;

/// A result and the file that it was read from.
struct Read<'a> {
    result: CaseResult,
    from: &'a Path,
}

/// Tells the failed cases and the sum of all.
pub(crate) fn run(args: &MergeArgs) -> Result<(), Failure> {
    if let Some(path) = &args.junit {
        overwrite::refuse(&[Output { option: "--junit", path }], &args.results)?;
    }
    let read = read_all(&args.results)?;
    let results = complete(read)?;
    let failed = results.iter().filter(|result| result.verdict == Verdict::Failed);
    for result in failed.clone() {
        let told = format!("FAILED  {}: {}\n{}", result.file, result.title, failure_story(result));
        output::print(told.as_bytes())?;
    }
    if let Some(path) = &args.junit {
        output::write(Some(path), junit_report(&results)?.as_bytes())?;
    }
    let (all, failed) = (results.len() as u64, failed.count() as u64);
    output::print_line(format_args!("{}: {} ok, {failed} failed", case_count(all), all - failed))?;
    if failed == 0 { Ok(()) } else { Err(Failure::CasesFailed) }
}

fn read_all(paths: &[PathBuf]) -> Result<Vec<Read<'_>>, Failure> {
    let (mut results, mut problems) = (Vec::new(), FileProblems::default());
    for path in paths {
        let text = match user_files::text(path, Wanted::Results) {
            Ok(text) => text,
            Err(error) => {
                let message = format!("cannot read {}: {error}", path.display());
                problems.push(FileProblem::of_file(&message, &error.help()));
                continue;
            }
        };
        let mut start = 0;
        for line in text.split_inclusive('\n') {
            match result_of(line) {
                Ok(result) => results.push(Read { result, from: path }),
                Err(reason) => {
                    let span = start..start + line.trim_end().len();
                    problems.push_by(|| no_result(path, &text, span, &reason));
                }
            }
            start += line.len();
        }
    }
    if problems.is_empty() { Ok(results) } else { Err(Failure::BadFile(problems)) }
}

fn result_of(line: &str) -> Result<CaseResult, String> {
    let result: CaseResult = serde_json::from_str(line).map_err(|error| error.to_string())?;
    let is_case = (1..=result.cases).contains(&result.case) && result.cases <= CASES_MAX;
    if is_case && result.partition.has(result.case) {
        Ok(result)
    } else {
        Err(format!("case {} of {} in part {} cannot be", result.case, result.cases, result.partition))
    }
}

fn no_result(path: &Path, text: &str, span: std::ops::Range<usize>, reason: &str) -> FileProblem {
    let help = "each line comes from `ectwin replay --json`; a job that was killed may have left half a line";
    FileProblem::in_text(path, text, span, &format!("this line is no result: {reason}"), help)
}

/// All cases of one campaign, in order.
fn complete(read: Vec<Read<'_>>) -> Result<Vec<CaseResult>, Failure> {
    let Some(first) = read.first() else {
        return Err(refused("there is no result in these files", "each part writes its own by `--json`"));
    };
    if let Some(other) = read.iter().find(|read| campaign(&read.result) != campaign(&first.result)) {
        let message =
            format!("{} and {} are not of one campaign", first.from.display(), other.from.display());
        return Err(refused(&message, "run all parts by one version, with the same files and seeds"));
    }
    let (_, cases, parts) = campaign(&first.result);
    let mut merged: BTreeMap<u64, Read<'_>> = BTreeMap::new();
    for read in read {
        let (case, from) = (read.result.case, read.from.display());
        if let Some(other) = merged.insert(case, read) {
            let message = format!("case {case} is there twice: in {} and in {from}", other.from.display());
            return Err(refused(&message, "give each part once"));
        }
    }
    let missing: Vec<u64> = (1..=cases).filter(|case| !merged.contains_key(case)).collect();
    if missing.is_empty() {
        Ok(merged.into_values().map(|read| read.result).collect())
    } else {
        Err(lacking(&missing, cases, parts))
    }
}

/// What all parts of a campaign have in common: its fingerprint, the number of its cases and of its parts.
fn campaign(result: &CaseResult) -> (&str, u64, u64) {
    (&result.campaign, result.cases, result.partition.count())
}

/// Which parts lack which cases.
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
