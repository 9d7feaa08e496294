//! A row of a table as data for programs: its fields in their order, whatever its type.

use core::fmt;

use serde::ser::{self, Impossible, SerializeMap, SerializeSeq, SerializeStruct};
use serde::{Serialize, Serializer};

/// The fields of a row with their names and values. It serializes as the row itself.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Record(Vec<(String, Value)>);

#[derive(Clone, Debug, PartialEq, Eq)]
enum Value {
    Nothing,
    Flag(bool),
    Number(u64),
    Text(String),
    List(Vec<Value>),
    Record(Record),
}

impl Record {
    /// The fields of a row: a struct or a map of truth values, natural numbers, texts, names of variants, lists, and such
    /// rows.
    ///
    /// # Panics
    /// It has another value: that is a mistake in a type of ours.
    #[must_use]
    pub fn of(row: &impl Serialize) -> Self {
        match row.serialize(ToValue) {
            Ok(Value::Record(record)) => record,
            Ok(other) => panic!("a row has fields: {other:?}"),
            Err(error) => panic!("{error}"),
        }
    }
}

impl Serialize for Record {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}

impl Serialize for Value {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Nothing => serializer.serialize_none(),
            Self::Flag(flag) => serializer.serialize_bool(*flag),
            Self::Number(number) => serializer.serialize_u64(*number),
            Self::Text(text) => serializer.serialize_str(text),
            Self::List(list) => list.serialize(serializer),
            Self::Record(record) => record.serialize(serializer),
        }
    }
}

/// The value cannot be in a table.
#[derive(Debug)]
struct Unsupported(String);

impl fmt::Display for Unsupported {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "a row of a table has {}", self.0)
    }
}

impl core::error::Error for Unsupported {}

impl ser::Error for Unsupported {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self(message.to_string())
    }
}

struct ToValue;

/// Methods for values that no table has.
macro_rules! unsupported {
    ($($method:ident($($argument:ty),*);)*) => {
        $(fn $method(self, $(_: $argument),*) -> Result<Value, Unsupported> {
            Err(Unsupported(stringify!($method).into()))
        })*
    };
}

macro_rules! natural {
    ($($method:ident($number:ty);)*) => {
        $(fn $method(self, number: $number) -> Result<Value, Unsupported> {
            Ok(Value::Number(number.into()))
        })*
    };
}

impl Serializer for ToValue {
    type Ok = Value;
    type Error = Unsupported;
    type SerializeSeq = List;
    type SerializeTuple = Impossible<Value, Unsupported>;
    type SerializeTupleStruct = Impossible<Value, Unsupported>;
    type SerializeTupleVariant = Impossible<Value, Unsupported>;
    type SerializeMap = Fields;
    type SerializeStruct = Fields;
    type SerializeStructVariant = Impossible<Value, Unsupported>;

    natural! {
        serialize_u8(u8);
        serialize_u16(u16);
        serialize_u32(u32);
        serialize_u64(u64);
    }

