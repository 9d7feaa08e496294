//! The keys of one behaviour.

use core::ops::{Range, RangeInclusive};

use time::Duration;
use user_file::{DeValue, Problem, Reader, Section, values, wrong_type};
use variables::Numeric;

use super::section::{CsvKeys, Does};
use super::signal::Signal;
use super::table::{BEHAVIOURS, BehaviourRow, DURATION, LeftOut};

/// The shortest period and interval.
const SHORTEST: Duration = Duration::from_micros(1);

/// The value of one key: a table with one behaviour.
pub(super) fn behaviour(
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
        if !entries.is_empty() {
            // Its key is unknown, and has been refused.
            return None;
        }
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
            let span = self.keys.get("high").map_or_else(|| self.span.clone(), |high| high.span());
            self.reader.refuse(span, problem);
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
