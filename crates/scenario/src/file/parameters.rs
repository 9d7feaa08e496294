//! Parameters: `with = { loss = [0, 1, 5], state = ["OP", "SAFE-OP"] }` makes a case of each combination of values.

use core::cmp::Ordering;
use std::sync::LazyLock;

use serde::Deserialize;
use toml::Spanned;
use user_file::{DeValue, Located, Problem, Reader, Section, Value, wrong_type};

use super::names::{Named, Names, is_name, written};
use super::places::Span;

/// The key of the parameters.
pub(super) const WITH: &str = "with";

/// The key of the preludes.
pub(super) const USE: &str = "use";

/// Maximum number of cases of a file.
pub(super) const CASES_MAX: usize = 10_000;

/// The parameters of a file, the first one in the file first.
pub(super) struct Parameters<'d, 'i> {
    list: Vec<Parameter<'d, 'i>>,
    /// The place of all of them.
    pub(super) span: Span,
}

/// Values for one name, at least one.
pub(super) struct Parameter<'d, 'i> {
    pub(super) name: Located<&'d str>,
    values: Vec<DeValue<'i>>,
    /// The place of its values.
    span: Span,
}

impl<'d, 'i> Parameters<'d, 'i> {
    /// The parameters of a file; none if they have a mistake. Without `with` there are none, and the file is one case.
    pub(super) fn read(reader: &mut Reader<'_>, file: &Section<'d, 'i>) -> Option<Self> {
        let Some(value) = file.get(WITH) else { return Some(Self { list: Vec::new(), span: 0..0 }) };
        let Some(section) = Section::of(WITH, value) else {
            let expected = "a table of lists, such as `{ loss = [0, 1, 5] }`";
            reader.refuse_by(value.span(), || wrong_type(WITH, value.get_ref(), expected));
            return None;
        };
        let list = parameters(reader, &section, &Names::default())?;
        if list.is_empty() {
            let help = "such as `with = { loss = [0, 1, 5] }`";
            reader.refuse(value.span(), Problem::new("`with` has no parameter", "").with_help(help));
            return None;
        }
        Some(Self { list, span: value.span() })
    }

    /// Number of cases.
    pub(super) fn count(&self) -> usize {
        product(&self.list)
    }

    /// The values of the case with this number, from 0. The values of the last parameter change first.
    pub(super) fn case(&self, number: usize) -> Vec<Named<'i>> {
        combination(&self.list, number)
    }

    /// The text of the file with one value for each parameter, those of the case with this number.
    pub(super) fn text_of_case(&self, text: &str, number: usize) -> String {
        let mut text = text.to_owned();
        let mut own: Vec<_> = self.list.iter().map(|list| list.span.clone()).zip(self.case(number)).collect();
        // From the last one on, so that the places of the others stay right.
        own.sort_by_key(|(span, _)| core::cmp::Reverse(span.start));
        for (span, named) in own {
            text.replace_range(span, &format!("[{}]", named.toml()));
        }
        text
    }
}

/// The names of a table, each with its list of values; none if there is a mistake. The ranges of numbers can use `names`.
pub(super) fn parameters<'d, 'i>(
    reader: &mut Reader<'_>,
    section: &Section<'d, 'i>,
    names: &Names<'_, 'i>,
) -> Option<Vec<Parameter<'d, 'i>>> {
    let refused = reader.refused();
    let mut list = Vec::new();
    for (name, value) in section.entries() {
        if !is_name(name.value) {
            let help = "a name has letters, digits and _, and begins with no digit";
            let message = format!("`{}` cannot be in braces", name.value);
            reader.refuse(name.span.clone().unwrap_or_default(), Problem::new(message, "").with_help(help));
        }
        if let Some(values) = values(reader, &section.place_of(name.value), value, names) {
            list.push(Parameter { name, values, span: value.span() });
        }
    }
    (reader.refused() == refused).then_some(list)
}

