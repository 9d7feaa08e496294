//! The project's checks: `cargo xtask ci` runs all of them and lists those that failed.

mod advisories;
mod arrows;
mod bless;
mod ci;
mod conformance;
mod fuzz;
mod library;
mod metadata;
mod outcome;
mod sources;
mod tests_step;
mod tidy;
mod tools;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// The project's checks. Without root and with only Rust installed they run as far as possible and report what
/// they left out.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
struct Arguments {
    #[command(subcommand)]
    task: Task,
}

#[derive(Subcommand)]
enum Task {
    /// Everything that must pass before a change is merged
    Ci(ci::Options),
    /// Which crate uses which, what the core must not use, circles between files, and which files name a unit model
    Arrows {
        /// Write the lists of circles and of files that name a model, if they only shrink
        #[arg(long)]
        bless: bool,
    },
    /// The protocol reference: citations have a target, and every conformance statement has a test or a reason
    Conformance {
        /// Write the files with the tests of each statement, as `bless` does too
        #[arg(long)]
        bless: bool,
    },
    /// The library without features: how many crates it needs, and that it builds
    Library,
    /// The licences and origins of the dependencies
    Licences,
    /// Known vulnerabilities of the dependencies, if their index can be reached
    Advisories,
    /// The rules for files: lengths, words, pages, purposes
    Tidy,
    /// The project's fuzzers: inputs that are generated or damaged, and conditions that hold after each
    Fuzz(fuzz::Options),
    /// Write the generated files of the repository: pages of events, the table of the setting rules, the tests
    /// of statements
    Bless,
}

fn main() -> ExitCode {
    let outcome = match Arguments::parse().task {
        Task::Ci(options) => return ci::run(&options),
        Task::Arrows { bless: true } => arrows::bless(),
        Task::Arrows { bless: false } => arrows::check(),
        Task::Conformance { bless: true } => conformance::bless(),
        Task::Conformance { bless: false } => conformance::check(),
        Task::Library => library::check(),
        Task::Licences => tools::licences(),
        Task::Advisories => advisories::check().told(),
        Task::Tidy => tidy::check(),
        Task::Fuzz(options) => fuzz::run(&options),
        Task::Bless => bless::bless(),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(reason) => {
            eprintln!("{reason}");
            ExitCode::FAILURE
        }
    }
}
