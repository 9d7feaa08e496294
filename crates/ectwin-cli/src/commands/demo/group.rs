//! The slaves that the master of the demo combines into a group.

use ethercrab::subdevice_group::SubDeviceGroup;

pub(super) const MAX_UNITS: usize = 2;
pub(super) const MAX_PROCESS_DATA_BYTES: usize = 512;

pub(super) type Group<S> = SubDeviceGroup<MAX_UNITS, MAX_PROCESS_DATA_BYTES, ethercrab::DefaultLock, S>;
