//! AL status codes: the one that is in no standard, and what is particular about those of the standard.

use unit_model::tables::{AlStatusNote, VendorAlStatusCode};
use wire::AlStatusCode;

/// Manual, 8-5-2.
pub(super) const VENDOR_CODES: &[VendorAlStatusCode] = &[VendorAlStatusCode {
    code: AlStatusCode(0x8004),
    name: "CPU Unit error (NX-ECT101)",
    state: "INIT + error",
    cause: "The hardware of the unit or of the CPU Unit failed: NX Unit Clock Not Synchronized Error.",
    correction: "Switch the power off and on; the unit stays in INIT until then.",
}];

const fn note(code: AlStatusCode, cause: &'static str, correction: &'static str) -> AlStatusNote {
    AlStatusNote { code, cause, correction }
}

#[rustfmt::skip]
pub(super) const NOTES: &[AlStatusNote] = &[
    note(AlStatusCode::UNSPECIFIED, "; in the NX-ECT101 an NX Unit Processing Error", ""),
    note(AlStatusCode::NO_MEMORY, "; in the NX-ECT101 its non-volatile memory failed", ""),
    note(AlStatusCode::NO_VALID_FIRMWARE, "; in the NX-ECT101 the SII did not verify", ""),
    note(AlStatusCode::INVALID_MAILBOX_CONFIGURATION_PREOP, "", ": 400 bytes at 0x1000 and at 0x1200 for the NX-ECT101"),
    note(AlStatusCode::SYNC_MANAGER_WATCHDOG, ", 9 s in an NX-ECT101", ""),
    note(AlStatusCode::SYNCHRONIZATION_NOT_SUPPORTED, "; the NX-ECT101 has Free-Run only", ""),
    note(AlStatusCode::INVALID_DC_SYNC_CONFIGURATION, "; the NX-ECT101 has no DC mode", ""),
    note(AlStatusCode::SLAVE_RESTARTED_LOCALLY, "; in the NX-ECT101 by NX Unit Restart", ""),
];

/// The name of a code.
pub(super) fn name(code: AlStatusCode) -> &'static str {
    let of_vendor = VENDOR_CODES.iter().find(|row| row.code == code).map(|row| row.name);
    of_vendor.or_else(|| code.row().map(|row| row.meaning)).unwrap_or("vendor-specific")
}
