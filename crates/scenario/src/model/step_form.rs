//! A step as in a file: a table of keys, one notation of times, orders and expectations.

use core::fmt;

use plant::line::LineOrder;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use time::Duration;

use super::condition::Condition;
use super::cpu::CpuOrder;
use super::group::Branch;
use super::master::MasterOrder;
use super::random::{RandomForm, RandomSteps};
use super::spelling::optional_text;
use super::step::{Expectation, Group, Members, Mode, Order, Repetition, ScriptStep, Step, Trigger};
use super::unit::UnitOrder;

/// The keys of a step.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct StepForm {
    #[serde(with = "optional_text", skip_serializing_if = "Option::is_none")]
    pub(crate) at: Option<Duration>,
    #[serde(with = "optional_text", skip_serializing_if = "Option::is_none")]
    pub(crate) after: Option<Duration>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) when: Option<Condition>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) master: Option<MasterOrder>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) unit: Option<UnitOrder>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) cpu: Option<CpuOrder>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) line: Option<LineOrder>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) expect: Option<Condition>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) never: Option<Condition>,
    #[serde(with = "optional_text", skip_serializing_if = "Option::is_none")]
    pub(crate) within: Option<Duration>,
    #[serde(with = "optional_text", skip_serializing_if = "Option::is_none")]
    pub(crate) r#for: Option<Duration>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) until: Option<Condition>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) r#while: Option<Condition>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) repeat: Option<u64>,
    #[serde(with = "optional_text", skip_serializing_if = "Option::is_none")]
    pub(crate) every: Option<Duration>,
    #[serde(with = "optional_text", skip_serializing_if = "Option::is_none")]
    pub(crate) jitter: Option<Duration>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) random: Option<RandomForm>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) steps: Option<Vec<ScriptStep>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) together: Option<Vec<Branch>>,
}

/// Keys that contradict each other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Contradiction {
    /// The contradiction.
    pub(crate) message: String,
    /// The remedy; empty if the message contains it.
    pub(crate) help: String,
}

impl Contradiction {
    fn new(message: impl Into<String>) -> Self {
        Self { message: message.into(), help: String::new() }
    }

    fn with_help(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { message: message.into(), help: help.into() }
    }
}

impl fmt::Display for Contradiction {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { message, help } = self;
        if help.is_empty() { formatter.write_str(message) } else { write!(formatter, "{message}; {help}") }
    }
}

impl StepForm {
    /// The meaning of the keys together.
    pub(crate) fn read(self) -> Result<ScriptStep, Contradiction> {
        if let Some(random) = &self.random {
            return self.random_steps(random).map(ScriptStep::Random);
        }
        if self.steps.is_some() || self.together.is_some() {
            return self.group().map(ScriptStep::Group);
        }
        let mode = self.mode()?;
        let repetition = self.repetition()?;
        let trigger = self.trigger()?;
        let order = self.order(mode)?;
        Ok(ScriptStep::Step(Step { trigger, order, repetition }))
    }

    fn random_steps(&self, RandomForm { steps, draws }: &RandomForm) -> Result<RandomSteps, Contradiction> {
        let alone = Self { random: self.random.clone(), within: self.within, ..Self::default() };
        if *self != alone {
            return Err(Contradiction::with_help(
                "`random` has only `within` beside it",
                "let a step before it wait, such as `{ after = \"1s\", line = \"be quiet\" }`",
            ));
        }
        match self.within {
            Some(within) => Ok(RandomSteps { count: *steps, within, draws: draws.clone() }),
            None => Err(Contradiction::with_help(
                "`random` needs the time that its steps take together",
                "such as `within = \"1s\"`",
            )),
        }
    }

