//! An order or a condition in a file: a text is a sentence, a table is the typed value.

use core::fmt;
use core::marker::PhantomData;

use serde::de::value::MapAccessDeserializer;
use serde::de::{self, DeserializeOwned, IgnoredAny, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};

/// One of both.
pub(super) enum SaidEntry<T> {
    Sentence(String),
    Typed(T),
}

impl<'de, T: DeserializeOwned> Deserialize<'de> for SaidEntry<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(SaidVisitor(PhantomData))
    }
}

struct SaidVisitor<T>(PhantomData<T>);

impl<'de, T: DeserializeOwned> Visitor<'de> for SaidVisitor<T> {
    type Value = SaidEntry<T>;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a sentence, or a table with one key, its typed form")
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<Self::Value, E> {
        Ok(SaidEntry::Sentence(text.to_owned()))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let value = T::deserialize(MapAccessDeserializer::new(&mut map))?;
        match map.next_key::<IgnoredAny>()? {
            None => Ok(SaidEntry::Typed(value)),
            Some(_) => Err(de::Error::custom("the typed form of an order or a condition has one key")),
        }
    }
}
