//! The project's fuzzers: inputs from a grammar, damaged real files, and the conditions that hold after each of them.
//!
//! An input is bytes, so that it can be stored in a file, shrunk and tried again: the entries of [`FUZZERS`]
//! make inputs from a seed and check them. The same seed gives the same inputs. `cargo xtask fuzz` runs them.

mod bytes;
mod capture;
mod examine;
mod frames;
mod fuzzer;
mod hex;
mod mailbox;
mod mistakes;
mod random;
mod real_files;
mod run;
mod scenario;
mod shrink;
mod sii;
mod st;
mod text;
mod unit_file;

pub use examine::{Examined, examine};
pub use fuzzer::{Checked, Fuzzer, Grain, Limits};
pub use random::Random;
pub use real_files::{Seeds, root};
pub use run::{Found, Plan, Report, Watch, run};

/// All fuzzers, in the order in which they are run.
pub const FUZZERS: &[Fuzzer] = &[
    frames::FUZZER,
    mailbox::FUZZER,
    unit_file::FUZZER,
    scenario::FUZZER,
    st::FUZZER,
    capture::FUZZER,
    sii::FUZZER,
];

/// The fuzzer of this name.
#[must_use]
pub fn find(name: &str) -> Option<&'static Fuzzer> {
    FUZZERS.iter().find(|fuzzer| fuzzer.name == name)
}
