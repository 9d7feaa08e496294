//! Scenarios in code: steps by their sentences or as typed values, for tests in Rust.

use time::Duration;

use crate::model::{
    Condition, CpuOrder, Expectation, LineOrder, MasterOrder, Mode, Order, Paths, Script, ScriptMaster,
    ScriptUnit, Step, Trigger, UnitOrder,
};
use crate::ready::{ErrorPlace, Files, ScenarioError, ScenarioErrors};
use crate::run::Scenario;
use crate::words::{NoSentence, Say};
use user_file::Wanted;

/// Writes a scenario step by step. Each method adds one step, or says when the next one is due. Orders and conditions are
/// sentences or typed values.
///
/// ```
/// use scenario::model::{Condition, LineOrder, CableNumber};
/// use scenario::{Recording, ScenarioBuilder};
/// use time::Duration;
///
/// let first = CableNumber::new(1).ok_or("cables count from 1")?;
/// let scenario = ScenarioBuilder::new("a cable is pulled in OP")
///     .unit("model = \"nx-ect101\"")
///     .master("take all units to OP")
///     .within(Duration::from_millis(100)).expect("all units are in OP")
///     .after(Duration::from_millis(20)).line(LineOrder::Unplug { cable: first })
///     .within(Duration::from_millis(110)).expect("unit 1 is in SAFE-OP with AL status code 0x001B")
///     .expect(Condition::MasterIdle)
///     .finish()?;
/// assert!(scenario.replay(1, Recording::new(false, false)).passes());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
#[must_use = "a scenario is ready with `finish`"]
pub struct ScenarioBuilder {
    script: Script,
    /// Texts of unit files, in the order of the line.
    units: Vec<String>,
    /// Names and texts of user programs.
    programs: Vec<(String, String)>,
    /// What the next step says of its moment.
    trigger: Trigger,
    mode: Mode,
    /// What is wrong with sentences.
    wrong: Vec<ScenarioError>,
}

impl ScenarioBuilder {
    /// A scenario with this title, without steps.
    pub fn new(title: &str) -> Self {
        Self {
            script: Script::new(title),
            units: Vec::new(),
            programs: Vec::new(),
            trigger: Trigger::AtOnce,
            mode: Mode::Now,
            wrong: Vec::new(),
        }
    }

    /// Adds a unit at the end of the line, by the text of its unit file. Without any it is one default unit.
    pub fn unit(mut self, unit_file: &str) -> Self {
        // The file is found by its position.
        self.script.units.push(ScriptUnit::File(self.units.len().to_string()));
        self.units.push(unit_file.to_owned());
        self
    }

    /// A user program in Structured Text that units, steps or [`Self::master_program`] name so.
    pub fn program(mut self, name: &str, text: &str) -> Self {
        self.programs.push((name.to_owned(), text.to_owned()));
        self
    }

    /// The scripted master runs the program of this name in its process data cycle.
    pub fn master_program(mut self, name: &str) -> Self {
        let program = Paths::One(name.to_owned());
        self.script.master = Some(ScriptMaster { program, device_names: Vec::new(), task_period: None });
        self
    }

    /// The next step is due at this time from the beginning.
    pub fn at(mut self, at: Duration) -> Self {
        self.trigger = Trigger::At(at);
        self
    }

    /// The next step is due this time after the one before it.
    pub fn after(mut self, after: Duration) -> Self {
        self.trigger = Trigger::After(after);
        self
    }

    /// The next step is due as soon as this holds.
    pub fn when(mut self, condition: impl Say<Condition>) -> Self {
        if let Some(condition) = self.said(condition) {
            self.trigger = Trigger::When(condition);
        }
        self
    }

    /// The next expectation has to hold at some moment before this time has passed.
    pub fn within(mut self, within: Duration) -> Self {
        self.mode = Mode::Within(within);
        self
    }

    /// The next expectation has to hold until this does.
    pub fn until(mut self, condition: impl Say<Condition>) -> Self {
        if let Some(condition) = self.said(condition) {
            self.mode = Mode::Until(condition);
        }
        self
    }

    /// Orders something of the scripted master.
    pub fn master(self, order: impl Say<MasterOrder>) -> Self {
        self.order(order, Order::Master)
    }

    /// Does something to a unit by hand.
    pub fn unit_order(self, order: impl Say<UnitOrder>) -> Self {
        self.order(order, Order::Unit)
    }

    /// Does something to a CPU Unit.
    pub fn cpu(self, order: impl Say<CpuOrder>) -> Self {
        self.order(order, Order::Cpu)
    }

    /// Does something to the line.
    pub fn line(self, order: impl Say<LineOrder>) -> Self {
        self.order(order, Order::Line)
    }

    /// Asks for something that has to hold.
    pub fn expect(mut self, condition: impl Say<Condition>) -> Self {
        let mode = core::mem::replace(&mut self.mode, Mode::Now);
        self.order(condition, |condition| Order::Expect(Expectation { condition, mode }))
    }

    /// Asks for something that must not hold, to the end or until something else does.
    pub fn never(mut self, condition: impl Say<Condition>) -> Self {
        let mode = match core::mem::replace(&mut self.mode, Mode::Now) {
            Mode::Until(until) => Mode::NeverUntil(until),
            Mode::Now | Mode::Within(_) | Mode::Never | Mode::For(_) | Mode::NeverUntil(_) => Mode::Never,
        };
        self.order(condition, |condition| Order::Expect(Expectation { condition, mode }))
    }

    /// Adds a typed step. It has its own moment.
    pub fn step(mut self, step: Step) -> Self {
        self.script.steps.push(step.into());
        self
    }

    /// The scenario.
    ///
    /// # Errors
    /// What is wrong with sentences, values and units, each with the number of its step or unit.
    pub fn finish(mut self) -> Result<Scenario, ScenarioErrors> {
        let wrong = core::mem::take(&mut self.wrong);
        let script = core::mem::replace(&mut self.script, Script::new(""));
        let made = Scenario::of(script, &mut self);
        if wrong.is_empty() { made } else { Err(ScenarioErrors { list: wrong, more: 0 }) }
    }

    fn order<T>(mut self, order: impl Say<T>, kind: impl FnOnce(T) -> Order) -> Self {
        let trigger = core::mem::replace(&mut self.trigger, Trigger::AtOnce);
        if let Some(value) = self.said(order) {
            self.script.steps.push(Step { trigger, order: kind(value), repetition: None }.into());
        }
        self
    }

    fn said<T>(&mut self, said: impl Say<T>) -> Option<T> {
        match said.value() {
            Ok(value) => Some(value),
            Err(NoSentence { message, help }) => {
                let number = self.script.steps.len() + self.wrong.len() + 1;
                self.wrong.push(ScenarioError { place: ErrorPlace::Step(number), message, help });
                None
            }
        }
    }
}

/// The files of a builder are texts that it was given.
impl Files for ScenarioBuilder {
    fn text(&mut self, name: &str, _wanted: Wanted) -> Result<String, String> {
        let unit = name.parse().ok().and_then(|at: usize| self.units.get(at));
        let program = self.programs.iter().find(|(known, _)| known == name).map(|(_, text)| text);
        unit.or(program).cloned().ok_or_else(|| "no such unit and no such program".to_owned())
    }
}
