//! Values of types that serde reads. All mistakes in such a value are reported, not only the first one.

use core::fmt;
use core::marker::PhantomData;
use core::ops::Range;
use std::collections::BTreeSet;

use serde::de::value::StrDeserializer;
use serde::de::{
    self, DeserializeOwned, DeserializeSeed, Deserializer, EnumAccess, Expected, IntoDeserializer, MapAccess,
    SeqAccess, Unexpected, VariantAccess, Visitor,
};
use serde::forward_to_deserialize_any;
use toml::de::DeValue;

use crate::error::Problem;
use crate::mistakes::MISTAKES_MAX;
use crate::reader::{Reader, Section, Value, wrong_type};
use crate::words::shown;

impl Reader<'_> {
    /// `value` as a `T`; none if a part of it is refused.
    pub fn typed<T: DeserializeOwned>(&mut self, place: &str, value: &Value<'_>) -> Option<T> {
        let mut findings = Findings { reader: self, refused: BTreeSet::new() };
        for _ in 0..PASSES_MAX {
            let known = findings.refused.len();
            let part = Part { findings: &mut findings, place: place.to_owned(), value };
            let read = part.take(PhantomData::<T>);
            if findings.refused.is_empty() {
                return read.ok();
            }
            // A refused part ends the reading of the value around it. When it is left out, the parts after it are read too.
            if findings.refused.len() == known {
                break;
            }
        }
        None
    }
}

/// Maximum number of times that one value is read: this limits its refused parts, in addition to unknown keys.
const PASSES_MAX: usize = 2 * MISTAKES_MAX;

/// The mistakes in one value so far.
struct Findings<'r, 't> {
    reader: &'r mut Reader<'t>,
    /// First and last byte of the keys and values that are left out from now on.
    refused: BTreeSet<(usize, usize)>,
}

impl Findings<'_, '_> {
    fn is_refused(&self, span: &Range<usize>) -> bool {
        self.refused.contains(&(span.start, span.end))
    }

    /// Whether it was not refused before.
    fn leave_out(&mut self, span: &Range<usize>) -> bool {
        self.refused.insert((span.start, span.end))
    }

    fn refuse_unknown_keys(&mut self, section: &Section<'_, '_>, names: &[&str]) {
        for (key, _) in section.entries().into_iter().filter(|(key, _)| !names.contains(&key.value)) {
            let span = key.span.unwrap_or_default();
            if self.leave_out(&span) {
                self.reader.refuse_by(span, || section.unknown_key(key.value, names));
            }
        }
    }

    /// Refuses the value at `span`, unless its mistake has already been reported.
    fn refuse(&mut self, place: &str, span: Range<usize>, wrong: Wrong) -> Wrong {
        let problem = match wrong {
            Wrong::Refused => return Wrong::Refused,
            Wrong::Incomplete => None,
            // The missing part may be one of the refused parts.
            Wrong::Missing(_) | Wrong::Length { .. } if !self.refused.is_empty() => None,
            Wrong::Missing(name) => Some(Problem::new(format!("`{place}.{name}` is missing"), "")),
            Wrong::Length { count, expected } => {
                Some(Problem::new(format!("`{place}` has a length of {count}"), expected))
            }
            Wrong::Other { found, expected } => Some(Problem::new(format!("`{place}` is {found}"), expected)),
            Wrong::Words(words) => Some(Problem::new(words, "")),
            Wrong::Problem(problem) => Some(*problem),
        };
        self.leave_out(&span);
        if let Some(problem) = problem {
            self.reader.refuse(span, problem);
        }
        Wrong::Refused
    }
}

/// Why a value cannot be read.
#[derive(Debug)]
enum Wrong {
    /// The mistake has been reported, and this part is not read again.
    Refused,
    /// It needs a part that has been refused.
    Incomplete,
    /// A key is missing.
    Missing(&'static str),
    /// A list has too few elements, or too many.
    Length { count: usize, expected: String },
    /// It differs from the expected type.
    Other { found: String, expected: String },
    /// The message of its type.
    Words(String),
    /// The message of this reader.
    Problem(Box<Problem>),
}

impl Wrong {
    fn other(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        let found = match found {
            Unexpected::Str(text) => format!("\"{}\"", shown(text)),
            Unexpected::Seq => "an array".to_owned(),
            Unexpected::Map => "a table".to_owned(),
            found => found.to_string(),
        };
        Self::Other { found, expected: expected.to_string() }
    }
}

impl fmt::Display for Wrong {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(self, formatter)
    }
}

