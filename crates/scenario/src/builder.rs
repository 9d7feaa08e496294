//! Steps in code: the same sentences as in a file, for tests in Rust.

use time::Duration;

use crate::file::ScenarioErrors;
use crate::run::Scenario;

/// Writes a scenario step by step. Each method adds one step, or says when the next one is due.
///
/// ```
/// use scenario::{Recording, ScenarioBuilder};
/// use time::Duration;
///
/// let scenario = ScenarioBuilder::new("a cable is pulled in OP")
///     .unit("model = \"nx-ect101\"")
///     .master("take all units to OP")
///     .within(Duration::from_millis(100)).expect("all units are in OP")
///     .after(Duration::from_millis(20)).line("unplug cable 1")
///     .within(Duration::from_millis(110)).expect("unit 1 is in SAFE-OP with AL status code 0x001B")
///     .finish()?;
/// assert!(scenario.replay(1, Recording::new(false, false)).passes());
/// # Ok::<(), scenario::ScenarioErrors>(())
/// ```
#[derive(Clone, Debug)]
#[must_use = "a scenario is ready with `finish`"]
pub struct ScenarioBuilder {
    title: String,
    units: Vec<String>,
    /// Names and texts of user programs.
    programs: Vec<(String, String)>,
    /// The master's own program.
    master: Option<String>,
    steps: Vec<String>,
    /// What the next step says of its moment.
    moment: Vec<(&'static str, String)>,
}

macro_rules! tellers {
    ($($(#[doc = $doc:literal])+ $name:ident;)*) => {
        impl ScenarioBuilder {
            $(
                $(#[doc = $doc])+
                pub fn $name(self, sentence: &str) -> Self {
                    self.step(stringify!($name), sentence)
                }
            )*
        }
    };
}

tellers! {
    /// Orders something of the scripted master.
    master;
    /// Does something to a unit by hand.
    unit_order;
    /// Does something to a CPU Unit.
    cpu;
    /// Does something to the line.
    line;
    /// Asks for something that has to hold.
    expect;
    /// Asks for something that must not hold, to the end.
    never;
}

impl ScenarioBuilder {
    /// A scenario with this title, without steps.
    pub fn new(title: &str) -> Self {
        Self {
            title: title.to_owned(),
            units: Vec::new(),
            programs: Vec::new(),
            master: None,
            steps: Vec::new(),
            moment: Vec::new(),
        }
    }

    /// Adds a unit at the end of the line, by the text of its unit file. Without any it is one default unit.
    pub fn unit(mut self, unit_file: &str) -> Self {
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
        self.master = Some(name.to_owned());
        self
    }

    /// The next step is due at this time from the beginning.
    pub fn at(self, at: Duration) -> Self {
        self.moment("at", at.to_string())
    }

    /// The next step is due so long after the one before it.
    pub fn after(self, after: Duration) -> Self {
        self.moment("after", after.to_string())
    }

    /// The next step is due as soon as this holds.
    pub fn when(self, condition: &str) -> Self {
        self.moment("when", condition.to_owned())
    }

    /// The next expectation has to hold at some moment before this time has passed.
    pub fn within(self, within: Duration) -> Self {
        self.moment("within", within.to_string())
    }

    /// The next expectation has to hold until this does.
    pub fn until(self, condition: &str) -> Self {
        self.moment("until", condition.to_owned())
    }

    /// The scenario.
    ///
    /// # Errors
    /// What is wrong with the sentences and the units; a step stands in the line of its number, behind the title.
    pub fn finish(self) -> Result<Scenario, ScenarioErrors> {
        let places: Vec<String> = (0..self.units.len()).map(|at| format!("{at:?}")).collect();
        let units: Vec<String> = places.iter().map(|place| toml_string(place)).collect();
        let master = self.master.as_ref();
        let master = master.map(|name| format!("master = {{ program = {} }}\n", toml_string(name)));
        let master = master.unwrap_or_default();
        let (title, units) = (toml_string(&self.title), units.join(", "));
        let head = format!("title = {title}\nunits = [{units}]\nsteps = [\n");
        let text = format!("{head}{}\n]\n{master}", self.steps.join(",\n"));
        Scenario::parse(&text, |name| {
            let unit = places.iter().position(|known| known == name).and_then(|at| self.units.get(at));
            let program = self.programs.iter().find(|(known, _)| known == name).map(|(_, text)| text);
            unit.or(program).cloned().ok_or_else(|| "no such unit and no such program".to_owned())
        })
    }

    fn moment(mut self, key: &'static str, value: String) -> Self {
        self.moment.push((key, value));
        self
    }

    fn step(mut self, teller: &str, sentence: &str) -> Self {
        let teller = if teller == "unit_order" { "unit" } else { teller };
        let moment = self.moment.drain(..).map(|(key, value)| format!("{key} = {}, ", toml_string(&value)));
        let moment: String = moment.collect();
        self.steps.push(format!("{{ {moment}{teller} = {} }}", toml_string(sentence)));
        self
    }
}

/// A basic string of TOML.
fn toml_string(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}