    /// A group has steps, and no order of its own.
    fn group(self) -> Result<Group, Contradiction> {
        let repetition = self.repetition()?;
        let trigger = self.trigger()?;
        let alone = Self {
            at: self.at,
            after: self.after,
            when: self.when.clone(),
            repeat: self.repeat,
            every: self.every,
            jitter: self.jitter,
            steps: self.steps.clone(),
            together: self.together.clone(),
            ..Self::default()
        };
        if alone != self {
            let help = "its keys are `at`, `after`, `when`, `repeat`, `every` and `jitter`";
            return Err(Contradiction::with_help(
                "a group has no order and no expectation beside its steps",
                help,
            ));
        }
        let members = match (self.steps, self.together, repetition) {
            (Some(steps), None, None) => Members::Sequence(steps),
            (Some(steps), None, Some(repetition)) => Members::Repeat { repetition, steps },
            (None, Some(branches), None) => {
                Members::Together(branches.into_iter().map(Branch::steps).collect())
            }
            (None, Some(_), Some(_)) => {
                let help = "such as `{ repeat = 5, every = \"1s\", steps = [{ together = […] }] }`";
                return Err(Contradiction::with_help("`together` is not repeated", help));
            }
            (Some(_), Some(_), _) | (None, None, _) => {
                return Err(Contradiction::new("a group has either `steps` or `together`"));
            }
        };
        Ok(Group { trigger, members })
    }

    fn of_group(Group { trigger, members }: Group) -> Self {
        let mut form = Self::default();
        form.set_trigger(trigger);
        match members {
            Members::Sequence(steps) => form.steps = Some(steps),
            Members::Repeat { repetition, steps } => {
                form.set_repetition(repetition);
                form.steps = Some(steps);
            }
            Members::Together(sequences) => {
                form.together = Some(sequences.into_iter().map(Branch::List).collect());
            }
        }
        form
    }

    fn set_trigger(&mut self, trigger: Trigger) {
        match trigger {
            Trigger::AtOnce => {}
            Trigger::At(at) => self.at = Some(at),
            Trigger::After(after) => self.after = Some(after),
            Trigger::When(when) => self.when = Some(when),
        }
    }

    fn set_repetition(&mut self, Repetition { times, every, jitter }: Repetition) {
        (self.repeat, self.every) = (Some(times), Some(every));
        self.jitter = Some(jitter).filter(|jitter| !jitter.is_zero());
    }

    fn trigger(&self) -> Result<Trigger, Contradiction> {
        match (self.at, self.after, &self.when) {
            (None, None, None) => Ok(Trigger::AtOnce),
            (Some(at), None, None) => Ok(Trigger::At(at)),
            (None, Some(after), None) => Ok(Trigger::After(after)),
            (None, None, Some(when)) => Ok(Trigger::When(when.clone())),
            _ => Err(Contradiction::new("a step has at most one of `at`, `after` and `when`")),
        }
    }

    /// The time at which an expectation must be true; none: the keys leave it out.
    fn mode(&self) -> Result<Option<Mode>, Contradiction> {
        match (self.within, self.r#for, &self.until, &self.r#while) {
            (None, None, None, None) => Ok(None),
            (Some(within), None, None, None) => Ok(Some(Mode::Within(within))),
            (None, Some(span), None, None) => Ok(Some(Mode::For(span))),
            (None, None, Some(until), None) => Ok(Some(Mode::Until(until.clone()))),
            (None, None, None, Some(condition)) => Ok(Some(Mode::While(condition.clone()))),
            _ => Err(Contradiction::new("`within`, `for`, `until` and `while` contradict each other")),
        }
    }

    fn repetition(&self) -> Result<Option<Repetition>, Contradiction> {
        match (self.repeat, self.every, self.jitter) {
            (None, None, None) => Ok(None),
            (Some(times), Some(every), jitter) => {
                Ok(Some(Repetition { times, every, jitter: jitter.unwrap_or(Duration::ZERO) }))
            }
            (Some(times), None, _) => Err(Contradiction::with_help(
                "`repeat` needs `every`, the time from one to the next",
                format!("such as `repeat = {times}, every = \"100ms\"`"),
            )),
            (None, Some(every), _) => Err(Contradiction::with_help(
                "`every` needs `repeat`, the total number of times",
                format!("such as `repeat = 3, every = \"{every}\"`"),
            )),
            (None, None, Some(jitter)) => Err(Contradiction::with_help(
                "`jitter` belongs to `repeat` and `every`",
                format!("such as `repeat = 3, every = \"100ms\", jitter = \"{jitter}\"`"),
            )),
        }
    }

