//! Dates and times of day. A DATE and a DATE_AND_TIME count nanoseconds from 1970-01-01, a TIME_OF_DAY from
//! midnight (W501, 6-3-5). There are no leap seconds and no time zones.

use core::fmt::{self, Write};

use crate::elementary::{Class, Elementary};

const NS_PER_DAY: u64 = 86_400 * NS_PER_S;
const NS_PER_S: u64 = 1_000_000_000;

const FIRST_YEAR: u64 = 1970;
const LAST_YEAR: u64 = 2106;
/// 2106-02-06, counted from 1970-01-01.
const LAST_DAY: u64 = 49_709;

/// The greatest value of a DATE, a TIME_OF_DAY or a DATE_AND_TIME.
#[must_use]
pub const fn last(elementary: Elementary) -> u64 {
    match elementary {
        Elementary::Date => LAST_DAY * NS_PER_DAY,
        Elementary::TimeOfDay => NS_PER_DAY - 1,
        _ => (LAST_DAY + 1) * NS_PER_DAY - 1,
    }
}

/// A duration later, or earlier with a negative one. After the last value follows the first.
#[must_use]
pub fn later(elementary: Elementary, moment: u64, duration_ns: i128) -> u64 {
    let count = i128::from(last(elementary)) + 1;
    (i128::from(moment) + duration_ns).rem_euclid(count) as u64
}

/// The part of a DATE_AND_TIME that a type holds.
#[must_use]
pub const fn part(of: Elementary, moment: u64) -> u64 {
    match of {
        Elementary::Date => moment - moment % NS_PER_DAY,
        Elementary::TimeOfDay => moment % NS_PER_DAY,
        _ => moment,
    }
}

/// The type whose literals begin with `prefix`, such as `D`, `DATE` or `tod`; none if it is not a prefix of a
/// date or time of day.
#[must_use]
pub fn type_of_prefix(prefix: &str) -> Option<Elementary> {
    if prefix.eq_ignore_ascii_case("D") {
        return Some(Elementary::Date);
    }
    Elementary::named(prefix).filter(|elementary| elementary.class() == Class::Date)
}

/// The value of a literal such as `D#2024-02-29`; none if it is not a literal of this type.
#[must_use]
pub fn value_of(elementary: Elementary, literal: &str) -> Option<u64> {
    let (prefix, text) = literal.split_once('#')?;
    if type_of_prefix(prefix) == Some(elementary) { read(elementary, text) } else { None }
}

/// The value after `D#`, `TOD#` or `DT#`; none if there is no such day or time.
#[must_use]
pub fn read(elementary: Elementary, text: &str) -> Option<u64> {
    match elementary {
        Elementary::Date => date(text),
        Elementary::TimeOfDay => time_of_day(text),
        _ => {
            let (day, time) = text.rsplit_once('-')?;
            Some(date(day)? + time_of_day(time)?)
        }
    }
}

/// Writes a value as its literal.
///
/// # Errors
/// `text` returns an error.
pub fn write(text: &mut impl Write, elementary: Elementary, moment: u64) -> fmt::Result {
    match elementary {
        Elementary::Date => {
            text.write_str("D#")?;
            write_date(text, moment / NS_PER_DAY)
        }
        Elementary::TimeOfDay => {
            text.write_str("TOD#")?;
            write_time(text, moment)
        }
        _ => {
            text.write_str("DT#")?;
            write_date(text, moment / NS_PER_DAY)?;
            text.write_char('-')?;
            write_time(text, moment % NS_PER_DAY)
        }
    }
}

fn date(text: &str) -> Option<u64> {
    let [year, month, day] = numbers(text, '-')?;
    let is_known =
        (FIRST_YEAR..=LAST_YEAR).contains(&year) && (1..=days_of_month(year, month)?).contains(&day);
    if !is_known {
        return None;
    }
    let months: u64 = (1..month).filter_map(|month| days_of_month(year, month)).sum();
    let days = (FIRST_YEAR..year).map(days_of_year).sum::<u64>() + months + day - 1;
    Some(days).filter(|days| *days <= LAST_DAY).map(|days| days * NS_PER_DAY)
}

fn time_of_day(text: &str) -> Option<u64> {
    let (whole, fraction) = text.split_once('.').unwrap_or((text, "0"));
    let [hours, minutes, seconds] = numbers(whole, ':')?;
    if hours >= 24 || minutes >= 60 || seconds >= 60 {
        return None;
    }
    Some(((hours * 60 + minutes) * 60 + seconds) * NS_PER_S + nanoseconds(fraction)?)
}

/// The digits after the decimal point of seconds; digits below a nanosecond are cut off.
fn nanoseconds(fraction: &str) -> Option<u64> {
    let digits: Option<Vec<u64>> = fraction.chars().map(|digit| digit.to_digit(10).map(u64::from)).collect();
    let padded = digits?.into_iter().chain(core::iter::repeat(0));
    Some(padded.take(9).fold(0, |so_far, digit| so_far * 10 + digit))
}

