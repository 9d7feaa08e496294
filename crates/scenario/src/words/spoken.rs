//! Typed values that have sentences.

use core::fmt;

use super::sentence::{NoSentence, Sentence, read, say};
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
        read(Self::SENTENCES, text)
    }

    /// The sentence of the value.
    fn sentence(&self) -> String {
        say(Self::SENTENCES, self).unwrap_or_else(|| format!("{self:?}"))
    }
}

/// A source of a typed value: the value itself, or its sentence.
pub trait Say<T> {
    /// The value.
    ///
    /// # Errors
    /// The text is not a sentence.
    fn value(self) -> Result<T, NoSentence>;
}

impl<T: Spoken> Say<T> for &str {
    fn value(self) -> Result<T, NoSentence> {
        T::from_sentence(self)
    }
}

impl<T: Spoken> Say<T> for &String {
    fn value(self) -> Result<T, NoSentence> {
        T::from_sentence(self)
    }
}

impl<T: Spoken> Say<T> for String {
    fn value(self) -> Result<T, NoSentence> {
        T::from_sentence(&self)
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

        impl fmt::Display for $type {
            fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                formatter.write_str(&self.sentence())
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
