//! The `ectwin` command.

mod cli;
mod colour;
mod commands;
mod descriptors;
mod ending_signal;
mod failure;
mod failure_document;
mod file_problem;
mod interrupt;
mod later_output;
mod output;
mod output_file;
mod overwrite;
mod privileges;
mod signals;
mod unit_files;
mod whole_file;

use std::process::ExitCode;
use std::sync::Arc;

use clap::Parser;
use signal_hook::consts::SIGXFSZ;

fn main() -> ExitCode {
    let cli = cli::Cli::parse();
    output::start_logging(cli.verbose);
    // A write beyond the file size limit of the process is then refused, like by a full disk, and does not end
    // the process. On a system without this signal no handler is needed.
    let _ = signal_hook::flag::register(SIGXFSZ, Arc::default());
    match commands::run(cli.command, cli.verbose) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}
