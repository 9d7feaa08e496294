//! Lists of steps with groups: the values of `for` are put in here, each step keeps its place in the file.

use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};
use user_file::{Located, Problem, Section, Value, wrong_type};

use super::names::{Named, Names};
use super::parameters::{Parameter, combination, parameters, product};
use super::places::StepPlaces;
use super::reader::{FileReader, span_of};
use super::steps::{PartReader, StepReading, read_step};
use crate::model::{Branch, ScriptStep, StepForm};
use crate::ready::{DEPTH_MAX, Written, empty_list, group_words};

/// The keys of a group.
const KEYS: &[&str] = &["at", "after", "when", "repeat", "every", "jitter", FOR, STEPS, TOGETHER];
const FOR: &str = "for";
const STEPS: &str = "steps";
const TOGETHER: &str = "together";

/// Maximum number of steps that the values of one `for` make.
const EXPANDED_MAX: usize = 10_000;

/// Where a list of steps is.
#[derive(Clone, Copy)]
pub(super) struct Scope<'s, 'n, 'i> {
    /// The names that its texts can use.
    pub(super) names: &'s Names<'n, 'i>,
    /// Number of groups around it.
    pub(super) depth: usize,
}

/// The steps of a list; wrong ones are left out.
pub(super) fn read_steps<'i>(
    file: &mut FileReader<'_, '_>,
    place: &str,
    list: &[Value<'i>],
    scope: Scope<'_, '_, 'i>,
) -> Vec<ScriptStep> {
    let read = |(at, value): (usize, &Value<'i>)| read_entry(file, &format!("{place}[{at}]"), value, scope);
    list.iter().enumerate().filter_map(read).collect()
}

fn read_entry<'i>(
    file: &mut FileReader<'_, '_>,
    place: &str,
    value: &Value<'i>,
    scope: Scope<'_, '_, 'i>,
) -> Option<ScriptStep> {
    if let Some(group) = Section::of("", value).filter(is_group) {
        return GroupReader { place, section: &group, value, scope }.read(file);
    }
    let names = scope.names;
    let replaced = if names.are_none() { None } else { Some(names.replaced(file.reader, value)?) };
    let StepReading { step, places, written } = read_step(file, place, replaced.as_ref().unwrap_or(value))?;
    file.places.steps.push(places);
    file.written.push(written);
    Some(step)
}

/// A group has steps, or values for them. `for` with a time belongs to an expectation.
fn is_group(step: &Section<'_, '_>) -> bool {
    let has_values = step.get(FOR).is_some_and(|value| value.get_ref().is_table());
    has_values || step.get(STEPS).is_some() || step.get(TOGETHER).is_some()
}

/// Reads one group.
struct GroupReader<'g, 'd, 'n, 'i> {
    place: &'g str,
    section: &'g Section<'d, 'i>,
    value: &'g Value<'i>,
    scope: Scope<'g, 'n, 'i>,
}

