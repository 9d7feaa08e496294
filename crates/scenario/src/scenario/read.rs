//! Reading a scenario file.

use core::ops::Range;

use nx_ect101::unit_file::UnitFile;
use plc::{Builtin, DeviceVariables};
use serde::Deserialize;
use time::Duration;
use toml::Spanned;

use super::{RandomPart, Scenario, ScenarioError, ScenarioErrors, Step, Trigger, UnitSource, UserProgram};
use crate::expectation::Condition;
use crate::orders::{
    CpuOrder, Expectation, FrameFault, LineOrder, MasterOrder, Mode, Order, UnitOrder, UnitSet,
};
use crate::recorded::RecordedFrames;
use crate::sentence;
use crate::sentences::{CONDITIONS, CPU, LINE, MASTER, UNIT};

/// Seed of a scenario that names none.
const DEFAULT_SEED: u64 = 1;
const DEFAULT_LIMIT: Duration = Duration::from_secs(60);
const DEFAULT_CYCLE: Duration = Duration::from_millis(1);
/// Most repetitions of a step, and most steps of the dice.
const STEPS_MAX: u64 = 10_000;
/// The unit of a scenario that names none.
const DEFAULT_UNIT: &str = "model = \"nx-ect101\"";

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    title: Spanned<String>,
    seed: Option<u64>,
    limit: Option<Spanned<String>>,
    cycle: Option<Spanned<String>>,
    capture: Option<String>,
    #[serde(default)]
    units: Vec<Spanned<UnitEntry>>,
    steps: Vec<Spanned<StepEntry>>,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum UnitEntry {
    Path(String),
    Table(toml::Table),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct StepEntry {
    at: Option<Spanned<String>>,
    after: Option<Spanned<String>>,
    when: Option<Spanned<String>>,
    master: Option<Spanned<String>>,
    unit: Option<Spanned<String>>,
    cpu: Option<Spanned<String>>,
    line: Option<Spanned<String>>,
    expect: Option<Spanned<String>>,
    never: Option<Spanned<String>>,
    within: Option<Spanned<String>>,
    r#for: Option<Spanned<String>>,
    until: Option<Spanned<String>>,
    repeat: Option<Spanned<u64>>,
    every: Option<Spanned<String>>,
    jitter: Option<Spanned<String>>,
    random: Option<Spanned<u64>>,
}

impl Scenario {
    /// Reads the text of a scenario file. `unit_file` gives the text of a unit file that it names.
    ///
    /// # Errors
    /// Everything that is wrong, in the order of the file: text that is no TOML (then nothing else is judged),
    /// unknown keys, sentences that are none, units that do not exist, steps that contradict each other.
    pub fn parse(
        text: &str,
        unit_file: impl FnMut(&str) -> Result<String, String>,
    ) -> Result<Self, ScenarioErrors> {
        let file: File = toml::from_str(text).map_err(|error| {
            let span = error.span().unwrap_or_default();
            ScenarioErrors(vec![ScenarioError::new(text, span, error.message().to_owned(), String::new())])
        })?;
        let mut reader = Reader { text, variables: Vec::new(), names: Vec::new(), errors: Vec::new() };
        let scenario = reader.scenario(file, unit_file);
        if reader.errors.is_empty() {
            return Ok(scenario);
        }
        reader.errors.sort_by_key(|error| error.span.start);
        Err(ScenarioErrors(reader.errors))
    }
}

struct Reader<'a> {
    text: &'a str,
    /// Device names of the units.
    names: Vec<String>,
    /// Their device variables.
    variables: Vec<DeviceVariables>,
    errors: Vec<ScenarioError>,
}

