//! What a device says of itself in `Info`: sizes, time-outs, current, identification.

use super::element::Element;
use crate::Timeouts;

/// An element `Info`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct InfoElement {
    /// Size of the memory of the controller in bytes, with its registers.
    pub memory_bytes: Option<u32>,
    /// The number of SyncManagers of the controller.
    pub sync_manager_count: Option<u8>,
    /// The number of FMMUs of the controller.
    pub fmmu_count: Option<u8>,
    /// The current that it draws from the EBus in mA; negative feeds in.
    pub ebus_current_ma: Option<i16>,
    /// Time-outs of the master; the usual ones if they are left out.
    pub timeouts: Timeouts,
    /// The register with the identification value.
    pub identification_offset: Option<u16>,
    /// Whether the identification value is in the AL status code.
    pub identification_in_al_status: bool,
    /// Whether it goes to SAFE-OP without synchronization.
    pub safe_op_without_sync: bool,
}

impl InfoElement {
    pub(super) fn read(element: Element<'_>) -> Self {
        let controller = element.child("EtherCATController");
        let behavior = element.at(&["StateMachine", "Behavior"]);
        let in_status = element.value_of("IdentificationReg134").is_some_and(|value| value.flag());
        Self {
            memory_bytes: controller.and_then(|controller| controller.number_of("DpramSize")),
            sync_manager_count: controller.and_then(|controller| controller.number_of("SmCount")),
            fmmu_count: controller.and_then(|controller| controller.number_of("FmmuCount")),
            ebus_current_ma: element
                .child("Electrical")
                .and_then(|electrical| electrical.number_of("EBusCurrent")),
            timeouts: timeouts(element),
            identification_offset: element.number_of("IdentificationAdo"),
            identification_in_al_status: in_status,
            safe_op_without_sync: behavior.is_some_and(|behavior| behavior.flag("StartToSafeopNoSync")),
        }
    }
}

fn timeouts(info: Element<'_>) -> Timeouts {
    let states = info.at(&["StateMachine", "Timeout"]);
    let mailbox = info.at(&["Mailbox", "Timeout"]);
    let of = |timeouts: Option<Element<'_>>, name, usual| {
        timeouts.and_then(|all| all.number_of(name)).unwrap_or(usual)
    };
    let usual = Timeouts::USUAL;
    Timeouts {
        pre_op_ms: of(states, "PreopTimeout", usual.pre_op_ms),
        safe_op_op_ms: of(states, "SafeopOpTimeout", usual.safe_op_op_ms),
        back_to_init_ms: of(states, "BackToInitTimeout", usual.back_to_init_ms),
        back_to_safe_op_ms: of(states, "BackToSafeopTimeout", usual.back_to_safe_op_ms),
        mailbox_request_ms: of(mailbox, "RequestTimeout", usual.mailbox_request_ms),
        mailbox_response_ms: of(mailbox, "ResponseTimeout", usual.mailbox_response_ms),
    }
}
