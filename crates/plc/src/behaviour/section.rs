//! The keys `behaviour` and `loopback` of a unit file, for every model with variables.

use core::ops::{Range, RangeInclusive};
use std::path::PathBuf;

use time::Duration;
use user_file::{
    DeValue, Located, Problem, Reader, Section, did_you_mean, nearest, shown, values, wrong_type,
};
use variables::{Numeric, Target, VariableTable, variable_name};

use super::signal::Signal;
use super::table::{BEHAVIOURS, BehaviourRow, DURATION, LeftOut};
use crate::device_variables::DeviceVariables;

/// The keys at the top of a unit file.
pub const BEHAVIOUR_KEYS: [&str; 2] = [BEHAVIOUR, LOOPBACK];

const BEHAVIOUR: &str = "behaviour";
const LOOPBACK: &str = "loopback";
const SHORTEST: Duration = Duration::from_micros(1);

/// What the variables of a unit do by themselves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BehaviourSection {
    /// Variables with a behaviour, in the order of the file.
    pub behaviours: Vec<Behaviour>,
    /// Variables that have the value of another one.
    pub loops: Vec<Loop>,
}

/// A variable with a behaviour.
#[derive(Clone, Debug, PartialEq)]
pub struct Behaviour {
    /// The variable.
    pub target: Target,
    /// Its type.
    pub numeric: Numeric,
    /// What it does.
    pub does: Does,
}

/// What a variable does.
#[derive(Clone, Debug, PartialEq)]
pub enum Does {
    /// This.
    Signal(Signal),
    /// What a file says, which has not been read.
    Csv(CsvKeys),
}

/// A table over time in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CsvKeys {
    /// The file, seen from the unit file.
    pub file: Located<PathBuf>,
    /// The name or number of the column; none: the first one with values.
    pub column: Option<String>,
    /// Whether it begins again after its end.
    pub repeats: bool,
}

/// A variable that has the value of another one of the same type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Loop {
    /// The variable that is written.
    pub to: Target,
    /// The one that is read.
    pub from: Target,
}

impl BehaviourSection {
    /// Reads both keys; `variables` are those of the unit.
    #[must_use]
    pub fn read(reader: &mut Reader<'_>, file: &Section<'_, '_>, variables: &DeviceVariables) -> Self {
        let mut read = Self::default();
        let mut written = Vec::new();
        if let Some(section) = reader.section(file, BEHAVIOUR) {
            for (name, value) in section.entries() {
                let target = written_variable(reader, &section, &name, variables, &mut written);
                let Some(target) = target else { continue };
                let place = section.place_of(name.value);
                if let Some(does) = behaviour(reader, &place, value, target.numeric) {
                    read.behaviours.push(Behaviour { target: target.target, numeric: target.numeric, does });
                }
            }
        }
        if let Some(section) = reader.section(file, LOOPBACK) {
            for (name, value) in section.entries() {
                let to = written_variable(reader, &section, &name, variables, &mut written);
                let from = reader.read(&section.place_of(name.value), value, |place, value| {
                    let from = values::text(place, value, "the name of a variable")?;
                    variable(from, variables)
                });
                let (Some(to), Some(from)) = (to, from) else { continue };
                match loop_of(variables, to.target, from.value) {
                    Ok(pair) => read.loops.push(pair),
                    Err(problem) => reader.refuse(value.span(), problem),
                }
            }
        }
        read
    }

    /// Whether a seed changes what it does.
    #[must_use]
    pub fn is_random(&self) -> bool {
        self.behaviours.iter().any(|behaviour| match &behaviour.does {
            Does::Signal(signal) => signal.is_random(),
            Does::Csv(_) => false,
        })
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.behaviours.is_empty() && self.loops.is_empty()
    }
}

/// A variable that can be written.
struct Written {
    target: Target,
    numeric: Numeric,
}

/// The variable of a key; it is written by this key only.
fn written_variable(
    reader: &mut Reader<'_>,
    section: &Section<'_, '_>,
    name: &Located<&str>,
    variables: &DeviceVariables,
    written: &mut Vec<Target>,
) -> Option<Written> {
    let found = variable(name.value, variables).and_then(|target| writable(name.value, target, variables));
    let found = found.and_then(|found| {
        if written.contains(&found.target) {
            let message = format!("`{}` has a behaviour already", section.place_of(name.value));
            return Err(Problem::new(message, "one for each variable"));
        }
        written.push(found.target);
        Ok(found)
    });
    found.map_err(|problem| reader.refuse_key(name, problem)).ok()
}

