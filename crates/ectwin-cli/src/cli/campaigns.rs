//! The arguments of commands for scenarios in virtual time: `replay`, `import`, `search`, `merge`.

use std::num::{NonZeroU64, NonZeroUsize};
use std::path::PathBuf;

use clap::Args;

use super::count;
use crate::commands::replay::{PartitionChoice, SeedChoice, SeedRange};

#[derive(Debug, Args)]
pub(crate) struct ReplayArgs {
    /// Scenario files; a folder means all .toml files in it and below
    #[arg(required = true, value_name = "FILE")]
    pub(crate) files: Vec<PathBuf>,
    /// Seed of the random generator instead of the one in each file; `random` chooses one and prints it
    #[arg(long, value_name = "N|random", conflicts_with = "seeds")]
    pub(crate) seed: Option<SeedChoice>,
    /// Replay each scenario with all of these seeds: 1..100, or 100 for the same
    #[arg(long, value_name = "A..B")]
    pub(crate) seeds: Option<SeedRange>,
    /// Replay only the case with these values of the file's parameters, such as "loss = 1, state = OP", in any order
    #[arg(long, value_name = "VALUES")]
    pub(crate) case: Option<String>,
    /// Write the golden traces beside the files that have one, and beside those that are named, and exit
    #[arg(long, conflicts_with_all = ["seed", "seeds", "partition", "case"])]
    pub(crate) bless: bool,
    /// Print the actions with their times, below each case
    #[arg(long)]
    pub(crate) trace: bool,
    /// Print which states, transitions, codes, events, registers and rules no case has met
    #[arg(long, conflicts_with_all = ["bless", "list"])]
    pub(crate) coverage: bool,
    /// Write a JUnit file, for CI systems
    #[arg(long, value_name = "OUT")]
    pub(crate) junit: Option<PathBuf>,
    /// Write one JSON line for each case, for other programs and for `ectwin merge`
    #[arg(long, value_name = "OUT")]
    pub(crate) json: Option<PathBuf>,
    /// Write every frame (pcapng): of one case to a file, of several to a folder, whose path ends with /
    #[arg(long, value_name = "OUT")]
    pub(crate) pcap: Option<PathBuf>,
    /// Replay only this part of the cases, such as 1/4; `auto` uses the variables of the CI system
    #[arg(long, value_name = "i/n|auto")]
    pub(crate) partition: Option<PartitionChoice>,
    /// Replay only the files whose path contains this text; if given several times, one of the texts
    #[arg(long, value_name = "TEXT")]
    pub(crate) filter: Vec<String>,
    /// Print the files, titles and numbers of cases, and exit; with --json a line for each case
    #[arg(long, conflicts_with_all = ["bless", "junit", "pcap", "trace", "on_failure", "fail_fast"])]
    pub(crate) list: bool,
    /// Print the expectations that test nothing, because the case passes with the contrary of one too, and the warnings
    #[arg(long, conflicts_with_all = ["bless", "junit", "pcap", "trace", "on_failure", "fail_fast", "list"])]
    pub(crate) vacuous: bool,
    /// End after the first case that fails, in the order of the cases
    #[arg(long)]
    pub(crate) fail_fast: bool,
    /// Keep capture, trace and report of each failed case in this folder; the report has the command that repeats it
    #[arg(long, value_name = "DIR")]
    pub(crate) on_failure: Option<PathBuf>,
    /// Print nothing but the cases that fail
    #[arg(short, long)]
    pub(crate) quiet: bool,
    /// Number of threads; default: as many as the machine can run in parallel. It does not change the results
    #[arg(long, value_name = "N", value_parser = count::jobs)]
    jobs: Option<NonZeroUsize>,
}

impl ReplayArgs {
    /// Number of threads.
    pub(crate) fn jobs(&self) -> NonZeroUsize {
        self.jobs.or_else(|| std::thread::available_parallelism().ok()).unwrap_or(NonZeroUsize::MIN)
    }
}

#[derive(Debug, Args)]
pub(crate) struct ImportArgs {
    /// A capture (pcapng) of a master and its units
    #[arg(value_name = "CAPTURE")]
    pub(crate) capture: PathBuf,
    /// Unit files, in chain order; default: as many default units as there are in the capture
    #[arg(long = "unit", value_name = "FILE")]
    pub(crate) units: Vec<PathBuf>,
    /// The scenario file to write
    #[arg(short, long, value_name = "SCENARIO")]
    pub(crate) output: PathBuf,
}

#[derive(Debug, Args)]
pub(crate) struct SearchArgs {
    /// A scenario file with a `random` step
    #[arg(value_name = "FILE")]
    pub(crate) scenario: PathBuf,
    /// Number of seeds
    #[arg(long, value_name = "N", default_value = "1000", value_parser = count::runs)]
    pub(crate) runs: NonZeroU64,
    /// The first seed
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(crate) seed: u64,
    /// Write the reduced scenario of a failure to this file; default: beside FILE, with the seed in its name
    #[arg(short, long, value_name = "OUT")]
    pub(crate) output: Option<PathBuf>,
    /// Search all seeds, and reduce each different failure, not only the first
    #[arg(long, conflicts_with = "output")]
    pub(crate) all: bool,
    /// End after this time, such as 600s: with the next result
    #[arg(long, value_name = "TIME", value_parser = count::budget)]
    pub(crate) budget: Option<time::Duration>,
    /// Write one JSON line for each different failure and one for the end, for other programs and for `ectwin merge`
    #[arg(long, value_name = "OUT")]
    pub(crate) json: Option<PathBuf>,
    /// Write a JUnit file, for CI systems: a failed case for each different failure, a passed one if nothing is found
    #[arg(long, value_name = "OUT")]
    pub(crate) junit: Option<PathBuf>,
    /// Search only this part of the seeds, such as 1/4; `auto` uses the variables of the CI system
    #[arg(long, value_name = "i/n|auto")]
    pub(crate) partition: Option<PartitionChoice>,
    /// Number of threads; default: as many as the machine can run in parallel. It does not change the results
    #[arg(long, value_name = "N", value_parser = count::jobs)]
    jobs: Option<NonZeroUsize>,
}

impl SearchArgs {
    /// Number of threads.
    pub(crate) fn jobs(&self) -> NonZeroUsize {
        self.jobs.or_else(|| std::thread::available_parallelism().ok()).unwrap_or(NonZeroUsize::MIN)
    }
}

#[derive(Debug, Args)]
pub(crate) struct MergeArgs {
    /// The files that the parts have written with `ectwin replay --json` or `ectwin search --json`
    #[arg(required = true, value_name = "RESULT")]
    pub(crate) results: Vec<PathBuf>,
    /// Write a JUnit file of all cases
    #[arg(long, value_name = "OUT")]
    pub(crate) junit: Option<PathBuf>,
}
