//! Real media and the real clock: raw, UDP, TAP and in-memory links.
