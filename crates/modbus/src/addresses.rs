//! Addresses of registers or bits in a request.

use crate::exception::Exception;

/// Addresses one after another, at least one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Addresses {
    pub(crate) first: u16,
    pub(crate) quantity: u16,
}

impl Addresses {
    pub(crate) const fn one(first: u16) -> Self {
        Self { first, quantity: 1 }
    }

    /// Within the quantities that a request may contain.
    pub(crate) fn checked(first: u16, quantity: u16, most: u16) -> Result<Self, Exception> {
        let is_possible = (1..=most).contains(&quantity);
        is_possible.then_some(Self { first, quantity }).ok_or(Exception::IllegalDataValue)
    }
}
