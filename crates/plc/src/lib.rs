//! The CPU Unit: its task, its modes, its user programs on the NX bus.
