//! Which abort code a unit returns if the standard has several for one reason.

use wire::SdoAbort;

/// The abort codes that differ between units.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AbortProfile {
    /// A download is longer than the entry or object.
    pub length_too_high: SdoAbort,
    /// A download is shorter than the entry, or ends within an entry.
    pub length_too_low: SdoAbort,
    /// Complete access to an object that does not support it.
    pub complete_access_unsupported: SdoAbort,
    /// Complete access that begins at a subindex above 1.
    pub complete_access_subindex: SdoAbort,
    /// An upload of a write-only entry.
    pub write_only: SdoAbort,
}

impl AbortProfile {
    /// The most specific code for each reason (CiA 301 and ETG.1000.6).
    pub const CIA_301: Self = Self {
        length_too_high: SdoAbort::LENGTH_TOO_HIGH,
        length_too_low: SdoAbort::LENGTH_TOO_LOW,
        complete_access_unsupported: SdoAbort::COMPLETE_ACCESS_UNSUPPORTED,
        complete_access_subindex: SdoAbort::UNSUPPORTED_ACCESS,
        write_only: SdoAbort::WRITE_ONLY,
    };

    /// One code for every wrong length and one for every unsupported access, for units whose manual lists no others.
    pub const COARSE: Self = Self {
        length_too_high: SdoAbort::LENGTH_MISMATCH,
        length_too_low: SdoAbort::LENGTH_MISMATCH,
        complete_access_unsupported: SdoAbort::UNSUPPORTED_ACCESS,
        complete_access_subindex: SdoAbort::UNSUPPORTED_ACCESS,
        write_only: SdoAbort::UNSUPPORTED_ACCESS,
    };
}

impl Default for AbortProfile {
    fn default() -> Self {
        Self::CIA_301
    }
}
