//! `--vacuous`: the expectations that test nothing, because their contraries are fulfilled too.

use std::io::Write;
use std::ops::ControlFlow;
use std::sync::Arc;

use scenario::{Recording, Vacuity, VacuousStep};
use serde::Serialize;
use user_file::{counted, on_one_line};

use super::campaign::Campaign;
use super::case::Case;
use super::partition::Partition;
use super::result::{CaseResult, Verdict, WarnedStep};
use super::{interrupted, story, threads};
use crate::cli::ReplayArgs;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::later_output::LaterOutput;
use crate::output::{self, People};
use crate::overwrite::{self, Output};

/// A case, as a line of JSON.
#[derive(Serialize)]
struct Checked {
    #[serde(flatten)]
    result: CaseResult,
    /// Number of its expectations.
    expectations: usize,
    /// Those that test nothing.
    vacuous: Vec<VacuousLine>,
}

#[derive(Serialize)]
struct VacuousLine {
    /// The line in the file, from 1.
    line: usize,
    /// The sentence.
    step: String,
}

impl Checked {
    /// Of a case that fails, no contrary is replayed.
    fn of(case: &Case<'_>, partition: Partition) -> Self {
        let report = case.scenario.replay(case.seed, Recording::new(false, false));
        let result = CaseResult::new(case, partition, &report);
        let Vacuity { expectations, vacuous } = match result.verdict {
            Verdict::Passed => case.scenario.vacuity(case.seed),
            Verdict::Failed => Vacuity::default(),
        };
        let line = |VacuousStep { line, text }| VacuousLine { line, step: text };
        Self { result, expectations, vacuous: vacuous.into_iter().map(line).collect() }
    }

    /// The warnings of steps that are not named because of their contraries.
    fn warnings(&self) -> impl Iterator<Item = &WarnedStep> {
        let is_named = |warned: &WarnedStep| self.vacuous.iter().any(|vacuous| vacuous.line == warned.line);
        self.result.warnings.iter().filter(move |warned| !is_named(warned))
    }

    /// Number of its findings.
    fn findings(&self) -> usize {
        self.vacuous.len() + self.warnings().count()
    }

    fn words(&self) -> String {
        let file = on_one_line(&self.result.file);
        let line = |VacuousLine { line, step }: &VacuousLine| {
            format!("{file}:{line}: `{}` tests nothing: its contrary passes too\n", on_one_line(step))
        };
        let warning = |WarnedStep { line, step, message }: &WarnedStep| {
            format!("{file}:{line}: `{}`: {message}\n", on_one_line(step))
        };
        match self.result.verdict {
            Verdict::Passed => self.vacuous.iter().map(line).chain(self.warnings().map(warning)).collect(),
            Verdict::Failed => story::failed_case(&self.result),
        }
    }
}

/// Prints the expectations of a part that test nothing; none may, and all cases must pass.
pub(super) fn run(campaign: Campaign, partition: Partition, args: &ReplayArgs) -> Result<(), Failure> {
    let json = args.json.as_deref();
    let outputs: Vec<_> = json.map(|path| Output { option: "--json", path }).into_iter().collect();
    overwrite::refuse(&outputs, campaign.inputs())?;
    let people = People::beside(json);
    let mut lines = json.map(LaterOutput::open).transpose()?.map(LaterOutput::begin);
    let cases: Vec<u64> = campaign.cases_of(partition).collect();
    let (mut expectations, mut vacuous, mut failed) = (0, 0, 0);
    let unwritable =
        |source| Failure::Unwritable { path: json.unwrap_or(std::path::Path::new("-")).to_owned(), source };
    let (of_part, campaign, interrupt) = (cases.len() as u64, Arc::new(campaign), Interrupt::watch()?);
    let of_threads = Arc::clone(&campaign);
    let check = move |number: u64| Checked::of(&of_threads.case(number), partition);
    let interrupted = threads::replay(cases, args.jobs(), &interrupt, check, |checked| {
        expectations += checked.expectations;
        vacuous += checked.findings();
        failed += u64::from(checked.result.verdict == Verdict::Failed);
        people.print_cases(&checked.words())?;
        if let Some(lines) = &mut lines {
            let line = output::json_line(&checked)? + "\n";
            lines.write_all(line.as_bytes()).map_err(unwritable)?;
        }
        Ok(ControlFlow::Continue(()))
    })?;
    if let Some(lines) = &mut lines {
        lines.complete().map_err(unwritable)?;
    }
    if let Some(interrupted) = &interrupted {
        return Err(interrupted::failure(interrupted, &campaign));
    }
    let of_cases = story::cases(of_part);
    let failed_words = if failed == 0 { String::new() } else { format!(", {failed} failed") };
    let expectations = counted(expectations, "expectation");
    let verb = if vacuous == 1 { "tests" } else { "test" };
    people.print_line(format_args!("{of_cases}{failed_words}, {expectations}: {vacuous} {verb} nothing"))?;
    if vacuous == 0 && failed == 0 { Ok(()) } else { Err(Failure::CasesFailed) }
}
