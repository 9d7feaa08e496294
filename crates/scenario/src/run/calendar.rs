//! The date at which every scenario starts.

/// The system time of the CPU Units at the start: 2026-01-01 00:00:00 UTC.
pub(crate) const SYSTEM_TIME_NS: u64 = 1_767_225_600_000_000_000;
