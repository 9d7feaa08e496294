//! `ectwin replay FILE…`: scenarios in virtual time, their verdicts, and their output files.
//!
//! A campaign is scenarios × seeds. Its cases have numbers, so that parts of it can run anywhere and in
//! parallel: output is in the order of the numbers, independent of the threads.

mod bless;
mod campaign;
mod captures;
mod case;
mod case_choice;
mod case_files;
mod coverage;
mod failed_cases;
mod files;
mod fingerprint;
mod golden;
mod interrupted;
mod junit;
mod list;
mod on_failure;
mod partition;
mod printed;
mod progress;
mod result;
mod results;
mod seeds;
mod shard;
mod spool;
mod story;
mod threads;
mod vacuous;

use std::sync::Arc;

use crate::cli::ReplayArgs;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::output::{self, People};
use crate::overwrite::{self, Output};

use campaign::Campaign;
use captures::Captures;
use printed::{Printed, Shown};
use results::Results;
use threads::{Outputs, Wanted};

pub(crate) use campaign::{read_cases, scenario_for_line, scenario_in};
pub(crate) use case::{CASES_MAX, Case, named, title};
pub(crate) use failed_cases::FailedCases;
pub(crate) use junit::{JunitReport, NotEnded, NotEndedBy, Totals};
pub(crate) use partition::{Partition, PartitionChoice};
pub(crate) use progress::{Counted, Progress};
pub(crate) use result::{CaseResult, FailedStep, Verdict};
pub(crate) use seeds::{SeedChoice, SeedRange};
pub(crate) use shard::chosen as chosen_part;
pub(crate) use spool::Spool;
pub(crate) use story::{
    case as case_story, cases as case_count, failed_case, quoted, warned as with_warnings,
};
pub(crate) use threads::{Interrupted, replay as on_threads};

/// Replays all cases of the selected part.
pub(crate) fn run(args: &ReplayArgs) -> Result<(), Failure> {
    let partition = shard::chosen(args.partition)?;
    let mut campaign = Campaign::read(args)?;
    if args.bless {
        return bless::bless(&mut campaign, &args.files);
    }
    let cases: Vec<u64> = campaign.cases_of(partition).collect();
    if args.list {
        return list::print(&campaign, partition, args.json.as_deref());
    }
    if args.vacuous {
        return vacuous::run(campaign, partition, args);
    }
    overwrite::refuse(&outputs(args), campaign.inputs())?;
    let people = People::beside(outputs(args).iter().map(|output| output.path));
    let captures = Captures::choose(args.pcap.as_deref(), cases.len(), campaign.inputs())?;
    if !args.quiet {
        campaign.unit_files().iter().try_for_each(|path| {
            People::Stderr.print_line(format_args!("passed over {}: it is a unit file", output::shown(path)))
        })?;
    }
    if let Some(seed) = campaign.drawn_seed() {
        people.print_line(format_args!("seed {seed}, drawn at random"))?;
    }
    let printed = Printed::new(people, shown(args), args.trace, cases.len() as u64);
    let mut results = Results::open(args, captures, printed, &campaign, partition)?;
    let wanted = wanted(args);
    let interrupt = Interrupt::watch()?;
    let (of_part, campaign) = (cases.len() as u64, Arc::new(campaign));
    let of_threads = Arc::clone(&campaign);
    let replay = move |case: u64| threads::Ended::replay(&of_threads.case(case), partition, wanted);
    let interrupted = threads::replay(cases, args.jobs(), &interrupt, replay, |ended| results.take(ended))?;
    results.close(partition, of_part, &campaign, interrupted.as_ref())
}

/// The outputs of replays: a failed case has a trace in files of results, and a capture in the folder for failures.
fn wanted(args: &ReplayArgs) -> Wanted {
    let keeps = args.on_failure.is_some();
    let of_each = Outputs { trace: args.trace, capture: args.pcap.is_some() };
    let trace = keeps || args.json.is_some() || args.junit.is_some();
    Wanted { of_each, of_failed: Outputs { trace, capture: keeps }, met: args.coverage }
}

/// Of a campaign with several seeds only the failed cases are printed, unless their traces are wanted.
fn shown(args: &ReplayArgs) -> Shown {
    match (args.quiet, args.seeds.is_some() && !args.trace) {
        (true, _) => Shown::OnlyFailed,
        (false, true) => Shown::Failed,
        (false, false) => Shown::Each,
    }
}

fn outputs(args: &ReplayArgs) -> Vec<Output<'_>> {
    let all = [("--json", &args.json), ("--junit", &args.junit), ("--pcap", &args.pcap)];
    let given = all.into_iter().filter_map(|(option, path)| Some(Output { option, path: path.as_deref()? }));
    given.collect()
}
