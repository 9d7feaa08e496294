//! Remedies for a name that is not declared: the nearest one, or why a device variable is not there.

use super::scope::key;
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

/// The remedy for an unknown variable, by the names of the program and the device variables.
pub(super) fn remedy(name: &str, own: impl Iterator<Item = String>, devices: &[Global]) -> String {
    let devices: Vec<_> = devices.iter().map(|device| device.name.as_str()).collect();
    let near = nearest(name, own.chain(devices.iter().map(|&device| device.to_owned())));
    // A name of the program, or a slip of the finger in that of a device variable.
    let is_meant =
        near.as_ref().is_some_and(|near| !devices.contains(&near.as_str()) || is_one_letter_off(name, near));
    match of_a_unit(name, &devices).filter(|_| !is_meant) {
        Some(missing) => missing.remedy(),
        None => match near.or_else(|| without_device_name(name, &devices)) {
            Some(near) => did_you_mean(&near),
            None => "declare it in VAR … END_VAR".to_owned(),
        },
    }
}

fn did_you_mean(near: &str) -> String {
    format!("did you mean `{near}`?")
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
