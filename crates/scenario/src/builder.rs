//! Scenarios in code: steps by their sentences or as typed values, for tests in Rust.

use time::Duration;

use crate::model::{
    Branch, Condition, CpuOrder, LineOrder, MasterOrder, Paths, Script, ScriptMaster, ScriptStep, ScriptUnit,
    Step, StepForm, UnitOrder,
};
use crate::ready::{ErrorPlace, Files, ScenarioError, ScenarioErrors};
use crate::run::Scenario;
use crate::words::{NoSentence, Say};
use user_file::Wanted;

/// Builds a scenario step by step. Each method adds one step, or sets when the next one is due. Orders and
/// conditions are sentences or typed values.
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
    /// The keys of the next step so far.
    next: StepForm,
    /// The keys of the groups that are not complete, the outermost first.
    groups: Vec<StepForm>,
    /// Number of steps so far, correct or not.
    said: usize,
    /// The mistakes in steps, before units and programs are known.
    wrong: Vec<ScenarioError>,
}

impl ScenarioBuilder {
    /// A scenario with this title, without steps.
    pub fn new(title: &str) -> Self {
        Self {
            script: Script::new(title),
            units: Vec::new(),
            programs: Vec::new(),
            next: StepForm::default(),
            groups: Vec::new(),
            said: 0,
            wrong: Vec::new(),
        }
    }

    /// Adds a unit at the end of the line, by the text of its unit file. Without any units there is one default unit.
    pub fn unit(mut self, unit_file: &str) -> Self {
        // The file is found by its position.
        self.script.units.push(ScriptUnit::File(self.units.len().to_string()));
        self.units.push(unit_file.to_owned());
        self
    }

    /// A user program in Structured Text, with the name that units, steps or [`Self::master_program`] use.
    pub fn program(mut self, name: &str, text: &str) -> Self {
        self.programs.push((name.to_owned(), text.to_owned()));
        self
    }

    /// The scripted master runs the program with this name in its process data cycle.
    pub fn master_program(mut self, name: &str) -> Self {
        let program = Paths::One(name.to_owned());
        self.script.master = Some(ScriptMaster { program, device_names: Vec::new(), task_period: None });
        self
    }

    /// The next step is due at this time from the start.
    pub fn at(self, at: Duration) -> Self {
        self.key("at", at, |next| &mut next.at)
    }

    /// The next step is due this time after the one before it.
    pub fn after(self, after: Duration) -> Self {
        self.key("after", after, |next| &mut next.after)
    }

    /// The next step is due as soon as this condition is true.
    pub fn when(self, condition: impl Say<Condition>) -> Self {
        self.said_key("when", condition, |next| &mut next.when)
    }

    /// The next expectation must be true at some time before this time has passed.
    pub fn within(self, within: Duration) -> Self {
        self.key("within", within, |next| &mut next.within)
    }

    /// The next expectation must be true until this condition is true.
    pub fn until(self, condition: impl Say<Condition>) -> Self {
        self.said_key("until", condition, |next| &mut next.until)
    }

    /// The next expectation must be true whenever this condition is true, to the end.
    pub fn r#while(self, condition: impl Say<Condition>) -> Self {
        self.said_key("while", condition, |next| &mut next.r#while)
    }