impl<'d, 'n, 'i> GroupReader<'_, 'd, 'n, 'i> {
    /// None if it has a mistake; then none of its steps are kept.
    fn read(&self, file: &mut FileReader<'_, '_>) -> Option<ScriptStep> {
        let (first, refused) = (file.written.len(), file.reader.refused());
        let step = self.group(file).filter(|_| file.reader.refused() == refused);
        if step.is_none() {
            file.written.truncate(first);
            file.places.steps.truncate(first);
        }
        step
    }

    fn group(&self, file: &mut FileReader<'_, '_>) -> Option<ScriptStep> {
        let span = self.value.span();
        if self.scope.depth == DEPTH_MAX {
            let message = format!("this group is in {DEPTH_MAX} others, and a group cannot be in more");
            file.reader.refuse(span, Problem::new(message, "").with_help("use fewer groups in each other"));
            return None;
        }
        let at = file.written.len();
        file.places.steps.push(StepPlaces {
            whole: span.clone(),
            when: span_of(self.section, "when"),
            count: span_of(self.section, "repeat"),
            ..StepPlaces::default()
        });
        let line = file.lines.line(span.start);
        file.written.push(Written { line, bytes: span.clone(), text: String::new() });
        let refused = file.reader.refused();
        let form = self.head(file);
        let is_head_right = file.reader.refused() == refused;
        let form = self.members(file, form).filter(|_| is_head_right)?;
        match form.read() {
            Ok(step) => {
                if let (ScriptStep::Group(group), Some(written)) = (&step, file.written.get_mut(at)) {
                    written.text = group_words(&group.members);
                }
                Some(step)
            }
            Err(wrong) => {
                file.reader.refuse(span, Problem::new(wrong.message, "").with_help(wrong.help));
                None
            }
        }
    }

    /// Its times.
    fn head(&self, file: &mut FileReader<'_, '_>) -> StepForm {
        file.reader.only(self.section, KEYS);
        let own = self.scope.names.replaced(file.reader, &without_members(self.section, self.value));
        let Some(section) = own.as_ref().and_then(|own| Section::of("", own)) else {
            return StepForm::default();
        };
        let mut part = PartReader::of(file, &section);
        StepForm {
            at: part.duration("at"),
            after: part.duration("after"),
            when: part.condition("when"),
            repeat: part.number("repeat"),
            every: part.duration("every"),
            jitter: part.duration("jitter"),
            ..StepForm::default()
        }
    }

    /// Its steps, with each combination of the values of `for`.
    fn members(&self, file: &mut FileReader<'_, '_>, mut form: StepForm) -> Option<StepForm> {
        let values = self.values(file)?;
        let (first, refused) = (file.written.len(), file.reader.refused());
        for number in 0..product(&values) {
            let named = self.with_values(file, combination(&values, number))?;
            let names = self.scope.names.with(&named);
            self.sequences(file, &names, &mut form)?;
            if file.reader.refused() > refused {
                return None;
            }
            if number == 0 {
                refuse_unused(file, &named);
            }
            if !values.is_empty() && file.written.len() - first > EXPANDED_MAX {
                self.refuse_too_many(file);
                return None;
            }
        }
        Some(form)
    }

    /// The values of `for` with those of the names around the group; none if one is unknown.
    fn with_values(&self, file: &mut FileReader<'_, '_>, named: Vec<Named<'i>>) -> Option<Vec<Named<'i>>> {
        if self.scope.names.are_none() {
            return Some(named);
        }
        named.into_iter().map(|named| named.replaced(self.scope.names, file.reader)).collect()
    }

    /// The values of `for`; none if they have a mistake.
    fn values(&self, file: &mut FileReader<'_, '_>) -> Option<Vec<Parameter<'d, 'i>>> {
        let Some(value) = self.section.get(FOR) else { return Some(Vec::new()) };
        let Some(section) = Section::of(FOR, value) else {
            let expected = "names with lists of values, such as `for.unit = [2, 3]`";
            file.reader.refuse_by(value.span(), || wrong_type(FOR, value.get_ref(), expected));
            return None;
        };
        let list = parameters(file.reader, &section, self.scope.names)?;
        if let Some(Parameter { name, .. }) = list.iter().find(|other| self.scope.names.has(other.name.value))
        {
            let message = format!("`{{{}}}` has a value here already", name.value);
            let problem = Problem::new(message, "").with_help("give it another name");
            file.reader.refuse(name.span.clone().unwrap_or_default(), problem);
            return None;
        }
        if product(&list) > EXPANDED_MAX {
            self.refuse_too_many(file);
            return None;
        }
        Some(list)
    }

    fn refuse_too_many(&self, file: &mut FileReader<'_, '_>) {
        let message = format!("the values of `for` make more than {EXPANDED_MAX} steps");
        let help = "`repeat` repeats steps without values of their own";
        file.reader.refuse(span_of(self.section, FOR), Problem::new(message, "").with_help(help));
    }

    /// The sequences with these names, behind those with other values.
    fn sequences(
        &self,
        file: &mut FileReader<'_, '_>,
        names: &Names<'_, 'i>,
        form: &mut StepForm,
    ) -> Option<()> {
        let scope = Scope { names, depth: self.scope.depth + 1 };
        if self.section.get(STEPS).is_none() && self.section.get(TOGETHER).is_none() {
            let span = self.value.span();
            let problem = Problem::new("`for` needs `steps`", "").with_help("such as `steps = [ … ]`");
            file.reader.refuse(span, problem);
            return None;
        }
        if let Some(value) = self.section.get(STEPS) {
            let place = format!("{}.{STEPS}", self.place);
            let list = list(file, &place, value)?;
            let steps = read_steps(file, &place, list, scope);
            form.steps.get_or_insert_default().extend(steps);
        }
        if let Some(value) = self.section.get(TOGETHER) {
            let place = format!("{}.{TOGETHER}", self.place);
            for (at, branch) in list(file, &place, value)?.iter().enumerate() {
                let place = format!("{place}[{at}]");
                let steps = match branch.get_ref().as_array() {
                    Some(steps) => read_steps(file, &place, steps, scope),
                    None => read_entry(file, &place, branch, scope).into_iter().collect(),
                };
                form.together.get_or_insert_default().push(Branch::List(steps));
            }
        }
        Some(())
    }
}

fn refuse_unused(file: &mut FileReader<'_, '_>, named: &[Named<'_>]) {
    let help = "each value would make the same steps: use the name in a text, or `repeat`";
    named.iter().for_each(|named| named.refuse_unused(file.reader, help));
}

/// The elements of a list with at least one.
fn list<'v, 'i>(file: &mut FileReader<'_, '_>, place: &str, value: &'v Value<'i>) -> Option<&'v [Value<'i>]> {
    match value.get_ref().as_array() {
        Some(elements) if elements.is_empty() => {
            let problem = Problem::new(empty_list(place), "").with_help("a group has at least one step");
            file.reader.refuse(value.span(), problem);
            None
        }
        Some(elements) => Some(elements),
        None => {
            file.reader.refuse_by(value.span(), || wrong_type(place, value.get_ref(), "a list of steps"));
            None
        }
    }
}

/// A copy of a group without what is read with other names.
fn without_members<'i>(section: &Section<'_, 'i>, value: &Value<'i>) -> Value<'i> {
    let own = section.entries().into_iter().filter(|(key, _)| ![FOR, STEPS, TOGETHER].contains(&key.value));
    let entry = |(key, value): (Located<&str>, &Value<'i>)| {
        (Spanned::new(key.span.unwrap_or_default(), DeString::Owned(key.value.to_owned())), value.clone())
    };
    let table: DeTable<'i> = own.map(entry).collect();
    Spanned::new(value.span(), DeValue::Table(table))
}
