//! Reads a TOML document and collects its mistakes.

use core::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::error::{FileError, FileErrors, Problem, say_long_lists_once};
use crate::kind::{Wanted, of_another_kind};
use crate::located::Located;
use crate::mistakes::Mistakes;
use crate::words::shown;

/// A value as the TOML parser returns it.
pub type Value<'i> = Spanned<DeValue<'i>>;

/// Reads a TOML text of the required kind with `read`, which returns a value only if it can; if anything was
/// refused, the result is the errors.
///
/// # Errors
/// All mistakes, in the order of the file. For a text that is of another kind, or not TOML, only that is reported.
pub fn read_toml<T>(
    text: &str,
    wanted: Wanted,
    read: impl FnOnce(&mut Reader<'_>, &Section<'_, '_>) -> Option<T>,
) -> Result<T, FileErrors> {
    let mut reader = Reader { text, errors: Mistakes::default(), refused_keys: Vec::new() };
    if let Some(refusal) = of_another_kind(text.as_bytes(), "", wanted) {
        reader.refuse(0..0, Problem::new(format!("{}; {}", refusal.message, refusal.help), ""));
        return Err(reader.into_errors());
    }
    let (document, syntax_errors) = DeTable::parse_recoverable(text);
    if !syntax_errors.is_empty() {
        syntax_errors.iter().for_each(|error| reader.refuse_syntax(error));
        return Err(reader.into_errors());
    }
    let root = Section { place: String::new(), span: document.span(), table: document.get_ref() };
    match read(&mut reader, &root) {
        Some(result) if reader.errors.is_empty() => Ok(result),
        _ => Err(reader.into_errors()),
    }
}

/// Collects errors.
pub struct Reader<'t> {
    text: &'t str,
    errors: Mistakes<FileError>,
    /// The places of keys that are refused already.
    refused_keys: Vec<usize>,
}

