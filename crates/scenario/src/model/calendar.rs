//! The date and time at which a scenario starts.

use core::fmt;
use core::str::FromStr;

use super::spelling::{NotAValue, by_text};

const SECONDS_OF_DAY: u64 = 86_400;
const NANOS_OF_SECOND: u64 = 1_000_000_000;
const LAST_YEAR: u64 = 2078;

/// Date and time, UTC, as `2026-01-01T00:00:00`, from 1970 to 2078: what object 10F8 can show for a year to come.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Calendar {
    seconds: u64,
}

impl Calendar {
    /// The second that contains this time, in nanoseconds since 1970-01-01 00:00:00 UTC; also after 2078.
    #[must_use]
    pub const fn from_nanos(nanos: u64) -> Self {
        Self { seconds: nanos / NANOS_OF_SECOND }
    }

    /// Nanoseconds since 1970-01-01 00:00:00 UTC.
    #[must_use]
    pub const fn as_nanos(self) -> u64 {
        self.seconds * NANOS_OF_SECOND
    }
}

impl Default for Calendar {
    /// 2026-01-01T00:00:00.
    fn default() -> Self {
        Self { seconds: 1_767_225_600 }
    }
}

const fn is_leap_year(year: u64) -> bool {
    year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400))
}

const fn days_of_year(year: u64) -> u64 {
    if is_leap_year(year) { 366 } else { 365 }
}

/// Number of days of a month from 1 to 12; 0 for another one.
const fn days_of_month(year: u64, month: u64) -> u64 {
    match month {
        2 if is_leap_year(year) => 29,
        2 => 28,
        4 | 6 | 9 | 11 => 30,
        1 | 3 | 5 | 7 | 8 | 10 | 12 => 31,
        _ => 0,
    }
}

impl fmt::Display for Calendar {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (mut days, second) = (self.seconds / SECONDS_OF_DAY, self.seconds % SECONDS_OF_DAY);
        let (mut year, mut month) = (1970, 1);
        while days >= days_of_year(year) {
            days -= days_of_year(year);
            year += 1;
        }
        while days >= days_of_month(year, month) {
            days -= days_of_month(year, month);
            month += 1;
        }
        let (hour, minute, second) = (second / 3600, second / 60 % 60, second % 60);
        write!(formatter, "{year:04}-{month:02}-{:02}T{hour:02}:{minute:02}:{second:02}", days + 1)
    }
}

impl FromStr for Calendar {
    type Err = NotAValue;

    fn from_str(text: &str) -> Result<Self, NotAValue> {
        read(text).ok_or(NotAValue("date and time from 1970 to 2078 such as 2026-01-01T00:00:00"))
    }
}

fn read(text: &str) -> Option<Calendar> {
    let (date, time) = text.split_once('T')?;
    let [year, month, day] = numbers(date, '-', [4, 2, 2])?;
    let [hour, minute, second] = numbers(time, ':', [2, 2, 2])?;
    let is_date = (1970..=LAST_YEAR).contains(&year) && (1..=days_of_month(year, month)).contains(&day);
    if !is_date || hour > 23 || minute > 59 || second > 59 {
        return None;
    }
    let years: u64 = (1970..year).map(days_of_year).sum();
    let months: u64 = (1..month).map(|month| days_of_month(year, month)).sum();
    let days = years + months + day - 1;
    Some(Calendar { seconds: days * SECONDS_OF_DAY + hour * 3600 + minute * 60 + second })
}

/// Three numbers with these numbers of digits.
fn numbers(text: &str, between: char, digits: [usize; 3]) -> Option<[u64; 3]> {
    let parts: Vec<&str> = text.split(between).collect();
    let parts: [&str; 3] = parts.try_into().ok()?;
    let is_number = |(part, digits): (&&str, usize)| {
        part.len() == digits && part.bytes().all(|byte| byte.is_ascii_digit())
    };
    parts.iter().zip(digits).all(is_number).then_some(())?;
    let [first, second, third] = parts.map(|part| part.parse().ok());
    Some([first?, second?, third?])
}

by_text! { Calendar }

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_read_and_written() {
        for (text, seconds) in [
            ("1970-01-01T00:00:00", 0),
            ("2000-02-29T12:34:56", 951_827_696),
            ("2026-01-01T00:00:00", 1_767_225_600),
            ("2038-01-19T03:14:08", 2_147_483_648),
            ("2078-12-31T23:59:59", 3_439_756_799),
        ] {
            let calendar: Calendar = text.parse().unwrap_or_else(|_| panic!("{text}"));
            assert_eq!((calendar.seconds, calendar.to_string().as_str()), (seconds, text));
        }
        assert_eq!(Calendar::default().to_string(), "2026-01-01T00:00:00");
    }

    #[test]
    fn what_is_no_date_is_refused() {
        for text in [
            "",
            "2026-01-01",
            "2026-01-01 00:00:00",
            "2026-13-01T00:00:00",
            "2026-02-29T00:00:00",
            "2026-01-00T00:00:00",
            "2026-01-01T24:00:00",
            "2026-01-01T00:60:00",
            "1969-12-31T23:59:59",
            "2079-01-01T00:00:00",
            "26-01-01T00:00:00",
            "2026-01-01T00:00:00Z",
            "+026-01-01T00:00:00",
        ] {
            assert!(text.parse::<Calendar>().is_err(), "{text}");
        }
    }
}
