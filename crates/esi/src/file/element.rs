//! An element with its file, and the typed values in it. What cannot be read is reported and is missing then.

use roxmltree::Node;
use user_file::shown;

use super::number;
use super::place::Place;
use super::reading::Reading;
use crate::lint::finding::Report;
use crate::lint::rules::{self, Rule};

/// English as Windows numbers languages.
const ENGLISH: &str = "1033";
/// German.
const GERMAN: &str = "1031";

/// An element.
#[derive(Clone, Copy)]
pub(super) struct Element<'a> {
    node: Node<'a, 'a>,
    reading: &'a Reading<'a>,
}

impl<'a> Element<'a> {
    /// The root element of a document.
    pub(super) fn root(reading: &'a Reading<'a>) -> Self {
        Self { node: reading.root(), reading }
    }

    /// Its name, without a prefix.
    pub(super) fn name(self) -> &'a str {
        self.node.tag_name().name()
    }

    pub(super) fn place(self) -> Place {
        self.reading.place(self.node.range().start)
    }

    /// All elements in it.
    pub(super) fn elements(self) -> impl Iterator<Item = Self> {
        self.node.children().filter(Node::is_element).map(move |node| Self { node, ..self })
    }

    /// The elements of this name in it.
    pub(super) fn all(self, name: &'static str) -> impl Iterator<Item = Self> {
        self.elements().filter(move |element| element.name() == name)
    }

    /// The first element of this name in it.
    pub(super) fn child(self, name: &'static str) -> Option<Self> {
        self.all(name).next()
    }

    /// The element at the end of a path of first elements.
    pub(super) fn at(self, path: &[&'static str]) -> Option<Self> {
        path.iter().try_fold(self, |element, name| element.child(name))
    }

    /// Its text without blanks around it; empty if there is none.
    pub(super) fn text(self) -> &'a str {
        self.node.text().unwrap_or_default().trim()
    }

    /// Its text as a value.
    pub(super) fn value(self) -> Value<'a> {
        Value { text: self.text(), byte: self.node.range().start, name: self.name(), reading: self.reading }
    }

    /// The text of the first element of this name as a value.
    pub(super) fn value_of(self, name: &'static str) -> Option<Value<'a>> {
        Some(self.child(name)?.value())
    }

    /// The text of the first element of this name; empty if there is none.
    pub(super) fn text_of(self, name: &'static str) -> &'a str {
        self.child(name).map(Self::text).unwrap_or_default()
    }

    /// The number in the first element of this name.
    pub(super) fn number_of<T: TryFrom<i64>>(self, name: &'static str) -> Option<T> {
        self.value_of(name)?.number()
    }

    /// The 16 bits in the first element of this name; network files have them negative too.
    pub(super) fn wrapping_16(self, name: &'static str) -> Option<u16> {
        self.value_of(name)?.wrapping_16()
    }

    /// The 32 bits in the first element of this name; network files have them negative too.
    pub(super) fn wrapping_32(self, name: &'static str) -> Option<u32> {
        let value = self.value_of(name)?;
        if value.is_negative() { value.number::<i32>().map(i32::cast_unsigned) } else { value.number() }
    }

    /// An attribute; blanks around its text do not matter.
    pub(super) fn attribute(self, name: &'static str) -> Option<Value<'a>> {
        let found = self.node.attributes().find(|attribute| attribute.name() == name)?;
        let (text, byte) = (found.value().trim(), found.range().start);
        Some(Value { text, byte, name, reading: self.reading })
    }

    /// The text of an attribute with the blanks around it.
    pub(super) fn attribute_as_written(self, name: &str) -> Option<&'a str> {
        Some(self.node.attributes().find(|attribute| attribute.name() == name)?.value())
    }

    /// The number in an attribute.
    pub(super) fn number<T: TryFrom<i64>>(self, name: &'static str) -> Option<T> {
        self.attribute(name)?.number()
    }

    /// Whether an attribute is set; it is not if it is left out.
    pub(super) fn flag(self, name: &'static str) -> bool {
        self.attribute(name).is_some_and(Value::flag)
    }

    /// The text of the elements of this name: in English, else the first one that has a language other than German.
    pub(super) fn localized(self, name: &'static str) -> String {
        let in_language = |language: &'static str| {
            move |element: &Self| element.attribute("LcId").is_some_and(|id| id.text == language)
        };
        let named = || self.all(name).filter(|element| !element.text().is_empty());
        let english = named().find(in_language(ENGLISH));
        let other = || named().find(|element| !in_language(GERMAN)(element));
        english.or_else(other).or_else(|| named().next()).map(Self::text).unwrap_or_default().to_owned()
    }

    pub(super) fn report(self, rule: &'static Rule, message: String) {
        self.reading.report(rule, self.place(), message);
    }
}

/// The text of an attribute or of an element, with its place.
#[derive(Clone, Copy)]
pub(super) struct Value<'a> {
    /// The text, without blanks around it.
    pub(super) text: &'a str,
    byte: usize,
    name: &'a str,
    reading: &'a Reading<'a>,
}

impl Value<'_> {
    /// The number, if it is one and fits.
    pub(super) fn number<T: TryFrom<i64>>(self) -> Option<T> {
        let Some(written) = number::parse(self.text) else {
            self.report(rules::NOT_A_NUMBER, "is not a number; read as missing");
            return None;
        };
        let Ok(value) = T::try_from(written.value) else {
            let bits = 8 * size_of::<T>();
            self.report(rules::NUMBER_TOO_LARGE, &format!("does not fit into {bits} bits; read as missing"));
            return None;
        };
        if written.is_as_in_c {
            self.report(rules::NUMBER_AS_IN_C, "is a hexadecimal number as in C; read as such");
        }
        Some(value)
    }

    fn is_negative(self) -> bool {
        self.text.starts_with('-')
    }

    /// Its 16 bits; network files have them negative too.
    pub(super) fn wrapping_16(self) -> Option<u16> {
        if self.is_negative() { self.number::<i16>().map(i16::cast_unsigned) } else { self.number() }
    }

    /// Whether it is true: `1` or `true`.
    pub(super) fn flag(self) -> bool {
        match self.text.to_ascii_lowercase().as_str() {
            "1" | "true" => true,
            "0" | "false" => false,
            _ => {
                self.report(rules::NOT_A_BOOLEAN, "is neither true nor false; read as false");
                false
            }
        }
    }

    /// The bytes in hexadecimal digits; blanks between them do not matter.
    pub(super) fn bytes(self) -> Option<Vec<u8>> {
        let digits: Option<Vec<u8>> = self
            .text
            .chars()
            .filter(|c| !c.is_whitespace())
            .map(|c| c.to_digit(16).map(|digit| digit as u8))
            .collect();
        match digits {
            Some(digits) if digits.len().is_multiple_of(2) => {
                Some(digits.as_chunks().0.iter().map(|[high, low]| high << 4 | low).collect())
            }
            _ => {
                self.report(
                    rules::NOT_HEX_BINARY,
                    "is not an even number of hexadecimal digits; read as missing",
                );
                None
            }
        }
    }

    /// Reports what is wrong with the value: `NAME=`TEXT` WRONG`.
    pub(super) fn report(self, rule: &'static Rule, wrong: &str) {
        let place = self.reading.place(self.byte);
        self.reading.report(rule, place, format!("{} `{}` {wrong}", self.name, shown(self.text)));
    }
}
