//! Where results are. The results themselves are not kept: there may be a million of them.

use crate::commands::replay::Verdict;

/// Where the result of a case is.
#[derive(Clone, Copy)]
pub(super) struct Place {
    /// The number of the file, from 1; 0: none so far.
    pub(super) file: u32,
    pub(super) verdict: Verdict,
    /// Where its line begins, in bytes.
    pub(super) start: u64,
}