    fn order(self, mode: Option<Mode>) -> Result<Order, Contradiction> {
        let orders = [
            self.master.map(Order::Master),
            self.unit.map(Order::Unit),
            self.cpu.map(Order::Cpu),
            self.line.map(Order::Line),
        ];
        let orders: Vec<Order> = orders.into_iter().flatten().collect();
        let misplaced = || {
            Contradiction::new(
                "`within`, `for` and `while` belong to `expect`, `until` to `expect` and `never`",
            )
        };
        let never = |key: &str| {
            let help = "`never` is checked to the end of the run, or `until` a condition is true; `for` a time: \
                        `expect = \"not (…)\", for = \"…\"`";
            Contradiction::with_help(format!("`never` has no `{key}`"), help)
        };
        match (orders.as_slice(), self.expect, self.never) {
            ([order], None, None) => mode.map_or_else(|| Ok(order.clone()), |_| Err(misplaced())),
            ([], Some(condition), None) => {
                Ok(Order::Expect(Expectation { condition, mode: mode.unwrap_or(Mode::Now) }))
            }
            ([], None, Some(condition)) => {
                let mode = match mode {
                    None => Mode::Never,
                    Some(Mode::Until(until)) => Mode::NeverUntil(until),
                    Some(Mode::Within(_)) => return Err(never("within")),
                    Some(Mode::For(_)) => return Err(never("for")),
                    Some(Mode::While(_)) => return Err(never("while")),
                    Some(Mode::Now | Mode::Never | Mode::NeverUntil(_)) => return Err(misplaced()),
                };
                Ok(Order::Expect(Expectation { condition, mode }))
            }
            (orders, expect, never) => {
                let count = orders.len() + usize::from(expect.is_some()) + usize::from(never.is_some());
                Err(Contradiction::new(format!(
                    "a step has exactly one of `master`, `unit`, `cpu`, `line`, `expect`, `never`, `random`, `steps` \
                     and `together`; this one has {}",
                    if count == 0 { "none".to_owned() } else { count.to_string() }
                )))
            }
        }
    }

    fn of(step: Step) -> Self {
        let mut form = Self::default();
        form.set_trigger(step.trigger);
        match step.order {
            Order::Master(order) => form.master = Some(order),
            Order::Unit(order) => form.unit = Some(order),
            Order::Cpu(order) => form.cpu = Some(order),
            Order::Line(order) => form.line = Some(order),
            Order::Expect(expectation) => form.expect(expectation),
        }
        if let Some(repetition) = step.repetition {
            form.set_repetition(repetition);
        }
        form
    }

    fn expect(&mut self, Expectation { condition, mode }: Expectation) {
        let is_unwanted = matches!(mode, Mode::Never | Mode::NeverUntil(_));
        *(if is_unwanted { &mut self.never } else { &mut self.expect }) = Some(condition);
        match mode {
            Mode::Now | Mode::Never => {}
            Mode::Within(within) => self.within = Some(within),
            Mode::For(span) => self.r#for = Some(span),
            Mode::Until(until) | Mode::NeverUntil(until) => self.until = Some(until),
            Mode::While(condition) => self.r#while = Some(condition),
        }
    }
}

impl Serialize for Step {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        StepForm::of(self.clone()).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Step {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match ScriptStep::deserialize(deserializer)? {
            ScriptStep::Step(step) => Ok(step),
            ScriptStep::Random(_) => Err(de::Error::custom("`random` is not a single step")),
            ScriptStep::Group(_) => Err(de::Error::custom("a group is not a single step")),
        }
    }
}

impl Serialize for ScriptStep {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let form = match self {
            Self::Step(step) => StepForm::of(step.clone()),
            Self::Group(group) => StepForm::of_group(group.clone()),
            Self::Random(random) => {
                let RandomSteps { count, within, draws } = random.clone();
                let random = RandomForm { steps: count, draws };
                StepForm { random: Some(random), within: Some(within), ..StepForm::default() }
            }
        };
        form.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for ScriptStep {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        StepForm::deserialize(deserializer)?.read().map_err(de::Error::custom)
    }
}
