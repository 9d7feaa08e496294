//! The command line.

mod address;
mod campaigns;
mod count;
mod ctl;

use std::ffi::OsString;
use std::net::SocketAddr;
use std::path::PathBuf;

use clap::builder::PossibleValuesParser;
use clap::{Args, Parser, Subcommand, ValueEnum};
use link::LinkSpec;
use plant::{default_model, models};
use unit_model::ModelTables;

pub(crate) use campaigns::{ImportArgs, MergeArgs, ReplayArgs, SearchArgs};
pub(crate) use ctl::{Action, CtlArgs};

/// The EtherCAT twin: virtual slave units that real EtherCAT masters treat as real ones.
#[derive(Debug, Parser)]
#[command(version, max_term_width = 100)]
pub(crate) struct Cli {
    /// Log more, to stderr: -v what happens, -vv also SDOs, mailbox messages and mappings, -vvv also frames; RUST_LOG
    /// takes precedence
    #[arg(short, long, action = clap::ArgAction::Count, global = true)]
    pub(crate) verbose: u8,
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Run a unit with a real master (ethercrab) in this process; needs no root and no network
    #[cfg(feature = "ethercrab")]
    Demo,
    /// Emulate units, in chain order, until SIGINT, SIGTERM or SIGHUP
    Run(RunArgs),
    /// See and steer a twin that runs with --control, by the sentences of scenarios
    Ctl(CtlArgs),
    /// Print the event logs in a file of a unit's non-volatile memory, with causes and corrections
    Log(LogArgs),
    /// Run a command with units behind its network interface; the command's exit code is the result
    Exec(ExecArgs),
    /// The first process inside the namespaces of `exec`
    #[command(hide = true)]
    ExecInside(ExecInsideArgs),
    /// The process that becomes the command of `exec`
    #[command(name = "exec-command", hide = true)]
    ExecProgram {
        #[arg(last = true, required = true)]
        command: Vec<OsString>,
    },
    /// Check I/O allocation and PDO setting of a unit file against the setting rules
    Check(CheckArgs),
    /// Print the I/O map of a unit: variables, types, positions, Modbus addresses
    Map(MapArgs),
    /// Check an ESI file: what is wrong in it, by rule, line and correction
    Lint(LintArgs),
    /// Write the ESI file (XML) of a unit, for the configuration tool of a master
    Esi(ExportArgs),
    /// Write the SII image (EEPROM) of a unit
    Sii(ExportArgs),
    /// Replay scenarios in virtual time, and report whether their expectations are fulfilled
    Replay(ReplayArgs),
    /// Make a scenario from a capture: the master's frames are sent again, and the answers compared
    Import(ImportArgs),
    /// Add random steps, seed after seed, until an expectation fails; then reduce the steps
    Search(SearchArgs),
    /// Merge the results of all parts of a campaign or of a search; none may be missing
    Merge(MergeArgs),
    /// Structured Text, the language of user programs
    #[command(subcommand)]
    St(St),
    /// Print a table of the model
    #[command(subcommand)]
    List(List),
    /// Print the JSON Schema of what ectwin writes for other programs
    #[command(subcommand)]
    Schema(Schema),
    /// Explain a code, an object, a register, an indicator or a word
    Explain {
        /// Code, object or register in hexadecimal, such as 391E0000, 0x001B, 0x0602_0000, 0x1018, 10F3:05; indicator
        /// or pattern, such as ERR; name of an event, object or register; word of the glossary, such as watchdog
        #[arg(required = true, value_name = "WHAT")]
        what: Vec<String>,
    },
}