/// The variable with this name, with or without the name of the unit; blanks and dots of an entry's name are underscores.
fn variable(name: &str, variables: &VariableTable) -> Result<Target, Problem> {
    let unit = variables.unit().device_name.as_str();
    let (entry, element) = name.split_at(name.find('[').unwrap_or(name.len()));
    let with_unit = || format!("{}{element}", variable_name(unit, entry));
    let found = variables.find_target(name).or_else(|_| variables.find_target(&with_unit()));
    found.map_err(|_| {
        let of_unit =
            variables.iter().filter_map(|(_, variable)| variable.name.strip_prefix(unit)?.strip_prefix('_'));
        let names: Vec<&str> = of_unit.collect();
        let message = format!("the unit has no variable `{}`", shown(name));
        let problem = Problem::new(message, "one that `ectwin map` lists");
        match nearest(name, &names) {
            Some(nearest) => problem.with_help(did_you_mean(nearest)),
            None => problem,
        }
    })
}

fn writable(name: &str, target: Target, variables: &VariableTable) -> Result<Written, Problem> {
    let refused = |message: String, expected: &str| Err(Problem::new(message, expected));
    let Ok(variable_type) = variables.type_of(target) else {
        return refused(format!("`{name}` is not a variable of the unit"), "a variable");
    };
    if variable_type.elements.is_some() {
        return refused(format!("`{name}` is {variable_type}"), "one element, such as `NAME[0]`");
    }
    let Some(numeric) = Numeric::of(variable_type.elementary) else {
        return refused(format!("`{name}` is {variable_type}"), "a variable whose values are numbers");
    };
    if variables.writable(target, &numeric.value(0.0)).is_err() {
        return refused(format!("`{name}` is set by the master"), "a variable that goes to the master");
    }
    Ok(Written { target, numeric })
}

fn loop_of(variables: &VariableTable, to: Target, from: Target) -> Result<Loop, Problem> {
    match (variables.type_of(to), variables.type_of(from)) {
        (Ok(to_type), Ok(from_type)) if to_type == from_type => Ok(Loop { to, from }),
        (Ok(to_type), Ok(from_type)) => Err(Problem::new(
            format!("the variable is {from_type}, and the one that gets its value is {to_type}"),
            "two variables of one type",
        )),
        _ => Err(Problem::new("not a variable of the unit", "a variable")),
    }
}

/// The value of one key: a table with one behaviour.
fn behaviour(
    reader: &mut Reader<'_>,
    place: &str,
    value: &user_file::Value<'_>,
    numeric: Numeric,
) -> Option<Does> {
    let names: Vec<&str> = BEHAVIOURS.iter().map(|row| row.name).collect();
    let expected = || format!("a table with one of {}", names.join(", "));
    let Some(section) = Section::of(place, value) else {
        reader.refuse_by(value.span(), || wrong_type(place, value.get_ref(), &expected()));
        return None;
    };
    reader.only(&section, &names);
    let entries = section.entries();
    let mut known = entries
        .iter()
        .filter_map(|(name, value)| Some((row(name.value)?, section.place_of(name.value), value)));
    let Some((row, place, value)) = known.next() else {
        reader.refuse_by(value.span(), || Problem::new(format!("`{place}` has no behaviour"), expected()));
        return None;
    };
    if known.next().is_some() {
        reader.refuse_by(value.span(), || {
            Problem::new(format!("`{place}` is not the only behaviour"), "one for each variable")
        });
        return None;
    }
    if row.keys.is_empty() {
        let hold = reader.read(&place, value, |place, value| number(place, value, numeric))?;
        return Some(Does::Signal(Signal::Hold { value: hold.value }));
    }
    let Some(keys) = Section::of(&place, value) else {
        reader.refuse_by(value.span(), || {
            wrong_type(&place, value.get_ref(), &format!("as in {}", row.example))
        });
        return None;
    };
    reader.only(&keys, &row.keys.iter().map(|key| key.name).collect::<Vec<_>>());
    Keys { reader, row, keys, numeric, span: value.span() }.read()
}

fn row(name: &str) -> Option<&'static BehaviourRow> {
    BEHAVIOURS.iter().find(|row| row.name == name)
}

/// The keys of one behaviour.
struct Keys<'r, 't, 'd, 'i> {
    reader: &'r mut Reader<'t>,
    row: &'static BehaviourRow,
    keys: Section<'d, 'i>,
    numeric: Numeric,
    span: Range<usize>,
}

impl Keys<'_, '_, '_, '_> {
    fn read(mut self) -> Option<Does> {
        let signal = match self.row.name {
            "ramp" => {
                let (from, to, period) = (self.number("from"), self.number("to"), self.time("period"));
                Signal::Ramp { from: from?, to: to?, period: period? }
            }
            "sine" => {
                let (limits, period) = (self.limits(), self.time("period"));
                let (low, high) = limits?;
                Signal::Sine { low, high, period: period? }
            }
            "square" => {
                let (limits, period) = (self.limits(), self.time("period"));
                let duty_percent = self.number_of("duty", |place, value| {
                    number_in(place, value, 0.0..=100.0, "0 to 100 percent of the period")
                });
                let (low, high) = limits?;
                Signal::Square { low, high, period: period?, duty_percent: duty_percent? }
            }
            "random" => {
                let (limits, every) = (self.limits(), self.time("every"));
                let (low, high) = limits?;
                Signal::Random { low, high, every: every? }
            }
            "counter" => self.counter()?,
            "csv" => return self.csv(),
            name => unreachable!("the table of behaviours has a row `{name}` that nothing reads"),
        };
        Some(Does::Signal(signal))
    }

