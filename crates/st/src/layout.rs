//! Variables in the form of messages.

use crate::elementary::Elementary;

/// A variable referred to by a reference of the type ANY, in the form of a message: elementary values one after
/// the other.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Layout {
    /// Offset in slots, and type.
    pub(crate) values: Vec<(u32, Elementary)>,
}
