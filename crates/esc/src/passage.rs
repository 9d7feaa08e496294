//! The times at which a frame passes an ESC.

use time::Instant;

/// When a frame passed this ESC.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Passage {
    /// It arrived at port 0.
    pub arrival: Instant,
    /// It returned to port 1, or passed it inside if its loop is closed.
    pub returned_out: Instant,
}
