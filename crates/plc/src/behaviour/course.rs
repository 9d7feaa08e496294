//! A table over time: the course of one value, from the columns of a CSV file.

use core::fmt;
use core::ops::RangeInclusive;

use time::Duration;
use user_file::counted;

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
    /// Reads a CSV file: times in seconds in the first column, ascending from 0, values in the others. Semicolons, else
    /// tabs, else commas of the first line separate the columns of all lines; where it is no comma, numbers can have a
    /// decimal comma. A first line that does not begin with a number has the names of the columns. Empty lines, and
    /// lines that begin with `#`, are passed over.
    ///
    /// `column` is a name, or a number that counts the columns of values from 1; left out it is the first one. With
    /// `repeats` the course begins again after its last row, whose value is then only the end of the one before. Values
    /// are those of `range`.
    ///
    /// # Errors
    /// What is wrong first.
    pub fn from_csv(
        text: &str,
        column: Option<&str>,
        repeats: bool,
        range: &RangeInclusive<f64>,
    ) -> Result<Self, CsvProblem> {
        let whole = |message: &str| CsvProblem { line: None, message: message.into() };
        let empty = || whole("the file has no row with a time and a value");
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut lines = (1..)
            .zip(text.lines())
            .filter(|(_, line)| !line.trim().is_empty() && !line.starts_with('#'))
            .peekable();
        let (_, first) = *lines.peek().ok_or_else(empty)?;
        let form = Form::of(first);
        let names = lines.next_if(|(_, line)| form.time(line).is_none());
        let column = column_number(names.map(|(_, line)| form.cells(line).collect()), column)?;
        let mut rows: Vec<(Duration, f64)> = Vec::new();
        for (line, row) in lines {
            let problem = |message| CsvProblem { line: Some(line), message };
            let (time, value) = form.row(row, column).map_err(problem)?;
            if !range.contains(&value) {
                let (least, most) = (range.start(), range.end());
                return Err(problem(format!("{value} is not a value of the variable: {least} to {most}")));
            }
            let follows = rows.last().map_or(time == Duration::ZERO, |(before, _)| time > *before);
            if !follows {
                return Err(problem(match rows.last() {
                    None => "the first time is not 0: a course begins at power-on".into(),
                    Some(_) => "this time is not later than the one before".into(),
                }));
            }
            rows.push((time, value));
        }
        let last = rows.last().ok_or_else(empty)?.0;
        if repeats && rows.len() < 2 {
            return Err(whole("a course that repeats has at least two rows: its last one is its end"));
        }
        Ok(Self { rows, period: repeats.then_some(last) })
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

/// How the lines of a file are written.
#[derive(Clone, Copy)]
struct Form {
    separator: char,
    columns: usize,
}

impl Form {
    /// That of the first line is that of all.
    fn of(first: &str) -> Self {
        let separator = [';', '\t'].into_iter().find(|separator| first.contains(*separator)).unwrap_or(',');
        Self { separator, columns: first.split(separator).count() }
    }

    fn cells(self, line: &str) -> impl Iterator<Item = &str> {
        line.split(self.separator).map(|cell| cell.trim().trim_matches('"'))
    }

    fn number(self, cell: &str) -> Option<f64> {
        let number = match cell.to_ascii_uppercase().as_str() {
            "TRUE" => return Some(1.0),
            "FALSE" => return Some(0.0),
            _ if self.separator == ',' => cell.parse(),
            _ => cell.replacen(',', ".", 1).parse(),
        };
        number.ok().filter(|number: &f64| number.is_finite())
    }

    /// The time of a row in seconds.
    fn time(self, row: &str) -> Option<f64> {
        self.cells(row).next().and_then(|cell| self.number(cell))
    }

    fn row(self, row: &str, column: usize) -> Result<(Duration, f64), String> {
        let cells: Vec<&str> = self.cells(row).collect();
        if cells.len() != self.columns {
            let (has, first) = (counted(cells.len(), "column"), self.columns);
            return Err(format!(
                "it has {has} separated by {:?}, and the first line has {first}",
                self.separator
            ));
        }
        let time = cells.first().copied().unwrap_or_default();
        let seconds = self.number(time).filter(|seconds| (0.0..=1e9).contains(seconds));
        let seconds = seconds.ok_or_else(|| format!("`{time}` is not a time in seconds, 0 to 1000000000"))?;
        let value = cells.get(column).ok_or_else(|| format!("there is no column {column} of values"))?;
        let value = self.number(value).ok_or_else(|| format!("`{value}` is not a number, TRUE or FALSE"))?;
        Ok((Duration::from_nanos((seconds * 1e9).round() as u64), value))
    }
}

/// The position of the column in a row: 0 is that of the times.
fn column_number(names: Option<Vec<&str>>, wanted: Option<&str>) -> Result<usize, CsvProblem> {
    let Some(wanted) = wanted else { return Ok(1) };
    let names = names.map(|names| names.into_iter().skip(1).collect::<Vec<_>>()).unwrap_or_default();
    if let Some(position) = names.iter().position(|name| *name == wanted) {
        return Ok(position + 1);
    }
    if let Some(number) = wanted.parse().ok().filter(|number| *number > 0) {
        return Ok(number);
    }
    let message = if names.is_empty() {
        format!("there is no column `{wanted}`: the first line has no names")
    } else {
        format!("there is no column `{wanted}`, expected {}", names.join(" or "))
    };
    Err(CsvProblem { line: None, message })
}

#[cfg(test)]
mod tests {
    use super::*;

    const NAMED: &str = "time;valve;level\n0;TRUE;1.5\n\n# pause\n0.5;FALSE;2\n2;TRUE;3\n";

    fn course(text: &str, column: Option<&str>, repeats: bool) -> Course {
        Course::from_csv(text, column, repeats, &(-1e6..=1e6)).unwrap_or_else(|problem| panic!("{problem}"))
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

    /// As a spreadsheet with decimal commas writes it.
    #[test]
    fn where_no_comma_separates_it_is_a_decimal_comma() {
        let text = "time;level\n0;100,5\n1,5;200\n";
        let at = |ms| course(text, None, false).value(Duration::from_millis(ms));
        assert_eq!([at(0), at(1_499), at(1_500)], [100.5, 100.5, 200.0]);
        assert_eq!(course("0\t1,5\n", None, false).value(Duration::ZERO), 1.5);
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
            ("0,1\n1\n", None, false, "line 2: it has 1 column separated by ',', and the first line has 2"),
            ("0\n", None, false, "line 1: there is no column 1 of values"),
            (
                "time;a\n0;1;2\n",
                None,
                false,
                "line 2: it has 3 columns separated by ';', and the first line has 2",
            ),
            (
                "0,1\n1,2000000\n",
                None,
                false,
                "line 2: 2000000 is not a value of the variable: -1000000 to 1000000",
            ),
            ("0,1\n", Some("4"), false, "line 1: there is no column 4 of values"),
            ("0,1\n", Some("0"), false, "there is no column `0`: the first line has no names"),
            (NAMED, Some("valv"), false, "there is no column `valv`, expected valve or level"),
        ] {
            let problem = Course::from_csv(text, column, repeats, &(-1e6..=1e6)).expect_err(message);
            assert_eq!(problem.to_string(), message, "{text}");
        }
    }
}
