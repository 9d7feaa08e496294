//! AL status codes of a model, beyond the standard.

use wire::AlStatusCode;

/// An AL status code that is in no standard.
#[derive(Clone, Copy, Debug)]
pub struct VendorAlStatusCode {
    /// The code.
    pub code: AlStatusCode,
    /// Its name in the documents of the maker.
    pub name: &'static str,
    /// The states in which it is shown.
    pub state: &'static str,
    /// The likely cause, a sentence.
    pub cause: &'static str,
    /// The correction, a sentence.
    pub correction: &'static str,
}

/// What is particular about a code of the standard in a model: the ends of two sentences, each with the mark that joins it
/// to the words before.
#[derive(Clone, Copy, Debug)]
pub struct AlStatusNote {
    /// The code.
    pub code: AlStatusCode,
    /// End of the sentence with the cause; empty if there is nothing to add.
    pub cause: &'static str,
    /// End of the sentence with the correction; empty if there is nothing to add.
    pub correction: &'static str,
}