    /// The next expectation must be true until this time has passed.
    pub fn lasting(self, span: Duration) -> Self {
        self.key("for", span, |next| &mut next.r#for)
    }

    /// An order to the scripted master.
    pub fn master(self, order: impl Say<MasterOrder>) -> Self {
        self.said_key("master", order, |next| &mut next.master).add()
    }

    /// An action on a unit by hand.
    pub fn unit_order(self, order: impl Say<UnitOrder>) -> Self {
        self.said_key("unit", order, |next| &mut next.unit).add()
    }

    /// An action on a CPU Unit.
    pub fn cpu(self, order: impl Say<CpuOrder>) -> Self {
        self.said_key("cpu", order, |next| &mut next.cpu).add()
    }

    /// An action on the line.
    pub fn line(self, order: impl Say<LineOrder>) -> Self {
        self.said_key("line", order, |next| &mut next.line).add()
    }

    /// A condition that must be true.
    pub fn expect(self, condition: impl Say<Condition>) -> Self {
        self.said_key("expect", condition, |next| &mut next.expect).add()
    }

    /// A condition that must not be true, to the end or until another condition is true.
    pub fn never(self, condition: impl Say<Condition>) -> Self {
        self.said_key("never", condition, |next| &mut next.never).add()
    }

    /// A group of steps that is repeated: each round begins `every` after the one before it. Its steps are those that `steps`
    /// adds.
    pub fn repeat(self, times: u64, every: Duration, steps: impl FnOnce(Self) -> Self) -> Self {
        let group = |form: &mut StepForm, steps| {
            (form.repeat, form.every, form.steps) = (Some(times), Some(every), Some(steps));
        };
        self.begin_group().members(steps, group).end_group()
    }

    /// Sequences of steps that begin at the same time. The next step waits for the last of them.
    pub fn together<const N: usize>(self, sequences: [fn(Self) -> Self; N]) -> Self {
        let add = |form: &mut StepForm, steps| {
            form.together.get_or_insert_default().push(Branch::List(steps));
        };
        let group = self.begin_group();
        sequences.into_iter().fold(group, |group, steps| group.members(steps, add)).end_group()
    }

    /// The steps from here on belong to a group, whose time is that of the next step.
    fn begin_group(mut self) -> Self {
        self.said += 1;
        self.groups.push(core::mem::take(&mut self.next));
        self
    }

    /// The steps that `steps` adds are members of the innermost group.
    fn members(
        mut self,
        steps: impl FnOnce(Self) -> Self,
        add: impl FnOnce(&mut StepForm, Vec<ScriptStep>),
    ) -> Self {
        let before = core::mem::take(&mut self.script.steps);
        let mut after = steps(self);
        let members = core::mem::replace(&mut after.script.steps, before);
        if let Some(form) = after.groups.last_mut() {
            add(form, members);
        }
        after
    }

    /// The innermost group is complete.
    fn end_group(mut self) -> Self {
        if let Some(form) = self.groups.pop() {
            match form.read() {
                Ok(group) => self.script.steps.push(group),
                Err(wrong) => self.refuse(wrong.message, wrong.help),
            }
        }
        self
    }

    /// Adds a typed step. It has its own time.
    pub fn step(mut self, step: Step) -> Self {
        if core::mem::take(&mut self.next) != StepForm::default() {
            self.refuse("a typed step has its own time", "remove the time before `step`");
        }
        self.said += 1;
        self.script.steps.push(step.into());
        self
    }

    /// The scenario.
    ///
    /// # Errors
    /// The mistakes in steps, or else in values and units, each with the number of its step or unit.
    pub fn finish(mut self) -> Result<Scenario, ScenarioErrors> {
        if self.next != StepForm::default() {
            self.refuse("a moment without a step", "add the step, or remove the moment");
        }
        if !self.wrong.is_empty() {
            return Err(ScenarioErrors { list: self.wrong, more: 0 });
        }
        let script = core::mem::replace(&mut self.script, Script::new(""));
        Scenario::of(script, &mut self)
    }

    /// Sets one key of the next step.
    fn key<T>(mut self, name: &str, value: T, key: impl FnOnce(&mut StepForm) -> &mut Option<T>) -> Self {
        if key(&mut self.next).replace(value).is_some() {
            self.refuse(format!("a step has one `{name}`"), "");
        }
        self
    }

    fn said_key<T>(
        mut self,
        name: &str,
        said: impl Say<T>,
        key: impl FnOnce(&mut StepForm) -> &mut Option<T>,
    ) -> Self {
        match said.value() {
            Ok(value) => self.key(name, value, key),
            Err(NoSentence { message, help }) => {
                self.refuse(message, help);
                self
            }
        }
    }

    /// Adds the next step.
    fn add(mut self) -> Self {
        let form = core::mem::take(&mut self.next);
        let number = self.said + 1;
        if !self.is_wrong(number) {
            match form.read() {
                Ok(step) => self.script.steps.push(step),
                Err(wrong) => self.refuse(wrong.message, wrong.help),
            }
        }
        self.said = number;
        self
    }

    /// Records a mistake in the next step.
    fn refuse(&mut self, message: impl Into<String>, help: impl Into<String>) {
        let place = ErrorPlace::Step(self.said + 1);
        self.wrong.push(ScenarioError { place, message: message.into(), help: help.into() });
    }

    fn is_wrong(&self, number: usize) -> bool {
        self.wrong.last().is_some_and(|wrong| wrong.place == ErrorPlace::Step(number))
    }
}

/// The files of a builder are the texts passed to it.
impl Files for ScenarioBuilder {
    fn text(&mut self, name: &str, _wanted: Wanted) -> Result<String, String> {
        let unit = name.parse().ok().and_then(|at: usize| self.units.get(at));
        let program = self.programs.iter().find(|(known, _)| known == name).map(|(_, text)| text);
        unit.or(program).cloned().ok_or_else(|| "no such unit and no such program".to_owned())
    }
}
