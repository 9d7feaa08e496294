//! Remedies for a name that is not declared: the nearest one, or why a device variable is not there.

use super::scope::key;
use crate::problem::did_you_mean;
use crate::variable::Global;

/// The minimum similarity of two names for a suggestion.
const LIKENESS: f64 = 0.8;

const OTHER_UNIT_FILE: &str = "`ectwin st check --unit FILE` checks a program with the unit file FILE";

/// The name that is nearest to a misspelt one.
pub(super) fn nearest(name: &str, candidates: impl Iterator<Item = String>) -> Option<String> {
    let wanted = key(name);
    let scored = candidates.map(|candidate| (strsim::jaro_winkler(&wanted, &key(&candidate)), candidate));
    let best = scored.max_by(|left, right| left.0.total_cmp(&right.0).then_with(|| right.1.cmp(&left.1)));
    best.filter(|(score, _)| *score >= LIKENESS).map(|(_, candidate)| candidate)
}

/// The remedy for an unknown variable, by the names of the program and the device variables. `declare` is the
/// remedy for a variable that the program has not declared.
pub(super) fn remedy(
    name: &str,
    own: impl Iterator<Item = String>,
    devices: &[Global],
    declare: &str,
) -> String {
    let devices: Vec<_> = devices.iter().map(|device| device.name.as_str()).collect();
    // A declared device variable is one all the same.
    let own = own.filter(|own| !devices.iter().any(|device| device.eq_ignore_ascii_case(own)));
    let near = nearest(name, own.chain(devices.iter().map(|&device| device.to_owned())));
    // A name of the program, or a slip of the finger in that of a device variable.
    let is_meant =
        near.as_ref().is_some_and(|near| !devices.contains(&near.as_str()) || is_one_letter_off(name, near));
    match of_a_unit(name, &devices).filter(|_| !is_meant) {
        Some(missing) => missing.remedy(),
        None => match near.or_else(|| without_device_name(name, &devices)) {
            Some(near) => did_you_mean(near),
            None => match of_another_model(name, &devices) {
                Some(missing) => format!("{declare}, or: {}", missing.remedy()),
                None => declare.to_owned(),
            },
        },
    }
}

/// Whether a name is that of a device variable of another unit or of another I/O allocation, and then the remedy.
pub(super) fn remedy_of_a_device(name: &str, devices: &[Global]) -> Option<String> {
    let devices: Vec<_> = devices.iter().map(|device| device.name.as_str()).collect();
    let (_, rest) = parts(name)?;
    let is_of_the_scheme = devices.iter().filter_map(|device| parts(device)).any(|(_, own)| {
        let ends = end_after_number(own).is_some_and(|end| end_after_number(rest) == Some(end));
        ends || key(&without_digits(own)) == key(&without_digits(rest))
    });
    of_a_unit(name, &devices).filter(|_| is_of_the_scheme).map(|missing| missing.remedy())
}

/// What follows the last number of a name, in capitals; none if nothing does.
fn end_after_number(name: &str) -> Option<String> {
    let number = name.rfind(|letter: char| letter.is_ascii_digit())?;
    name.get(number + 1..).filter(|end| !end.is_empty()).map(key)
}

fn without_digits(name: &str) -> String {
    name.chars().filter(|letter| !letter.is_ascii_digit()).collect()
}

/// A name with a device name whose letters are not those of this unit, such as `N1_Zero` where all device
/// variables begin with `O1_`: a unit of another model can be meant, or a variable of the program.
fn of_another_model<'d>(name: &str, devices: &[&'d str]) -> Option<Missing<'d>> {
    let (head, _) = parts(name)?;
    let mut names = devices.iter().filter_map(|device| parts(device).map(|(own, _)| own));
    let own = names.next().filter(|own| without_numbers(own) != without_numbers(head))?;
    names.all(|other| other == own).then_some(Missing::OtherUnit { own })
}

/// The I/O port that is nearest to an unknown AT specification: the same port of this unit, if it has that.
pub(super) fn nearest_port(at: &str, ports: &[String]) -> Option<String> {
    let port = |path: &str| path.rsplit('/').next().map(key);
    let same = ports.iter().find(|own| port(own) == port(at));
    same.cloned().or_else(|| nearest(at, ports.iter().cloned()))
}

/// Whether one letter is wrong, missing or too much; numbers distinguish names.
fn is_one_letter_off(name: &str, near: &str) -> bool {
    // The table of distances is as large as both names: a name of a program may have any length.
    if name.len().abs_diff(near.len()) > 1 {
        return false;
    }
    let numbers = |name: &str| name.chars().filter(char::is_ascii_digit).collect::<String>();
    numbers(name) == numbers(near) && strsim::damerau_levenshtein(&key(name), &key(near)) == 1
}

/// A device variable that this unit does not have.
enum Missing<'d> {
    /// It begins with the device name of another unit; this unit has this name.
    OtherUnit { own: &'d str },
    /// The I/O allocation of this unit is another one; its nearest device variable.
    OtherAllocation { near: String },
}

impl Missing<'_> {
    fn remedy(&self) -> String {
        match self {
            Self::OtherUnit { own } => {
                format!("the device variables of this unit begin with `{own}_`; {OTHER_UNIT_FILE}")
            }
            Self::OtherAllocation { near } => {
                let near = did_you_mean(near);
                format!("{near} `ectwin map` lists the variables of an I/O allocation; {OTHER_UNIT_FILE}")
            }
        }
    }
}

/// What an unknown name is that has the form of the device variables: `N2_UINTs_01_M_to_C` where there is
/// `N1_UINTs_01_M_to_C`. If there are several units, any of them can be meant.
fn of_a_unit<'d>(name: &str, devices: &[&'d str]) -> Option<Missing<'d>> {
    let (head, rest) = parts(name)?;
    let known = || devices.iter().filter_map(|device| parts(device));
    let near = nearest(rest, known().map(|(_, rest)| rest.to_owned()))?;
    let (own, _) = known().find(|(own, _)| without_numbers(own) == without_numbers(head))?;
    if known().any(|(other, _)| other != own && without_numbers(other) == without_numbers(own)) {
        return None;
    }
    Some(match own.eq_ignore_ascii_case(head) {
        true => Missing::OtherAllocation { near: format!("{own}_{near}") },
        false => Missing::OtherUnit { own },
    })
}

/// The device variable that a name resembles if the device name is missing.
fn without_device_name(name: &str, devices: &[&str]) -> Option<String> {
    let known = || devices.iter().filter_map(|device| Some((*device, parts(device)?.1)));
    let near = nearest(name, known().map(|(_, rest)| rest.to_owned()))?;
    known().find(|(_, rest)| *rest == near).map(|(device, _)| device.to_owned())
}

/// The device name of a device variable, which ends in a number, and the rest after `_`.
fn parts(name: &str) -> Option<(&str, &str)> {
    name.split_once('_').filter(|(head, _)| head.ends_with(|last: char| last.is_ascii_digit()))
}

fn without_numbers(head: &str) -> String {
    key(head.trim_end_matches(|last: char| last.is_ascii_digit()))
}