/// The values of a parameter: a list of numbers, ranges of numbers, texts and truth values, none of them twice; or one range.
fn values<'i>(
    reader: &mut Reader<'_>,
    place: &str,
    value: &Value<'i>,
    names: &Names<'_, 'i>,
) -> Option<Vec<DeValue<'i>>> {
    let values = match value.get_ref() {
        DeValue::Array(array) => &array[..],
        DeValue::Table(_) => core::slice::from_ref(value),
        other => {
            reader.refuse_by(value.span(), || wrong_type(place, other, EXPECTED_VALUES));
            return None;
        }
    };
    if values.is_empty() {
        let problem = Problem::new(format!("`{place}` is an empty list"), "").with_help("one value at least");
        reader.refuse(value.span(), problem);
        return None;
    }
    let mut seen = std::collections::BTreeSet::new();
    let mut all = Vec::new();
    for value in values {
        for one in elements(reader, place, value, names)? {
            let text = written(&one);
            if !seen.insert(text.clone()) {
                let message = format!("`{place}` has the value {text} twice");
                reader.refuse(value.span(), Problem::new(message, ""));
                return None;
            }
            all.push(one);
        }
    }
    Some(all)
}

const EXPECTED_VALUES: &str = "a list of values, such as [0, 1, 5], or a range such as { from = 3, to = 5 }";

/// A range of numbers among the values of a parameter.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Numbers {
    from: u64,
    to: u64,
}

/// One value, or the numbers of a range.
fn elements<'i>(
    reader: &mut Reader<'_>,
    place: &str,
    value: &Value<'i>,
    names: &Names<'_, 'i>,
) -> Option<Vec<DeValue<'i>>> {
    match value.get_ref() {
        DeValue::Array(_) => {
            let expected = "a number, a text, true, false, or a range such as { from = 3, to = 5 }";
            reader.refuse_by(value.span(), || wrong_type(place, value.get_ref(), expected));
            None
        }
        DeValue::Table(_) => {
            let value = &names.replaced(reader, value)?;
            let Numbers { from, to } = reader.typed(place, value)?;
            if from < to && to - from < CASES_MAX as u64 && to <= NUMBER_MAX {
                return Some((from..=to).filter_map(integer).collect());
            }
            let problem = Problem::new(format!("`{place}` is no range from {from} to {to}"), "");
            let help = match from.cmp(&to) {
                Ordering::Greater => format!("the smaller number is first: `{{ from = {to}, to = {from} }}`"),
                Ordering::Equal => format!("one value is `[{from}]`"),
                Ordering::Less => {
                    format!("a range has at most {CASES_MAX} numbers, and they end at {NUMBER_MAX}")
                }
            };
            reader.refuse(value.span(), problem.with_help(help));
            None
        }
        one => Some(vec![one.clone()]),
    }
}

/// Last number of a range.
const NUMBER_MAX: u64 = 65_535;

/// The digits of the numbers of ranges: an integer of a file borrows its text.
static DIGITS: LazyLock<Vec<String>> =
    LazyLock::new(|| (0..=NUMBER_MAX).map(|number| number.to_string()).collect());

/// A number as in a list; none if it is greater than the last one.
fn integer(number: u64) -> Option<DeValue<'static>> {
    let digits = DIGITS.get(usize::try_from(number).ok()?)?;
    DeValue::parse(digits).ok().map(Spanned::into_inner)
}

/// Number of combinations of all values.
pub(super) fn product(list: &[Parameter<'_, '_>]) -> usize {
    list.iter().fold(1, |product: usize, parameter| product.saturating_mul(parameter.values.len()))
}

/// The combination with this number, from 0.
pub(super) fn combination<'i>(list: &[Parameter<'_, 'i>], number: usize) -> Vec<Named<'i>> {
    let mut rest = number;
    let last_first = list.iter().rev().map(|Parameter { name, values, .. }| {
        let value = values[rest % values.len()].clone();
        rest /= values.len();
        Named::new(name, value)
    });
    let mut named: Vec<_> = last_first.collect();
    named.reverse();
    named
}