impl Reader<'_> {
    /// Notes a mistake at `span`.
    pub fn refuse(&mut self, span: Range<usize>, problem: Problem) {
        self.refuse_by(span, || problem);
    }

    /// Notes a mistake at `span`, with a text that is made only if the mistake is reported.
    pub fn refuse_by(&mut self, span: Range<usize>, problem: impl FnOnce() -> Problem) {
        let text = self.text;
        self.errors.note(span.start, || FileError::new(text, span, problem()));
    }

    /// Number of mistakes so far.
    #[must_use]
    pub const fn refused(&self) -> usize {
        self.errors.count()
    }

    /// Refuses a key in the caller's words; [`Reader::only`] does not refuse it again.
    pub fn refuse_key(&mut self, key: &Located<&str>, problem: Problem) {
        let span = key.span.clone().unwrap_or_default();
        self.refused_keys.push(span.start);
        self.refuse(span, problem);
    }

    /// Refuses every key of `section` that is none of `keys`.
    pub fn only(&mut self, section: &Section<'_, '_>, keys: &[&str]) {
        for (key, _) in section.entries().into_iter().filter(|(key, _)| !keys.contains(&key.value)) {
            if key.span.as_ref().is_some_and(|span| self.refused_keys.contains(&span.start)) {
                continue;
            }
            self.refuse_by(key.span.unwrap_or_default(), || section.unknown_key(key.value, keys));
        }
    }

    /// Refuses `section` without `key`; `expected` shows how to write it.
    pub fn require(&mut self, section: &Section<'_, '_>, key: &str, expected: &str) {
        if section.get(key).is_none() {
            let start = section.span.start;
            let message = format!("`{}` is missing", section.place_of(key));
            self.refuse(start..start, Problem::new(message, expected));
        }
    }

    /// The value of `key`, read with `read`; none if it is left out or refused.
    pub fn value<T>(
        &mut self,
        section: &Section<'_, '_>,
        key: &str,
        read: impl FnOnce(&str, &DeValue<'_>) -> Result<T, Problem>,
    ) -> Option<Located<T>> {
        self.read(&section.place_of(key), section.get(key)?, read)
    }

    /// `value`, read with `read`; none if it is refused.
    pub fn read<T>(
        &mut self,
        place: &str,
        value: &Value<'_>,
        read: impl FnOnce(&str, &DeValue<'_>) -> Result<T, Problem>,
    ) -> Option<Located<T>> {
        match read(place, value.get_ref()) {
            Ok(read) => Some(Located::at(value.span(), read)),
            Err(problem) => {
                self.refuse(value.span(), problem);
                None
            }
        }
    }

    /// The table at `key`; none if it is left out, or not a table.
    pub fn section<'d, 'i>(&mut self, parent: &Section<'d, 'i>, key: &str) -> Option<Section<'d, 'i>> {
        let value = parent.get(key)?;
        let place = parent.place_of(key);
        let section = Section::of(&place, value);
        if section.is_none() {
            self.refuse_by(value.span(), || wrong_type(&place, value.get_ref(), "a table"));
        }
        section
    }

    /// Every element of the array `value`, read with `read`; refused elements are left out.
    pub fn array<T>(
        &mut self,
        place: &str,
        value: &Value<'_>,
        mut read: impl FnMut(&str, &DeValue<'_>) -> Result<T, Problem>,
    ) -> Vec<Located<T>> {
        let elements = value.get_ref().as_array().into_iter().flat_map(|array| array.iter());
        let numbered = elements.enumerate();
        numbered.filter_map(|(at, each)| self.read(&format!("{place}[{at}]"), each, &mut read)).collect()
    }

    fn refuse_syntax(&mut self, error: &toml::de::Error) {
        // The parser's text is already a fragment, with the expected contents at its end.
        let message = error.message().replace('\n', ", ");
        let (message, expected) = message.split_once(", expected ").unwrap_or((&message, ""));
        let span = error.span().unwrap_or(0..0);
        let found = match self.text.get(span.clone()).unwrap_or("") {
            "" => String::new(),
            found => format!(" at `{}`", shown(found)),
        };
        self.refuse(span, Problem::new(format!("not TOML: {message}{found}"), expected));
    }

    fn into_errors(self) -> FileErrors {
        let (mut list, more) = self.errors.into_parts();
        say_long_lists_once(&mut list);
        FileErrors { list, more }
    }
}

/// A table of the file.
pub struct Section<'d, 'i> {
    place: String,
    span: Range<usize>,
    table: &'d DeTable<'i>,
}

impl<'d, 'i> Section<'d, 'i> {
    /// `value` as a table whose keys follow `place` in messages; none if it is not a table.
    #[must_use]
    pub fn of(place: &str, value: &'d Value<'i>) -> Option<Self> {
        let table = value.get_ref().as_table()?;
        Some(Self { place: place.to_owned(), span: value.span(), table })
    }

    pub(crate) fn unknown_key(&self, key: &str, keys: &[&str]) -> Problem {
        Problem::unknown(format!("unknown key `{}`", self.place_of(&shown(key))), key, keys)
    }

    /// The value of `key`.
    pub fn get(&self, key: &str) -> Option<&'d Value<'i>> {
        self.table.iter().find(|(known, _)| known.get_ref() == key).map(|(_, value)| value)
    }

    /// All keys with their spans, and their values, in the order of the file.
    pub fn entries(&self) -> Vec<(Located<&'d str>, &'d Value<'i>)> {
        let mut entries: Vec<_> = self.table.iter().collect();
        entries.sort_unstable_by_key(|(key, _)| key.span().start);
        let located = |key: &'d Spanned<_>| Located::at(key.span(), AsRef::<str>::as_ref(key.get_ref()));
        entries.into_iter().map(|(key, value)| (located(key), value)).collect()
    }

    /// `key` with the tables that contain it.
    pub fn place_of(&self, key: &str) -> String {
        match self.place.as_str() {
            "" => key.to_owned(),
            place => format!("{place}.{key}"),
        }
    }

    /// `value` at the place of this table.
    pub fn locate<T>(&self, value: T) -> Located<T> {
        Located::at(self.span.clone(), value)
    }
}

/// `value` has a type other than `expected`.
pub fn wrong_type(place: &str, value: &DeValue<'_>, expected: &str) -> Problem {
    let found = match value {
        DeValue::String(_) => "a string",
        DeValue::Integer(_) => "an integer",
        DeValue::Float(_) => "a float",
        DeValue::Boolean(_) => "a boolean",
        DeValue::Datetime(_) => "a date",
        DeValue::Array(_) => "an array",
        DeValue::Table(_) => "a table",
    };
    Problem::new(format!("`{place}` is {found}"), expected)
}