impl Reader<'_> {
    fn refuse(&mut self, span: Range<usize>, message: impl Into<String>, help: impl Into<String>) {
        self.errors.push(ScenarioError::new(self.text, span, message.into(), help.into()));
    }

    fn scenario(
        &mut self,
        file: File,
        mut unit_file: impl FnMut(&str) -> Result<String, String>,
    ) -> Scenario {
        let mut units: Vec<_> =
            file.units.into_iter().filter_map(|entry| self.unit(entry, &mut unit_file)).collect();
        if units.is_empty() && self.errors.is_empty() {
            units.extend(self.unit_text(DEFAULT_UNIT, 0..0, None));
        }
        self.names = units.iter().map(|unit| unit.file.name.value.clone()).collect();
        self.variables = units.iter().map(|unit| DeviceVariables::of_unit_file(&unit.file)).collect();
        let count = units.len();
        let limit = file.limit.and_then(|limit| self.duration(&limit)).unwrap_or(DEFAULT_LIMIT);
        let cycle = file.cycle.and_then(|cycle| self.cycle(&cycle)).unwrap_or(DEFAULT_CYCLE);
        let mut steps = Vec::new();
        let mut reached = Duration::ZERO;
        let mut random = None;
        for entry in file.steps {
            let span = entry.span();
            let entry = entry.into_inner();
            if entry.random.is_some() {
                self.random(&entry, span, steps.len(), &mut random);
                continue;
            }
            let repetition = self.repetition(&entry, span.clone());
            if let Some(step) = self.step(entry, span.clone(), count) {
                self.check_order(&step.trigger, &mut reached, limit, span);
                let again = repetition.map(|(times, trigger)| (0..times).map(move |_| trigger.clone()));
                let again = again.into_iter().flatten().map(|trigger| Step { trigger, ..step.clone() });
                let again: Vec<_> = again.collect();
                steps.push(step);
                steps.extend(again);
            }
        }
        let seed = file.seed.unwrap_or(DEFAULT_SEED);
        let title = file.title.into_inner();
        let recorded = RecordedFrames::default();
        let (capture, golden_trace) = (file.capture, None);
        Scenario { title, seed, limit, units, cycle, steps, capture, recorded, golden_trace, random }
    }

    /// Times from the beginning that run backwards, or behind the limit, can never be.
    fn check_order(
        &mut self,
        trigger: &Trigger,
        reached: &mut Duration,
        limit: Duration,
        span: Range<usize>,
    ) {
        let at = match trigger {
            Trigger::At(at) if *at < *reached => {
                let message =
                    format!("{at} lies before the step in front of it, which is not before {reached}");
                return self.refuse(span, message, "steps happen in the order of the file");
            }
            Trigger::At(at) => *at,
            Trigger::After(after) | Trigger::About(after, _) => *reached + *after,
            Trigger::AtOnce | Trigger::When(_) => *reached,
        };
        *reached = at;
        if at > limit {
            self.refuse(span, format!("{at} lies behind the limit of {limit}"), "set `limit = \"…\"` higher");
        }
    }

    /// `{ random = 12, within = "1s" }`: steps that the dice write.
    fn random(
        &mut self,
        entry: &StepEntry,
        span: Range<usize>,
        place: usize,
        random: &mut Option<RandomPart>,
    ) {
        let (Some(count), Some(within)) = (&entry.random, &entry.within) else {
            return self.refuse(
                span,
                "`random` needs the time that its steps take together",
                "such as `within = \"1s\"`",
            );
        };
        if random.is_some() {
            return self.refuse(span, "a scenario has one `random` step", "");
        }
        if !(1..=STEPS_MAX).contains(count.get_ref()) {
            return self.refuse(count.span(), format!("`random` is 1 to {STEPS_MAX} steps"), "");
        }
        let Some(within) = self.duration(within) else { return };
        let count = *count.get_ref() as usize;
        *random = Some(RandomPart { place, count, span: within, line: self.line(span.start), bytes: span });
    }

    /// How often a step happens once more, and when.
    fn repetition(&mut self, entry: &StepEntry, span: Range<usize>) -> Option<(u64, Trigger)> {
        match (&entry.repeat, &entry.every) {
            (None, None) if entry.jitter.is_none() => None,
            (Some(times), Some(every)) => {
                if !(1..=STEPS_MAX).contains(times.get_ref()) {
                    self.refuse(times.span(), format!("`repeat` is 1 to {STEPS_MAX} times"), "");
                    return None;
                }
                let every = self.duration(every)?;
                let jitter = entry.jitter.as_ref().map(|jitter| self.duration(jitter));
                let trigger = match jitter.unwrap_or(Some(Duration::ZERO))? {
                    jitter if jitter > every => {
                        self.refuse(
                            span,
                            format!("a jitter of {jitter} is more than the period of {every}"),
                            "",
                        );
                        return None;
                    }
                    Duration::ZERO => Trigger::After(every),
                    jitter => Trigger::About(every, jitter),
                };
                Some((*times.get_ref() - 1, trigger))
            }
            _ => {
                self.refuse(span, "`repeat` and `every` belong together, and `jitter` to both", "");
                None
            }
        }
    }

    fn line(&self, at: usize) -> usize {
        self.text.get(..at).unwrap_or_default().matches('\n').count() + 1
    }

    fn cycle(&mut self, text: &Spanned<String>) -> Option<Duration> {
        let cycle = self.duration(text)?;
        if cycle.is_zero() {
            self.refuse(text.span(), "a cycle of 0 never ends", "such as `cycle = \"1ms\"`");
        }
        Some(cycle)
    }

    fn duration(&mut self, text: &Spanned<String>) -> Option<Duration> {
        let duration = text.get_ref().parse();
        if let Err(error) = &duration {
            self.refuse(text.span(), format!("`{}`: {error}", text.get_ref()), "");
        }
        duration.ok()
    }

    fn unit(
        &mut self,
        entry: Spanned<UnitEntry>,
        unit_file: &mut impl FnMut(&str) -> Result<String, String>,
    ) -> Option<UnitSource> {
        let span = entry.span();
        match entry.into_inner() {
            UnitEntry::Path(path) => match unit_file(&path) {
                Ok(text) => self.unit_text(&text, span, Some(&path)),
                Err(reason) => {
                    self.refuse(span, format!("the unit file {path} cannot be read: {reason}"), "");
                    None
                }
            },
            UnitEntry::Table(table) => {
                let text = toml::to_string(&table).unwrap_or_default();
                self.unit_text(&text, span, None)
            }
        }
    }

    fn unit_text(&mut self, text: &str, span: Range<usize>, path: Option<&str>) -> Option<UnitSource> {
        let file = match UnitFile::parse(text) {
            Ok(file) => file,
            Err(errors) => {
                for error in errors.iter() {
                    // A unit that stands in the scenario has no text of its own to point into.
                    let message = match path {
                        Some(path) => format!("{path}:{error}"),
                        None => format!("the unit: {}", error.words()),
                    };
                    self.refuse(span.clone(), message, "");
                }
                return None;
            }
        };
        let program = match &file.cpu.program {
            None => UserProgram::None,
            Some(program) => match Builtin::named(&program.value.display().to_string()) {
                Some(builtin) => UserProgram::Builtin(builtin),
                None => {
                    let help = format!("{}, or none at all", Builtin::ALL.map(Builtin::name).join(", "));
                    self.refuse(span, format!("the program {} is not known", program.value.display()), help);
                    return None;
                }
            },
        };
        Some(UnitSource { file, program })
    }

    fn step(&mut self, entry: StepEntry, span: Range<usize>, units: usize) -> Option<Step> {
        let trigger = self.trigger(&entry, span.clone(), units);
        let mode = self.mode(&entry, units);
        let tellers = [
            entry.master.map(|text| (text, Teller::Master)),
            entry.unit.map(|text| (text, Teller::Unit)),
            entry.cpu.map(|text| (text, Teller::Cpu)),
            entry.line.map(|text| (text, Teller::Line)),
            entry.expect.map(|text| (text, Teller::Expect)),
            entry.never.map(|text| (text, Teller::Never)),
        ];
        let mut told: Vec<_> = tellers.into_iter().flatten().collect();
        if told.len() != 1 {
            let message = format!(
                "a step tells one of master, unit, cpu, line, expect or never; this one {}",
                told.len()
            );
            self.refuse(span, message, "");
            return None;
        }
        let (text, teller) = told.remove(0);
        let fits = match (&mode, teller) {
            (None, _) | (Some(_), Teller::Expect) | (Some(Mode::Until(_)), Teller::Never) => true,
            (Some(_), _) => false,
        };
        if !fits {
            self.refuse(span, "`within` and `for` belong to `expect`, `until` to `expect` and `never`", "");
            return None;
        }
        let line = self.line(span.start);
        let order = self.order(&text, teller, mode.unwrap_or(Mode::Now), units)?;
        Some(Step { trigger: trigger?, order, line, text: text.into_inner() })
    }

    fn trigger(&mut self, entry: &StepEntry, span: Range<usize>, units: usize) -> Option<Trigger> {
        match (&entry.at, &entry.after, &entry.when) {
            (None, None, None) => Some(Trigger::AtOnce),
            (Some(at), None, None) => self.duration(at).map(Trigger::At),
            (None, Some(after), None) => self.duration(after).map(Trigger::After),
            (None, None, Some(when)) => self.condition(when, units).map(Trigger::When),
            _ => {
                self.refuse(span, "a step has one of at, after and when", "");
                None
            }
        }
    }

    /// What the step says of when an expectation has to hold.
    fn mode(&mut self, entry: &StepEntry, units: usize) -> Option<Mode> {
        match (&entry.within, &entry.r#for, &entry.until) {
            (Some(within), None, None) => self.duration(within).map(Mode::Within),
            (None, Some(span), None) => self.duration(span).map(Mode::For),
            (None, None, Some(until)) => self.condition(until, units).map(Mode::Until),
            (None, None, None) => None,
            (first, second, third) => {
                let span = [first, second, third]
                    .into_iter()
                    .flatten()
                    .map(Spanned::span)
                    .next()
                    .unwrap_or_default();
                self.refuse(span, "`within`, `for` and `until` contradict each other", "");
                None
            }
        }
    }

    fn order(&mut self, text: &Spanned<String>, teller: Teller, mode: Mode, units: usize) -> Option<Order> {
        let order = match teller {
            Teller::Master => self.sentence(MASTER, text).map(Order::Master),
            Teller::Unit => self.sentence(UNIT, text).map(Order::Unit),
            Teller::Cpu => self.sentence(CPU, text).map(Order::Cpu),
            Teller::Line => self.sentence(LINE, text).map(Order::Line),
            Teller::Expect | Teller::Never => {
                let condition = self.condition(text, units)?;
                let mode = match (teller, mode) {
                    (Teller::Never, Mode::Until(until)) => Mode::NeverUntil(until),
                    (Teller::Never, _) => Mode::Never,
                    (_, mode) => mode,
                };
                Some(Order::Expect(Expectation { condition, mode }))
            }
        }?;
        let exists = match &order {
            Order::Master(order) => unit_of_master(order).is_none_or(|set| set.exists(units)),
            Order::Unit(order) => unit_of_unit(order).exists(units),
            Order::Cpu(order) => unit_of_cpu(order).exists(units),
            Order::Line(LineOrder::Cable { number, .. }) => *number <= units,
            Order::Line(LineOrder::Disturb(disturbance)) => match disturbance.fault {
                FrameFault::Corrupt(cable) => cable < units,
                _ => true,
            },
            Order::Line(_) | Order::Expect(_) => true,
        };
        if !exists {
            self.refuse(text.span(), "it names a unit or a cable that is not there", line_of(units));
        }
        exists.then_some(order)
    }

    fn condition(&mut self, text: &Spanned<String>, units: usize) -> Option<Condition> {
        let condition = self.sentence(CONDITIONS, text)?;
        if let Condition::Variable { name, .. } = &condition
            && !self.variables.iter().any(|variables| variables.find_target(name).is_ok())
        {
            let help = format!("the units are named {}", self.names.join(", "));
            self.refuse(text.span(), format!("no unit has the device variable {name}"), help);
            return None;
        }
        let exists = condition.units().is_none_or(|set| set.exists(units));
        if !exists {
            self.refuse(text.span(), "it names a unit that is not there", line_of(units));
        }
        exists.then_some(condition)
    }

    fn sentence<T>(&mut self, table: &[sentence::Sentence<T>], text: &Spanned<String>) -> Option<T> {
        let read = sentence::read(table, text.get_ref());
        if let Err(problem) = &read {
            self.refuse(text.span(), problem.message.clone(), problem.help.clone());
        }
        read.ok()
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Teller {
    Master,
    Unit,
    Cpu,
    Line,
    Expect,
    Never,
}

fn line_of(units: usize) -> String {
    format!("the line has {units} unit{}, counted from 1", if units == 1 { "" } else { "s" })
}

impl UnitSet {
    const fn exists(self, count: usize) -> bool {
        match self {
            Self::All => true,
            Self::One(at) => at < count,
        }
    }
}

fn unit_of_master(order: &MasterOrder) -> Option<UnitSet> {
    match order {
        MasterOrder::Take(units, _) | MasterOrder::Request { units, .. } => Some(*units),
        MasterOrder::SetOutputs(unit, ..)
        | MasterOrder::Map(unit, ..)
        | MasterOrder::Assign(unit, ..)
        | MasterOrder::SyncManagerLength { unit, .. }
        | MasterOrder::SyncManagerControl { unit, .. }
        | MasterOrder::WriteSdo(unit, ..)
        | MasterOrder::ReadSdo(unit, _)
        | MasterOrder::WriteInHalves(unit, ..)
        | MasterOrder::WriteRegister(unit, ..) => Some(UnitSet::One(*unit)),
        _ => None,
    }
}

fn unit_of_unit(order: &UnitOrder) -> UnitSet {
    match order {
        UnitOrder::Restart(units)
        | UnitOrder::CyclePower(units)
        | UnitOrder::PowerOff(units)
        | UnitOrder::PowerOn(units)
        | UnitOrder::ResetErrors(units)
        | UnitOrder::ClearLog(units, _)
        | UnitOrder::Inject(units, _)
        | UnitOrder::Remove(units, _) => *units,
        UnitOrder::SetIdSwitch(unit, _) | UnitOrder::SpoilSii(unit, _) => UnitSet::One(*unit),
    }
}

fn unit_of_cpu(order: &CpuOrder) -> UnitSet {
    match order {
        CpuOrder::SetMode(units, _)
        | CpuOrder::SetIoRefreshing(units, _)
        | CpuOrder::SetTaskRunning(units, _)
        | CpuOrder::JumpTime(units, _) => *units,
        CpuOrder::SetInputs(unit, _) => UnitSet::One(*unit),
    }
}
