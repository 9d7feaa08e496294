//! A table over time: the course of one value, from the columns of a CSV file.

use core::fmt;

use time::Duration;

/// The longest file in bytes: ten million rows are a day with eight values a second.
pub const CSV_BYTES_MAX: usize = 64 << 20;

/// The course of one value. Between two rows it keeps the value of the first one.
#[derive(Clone, PartialEq)]
pub struct Course {
    /// Ascending in time; the first row is at 0.
    rows: Vec<(Duration, f64)>,
    /// After this time it begins again; none: the last value stays.
    period: Option<Duration>,
}

/// What is wrong in a CSV file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CsvProblem {
    /// Its line, counted from 1; none: the whole file.
    pub line: Option<usize>,
    /// The problem, with what is expected.
    pub message: String,
}

impl fmt::Display for CsvProblem {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(formatter, "line {line}: {}", self.message),
            None => formatter.write_str(&self.message),
        }
    }
}

impl core::error::Error for CsvProblem {}

impl Course {
    /// Reads a CSV file: times in seconds in the first column, ascending from 0, values in the others. Columns are
    /// separated by commas, semicolons or tabs. A first line that does not begin with a number has the names of the
    /// columns. Empty lines, and lines that begin with `#`, are passed over.
    ///
    /// `column` is a name, or a number that counts the columns of values from 1; left out it is the first one. With
    /// `repeats` the course begins again after its last row, whose value is then only the end of the one before.
    ///
    /// # Errors
    /// What is wrong first.
    pub fn from_csv(text: &str, column: Option<&str>, repeats: bool) -> Result<Self, CsvProblem> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut lines = (1..)
            .zip(text.lines())
            .filter(|(_, line)| !line.trim().is_empty() && !line.starts_with('#'))
            .peekable();
        let names = lines.next_if(|(_, line)| cells(line).next().is_some_and(|cell| number(cell).is_none()));
        let column = column_number(names.map(|(_, line)| line), column)?;
        let mut rows: Vec<(Duration, f64)> = Vec::new();
        for (line, row) in lines {
            let problem = |message| CsvProblem { line: Some(line), message };
            let (time, value) = row_of(row, column).map_err(problem)?;
            let follows = rows.last().map_or(time == Duration::ZERO, |(before, _)| time > *before);
            if !follows {
                return Err(problem(match rows.last() {
                    None => "the first time is not 0: a course begins at power-on".into(),
                    Some(_) => "this time is not later than the one before".into(),
                }));
            }
            rows.push((time, value));
        }
        let whole = |message: &str| CsvProblem { line: None, message: message.into() };
        let last = rows.last().ok_or_else(|| whole("the file has no row with a time and a value"))?.0;
        if repeats && rows.len() < 2 {
            return Err(whole("a course that repeats has at least two rows: its last one is its end"));
        }
        Ok(Self { rows, period: repeats.then_some(last) })
    }

    /// The values that it has.
    pub(super) fn values(&self) -> impl Iterator<Item = f64> {
        self.rows.iter().map(|(_, value)| *value)
    }

    /// The value at this time.
    pub(super) fn value(&self, at: Duration) -> f64 {
        let (_, at) = self.in_round(at);
        let after = self.rows.partition_point(|(time, _)| *time <= at);
        self.rows.get(after.saturating_sub(1)).map_or(0.0, |(_, value)| *value)
    }

    /// The time of the next row.
    pub(super) fn next_change(&self, at: Duration) -> Option<Duration> {
        let (begin, at) = self.in_round(at);
        let after = self.rows.partition_point(|(time, _)| *time <= at);
        self.rows.get(after).map(|(time, _)| begin + *time)
    }

    /// When the present round began, and the time since then.
    fn in_round(&self, at: Duration) -> (Duration, Duration) {
        let Some(period) = self.period else { return (Duration::ZERO, at) };
        let begin = period * (at.as_nanos() / period.as_nanos().max(1));
        (begin, Duration::from_nanos(at.as_nanos() - begin.as_nanos()))
    }
}

/// A long table is counted.
impl fmt::Debug for Course {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("Course")
            .field("rows", &self.rows.len())
            .field("period", &self.period)
            .finish()
    }
}

fn cells(line: &str) -> impl Iterator<Item = &str> {
    line.split([',', ';', '\t']).map(|cell| cell.trim().trim_matches('"'))
}

fn number(cell: &str) -> Option<f64> {
    match cell.to_ascii_uppercase().as_str() {
        "TRUE" => Some(1.0),
        "FALSE" => Some(0.0),
        _ => cell.parse().ok().filter(|number: &f64| number.is_finite()),
    }
}

