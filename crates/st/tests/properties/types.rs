//! The elementary types and their implicit conversions: table 10 and figure 12 of IEC 61131-3, and between
//! signed and unsigned integers the implicit casts of W501, 6-5-3.

/// The operations that a type permits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Bool,
    Bits,
    Signed,
    Unsigned,
    Real,
    Time,
}

/// A type, by its row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Type {
    pub(crate) name: &'static str,
    pub(crate) kind: Kind,
    pub(crate) bits: u32,
}

const fn row(name: &'static str, kind: Kind, bits: u32) -> Type {
    Type { name, kind, bits }
}

pub(crate) const BOOL: Type = row("BOOL", Kind::Bool, 1);
pub(crate) const INT: Type = row("INT", Kind::Signed, 16);
pub(crate) const REAL: Type = row("REAL", Kind::Real, 32);
pub(crate) const LREAL: Type = row("LREAL", Kind::Real, 64);
pub(crate) const LINT: Type = row("LINT", Kind::Signed, 64);
pub(crate) const TIME: Type = row("TIME", Kind::Time, 64);

pub(crate) const ALL: [Type; 16] = [
    BOOL,
    row("BYTE", Kind::Bits, 8),
    row("WORD", Kind::Bits, 16),
    row("DWORD", Kind::Bits, 32),
    row("LWORD", Kind::Bits, 64),
    row("SINT", Kind::Signed, 8),
    INT,
    row("DINT", Kind::Signed, 32),
    LINT,
    row("USINT", Kind::Unsigned, 8),
    row("UINT", Kind::Unsigned, 16),
    row("UDINT", Kind::Unsigned, 32),
    row("ULINT", Kind::Unsigned, 64),
    REAL,
    LREAL,
    TIME,
];

/// Implicit conversions, step by step: those of figure 12, and between integers of one width.
const STEPS: [(&str, &str); 26] = [
    ("BOOL", "BYTE"),
    ("BYTE", "WORD"),
    ("WORD", "DWORD"),
    ("DWORD", "LWORD"),
    ("SINT", "INT"),
    ("INT", "DINT"),
    ("DINT", "LINT"),
    ("USINT", "UINT"),
    ("UINT", "UDINT"),
    ("UDINT", "ULINT"),
    ("USINT", "INT"),
    ("UINT", "DINT"),
    ("UDINT", "LINT"),
    ("SINT", "USINT"),
    ("INT", "UINT"),
    ("DINT", "UDINT"),
    ("LINT", "ULINT"),
    ("USINT", "SINT"),
    ("UINT", "INT"),
    ("UDINT", "DINT"),
    ("ULINT", "LINT"),
    ("INT", "REAL"),
    ("UINT", "REAL"),
    ("DINT", "LREAL"),
    ("UDINT", "LREAL"),
    ("REAL", "LREAL"),
];

/// Whether a value of one type is converted to the other implicitly: whether there is a path of steps.
pub(crate) fn widens(from: Type, to: Type) -> bool {
    let mut reached = vec![from.name];
    loop {
        let is_new = |step: &&(&str, &str)| reached.contains(&step.0) && !reached.contains(&step.1);
        match STEPS.iter().find(is_new) {
            Some((_, next)) => reached.push(next),
            None => return reached.contains(&to.name),
        }
    }
}

/// The common type of two operands. For two integers it is the one of the higher rank, and within one rank the
/// unsigned one; for others the one that can hold both, else the narrowest real that can.
pub(crate) fn meet(left: Type, right: Type) -> Option<Type> {
    if left.is_integer() && right.is_integer() {
        return [left, right].into_iter().max_by_key(|type_| (type_.bits, type_.kind == Kind::Unsigned));
    }
    let both = |candidate: &Type| widens(left, *candidate) && widens(right, *candidate);
    [left, right].into_iter().find(both).or_else(|| [REAL, LREAL].into_iter().find(both))
}

pub(crate) fn named(name: &str) -> Type {
    ALL.into_iter().find(|row| row.name == name).expect("a type of the table")
}

impl Type {
    pub(crate) fn is_integer(self) -> bool {
        matches!(self.kind, Kind::Signed | Kind::Unsigned)
    }

    pub(crate) fn is_number(self) -> bool {
        self.is_integer() || self.kind == Kind::Real
    }

    /// Minimum and maximum value, for all types except the reals.
    pub(crate) fn limits(self) -> (i128, i128) {
        match self.kind {
            Kind::Signed | Kind::Time => (-(1_i128 << (self.bits - 1)), (1_i128 << (self.bits - 1)) - 1),
            _ => (0, (1_i128 << self.bits) - 1),
        }
    }

    /// A number modulo 2^bits, within the limits.
    pub(crate) fn wrapped(self, number: i128) -> i128 {
        let (least, _) = self.limits();
        number.wrapping_sub(least).rem_euclid(1_i128 << self.bits) + least
    }
}