/// Three numbers in decimal digits.
fn numbers(text: &str, separator: char) -> Option<[u64; 3]> {
    let mut parts = text
        .split(separator)
        .map(|part| part.bytes().all(|byte| byte.is_ascii_digit()).then(|| part.parse().ok()).flatten());
    let numbers = [parts.next()??, parts.next()??, parts.next()??];
    parts.next().is_none().then_some(numbers)
}

const fn days_of_year(year: u64) -> u64 {
    365 + is_leap(year) as u64
}

const fn is_leap(year: u64) -> bool {
    year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400))
}

fn days_of_month(year: u64, month: u64) -> Option<u64> {
    const DAYS: [u64; 12] = [31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];
    let days = DAYS.get(usize::try_from(month.checked_sub(1)?).ok()?)?;
    Some(days + u64::from(month == 2 && is_leap(year)))
}

fn write_date(text: &mut impl Write, mut day: u64) -> fmt::Result {
    let mut year = FIRST_YEAR;
    while day >= days_of_year(year) {
        day -= days_of_year(year);
        year += 1;
    }
    let mut month = 1;
    while let Some(days) = days_of_month(year, month).filter(|days| day >= *days) {
        day -= days;
        month += 1;
    }
    write!(text, "{year}-{month:02}-{:02}", day + 1)
}

fn write_time(text: &mut impl Write, time_ns: u64) -> fmt::Result {
    let (seconds, mut rest) = (time_ns / NS_PER_S, time_ns % NS_PER_S);
    write!(text, "{:02}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60)?;
    if rest == 0 {
        return Ok(());
    }
    let mut digits = 9;
    while rest.is_multiple_of(10) {
        rest /= 10;
        digits -= 1;
    }
    write!(text, ".{rest:0digits$}")
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use Elementary::{Date, DateAndTime, TimeOfDay};

    fn written(elementary: Elementary, moment: u64) -> String {
        let mut text = String::new();
        write(&mut text, elementary, moment).unwrap();
        text
    }

    #[test]
    fn the_ends_of_each_range() {
        let ends =
            [Date, TimeOfDay, DateAndTime].map(|type_| [0, last(type_)].map(|moment| written(type_, moment)));
        let expected = [
            ["D#1970-01-01", "D#2106-02-06"],
            ["TOD#00:00:00", "TOD#23:59:59.999999999"],
            ["DT#1970-01-01-00:00:00", "DT#2106-02-06-23:59:59.999999999"],
        ];
        assert_eq!(ends, expected);
    }

    #[test]
    fn seconds_of_unix_time_at_known_moments() {
        for (text, seconds) in [
            ("2000-02-29-00:00:00", 951_782_400),
            ("2001-09-09-01:46:40", 1_000_000_000),
            ("2024-2-29-1:2:3", 1_709_168_523),
            ("2038-01-19-03:14:07", 2_147_483_647),
        ] {
            assert_eq!(read(DateAndTime, text), Some(seconds * NS_PER_S), "{text}");
        }
    }

    #[test]
    fn what_is_no_day_and_no_time_is_refused() {
        for text in [
            "1969-12-31",
            "2106-02-07",
            "2023-02-29",
            "2100-02-29",
            "2024-00-01",
            "2024-13-01",
            "2024-01-00",
            "2024-01-32",
            "2024-01",
            "2024-01-01-01",
            "2024--1",
            "",
            "x-y-z",
            "99999999999999999999-01-01",
            // Numbers in range, but days that do not exist.
            "4-2-214647",
            "18446744073709551615-01-01",
        ] {
            assert_eq!(read(Date, text), None, "{text}");
        }
        for text in [
            "24:00:00",
            "23:60:00",
            "23:59:60",
            "12:00",
            "12:00:00:00",
            "1:2:3.x",
            "1:2:-3",
            "",
            "0:0:18446744073709551615",
            "5124095576030431:0:0",
        ] {
            assert_eq!(read(TimeOfDay, text), None, "{text}");
        }
    }

    #[test]
    fn a_literal_is_a_value_of_its_own_type_only() {
        for (literal, own) in [
            ("D#1970-01-02", Date),
            ("date#1970-01-02", Date),
            ("TOD#00:00:01", TimeOfDay),
            ("TIME_OF_DAY#00:00:01", TimeOfDay),
            ("dt#1970-01-01-00:00:01", DateAndTime),
        ] {
            for elementary in Elementary::ALL {
                assert_eq!(
                    value_of(elementary, literal).is_some(),
                    elementary == own,
                    "{literal} {elementary}"
                );
            }
        }
        for text in ["1970-01-02", "T#1s", "UINT#5", "#", "D#", ""] {
            assert_eq!(value_of(Date, text), None, "{text}");
        }
    }

    proptest! {
        #[test]
        fn a_written_moment_is_read_back(moment in 0..=last(DateAndTime)) {
            for type_ in [Date, TimeOfDay, DateAndTime] {
                let own = part(type_, moment);
                let text = written(type_, own);
                prop_assert_eq!(read(type_, text.split_once('#').unwrap().1), Some(own), "{}", text);
            }
        }
    }
}
