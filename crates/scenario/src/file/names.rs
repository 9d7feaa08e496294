//! Names in braces: `{loss}` in a text of the file is replaced by the value of the parameter `loss`.

use core::cell::Cell;

use toml::Spanned;
use user_file::{DeValue, Located, Problem, Reader, Value};

use super::places::Span;

/// A name with the value that replaces it.
pub(super) struct Named<'i> {
    name: String,
    /// The place of the name, for a message.
    span: Span,
    value: DeValue<'i>,
    is_used: Cell<bool>,
}

impl<'i> Named<'i> {
    pub(super) fn new(name: &Located<&str>, value: DeValue<'i>) -> Self {
        let span = name.span.clone().unwrap_or_default();
        Self { name: name.value.to_owned(), span, value, is_used: Cell::new(false) }
    }

    /// The same with the values of other names in its text; none if it has an unknown one.
    pub(super) fn replaced(self, names: &Names<'_, 'i>, reader: &mut Reader<'_>) -> Option<Self> {
        let value = names.replaced(reader, &Spanned::new(self.span.clone(), self.value))?;
        Some(Self { value: value.into_inner(), ..self })
    }

    /// `loss = 5`.
    pub(super) fn words(&self) -> String {
        format!("{} = {}", self.name, written(&self.value))
    }

    /// The value in the notation of a file.
    pub(super) fn toml(&self) -> String {
        match &self.value {
            DeValue::String(text) => toml::Value::String(text.to_string()).to_string(),
            other => written(other),
        }
    }

    /// Refuses a name that no text has used: every case would be the same.
    pub(super) fn refuse_unused(&self, reader: &mut Reader<'_>, help: &str) {
        if !self.is_used.get() {
            let message = format!("`{{{}}}` is not in any text", self.name);
            reader.refuse(self.span.clone(), Problem::new(message, "").with_help(help.to_owned()));
        }
    }
}

/// The value in a text.
pub(super) fn written(value: &DeValue<'_>) -> String {
    match value {
        DeValue::String(text) => text.to_string(),
        DeValue::Integer(number) if number.radix() == 16 => format!("0x{}", number.as_str()),
        DeValue::Integer(number) => i64::from_str_radix(number.as_str(), number.radix())
            .map_or_else(|_| number.as_str().to_owned(), |number| number.to_string()),
        DeValue::Float(number) => number.as_str().to_owned(),
        DeValue::Boolean(truth) => truth.to_string(),
        DeValue::Datetime(date) => date.to_string(),
        DeValue::Array(_) | DeValue::Table(_) => String::new(),
    }
}

/// The names that the texts of a part of the file can use.
#[derive(Default)]
pub(super) struct Names<'n, 'i> {
    known: Vec<&'n Named<'i>>,
}