impl core::error::Error for Wrong {}

impl de::Error for Wrong {
    fn custom<T: fmt::Display>(words: T) -> Self {
        Self::Words(words.to_string())
    }

    fn invalid_type(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self::other(found, expected)
    }

    fn invalid_value(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self::other(found, expected)
    }

    fn invalid_length(count: usize, expected: &dyn Expected) -> Self {
        Self::Length { count, expected: expected.to_string() }
    }

    fn missing_field(name: &'static str) -> Self {
        Self::Missing(name)
    }
}

/// A value inside the one that is read.
struct Part<'f, 'r, 't, 'd, 'i> {
    findings: &'f mut Findings<'r, 't>,
    place: String,
    value: &'d Value<'i>,
}

impl<'f, 'r, 't, 'd, 'i> Part<'f, 'r, 't, 'd, 'i> {
    fn take<'de, S: DeserializeSeed<'de>>(self, seed: S) -> Result<S::Value, Wrong> {
        self.read(|part| seed.deserialize(part))
    }

    /// The result of `read`; a mistake is reported at its place.
    fn read<T>(self, read: impl FnOnce(Part<'_, 'r, 't, 'd, 'i>) -> Result<T, Wrong>) -> Result<T, Wrong> {
        let Self { findings, place, value } = self;
        if findings.is_refused(&value.span()) {
            return Err(Wrong::Incomplete);
        }
        let part = Part { findings: &mut *findings, place: place.clone(), value };
        read(part).map_err(|wrong| findings.refuse(&place, value.span(), wrong))
    }

    /// The keys of a table; `names` are the permitted ones, none if all are permitted.
    fn keys<'de, V: Visitor<'de>>(
        self,
        names: Option<&'static [&'static str]>,
        visitor: V,
    ) -> Result<V::Value, Wrong> {
        let Self { findings, place, value } = self;
        let Some(section) = Section::of(&place, value) else {
            return Part { findings, place, value }.deserialize_any(visitor);
        };
        if let Some(names) = names {
            findings.refuse_unknown_keys(&section, names);
        }
        let mut entries = section.entries();
        entries.retain(|(key, value)| {
            let is_known = names.is_none_or(|names| names.contains(&key.value));
            is_known && !findings.is_refused(&value.span())
        });
        let entries = entries.into_iter().map(|(key, value)| (key.value, value));
        visitor.visit_map(Keys { findings, place, entries, next: None })
    }
}

impl<'de> Deserializer<'de> for Part<'_, '_, '_, '_, '_> {
    type Error = Wrong;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong> {
        match self.value.get_ref() {
            DeValue::String(text) => visitor.visit_str(text),
            DeValue::Boolean(truth) => visitor.visit_bool(*truth),
            DeValue::Integer(digits) => {
                let (text, radix) = (digits.as_str(), digits.radix());
                match (u64::from_str_radix(text, radix), i64::from_str_radix(text, radix)) {
                    (Ok(number), _) => visitor.visit_u64(number),
                    (_, Ok(number)) => visitor.visit_i64(number),
                    _ => Err(Wrong::other(Unexpected::Other(&shown(&digits.to_string())), &"64 bits")),
                }
            }
            DeValue::Float(digits) => match digits.as_str().parse() {
                Ok(number) => visitor.visit_f64(number),
                Err(_) => Err(Wrong::other(Unexpected::Other(&shown(digits.as_str())), &"a number")),
            },
            DeValue::Datetime(date) => visitor.visit_str(&date.to_string()),
            DeValue::Array(elements) => {
                let elements = elements.iter().enumerate();
                visitor.visit_seq(Elements { findings: self.findings, place: self.place, elements })
            }
            DeValue::Table(_) => self.keys(None, visitor),
        }
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong> {
        visitor.visit_some(self)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        visitor: V,
    ) -> Result<V::Value, Wrong> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Wrong> {
        self.keys(Some(fields), visitor)
    }

    /// A text, or a table with one key.
    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _name: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Wrong> {
        let Self { findings, place, value } = self;
        let unknown =
            |message, word| Err(Wrong::Problem(Box::new(Problem::unknown(message, word, variants))));
        if let DeValue::String(word) = value.get_ref() {
            return if variants.contains(&word.as_ref()) {
                visitor.visit_enum(StrDeserializer::new(word))
            } else {
                unknown(format!("`{place}` is \"{}\"", shown(word)), word)
            };
        }
        let Some(section) = Section::of(&place, value) else {
            let expected = "a text, or a table with one key";
            return Err(Wrong::Problem(Box::new(wrong_type(&place, value.get_ref(), expected))));
        };
        match section.entries().as_slice() {
            [(key, value)] if variants.contains(&key.value) => {
                let part = Part { findings, place: section.place_of(key.value), value };
                visitor.visit_enum(Variant { name: key.value, part })
            }
            [_] => {
                findings.refuse_unknown_keys(&section, variants);
                Err(Wrong::Incomplete)
            }
            keys => Err(Wrong::Other {
                found: format!("a table with {} keys", keys.len()),
                expected: "a table with one key".to_owned(),
            }),
        }
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit unit_struct seq tuple
        tuple_struct map identifier ignored_any
    }
}

