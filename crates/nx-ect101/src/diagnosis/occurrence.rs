//! One event that occurs, with its attached information.

use arrayvec::ArrayVec;

use crate::events::EventCode;
use crate::fault::Fault;
use crate::finding::Finding;
use crate::memory::DETAILS_MAX;

/// System information of NX Unit Processing Error: it is internal to OMRON, and an emulated unit has none.
const NO_SYSTEM_INFORMATION: [u32; DETAILS_MAX] = [0; DETAILS_MAX];

/// An event that occurs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Occurrence {
    pub(crate) event: EventCode,
    /// Attached information 1 to 4.
    pub(crate) details: ArrayVec<u32, DETAILS_MAX>,
}

impl Occurrence {
    pub(crate) fn new<const N: usize>(event: EventCode, details: [u32; N]) -> Self {
        Self { event, details: details.into_iter().take(DETAILS_MAX).collect() }
    }

    /// An event without attached information.
    pub(crate) fn bare(event: EventCode) -> Self {
        Self::new(event, [])
    }

    pub(crate) fn of_fault(fault: Fault) -> Self {
        match fault {
            Fault::Processing => Self::new(fault.event(), NO_SYSTEM_INFORMATION),
            _ => Self::bare(fault.event()),
        }
    }

    /// The event of a violated setting rule, with the index of the mapping if the event has one.
    pub(crate) fn of_finding(finding: &Finding) -> Self {
        let tells_index = finding.event_row().is_some_and(|event| !event.attached_information.is_empty());
        let index = finding.data_set.filter(|_| tells_index).map(|index| u32::from(index.0));
        Self { event: finding.event, details: index.into_iter().collect() }
    }
}
