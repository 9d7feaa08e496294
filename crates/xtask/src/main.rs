//! Our own checks: `cargo xtask ci` runs all of them and names those that failed.

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

/// Our own checks. Without root and without anything but Rust they run as far as they can and say what
/// they left out.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
struct Arguments {
    #[command(subcommand)]
    task: Task,
}

#[derive(Subcommand)]
enum Task {
    /// Everything that has to hold before a change lands
    Ci(ci::Options),
    /// Which crate uses which, what the core must not touch, circles between files, and who names a unit model
    Arrows {
        /// Write the lists of circles and of files that name a model, if they only shrink
        #[arg(long)]
        bless: bool,
    },
    /// The protocol reference: citations lead somewhere, and every conformance statement has a test or a reason
    Conformance {
        /// Write where statements are pinned, as `bless` does too
        #[arg(long)]
        bless: bool,
    },
    /// The library without features: how many crates it pulls in, and that it builds
    Library,
    /// The licences and origins of what we depend on
    Licences,
    /// Known vulnerabilities of what we depend on, where their index can be had
    Advisories,
    /// The habits of the house: lengths, words, pages, purposes
    Tidy,
    /// Our own fuzzers: inputs that are generated or damaged, and what has to hold after each
    Fuzz(fuzz::Options),
    /// Write what is generated and kept: pages of events, the table of the setting rules, where statements are pinned
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
