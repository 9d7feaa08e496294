//! `--list`: the files, their titles, and how many of their cases would be replayed.

use std::io::Write;
use std::path::Path;

use serde::Serialize;
use user_file::on_one_line;

use super::campaign::Campaign;
use super::case::{Case, named, title};
use super::partition::Partition;
use super::story;
use crate::failure::Failure;
use crate::later_output::LaterOutput;
use crate::output::{self, People};
use crate::overwrite::{self, Output};

/// A case that would be replayed, as a line of JSON.
#[derive(Serialize)]
struct ListedCase {
    case: u64,
    cases: u64,
    partition: Partition,
    file: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    parameters: Option<String>,
    title: String,
    seed: u64,
}

/// A file, and its cases in this part.
struct Listed {
    file: String,
    title: String,
    cases: u64,
    /// Their numbers by the values of the parameters.
    by_parameters: Vec<(String, u64)>,
}

/// Prints a line for each file with cases in this part, and below it one for the values of parameters; writes a line of
/// JSON for each case, if that is asked for.
pub(super) fn print(campaign: &Campaign, partition: Partition, json: Option<&Path>) -> Result<(), Failure> {
    let mut listed: Vec<Listed> = Vec::new();
    for number in campaign.cases_of(partition) {
        add(&mut listed, &campaign.case(number));
    }
    if let Some(path) = json {
        overwrite::refuse(&[Output { option: "--json", path }], campaign.inputs())?;
        write(campaign, partition, path)?;
    }
    let people = People::beside(json);
    for Listed { file, title, cases, by_parameters } in &listed {
        people.print_line(format_args!("{}: {title} ({})", named(file, None), story::cases(*cases)))?;
        for (parameters, cases) in by_parameters {
            people.print_line(format_args!(
                "        {} ({})",
                on_one_line(parameters),
                story::cases(*cases)
            ))?;
        }
    }
    people.print_line(story::cases(listed.iter().map(|file| file.cases).sum()))
}

fn add(listed: &mut Vec<Listed>, case: &Case<'_>) {
    let file = case.path.to_string_lossy();
    if listed.last().is_none_or(|last| last.file != file) {
        let title = on_one_line(&case.scenario.title);
        listed.push(Listed { file: file.into_owned(), title, cases: 0, by_parameters: Vec::new() });
    }
    let Some(last) = listed.last_mut() else { return };
    last.cases += 1;
    let Some(parameters) = &case.scenario.case else { return };
    match last.by_parameters.last_mut() {
        Some((known, count)) if known == parameters => *count += 1,
        _ => last.by_parameters.push((parameters.clone(), 1)),
    }
}

fn write(campaign: &Campaign, partition: Partition, path: &Path) -> Result<(), Failure> {
    let unwritable = |source| Failure::Unwritable { path: path.to_owned(), source };
    let mut lines = LaterOutput::open(path)?.begin();
    for number in campaign.cases_of(partition) {
        let case = campaign.case(number);
        let line = ListedCase {
            case: number,
            cases: case.count,
            partition,
            file: case.path.display().to_string(),
            parameters: case.scenario.case.clone(),
            title: title(case.scenario),
            seed: case.seed,
        };
        let line = output::json_line(&line)? + "\n";
        lines.write_all(line.as_bytes()).map_err(unwritable)?;
    }
    lines.complete().map_err(unwritable)
}