    fn counter(&mut self) -> Option<Signal> {
        let (from, to, every) = (self.number("from"), self.number("to"), self.time("every"));
        let step = self.number_of("step", |place, value| {
            number_in(place, value, f64::MIN..=f64::MAX, "not 0, towards `to`")
        });
        let (from, to, step) = (from?, to?, step?);
        if step == 0.0 || (to - from) * step < 0.0 {
            let message = format!("`{}` counts by {step} from {from} to {to}", self.keys.place_of("step"));
            self.reader
                .refuse(self.span.clone(), Problem::new(message, "a step that is not 0, towards `to`"));
            return None;
        }
        Some(Signal::Counter { from, to, step, every: every? })
    }

    fn csv(self) -> Option<Does> {
        self.reader.require(&self.keys, "file", "the path of a CSV file");
        let file = self.reader.value(&self.keys, "file", values::path);
        let column = self.reader.value(&self.keys, "column", |place, value| match value.as_integer() {
            Some(_) => {
                values::integer::<u32>(place, value, 1..=10_000, "1 to 10000").map(|at| at.to_string())
            }
            None => values::text(place, value, "the name or the number of a column").map(str::to_owned),
        });
        let repeats = self.reader.value(&self.keys, "repeat", values::truth);
        Some(Does::Csv(CsvKeys {
            file: file?,
            column: column.map(|column| column.value),
            repeats: repeats.is_some_and(|repeats| repeats.value),
        }))
    }

    fn limits(&mut self) -> Option<(f64, f64)> {
        let (low, high) = (self.number("low"), self.number("high"));
        let (low, high) = (low?, high?);
        if low > high {
            let message = format!("`{}` is {high}", self.keys.place_of("high"));
            let problem = Problem::new(message, format!("at least `low`, {low}"));
            self.reader.refuse(self.span.clone(), problem);
            return None;
        }
        Some((low, high))
    }

    /// A number of the type.
    fn number(&mut self, key: &str) -> Option<f64> {
        let numeric = self.numeric;
        self.number_of(key, |place, value| number(place, value, numeric))
    }

    /// A number; the one of the table if the key is left out.
    fn number_of(
        &mut self,
        key: &str,
        read: impl FnOnce(&str, &DeValue<'_>) -> Result<f64, Problem>,
    ) -> Option<f64> {
        if self.keys.get(key).is_some() {
            return self.reader.value(&self.keys, key, read).map(|read| read.value);
        }
        let default = self.default_of(key);
        if default.is_none() {
            self.reader.require(&self.keys, key, "a number of the type");
        }
        default
    }

    fn default_of(&self, key: &str) -> Option<f64> {
        let most = *self.numeric.range().end();
        match self.row.keys.iter().find(|row| row.name == key)?.left_out {
            LeftOut::Number(number) => Some(number),
            LeftOut::Greatest => Some(most),
            LeftOut::OneOfBool => (most == 1.0).then_some(1.0),
            LeftOut::Required | LeftOut::FirstColumn | LeftOut::No => None,
        }
    }

    fn time(&mut self, key: &str) -> Option<Duration> {
        self.reader.require(&self.keys, key, DURATION);
        let read = self.reader.value(&self.keys, key, |place, value| {
            values::duration(place, value, |duration| duration >= SHORTEST, DURATION)
        });
        read.map(|read| read.value)
    }
}

fn float(value: &DeValue<'_>) -> Option<f64> {
    if let Some(truth) = value.as_bool() {
        return Some(f64::from(u8::from(truth)));
    }
    if let Some(float) = value.as_float() {
        return float.as_str().parse().ok().filter(|float: &f64| float.is_finite());
    }
    let integer = value.as_integer()?;
    i128::from_str_radix(integer.as_str(), integer.radix()).ok().map(|integer| integer as f64)
}

/// A number that the type of the variable has.
fn number(place: &str, value: &DeValue<'_>, numeric: Numeric) -> Result<f64, Problem> {
    let (least, most) = (*numeric.range().start(), *numeric.range().end());
    let expected = if most == 1.0 { "true, false, 1 or 0".into() } else { format!("{least} to {most}") };
    number_in(place, value, least..=most, &expected)
}

fn number_in(
    place: &str,
    value: &DeValue<'_>,
    range: RangeInclusive<f64>,
    expected: &str,
) -> Result<f64, Problem> {
    let number = float(value).ok_or_else(|| wrong_type(place, value, &format!("a number, {expected}")))?;
    if !range.contains(&number) {
        return Err(Problem::new(format!("`{place}` is {number}"), expected));
    }
    Ok(number)
}

#[cfg(test)]
pub(super) mod tests;