impl<'n, 'i> Names<'n, 'i> {
    pub(super) fn of(named: &'n [Named<'i>]) -> Self {
        Self { known: named.iter().collect() }
    }

    /// These names and others.
    pub(super) fn with<'m>(&self, named: &'m [Named<'i>]) -> Names<'m, 'i>
    where
        'n: 'm,
    {
        Names { known: self.known.iter().copied().chain(named).collect() }
    }

    pub(super) fn has(&self, name: &str) -> bool {
        self.known.iter().any(|named| named.name == name)
    }

    /// No text is changed.
    pub(super) fn are_none(&self) -> bool {
        self.known.is_empty()
    }

    /// A copy of a value whose texts have the values of the names. A text that is only a name becomes the value itself, so
    /// that a number stays a number. Keys are not changed. None if a text has an unknown name, which is refused: what else
    /// is wrong in the value would be its effect.
    pub(super) fn replaced(&self, reader: &mut Reader<'_>, value: &Value<'i>) -> Option<Value<'i>> {
        let refused = reader.refused();
        let mut copy = value.clone();
        self.replace(reader, &mut copy);
        (reader.refused() == refused).then_some(copy)
    }

    fn replace(&self, reader: &mut Reader<'_>, value: &mut Value<'i>) {
        let span = value.span();
        match value.get_mut() {
            DeValue::String(text) => match self.value_of(text, &span, reader) {
                Replaced::Same => {}
                Replaced::Text(new) => *text = new.into(),
                Replaced::Value(new) => *value.get_mut() = new,
            },
            DeValue::Array(elements) => {
                elements.iter_mut().for_each(|element| self.replace(reader, element));
            }
            DeValue::Table(table) => {
                table.iter_mut().for_each(|(_, value)| self.replace(reader, value));
            }
            DeValue::Integer(_) | DeValue::Float(_) | DeValue::Boolean(_) | DeValue::Datetime(_) => {}
        }
    }

    fn value_of(&self, text: &str, span: &Span, reader: &mut Reader<'_>) -> Replaced<'i> {
        let pieces = pieces(text);
        if let [Piece::Name(name)] = pieces.as_slice() {
            return self.find(name, span, reader).map_or(Replaced::Same, Replaced::Value);
        }
        if pieces.iter().all(|piece| matches!(piece, Piece::Text(_))) {
            return Replaced::Same;
        }
        let text = pieces.into_iter().map(|piece| match piece {
            Piece::Text(text) => text.to_owned(),
            Piece::Braces(inside) => format!("{{{inside}}}"),
            Piece::Name(name) => {
                self.find(name, span, reader).map(|value| written(&value)).unwrap_or_default()
            }
        });
        Replaced::Text(text.collect())
    }

    fn find(&self, name: &str, span: &Span, reader: &mut Reader<'_>) -> Option<DeValue<'i>> {
        let found = self.known.iter().find(|named| named.name == name);
        if found.is_none() {
            let names: Vec<&str> = self.known.iter().map(|named| named.name.as_str()).collect();
            let problem = Problem::unknown(format!("nothing has the name `{{{name}}}`"), name, &names);
            let help = format!("a text that contains these braces has them twice: `{{{{{name}}}}}`");
            reader.refuse(span.clone(), problem.with_help(help));
        }
        let named = found?;
        named.is_used.set(true);
        Some(named.value.clone())
    }
}

/// What a text becomes.
enum Replaced<'i> {
    Same,
    Text(String),
    Value(DeValue<'i>),
}

/// A piece of a text.
#[derive(Debug, PartialEq, Eq)]
enum Piece<'t> {
    Text(&'t str),
    /// `{name}`.
    Name(&'t str),
    /// `{{name}}`, which means `{name}`.
    Braces(&'t str),
}

/// The pieces of a text. Braces around something else than a name are text.
fn pieces(text: &str) -> Vec<Piece<'_>> {
    let mut pieces = Vec::new();
    let mut rest = text;
    let mut searched = 0;
    while let Some(at) = rest.get(searched..).and_then(|tail| tail.find('{')).map(|at| searched + at) {
        let Some((piece, length)) = piece(&rest[at..]) else {
            searched = at + 1;
            continue;
        };
        if at > 0 {
            pieces.push(Piece::Text(&rest[..at]));
        }
        pieces.push(piece);
        rest = &rest[at + length..];
        searched = 0;
    }
    if !rest.is_empty() {
        pieces.push(Piece::Text(rest));
    }
    pieces
}

/// The name at the beginning of a text, in one pair of braces or in two, and the length of all of it.
fn piece(text: &str) -> Option<(Piece<'_>, usize)> {
    let inside = |text: &'_ str| text.find('}').filter(|&end| is_name(&text[..end]));
    if let Some(twice) = text.strip_prefix("{{") {
        let end = inside(twice).filter(|&end| twice[end..].starts_with("}}"))?;
        return Some((Piece::Braces(&twice[..end]), end + 4));
    }
    let once = text.strip_prefix('{')?;
    let end = inside(once)?;
    Some((Piece::Name(&once[..end]), end + 2))
}

/// Whether a text can be a name: a letter or `_`, then also digits.
pub(super) fn is_name(text: &str) -> bool {
    let is_letter = |character: char| character.is_ascii_alphabetic() || character == '_';
    text.starts_with(is_letter)
        && text.chars().all(|character| is_letter(character) || character.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_divided_at_names_in_braces() {
        use Piece::{Braces, Name, Text};
        assert_eq!(pieces("lose {loss} % of {n}"), [Text("lose "), Name("loss"), Text(" % of "), Name("n")]);
        assert_eq!(pieces("{loss}"), [Name("loss")]);
        assert_eq!(pieces("a {{loss}} b"), [Text("a "), Braces("loss"), Text(" b")]);
        for text in ["", "{", "{}", "{ loss }", "{1}", "{a", "}{", "{ä}"] {
            let expected: &[Piece<'_>] = if text.is_empty() { &[] } else { &[Text(text)] };
            assert_eq!(pieces(text), expected, "{text}");
        }
        assert_eq!(pieces("{ {a}"), [Text("{ "), Name("a")]);
        assert_eq!(pieces("{{a}"), [Text("{"), Name("a")]);
    }
}
