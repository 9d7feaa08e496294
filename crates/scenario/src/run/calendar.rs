//! The date at which every scenario begins.

/// The system time of the CPU Units at the beginning: 2026-01-01 00:00:00 UTC.
pub(crate) const SYSTEM_TIME_NS: u64 = 1_767_225_600_000_000_000;
