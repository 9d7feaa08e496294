//! Which ESCs wait for the end of the frame that is passing.

use crate::positions::Positions;

/// The ESCs at which something takes effect at the end of the frame.
#[derive(Clone, Debug)]
pub(crate) struct Waiting {
    /// Those that a datagram found by the index.
    pub(crate) some: Positions,
    /// There are such.
    pub(crate) found: bool,
    /// A datagram went through all ESCs, and some of them wait: each has to be asked.
    pub(crate) walked: bool,
}

impl Waiting {
    pub(crate) fn new(escs: usize) -> Self {
        Self { some: Positions::new(escs), found: false, walked: false }
    }
}