/// The position of the column in a row: 0 is that of the times.
fn column_number(names: Option<&str>, wanted: Option<&str>) -> Result<usize, CsvProblem> {
    let Some(wanted) = wanted else { return Ok(1) };
    let found = names.and_then(|names| cells(names).skip(1).position(|name| name == wanted));
    if let Some(position) = found {
        return Ok(position + 1);
    }
    if let Some(number) = wanted.parse().ok().filter(|number| *number > 0) {
        return Ok(number);
    }
    let names: Vec<&str> = names.iter().flat_map(|names| cells(names).skip(1)).collect();
    let message = if names.is_empty() {
        format!("there is no column `{wanted}`: the first line has no names")
    } else {
        format!("there is no column `{wanted}`, expected {}", names.join(" or "))
    };
    Err(CsvProblem { line: None, message })
}

fn row_of(row: &str, column: usize) -> Result<(Duration, f64), String> {
    let mut cells = cells(row);
    let time = cells.next().unwrap_or_default();
    let seconds = number(time).filter(|seconds| (0.0..=1e9).contains(seconds));
    let seconds = seconds.ok_or_else(|| format!("`{time}` is not a time in seconds, 0 to 1000000000"))?;
    let value = cells.nth(column - 1).ok_or_else(|| format!("there is no column {column} of values"))?;
    let value = number(value).ok_or_else(|| format!("`{value}` is not a number, TRUE or FALSE"))?;
    Ok((Duration::from_nanos((seconds * 1e9).round() as u64), value))
}

#[cfg(test)]
mod tests {
    use super::*;

    const NAMED: &str = "time;valve;level\n0;TRUE;1.5\n\n# pause\n0.5;FALSE;2\n2;TRUE;3\n";

    fn course(text: &str, column: Option<&str>, repeats: bool) -> Course {
        Course::from_csv(text, column, repeats).unwrap_or_else(|problem| panic!("{problem}"))
    }

    #[test]
    fn a_column_by_name_by_number_or_the_first_one() {
        let at = |course: &Course| {
            [0, 499, 500, 1_999, 2_000, 9_000].map(|ms| course.value(Duration::from_millis(ms)))
        };
        assert_eq!(at(&course(NAMED, None, false)), [1.0, 1.0, 0.0, 0.0, 1.0, 1.0]);
        assert_eq!(at(&course(NAMED, Some("level"), false)), [1.5, 1.5, 2.0, 2.0, 3.0, 3.0]);
        assert_eq!(at(&course(NAMED, Some("2"), true)), [1.5, 1.5, 2.0, 2.0, 1.5, 2.0]);
        assert_eq!(at(&course("0,7\r\n1,8\r\n", None, false)), [7.0, 7.0, 7.0, 8.0, 8.0, 8.0]);
    }

    #[test]
    fn the_next_change_is_the_next_row() {
        let next = |course: &Course| [0, 500, 2_000].map(|ms| course.next_change(Duration::from_millis(ms)));
        let ms = |millis| Some(Duration::from_millis(millis));
        assert_eq!(next(&course(NAMED, None, false)), [ms(500), ms(2_000), None]);
        assert_eq!(next(&course(NAMED, None, true)), [ms(500), ms(2_000), ms(2_500)]);
    }

    #[test]
    fn what_is_wrong_has_its_line() {
        for (text, column, repeats, message) in [
            ("", None, false, "the file has no row with a time and a value"),
            ("a,b\n", None, false, "the file has no row with a time and a value"),
            ("0,1\n", None, true, "a course that repeats has at least two rows: its last one is its end"),
            ("1,1\n", None, false, "line 1: the first time is not 0: a course begins at power-on"),
            ("0,1\n2,1\n2,2\n", None, false, "line 3: this time is not later than the one before"),
            ("0,1\nx,1\n", None, false, "line 2: `x` is not a time in seconds, 0 to 1000000000"),
            ("0,1\n-1,1\n", None, false, "line 2: `-1` is not a time in seconds, 0 to 1000000000"),
            ("0,1\n1,high\n", None, false, "line 2: `high` is not a number, TRUE or FALSE"),
            ("0,inf\n", None, false, "line 1: `inf` is not a number, TRUE or FALSE"),
            ("0,1\n1\n", None, false, "line 2: there is no column 1 of values"),
            ("0,1\n", Some("4"), false, "line 1: there is no column 4 of values"),
            ("0,1\n", Some("0"), false, "there is no column `0`: the first line has no names"),
            (NAMED, Some("valv"), false, "there is no column `valv`, expected valve or level"),
        ] {
            let problem = Course::from_csv(text, column, repeats).expect_err(message);
            assert_eq!(problem.to_string(), message, "{text}");
        }
    }
}
