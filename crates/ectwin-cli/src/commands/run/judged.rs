//! `run --scenario`: a scenario is played against the master that is there, and its verdict is the result of the run.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::thread::{self, JoinHandle};

use ectwin::{Handle, Setup};
use link::LinkSpec;
use scenario::{Report, Scenario};

use crate::cli::RunArgs;
use crate::commands::replay::{
    Case, CaseResult, NotEnded, NotEndedBy, Partition, Spool, Verdict, case_story, quoted, scenario_for_line,
};
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::later_output::{LaterOutput, ResultOut};
use crate::output::{self, People};
use crate::privileges::LaterUse;

use super::proof::Proof;

/// A scenario for the line of this command.
pub(super) struct Judged {
    path: PathBuf,
    scenario: Scenario,
    inputs: Vec<PathBuf>,
    fingerprint: u64,
}

/// The files of its verdict.
pub(super) struct VerdictFiles {
    junit: Option<Spool>,
    json: Option<(PathBuf, ResultOut)>,
}

/// A scenario that is being played.
pub(super) struct Judging {
    judged: Judged,
    files: VerdictFiles,
    people: People,
    /// The command that repeats it.
    again: String,
    interrupt: Interrupt,
    player: JoinHandle<(Option<Report>, Vec<String>)>,
}

/// The run ends with the thread that has this, also by its panic.
struct EndsWith(Handle);

impl Drop for EndsWith {
    fn drop(&mut self) {
        self.0.stop();
    }
}

impl Judged {
    /// Reads the scenario of the command line, if there is one, for a line of these units. Without any, it has its own.
    pub(super) fn read(args: &RunArgs, line: &[Setup]) -> Result<Option<Self>, Failure> {
        let Some(path) = args.scenario.clone() else { return Ok(None) };
        let units = (!line.is_empty()).then(|| line.iter().map(Setup::source).collect());
        let (scenario, inputs, fingerprint) = scenario_for_line(&path, units)?;
        Ok(Some(Self { path, scenario, inputs, fingerprint: fingerprint.number() }))
    }

    /// The units of the scenario.
    pub(super) fn units(&self) -> impl Iterator<Item = Setup> {
        self.scenario.units.iter().cloned().map(Setup::from_source)
    }

    /// The files that it has read.
    pub(super) fn inputs(&self) -> &[PathBuf] {
        &self.inputs
    }

    /// Plays it on a thread of its own, and then ends the run.
    pub(super) fn start(
        self,
        args: &RunArgs,
        link: &LinkSpec,
        files: VerdictFiles,
        mut proof: Proof,
        handle: Handle,
    ) -> Result<Judging, Failure> {
        let interrupt = Interrupt::watch()?;
        let outputs = [&args.junit, &args.json, &args.events];
        let people = People::beside(outputs.into_iter().filter_map(Option::as_deref));
        let again = again(args, link);
        let (scenario, seed) = (self.scenario.clone(), self.scenario.seed);
        let play = move || {
            let run = EndsWith(handle);
            let report = run.0.play(&scenario, seed, |lines| {
                // What is printed on stderr cannot fail.
                let _ = People::Stderr.print_text(lines);
                proof.look();
            });
            (report, proof.lines())
        };
        let player = thread::Builder::new().name("scenario".to_owned()).spawn(play);
        let player = player.map_err(Failure::System)?;
        Ok(Judging { judged: self, files, people, again, interrupt, player })
    }

    fn case(&self) -> Case<'_> {
        let Self { path, scenario, fingerprint, .. } = self;
        Case { number: 1, count: 1, fingerprint: *fingerprint, path, scenario, seed: scenario.seed }
    }
}

impl VerdictFiles {
    /// Opens them, before anything runs without effect.
    pub(super) fn open(args: &RunArgs) -> Result<Self, Failure> {
        let json = args.json.as_deref().map(LaterOutput::open).transpose()?;
        let junit = args.junit.as_deref().map(|path| Spool::open(path, "ectwin run")).transpose()?;
        Ok(Self { junit, json: args.json.clone().zip(json.map(LaterOutput::begin)) })
    }

    /// Those that are written when the run has ended.
    pub(super) fn later_use(args: &RunArgs) -> impl Iterator<Item = LaterUse> {
        let junit = args.junit.iter().filter(|path| !output::is_stdout(path));
        junit.cloned().map(LaterUse::Written)
    }

    fn write(self, result: &CaseResult) -> Result<(), Failure> {
        let Self { junit, json } = self;
        if let Some((path, mut out)) = json {
            let line = output::json_line(result)? + "\n";
            let written = out.write_all(line.as_bytes()).and_then(|()| out.flush());
            written.and_then(|()| out.complete()).map_err(|source| Failure::Unwritable { path, source })?;
        }
        let Some(mut junit) = junit else { return Ok(()) };
        junit.take(result)?;
        junit.close(&[])
    }

    /// There is no verdict: the file of JSON lines is empty.
    fn write_without_verdict(self, case: NotEnded) -> Result<(), Failure> {
        let Self { junit, json } = self;
        if let Some((path, mut out)) = json {
            out.complete().map_err(|source| Failure::Unwritable { path, source })?;
        }
        junit.map_or(Ok(()), |junit| junit.close(&[case]))
    }
}

impl Judging {
    /// The run has ended: writes the verdict, which is the result of the run.
    pub(super) fn end(self) -> Result<(), Failure> {
        let Self { judged, files, people, again, interrupt, player } = self;
        let panicked = || io::Error::other("the thread of the scenario panicked: a mistake of ours");
        let (report, frames) = player.join().map_err(|_| Failure::System(panicked()))?;
        let Some(report) = report else { return without_verdict(&judged, files, &interrupt) };
        let mut result = CaseResult::new(&judged.case(), Partition::WHOLE, &report);
        result.command = Some(again);
        if result.verdict == Verdict::Failed {
            result.frames = frames;
            result.keep_trace(report.recording.trace().unwrap_or_default());
        }
        files.write(&result)?;
        people.print_cases(&case_story(&result, None))?;
        match result.verdict {
            Verdict::Passed => Ok(()),
            Verdict::Failed => Err(Failure::CasesFailed),
        }
    }
}

/// A signal has ended the run before the scenario, or the link was closed.
fn without_verdict(judged: &Judged, files: VerdictFiles, interrupt: &Interrupt) -> Result<(), Failure> {
    let case = judged.case();
    let (signal, named) = (interrupt.signal(), case.named());
    let cause = signal.map_or("the end of the link or of stdin", |signal| signal.name());
    let message = format!("{cause} has ended the run before the scenario {named}");
    let file = judged.path.display().to_string();
    let not_ended =
        NotEnded { name: case.test_name(), file, why: NotEndedBy::Signal, message: message.clone() };
    files.write_without_verdict(not_ended)?;
    let help = "there is no verdict; the scenario ends by itself, at its `limit` at the latest".to_owned();
    Err(match signal {
        Some(signal) => Failure::Interrupted { signal, message, help },
        None => Failure::NoVerdict { message, help },
    })
}

/// The command that plays the scenario again.
fn again(args: &RunArgs, link: &LinkSpec) -> String {
    let path = |path: &Path| format!(" {}", quoted(&output::shown(path)));
    let units: String = args.units.iter().map(|unit| path(unit)).collect();
    let scenario = args.scenario.as_deref().map(path).unwrap_or_default();
    let fast = if args.fast { " --fast" } else { "" };
    format!("ectwin run{units} --link {link} --scenario{scenario}{fast}")
}
