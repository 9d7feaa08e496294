//! Whether a unit takes its times, or none.

/// `timing`: whether a unit takes the times of its model and of the file, or none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Timing {
    /// `exact`.
    #[default]
    Exact,
    /// `fast`: nothing waits, whatever the file says.
    Fast,
}

/// The words of the key.
pub(crate) const WORDS: [(&str, Timing); 2] = [("exact", Timing::Exact), ("fast", Timing::Fast)];
