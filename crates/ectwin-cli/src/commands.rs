//! The commands, one file each.

mod check;
mod ctl;
#[cfg(feature = "ethercrab")]
mod demo;
mod exec;
mod explain;
mod export;
mod import;
mod lint;
mod list_events;
mod list_indicators;
mod list_nx_objects;
mod list_objects;
mod list_rules;
mod log;
mod map;
mod merge;
pub(crate) mod replay;
mod run;
mod search;
mod st_check;

use ectwin::happenings;

use crate::cli::{Command, List, Schema, St};
use crate::failure::Failure;
use crate::output;

/// Executes the command; `verbose` is the number of `-v`.
pub(crate) fn run(command: Command, verbose: u8) -> Result<(), Failure> {
    match command {
        #[cfg(feature = "ethercrab")]
        Command::Demo => demo::run(),
        Command::Run(args) => run::run(&args),
        Command::Ctl(args) => ctl::run(&args),
        Command::Log(args) => log::run(&args),
        Command::Exec(args) => exec::run(&args, verbose),
        Command::ExecInside(args) => exec::run_inside(&args, verbose),
        Command::ExecProgram { command } => exec::run_command(&command),
        Command::Check(args) => check::run(&args),
        Command::Lint(args) => lint::run(&args),
        Command::Esi(args) => export::esi(&args),
        Command::Sii(args) => export::sii(&args),
        Command::Map(args) => map::run(&args),
        Command::St(St::Check(args)) => st_check::run(&args),
        Command::List(List::Events(args)) => list_events::run(&args),
        Command::List(List::Objects(args)) => list_objects::run(&args),
        Command::List(List::NxObjects(args)) => list_nx_objects::run(&args),
        Command::List(List::Indicators(args)) => list_indicators::run(&args),
        Command::List(List::Rules(args)) => list_rules::run(&args),
        Command::Schema(Schema::Events) => output::print(happenings::schema().as_bytes()),
        Command::Replay(args) => replay::run(&args),
        Command::Import(args) => import::run(&args),
        Command::Search(args) => search::run(&args),
        Command::Merge(args) => merge::run(&args),
        Command::Explain { what } => explain::run(&what.join(" ")),
    }
}