    unsupported! {
        serialize_i8(i8);
        serialize_i16(i16);
        serialize_i32(i32);
        serialize_i64(i64);
        serialize_f32(f32);
        serialize_f64(f64);
        serialize_char(char);
        serialize_bytes(&[u8]);
        serialize_unit();
        serialize_unit_struct(&'static str);
    }

    fn serialize_bool(self, flag: bool) -> Result<Value, Unsupported> {
        Ok(Value::Flag(flag))
    }

    fn serialize_str(self, text: &str) -> Result<Value, Unsupported> {
        Ok(Value::Text(text.into()))
    }

    fn serialize_none(self) -> Result<Value, Unsupported> {
        Ok(Value::Nothing)
    }

    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Result<Value, Unsupported> {
        value.serialize(self)
    }

    fn serialize_unit_variant(
        self,
        _: &'static str,
        _: u32,
        name: &'static str,
    ) -> Result<Value, Unsupported> {
        self.serialize_str(name)
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        value: &T,
    ) -> Result<Value, Unsupported> {
        value.serialize(self)
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        _: &T,
    ) -> Result<Value, Unsupported> {
        Err(Unsupported("a variant with a value".into()))
    }

    fn serialize_seq(self, _: Option<usize>) -> Result<List, Unsupported> {
        Ok(List(Vec::new()))
    }

    fn serialize_tuple(self, _: usize) -> Result<Self::SerializeTuple, Unsupported> {
        Err(Unsupported("a tuple".into()))
    }

    fn serialize_tuple_struct(
        self,
        _: &'static str,
        _: usize,
    ) -> Result<Self::SerializeTupleStruct, Unsupported> {
        Err(Unsupported("a tuple".into()))
    }

    fn serialize_tuple_variant(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        _: usize,
    ) -> Result<Self::SerializeTupleVariant, Unsupported> {
        Err(Unsupported("a variant with values".into()))
    }

    fn serialize_map(self, _: Option<usize>) -> Result<Fields, Unsupported> {
        Ok(Fields::default())
    }

    fn serialize_struct(self, _: &'static str, _: usize) -> Result<Fields, Unsupported> {
        Ok(Fields::default())
    }

    fn serialize_struct_variant(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        _: usize,
    ) -> Result<Self::SerializeStructVariant, Unsupported> {
        Err(Unsupported("a variant with fields".into()))
    }
}

struct List(Vec<Value>);

impl SerializeSeq for List {
    type Ok = Value;
    type Error = Unsupported;

    fn serialize_element<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Unsupported> {
        self.0.push(value.serialize(ToValue)?);
        Ok(())
    }

    fn end(self) -> Result<Value, Unsupported> {
        Ok(Value::List(self.0))
    }
}

#[derive(Default)]
struct Fields {
    fields: Vec<(String, Value)>,
    /// The key of a map whose value comes next.
    key: String,
}

impl SerializeMap for Fields {
    type Ok = Value;
    type Error = Unsupported;

    fn serialize_key<T: Serialize + ?Sized>(&mut self, key: &T) -> Result<(), Unsupported> {
        let Value::Text(key) = key.serialize(ToValue)? else {
            return Err(Unsupported("a key that is not a text".into()));
        };
        self.key = key;
        Ok(())
    }

    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Unsupported> {
        self.fields.push((core::mem::take(&mut self.key), value.serialize(ToValue)?));
        Ok(())
    }

    fn end(self) -> Result<Value, Unsupported> {
        Ok(Value::Record(Record(self.fields)))
    }
}

impl SerializeStruct for Fields {
    type Ok = Value;
    type Error = Unsupported;

    fn serialize_field<T: Serialize + ?Sized>(
        &mut self,
        name: &'static str,
        value: &T,
    ) -> Result<(), Unsupported> {
        self.fields.push((name.into(), value.serialize(ToValue)?));
        Ok(())
    }

    fn end(self) -> Result<Value, Unsupported> {
        Ok(Value::Record(Record(self.fields)))
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    #[derive(Serialize)]
    #[serde(rename_all = "snake_case")]
    enum Level {
        MinorFault,
    }

    #[derive(Serialize)]
    struct Row {
        name: &'static str,
        level: Level,
        number: u8,
        is_logged: bool,
        code: Option<u16>,
        values: BTreeMap<&'static str, u64>,
        causes: Vec<String>,
    }

    #[test]
    fn fields_keep_their_order_names_and_values() {
        let row = Row {
            name: "a",
            level: Level::MinorFault,
            number: 3,
            is_logged: true,
            code: None,
            values: BTreeMap::from([("x", 1)]),
            causes: vec!["b".into()],
        };
        let text = |text: &str| Value::Text(text.into());
        let expected = [
            ("name", text("a")),
            ("level", text("minor_fault")),
            ("number", Value::Number(3)),
            ("is_logged", Value::Flag(true)),
            ("code", Value::Nothing),
            ("values", Value::Record(Record(vec![("x".into(), Value::Number(1))]))),
            ("causes", Value::List(vec![text("b")])),
        ];
        let record = Record::of(&row);
        assert_eq!(record, Record(expected.map(|(name, value)| (name.to_owned(), value)).into()));
        assert_eq!(Record::of(&record), record, "a record serializes as its row");
    }

    #[test]
    #[should_panic(expected = "a row has fields")]
    fn a_single_value_is_no_row() {
        let _ = Record::of(&1u8);
    }
}
