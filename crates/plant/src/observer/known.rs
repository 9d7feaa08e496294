//! What is known of one unit.

use coe_kit::indicators::Pattern;
use device::Device;
use esc::{Esc, Port};
use mailbox::MailboxNote;
use time::Instant;
use unit_model::ModelUnit;
use wire::{AlState, AlStatus, AlStatusCode};

use super::mapping;
use crate::happening::HappeningKind;

/// A unit as it was at the last look.
#[derive(Debug, Default)]
pub(super) struct Known {
    status: AlStatus,
    code: AlStatusCode,
    is_off: bool,
    /// Links of port IN and port OUT.
    links: [bool; 2],
    injected_faults: u32,
    emergencies_lost: u64,
    /// The pattern of each indicator, in the order of the unit's model.
    pub(super) patterns: Vec<Pattern>,
}

impl Known {
    /// Reports the differences in a fixed order: power, links, faults, events, state, and what the mailbox has done. An SDO
    /// comes after the events that it has caused.
    #[inline]
    pub(super) fn compare(
        &mut self,
        now: Instant,
        device: &mut Device<Box<dyn ModelUnit>>,
        esc: &Esc,
        mut report: impl FnMut(HappeningKind),
    ) {
        if device.is_off() != self.is_off {
            self.is_off = !self.is_off;
            report(HappeningKind::Power { on: !self.is_off });
        }
        let links = [Port::In, Port::Out].map(|port| esc.port(port).link);
        if links != self.links {
            self.compare_links(links, &mut report);
        }
        let injected = device.unit().injected_faults();
        if injected != self.injected_faults {
            self.compare_faults(injected, &mut report);
        }
        while let Some(event) = device.unit_mut().take_event() {
            report(HappeningKind::Event(event));
        }
        let (status, code) = (device.al_status(), device.al_status_code());
        if (status, code) != (self.status, self.code) {
            let before = core::mem::replace(&mut self.status, status);
            self.code = code;
            report(HappeningKind::State { before, status, code });
            if (before.state, status.state) == (AlState::PreOp, AlState::SafeOp) {
                mapping::of(esc, now).for_each(|mapping| report(HappeningKind::Mapping(mapping)));
            }
        }
        while let Some(note) = device.take_mailbox_note() {
            report(kind_of(note));
        }
        let lost = device.emergencies_lost();
        if lost != self.emergencies_lost {
            let count = lost.saturating_sub(self.emergencies_lost);
            self.emergencies_lost = lost;
            report(HappeningKind::EmergenciesLost { count });
        }
    }

    #[cold]
    fn compare_links(&mut self, links: [bool; 2], report: &mut impl FnMut(HappeningKind)) {
        let before = core::mem::replace(&mut self.links, links);
        for (port, (before, present)) in [Port::In, Port::Out].into_iter().zip(before.into_iter().zip(links))
        {
            if before != present {
                report(HappeningKind::Link { port, present });
            }
        }
    }

    #[cold]
    fn compare_faults(&mut self, injected: u32, report: &mut impl FnMut(HappeningKind)) {
        let changed = injected ^ core::mem::replace(&mut self.injected_faults, injected);
        for place in (0..u32::BITS as u8).filter(|place| changed >> place & 1 == 1) {
            report(HappeningKind::Fault { place, injected: injected >> place & 1 == 1 });
        }
    }
}

const fn kind_of(note: MailboxNote) -> HappeningKind {
    match note {
        MailboxNote::Received(message) => HappeningKind::MessageReceived(message),
        MailboxNote::Sent(message) => HappeningKind::MessageSent(message),
        MailboxNote::Emergency(emergency) => HappeningKind::Emergency(emergency),
        MailboxNote::Sdo(sdo) => HappeningKind::Sdo(sdo),
    }
}
