//! Whether the times of a unit are simulated.

/// `timing`: whether a unit uses the times of its model and of the file, or no times.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Timing {
    /// `exact`.
    #[default]
    Exact,
    /// `fast`: nothing waits, whatever is in the file.
    Fast,
}

/// The words of the key.
pub(crate) const WORDS: [(&str, Timing); 2] = [("exact", Timing::Exact), ("fast", Timing::Fast)];
