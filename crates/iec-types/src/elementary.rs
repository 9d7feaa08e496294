//! The elementary types of IEC 61131-3 in the language, as one table.

use core::fmt;

/// An elementary type. IEC 61131-3, table 10. STRING is not an elementary type here: it has a length.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Elementary {
    /// One bit.
    Bool,
    /// Bit string of 8 bits.
    Byte,
    /// Bit string of 16 bits.
    Word,
    /// Bit string of 32 bits.
    Dword,
    /// Bit string of 64 bits.
    Lword,
    /// Signed integer of 8 bits.
    Sint,
    /// Signed integer of 16 bits.
    Int,
    /// Signed integer of 32 bits.
    Dint,
    /// Signed integer of 64 bits.
    Lint,
    /// Unsigned integer of 8 bits.
    Usint,
    /// Unsigned integer of 16 bits.
    Uint,
    /// Unsigned integer of 32 bits.
    Udint,
    /// Unsigned integer of 64 bits.
    Ulint,
    /// Floating point number of 32 bits.
    Real,
    /// Floating point number of 64 bits.
    Lreal,
    /// Duration, signed, 64 bits, in nanoseconds.
    Time,
    /// A day.
    Date,
    /// A time of day, to the nanosecond.
    TimeOfDay,
    /// A time on a day, to the nanosecond.
    DateAndTime,
}

/// The operations that a type permits: the generic types of IEC 61131-3, 6.4.3.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// BOOL.
    Bool,
    /// BYTE to LWORD.
    BitString,
    /// SINT to LINT.
    Signed,
    /// USINT to ULINT.
    Unsigned,
    /// REAL and LREAL.
    Real,
    /// TIME.
    Time,
    /// DATE, TIME_OF_DAY and DATE_AND_TIME.
    Date,
}

struct Row {
    elementary: Elementary,
    name: &'static str,
    /// Another name of the type; empty: none.
    alias: &'static str,
    class: Class,
    bits: u32,
}

const fn row(elementary: Elementary, name: &'static str, class: Class, bits: u32) -> Row {
    Row { elementary, name, alias: "", class, bits }
}

const fn row_with_alias(elementary: Elementary, name: &'static str, alias: &'static str) -> Row {
    Row { elementary, name, alias, class: Class::Date, bits: 64 }
}

/// In the order of the variants.
const ROWS: [Row; 19] = [
    row(Elementary::Bool, "BOOL", Class::Bool, 1),
    row(Elementary::Byte, "BYTE", Class::BitString, 8),
    row(Elementary::Word, "WORD", Class::BitString, 16),
    row(Elementary::Dword, "DWORD", Class::BitString, 32),
    row(Elementary::Lword, "LWORD", Class::BitString, 64),
    row(Elementary::Sint, "SINT", Class::Signed, 8),
    row(Elementary::Int, "INT", Class::Signed, 16),
    row(Elementary::Dint, "DINT", Class::Signed, 32),
    row(Elementary::Lint, "LINT", Class::Signed, 64),
    row(Elementary::Usint, "USINT", Class::Unsigned, 8),
    row(Elementary::Uint, "UINT", Class::Unsigned, 16),
    row(Elementary::Udint, "UDINT", Class::Unsigned, 32),
    row(Elementary::Ulint, "ULINT", Class::Unsigned, 64),
    row(Elementary::Real, "REAL", Class::Real, 32),
    row(Elementary::Lreal, "LREAL", Class::Real, 64),
    row(Elementary::Time, "TIME", Class::Time, 64),
    row(Elementary::Date, "DATE", Class::Date, 64),
    row_with_alias(Elementary::TimeOfDay, "TIME_OF_DAY", "TOD"),
    row_with_alias(Elementary::DateAndTime, "DATE_AND_TIME", "DT"),
];

impl Elementary {
    /// All of them.
    pub const ALL: [Self; 19] = {
        let mut all = [Self::Bool; 19];
        let mut place = 0;
        while place < all.len() {
            all[place] = ROWS[place].elementary;
            // The rows are in the order of the variants.
            assert!(all[place] as usize == place);
            place += 1;
        }
        all
    };

    /// Its name, in capitals.
    #[must_use]
    pub const fn name(self) -> &'static str {
        ROWS[self as usize].name
    }

    /// The type with this name, in upper or lower case.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let has_name = |elementary: &Self| {
            let row = &ROWS[*elementary as usize];
            row.name.eq_ignore_ascii_case(name) || (!name.is_empty() && row.alias.eq_ignore_ascii_case(name))
        };
        Self::ALL.into_iter().find(has_name)
    }

    /// The operations that it permits.
    #[must_use]
    pub const fn class(self) -> Class {
        ROWS[self as usize].class
    }

    /// Its number of bits: 1, 8, 16, 32 or 64.
    #[must_use]
    pub const fn bits(self) -> u32 {
        ROWS[self as usize].bits
    }

    /// Its number of bytes in a message; a BOOL takes one.
    #[must_use]
    pub const fn size_bytes(self) -> usize {
        self.bits().div_ceil(8) as usize
    }
}

impl fmt::Display for Elementary {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.pad(self.name())
    }
}