#[derive(Debug, Args)]
pub(crate) struct RunArgs {
    /// Unit files, in chain order from the master; default with --scenario: the units of the scenario
    #[arg(required_unless_present = "scenario", value_name = "FILE")]
    pub(crate) units: Vec<PathBuf>,
    /// raw:IFNAME, udp:ADDR[:PORT] or tap:NAME
    #[arg(long)]
    pub(crate) link: LinkSpec,
    /// Write every frame to this file (pcapng)
    #[arg(long, value_name = "FILE")]
    pub(crate) pcap: Option<PathBuf>,
    /// Write what happens to this file as JSON lines: states, events, emergencies, SDOs, links, faults, CPU Units
    #[arg(long, value_name = "FILE")]
    pub(crate) events: Option<PathBuf>,
    /// Run this user program instead of the one in the unit files: FILE.st in Structured Text, or FILE.wasm if the
    /// feature `wasm` is built in. Several files, or a folder, are one program. It is reloaded when a file changes
    #[arg(long = "program", value_name = "FILE")]
    pub(crate) programs: Vec<PathBuf>,
    /// Serve the variables of the CPU Units to Modbus TCP clients at this address; a port alone means 127.0.0.1
    #[arg(long, value_name = "[ADDR:]PORT", value_parser = address::modbus)]
    pub(crate) modbus: Option<SocketAddr>,
    /// The same for OPC UA clients, if the feature `opcua` is built in
    #[arg(long, value_name = "[ADDR:]PORT", value_parser = address::opcua)]
    pub(crate) opcua: Option<SocketAddr>,
    /// Let programs and `ectwin ctl` see and steer the units by JSON lines on this Unix socket; without PATH on one in
    /// $XDG_RUNTIME_DIR/ectwin
    #[arg(long, value_name = "PATH", num_args = 0..=1)]
    #[expect(clippy::option_option, reason = "the option, and its value, which can be left out")]
    pub(crate) control: Option<Option<PathBuf>>,
    /// Skip the simulated times of the unit, such as 2 ms before each SDO response
    #[arg(long)]
    pub(crate) fast: bool,
    /// Play this scenario against the master that is there, and end with its verdict: exit code 0, or 1 if an expectation
    /// is not fulfilled
    #[arg(long, value_name = "SCENARIO")]
    pub(crate) scenario: Option<PathBuf>,
    /// Write the verdict of the scenario as a JUnit file, for CI systems
    #[arg(long, value_name = "OUT", requires = "scenario")]
    pub(crate) junit: Option<PathBuf>,
    /// Write the verdict of the scenario as one JSON line, with the fields of `ectwin replay --json`
    #[arg(long, value_name = "OUT", requires = "scenario")]
    pub(crate) json: Option<PathBuf>,
    /// End when stdin is closed too, for a program that starts the units: they end with it, whatever ended it
    #[arg(long)]
    pub(crate) until_stdin_closes: bool,
}

#[derive(Clone, Debug, Args)]
pub(crate) struct ExecArgs {
    /// Unit files, in chain order from the master
    #[arg(required = true, value_name = "FILE")]
    pub(crate) units: Vec<PathBuf>,
    /// The cable: `veth`, an interface in a network namespace of its own, whose name is in ECTWIN_INTERFACE; or `udp`,
    /// whose address is in ECTWIN_UDP
    #[arg(long, value_enum, default_value_t)]
    pub(crate) link: Cable,
    /// Write every frame to this file (pcapng)
    #[arg(long, value_name = "FILE", conflicts_with = "on_failure")]
    pub(crate) pcap: Option<PathBuf>,
    /// Write what happens to this file, as JSON lines
    #[arg(long, value_name = "FILE", conflicts_with = "on_failure")]
    pub(crate) events: Option<PathBuf>,
    /// Run this user program instead of the one in the unit files, as with `run`
    #[arg(long = "program", value_name = "FILE")]
    pub(crate) programs: Vec<PathBuf>,
    /// Skip the simulated times of the unit, such as 2 ms before each SDO response
    #[arg(long)]
    pub(crate) fast: bool,
    /// Keep the capture, the events and the command line in a new folder in DIR if the command fails
    #[arg(long, value_name = "DIR")]
    pub(crate) on_failure: Option<PathBuf>,
    /// The command and its arguments, after `--`
    #[arg(last = true, required = true, value_name = "COMMAND")]
    pub(crate) command: Vec<OsString>,
}

/// The cable between the command and the units.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Cable {
    /// Two interfaces in a network namespace of its own
    #[default]
    Veth,
    /// UDP on the loopback interface; needs no namespace
    Udp,
}

impl ExecArgs {
    /// The arguments again.
    pub(crate) fn arguments(&self) -> Vec<OsString> {
        let link = self.link.to_possible_value().map(|link| link.get_name().to_owned()).unwrap_or_default();
        let mut arguments: Vec<_> = self.units.iter().map(OsString::from).collect();
        arguments.extend(["--link".into(), link.into()]);
        arguments.extend(self.of_units());
        arguments.push("--".into());
        arguments.extend(self.command.iter().cloned());
        arguments
    }

    /// Those that are for the units.
    pub(crate) fn of_units(&self) -> Vec<OsString> {
        let mut arguments = Vec::new();
        for program in &self.programs {
            arguments.extend(["--program".into(), OsString::from(program)]);
        }
        for (option, file) in [("--pcap", &self.pcap), ("--events", &self.events)] {
            arguments.extend(file.iter().flat_map(|file| [option.into(), OsString::from(file)]));
        }
        if self.fast {
            arguments.push("--fast".into());
        }
        arguments
    }
}

#[derive(Debug, Args)]
pub(crate) struct ExecInsideArgs {
    /// The process outside
    #[arg(long)]
    pub(crate) outside: u32,
    /// Capture and events are for the case that the command fails
    #[arg(long)]
    pub(crate) kept: bool,
    /// It is the first process of a namespace: the kernel ends all others with it
    #[arg(long)]
    pub(crate) first: bool,
    /// The folder in which the units make their control socket; it is removed at the end
    #[arg(long)]
    pub(crate) control_folder: PathBuf,
    #[command(flatten)]
    pub(crate) exec: ExecArgs,
}

