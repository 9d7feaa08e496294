//! The attributes of events as text for display.

use crate::events::{DetectionTiming, EcatEffect, EventLog, IndicatorStatus, IoRefreshEffect, Recovery};

/// The recovery from an error of a unit after the cause is gone.
pub(super) const fn recovery(recovery: Recovery) -> &'static str {
    match recovery {
        Recovery::ResetErrorInSlaveUnit => "reset the error in the unit: 2002:02 = 1, or from the CPU Unit",
        Recovery::RedoIoAllocationSettings => "correct the I/O allocation settings and download them",
        Recovery::CycleUnitPowerOrRestartNxBus => "cycle the power of the unit, or restart the NX bus",
        Recovery::CycleSlaveUnitPower | Recovery::CycleUnitPower => "cycle the power of the unit",
        Recovery::CycleNxUnitPowerThenResetErrorInNxBusFm => {
            "cycle the power of the unit, then reset the error in the NX Bus Function Module"
        }
        Recovery::RestartNxUnitThenResetErrorByFailsoft => {
            "restart the unit, then reset the error: in the NX Bus Function Module if the fail-soft setting is Stop, \
             in the unit if it is Fail-soft"
        }
        Recovery::ResetErrorByFailsoft => {
            "reset the error: in the NX Bus Function Module if the fail-soft setting is Stop, in the unit if it is \
             Fail-soft"
        }
        Recovery::None => {
            "none needed; if the event is a current error, that ends with a reset of the errors or a start of the unit"
        }
    }
}

pub(super) const fn detected(timing: DetectionTiming) -> &'static str {
    match timing {
        DetectionTiming::NxUnitPowerOn => "when the unit starts",
        DetectionTiming::EcatCommunicationsEstablished => "when EtherCAT communications are established",
        DetectionTiming::InitToPreop => "INIT to PRE-OP",
        DetectionTiming::PreopToSafeop => "PRE-OP to SAFE-OP",
        DetectionTiming::EcatStateTransition => "when the master asks for a state",
        DetectionTiming::Continuous => "at any time",
        DetectionTiming::NxMessageCommunications => "during NX message communications",
        DetectionTiming::UserCommand => "when a user commands it",
        DetectionTiming::Unspecified => "at any time (the manual gives no time)",
    }
}

pub(super) const fn ecat(effect: EcatEffect) -> &'static str {
    match effect {
        EcatEffect::StopInit => {
            "INIT; the unit stays there or goes there, and refuses PRE-OP while the error lasts"
        }
        EcatEffect::StopPreop => {
            "PRE-OP; the unit stays there and refuses SAFE-OP as long as the cause lasts"
        }
        EcatEffect::RetainState => "not changed",
        EcatEffect::EnterSafeop => "SAFE-OP",
        EcatEffect::NotAffected => "not affected",
        EcatEffect::Restart => "INIT, after the restart",
    }
}

pub(super) const fn io_refresh(effect: IoRefreshEffect) -> &'static str {
    match effect {
        IoRefreshEffect::Continues | IoRefreshEffect::NotAffected => "continues",
        IoRefreshEffect::ContinuesPartialExchange => {
            "continues; only entries that both sides have are exchanged"
        }
        IoRefreshEffect::NotPerformed => "does not start",
        IoRefreshEffect::Stops => "stops",
        IoRefreshEffect::ResumesAfterRestart => "starts again after the restart",
    }
}

pub(super) const fn event_log(log: EventLog) -> &'static str {
    match log {
        EventLog::System => "system event log, 32 records",
        EventLog::Access => "access event log, 5 records",
        EventLog::None => "no log",
    }
}

/// The pattern of an indicator; nothing if the event does not change it.
pub(super) const fn indicator(status: IndicatorStatus) -> Option<&'static str> {
    match status {
        IndicatorStatus::Lit => Some("lit"),
        IndicatorStatus::NotLit => Some("not lit"),
        IndicatorStatus::Flashing1s => Some("flashing at intervals of 1 s"),
        IndicatorStatus::Flashing2s => Some("flashing at intervals of 2 s"),
        IndicatorStatus::Flickering => Some("flickering"),
        IndicatorStatus::Blinking => Some("blinking"),
        IndicatorStatus::SingleFlash => Some("single flash"),
        IndicatorStatus::DoubleFlash => Some("double flash"),
        IndicatorStatus::Undefined | IndicatorStatus::NotListed => None,
    }
}

/// The meaning of a piece of attached information.
pub(super) fn attached(meaning: &str) -> &str {
    match meaning {
        "io_entry_mapping_index_hex" => "index of the I/O entry mapping, hexadecimal",
        "pdo_mapping_object_index_hex" => "index of the PDO mapping object, hexadecimal",
        "system_information" => "system information of the manufacturer; 0 in ectwin",
        "communications_type" => "kind of communications",
        "cleared_log" => "which log was cleared",
        other => other,
    }
}
