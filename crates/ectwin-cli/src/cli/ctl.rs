//! The arguments of `ectwin ctl`.

use std::path::PathBuf;

use clap::{Args, Subcommand};
use time::Duration;

#[derive(Debug, Args)]
pub(crate) struct CtlArgs {
    /// The socket of the twin; default: the one in ECTWIN_CONTROL, else that of the only twin that runs
    #[arg(long, global = true, value_name = "PATH")]
    pub(crate) control: Option<PathBuf>,
    /// One JSON document instead of text; with `watch`, JSON lines
    #[arg(long, global = true)]
    pub(crate) json: bool,
    #[command(subcommand)]
    pub(crate) action: Action,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Action {
    /// Carry out orders one after the other, such as `unplug cable 1`; the first that is refused is the last one
    Do {
        /// One sentence each; `-` reads them from stdin, one a line. Words without quotes are one sentence
        #[arg(required = true, value_name = "SENTENCE")]
        sentences: Vec<String>,
    },
    /// Whether conditions are true, such as `unit 1 is in OP`; the first that is not is the last one
    Expect {
        /// One sentence each; `-` reads them from stdin, one a line. Words without quotes are one sentence
        #[arg(required = true, value_name = "SENTENCE")]
        sentences: Vec<String>,
        /// Wait until they are true, for this time each, such as 5s
        #[arg(long, value_name = "TIME", value_parser = within)]
        within: Option<Duration>,
    },
    /// Print what each unit shows: state, AL status code, indicators, errors, mode, links, counters
    Status,
    /// Print what happens, as it happens, until Ctrl-C or the end of the twin
    Watch {
        /// Kinds of events, such as `state`, or device variables; `all` means every kind. Default: what `run -v` logs
        #[arg(value_name = "KIND|NAME")]
        subjects: Vec<String>,
    },
    /// Print the sentences of `do` and `expect` with their meanings
    Sentences {
        /// Only those that have this text
        #[arg(value_name = "WORD")]
        words: Vec<String>,
    },
    /// Print device variables, all of one moment
    Read {
        #[arg(required = true, value_name = "NAME")]
        names: Vec<String>,
    },
    /// Write device variables once, all in one task period
    Write {
        /// A number, TRUE, FALSE, a text, or a list as in JSON
        #[arg(required = true, value_name = "NAME=VALUE")]
        values: Vec<String>,
    },
    /// Give device variables a value until they are released, whatever program and master write
    Force {
        /// A number, TRUE, FALSE, a text, or a list as in JSON
        #[arg(required = true, value_name = "NAME=VALUE")]
        values: Vec<String>,
    },
    /// End the forcing of device variables
    Release {
        #[arg(required = true, value_name = "NAME")]
        names: Vec<String>,
    },
    /// Print an object, read from the side of the unit: no mailbox is used
    Object {
        /// Name or number of the unit
        unit: String,
        /// Index and subindex, such as 1018:04
        entry: String,
    },
    /// Print the faults at work
    Faults,
    /// End a fault at work
    Clear {
        /// What `faults` prints in front of it, or `all`
        #[arg(required = true, value_name = "FAULT|all")]
        fault: Vec<String>,
    },
}

fn within(text: &str) -> Result<Duration, String> {
    text.parse().map_err(|error: <Duration as std::str::FromStr>::Err| error.to_string())
}