#[derive(Debug, Args)]
pub(crate) struct MapArgs {
    /// The unit file
    #[arg(value_name = "FILE")]
    pub(crate) unit: PathBuf,
    /// Comma-separated values instead of text, with a line of column names
    #[arg(long, conflicts_with = "json")]
    pub(crate) csv: bool,
    /// One JSON document instead of text
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct LogArgs {
    /// The file that `storage` of the unit file names
    #[arg(value_name = "FILE.nvm")]
    pub(crate) memory: PathBuf,
    /// One JSON document instead of text
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct CheckArgs {
    /// The unit file
    #[arg(value_name = "FILE")]
    pub(crate) unit: PathBuf,
    /// One JSON document instead of text
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct LintArgs {
    /// The ESI file; dictionaries that it names are read beside it
    #[arg(value_name = "FILE.xml")]
    pub(crate) esi: PathBuf,
    /// Check this SII image (EEPROM) too, and compare it with the device of the file that has its identity
    #[arg(long, value_name = "IMAGE")]
    pub(crate) sii: Option<PathBuf>,
    /// One JSON document instead of text
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct ExportArgs {
    /// The unit file
    #[arg(value_name = "FILE")]
    pub(crate) unit: PathBuf,
    /// Write to this file instead of stdout
    #[arg(short, long, value_name = "OUT")]
    pub(crate) output: Option<PathBuf>,
}

#[derive(Debug, Subcommand)]
pub(crate) enum St {
    /// Check a program: report all problems, with positions and remedies
    Check(StCheckArgs),
}

#[derive(Debug, Args)]
pub(crate) struct StCheckArgs {
    /// The files of the program; a folder means all .st files in it and below
    #[arg(required = true, value_name = "FILE.st")]
    pub(crate) programs: Vec<PathBuf>,
    /// The unit file whose device variables the program uses; default: those of the factory setting
    #[arg(long, value_name = "FILE")]
    pub(crate) unit: Option<PathBuf>,
    /// One JSON document instead of text
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Subcommand)]
pub(crate) enum List {
    /// The events with their levels, AL status codes and emergency error codes
    Events(ListArgs),
    /// The CoE objects with their types, access rights and defaults
    Objects(ListArgs),
    /// The NX objects, as the CPU Unit sees them
    NxObjects(ListArgs),
    /// The meaning of each indicator, and its patterns over time
    Indicators(ListArgs),
    /// The setting rules with their events, in the order in which they are checked
    Rules(ListArgs),
}

#[derive(Debug, Subcommand)]
pub(crate) enum Schema {
    /// A line of `ectwin run --events`: every kind of event with its fields
    Events,
}

#[derive(Debug, Args)]
pub(crate) struct ListArgs {
    /// The unit model, as unit files name it
    #[arg(long, value_name = "MODEL", default_value = default_model().name(), value_parser = model_names())]
    model: String,
    /// One JSON document instead of text
    #[arg(long)]
    pub(crate) json: bool,
}

impl ListArgs {
    /// The tables of the model.
    pub(crate) fn tables(&self) -> &'static ModelTables {
        let named = models().iter().find(|model| model.name() == self.model);
        named.copied().unwrap_or(default_model()).tables()
    }

    /// The text of a table of the model; if it has no rows, a line that says so.
    pub(crate) fn text(&self, table: &str, rows: usize, text: impl FnOnce() -> String) -> String {
        if rows == 0 { format!("the model {} has no {table}\n", self.model) } else { text() }
    }
}

fn model_names() -> PossibleValuesParser {
    PossibleValuesParser::new(models().iter().map(|model| model.name()))
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_command_line_is_well_formed() {
        Cli::command().debug_assert();
    }

    #[test]
    fn no_runs_and_no_threads_are_refused_in_our_words() {
        for arguments in [["search", "x.toml", "--runs", "0"], ["replay", "x.toml", "--jobs", "0"]] {
            let refused = Cli::try_parse_from(["ectwin"].into_iter().chain(arguments)).unwrap_err();
            assert!(refused.to_string().contains("expected 1 or more, such as"), "{refused}");
        }
    }

    #[test]
    fn run_takes_several_units_and_one_link() {
        let cli =
            Cli::try_parse_from(["ectwin", "run", "a.toml", "b.toml", "--link", "udp:127.0.0.1", "--fast"]);
        let Command::Run(args) = cli.unwrap().command else { panic!("another command") };
        assert_eq!(args.units.len(), 2);
        assert_eq!(args.link.to_string(), "udp:127.0.0.1:34980");
        assert!(args.fast && args.pcap.is_none());
        assert!(Cli::try_parse_from(["ectwin", "run", "--link", "udp:127.0.0.1"]).is_err());
    }
}
