//! The moments at which a frame passes an ESC.

use time::Instant;

/// When a frame passed this ESC.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Passage {
    /// Came in at port 0.
    pub arrival: Instant,
    /// Came back at port 1, or passed it inside where its loop is closed.
    pub returned_out: Instant,
}
