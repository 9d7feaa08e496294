//! Typed values that have sentences.

use core::fmt;

use super::sentence::{Misfit, NoSentence, Sentence, row_of, say, try_read};
use super::tables::{CONDITIONS, CPU, LINE, MASTER, UNIT};
use crate::model::{Condition, CpuOrder, LineOrder, MasterOrder, UnitOrder};

/// A typed value that is read from a sentence and printed as one.
pub trait Spoken: Clone + fmt::Debug + 'static {
    /// Its sentences.
    const SENTENCES: &'static [Sentence<Self>];

    /// Reads a sentence.
    ///
    /// # Errors
    /// It is not one of [`Self::SENTENCES`].
    fn from_sentence(text: &str) -> Result<Self, NoSentence> {
        try_read(Self::SENTENCES, text).map_err(|misfit| mistake(text, &misfit))
    }

    /// The sentence of the value.
    fn sentence(&self) -> String {
        say(Self::SENTENCES, self).unwrap_or_else(|| format!("{self:?}"))
    }
}

/// The mistake in a text that is not a sentence of its key: another key has it, or the nearest sentence of its own.
pub(crate) fn mistake<T>(text: &str, misfit: &Misfit<'_, T>) -> NoSentence {
    match keys_of(text) {
        Some(keys) if !misfit.is_inside() => NoSentence {
            message: format!("`{text}` is a sentence of another key"),
            help: format!("this sentence belongs to {keys}"),
        },
        Some(_) | None => misfit.words(),
    }
}

/// The keys that have this sentence.
fn keys_of(text: &str) -> Option<&'static str> {
    let keys = [
        (row_of(MASTER, text).is_some(), "`master`"),
        (row_of(UNIT, text).is_some(), "`unit`"),
        (row_of(CPU, text).is_some(), "`cpu`"),
        (row_of(LINE, text).is_some(), "`line`"),
        (row_of(CONDITIONS, text).is_some(), "`expect`, `never`, `when`, `until` or `while`"),
    ];
    keys.into_iter().find(|(has_it, _)| *has_it).map(|(_, keys)| keys)
}

/// A source of a typed value: the value itself, or its sentence.
pub trait Say<T> {
    /// The value.
    ///
    /// # Errors
    /// The text is not a sentence.
    fn value(self) -> Result<T, NoSentence>;

    /// The text; none of a typed value.
    fn text(&self) -> Option<&str> {
        None
    }
}

impl<T: Spoken> Say<T> for &str {
    fn value(self) -> Result<T, NoSentence> {
        T::from_sentence(self)
    }

    fn text(&self) -> Option<&str> {
        Some(self)
    }
}

impl<T: Spoken> Say<T> for &String {
    fn value(self) -> Result<T, NoSentence> {
        T::from_sentence(self)
    }

    fn text(&self) -> Option<&str> {
        Some(self)
    }
}

impl<T: Spoken> Say<T> for String {
    fn value(self) -> Result<T, NoSentence> {
        T::from_sentence(&self)
    }

    fn text(&self) -> Option<&str> {
        Some(self)
    }
}

macro_rules! spoken {
    ($($type:ty: $table:ident;)*) => {$(
        impl Spoken for $type {
            const SENTENCES: &'static [Sentence<Self>] = $table;
        }

        impl Say<Self> for $type {
            fn value(self) -> Result<Self, NoSentence> {
                Ok(self)
            }
        }
    )*};
}

spoken! {
    MasterOrder: MASTER;
    UnitOrder: UNIT;
    CpuOrder: CPU;
    LineOrder: LINE;
    Condition: CONDITIONS;
}

/// Types of this crate are displayed as their sentences.
macro_rules! displayed {
    ($($type:ty)*) => {$(
        impl fmt::Display for $type {
            fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                formatter.write_str(&self.sentence())
            }
        }
    )*};
}

displayed! { MasterOrder UnitOrder CpuOrder Condition }