/// The keys of a table, with their values.
struct Keys<'f, 'r, 't, 'd, 'i, E: Iterator<Item = (&'d str, &'d Value<'i>)>>
where
    'i: 'd,
{
    findings: &'f mut Findings<'r, 't>,
    place: String,
    entries: E,
    next: Option<(&'d str, &'d Value<'i>)>,
}

impl<'de, 'd, 'i, E: Iterator<Item = (&'d str, &'d Value<'i>)>> MapAccess<'de>
    for Keys<'_, '_, '_, 'd, 'i, E>
{
    type Error = Wrong;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, Wrong> {
        self.next = self.entries.next();
        self.next.map(|(key, _)| seed.deserialize(StrDeserializer::<Wrong>::new(key))).transpose()
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, Wrong> {
        let Some((key, value)) = self.next.take() else { return Err(Wrong::Incomplete) };
        let place = format!("{}.{key}", self.place);
        Part { findings: &mut *self.findings, place, value }.take(seed)
    }
}

/// The elements of an array. Those that are refused are left out.
struct Elements<'f, 'r, 't, E> {
    findings: &'f mut Findings<'r, 't>,
    place: String,
    elements: E,
}

impl<'de, 'd, 'i: 'd, E: Iterator<Item = (usize, &'d Value<'i>)>> SeqAccess<'de> for Elements<'_, '_, '_, E> {
    type Error = Wrong;

    fn next_element_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<Option<S::Value>, Wrong> {
        let Self { findings, place, elements } = self;
        let Some((at, value)) = elements.find(|(_, value)| !findings.is_refused(&value.span())) else {
            return Ok(None);
        };
        Part { findings, place: format!("{place}[{at}]"), value }.take(seed).map(Some)
    }
}

/// The variant of an enum, given by the key of a table.
struct Variant<'f, 'r, 't, 'd, 'i> {
    name: &'d str,
    part: Part<'f, 'r, 't, 'd, 'i>,
}

impl<'de, 'f, 'r, 't, 'd, 'i> EnumAccess<'de> for Variant<'f, 'r, 't, 'd, 'i> {
    type Error = Wrong;
    type Variant = Part<'f, 'r, 't, 'd, 'i>;

    fn variant_seed<S: DeserializeSeed<'de>>(self, seed: S) -> Result<(S::Value, Self::Variant), Wrong> {
        let name: StrDeserializer<'_, Wrong> = self.name.into_deserializer();
        Ok((seed.deserialize(name)?, self.part))
    }
}

impl<'de> VariantAccess<'de> for Part<'_, '_, '_, '_, '_> {
    type Error = Wrong;

    /// `{ lose = {} }` is `"lose"`.
    fn unit_variant(self) -> Result<(), Wrong> {
        self.read(|part| part.keys(Some(&[]), de::IgnoredAny).map(drop))
    }

    fn newtype_variant_seed<S: DeserializeSeed<'de>>(self, seed: S) -> Result<S::Value, Wrong> {
        self.take(seed)
    }

    fn tuple_variant<V: Visitor<'de>>(self, _length: usize, visitor: V) -> Result<V::Value, Wrong> {
        self.read(|part| part.deserialize_any(visitor))
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Wrong> {
        self.read(|part| part.keys(Some(fields), visitor))
    }
}
