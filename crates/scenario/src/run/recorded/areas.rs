//! The contents of a unit's addresses, and whether they are the same in two runs of the same master.

use esi::{DeviceDescription, MailboxArea};

/// Some addresses of a unit.
pub(super) struct Area {
    first: u16,
    last: u16,
    pub(super) name: &'static str,
    is_compared: bool,
}

const fn compared(first: u16, last: u16, name: &'static str) -> Area {
    Area { first, last, name, is_compared: true }
}

/// The value depends on the time of the read.
const fn passed_over(first: u16, last: u16, name: &'static str) -> Area {
    Area { first, last, name, is_compared: false }
}

/// In the order of their addresses.
const AREAS: &[Area] = &[
    compared(0x0000, 0x000F, "ESC information"),
    compared(0x0010, 0x0013, "station address and alias"),
    compared(0x0100, 0x0103, "DL control"),
    compared(0x0110, 0x0111, "DL status"),
    compared(0x0120, 0x0121, "AL control"),
    passed_over(0x0130, 0x0135, "AL status"),
    compared(0x0200, 0x020F, "event masks"),
    passed_over(0x0210, 0x0223, "events"),
    passed_over(0x0300, 0x0313, "error counters"),
    compared(0x0400, 0x043F, "watchdog times"),
    passed_over(0x0440, 0x0443, "watchdog status"),
    compared(0x0500, 0x050F, "SII"),
    compared(0x0600, 0x06FF, "FMMUs"),
    passed_over(0x0800, 0x087F, "SyncManagers"),
    passed_over(0x0900, 0x09FF, "distributed clocks"),
    compared(0x1000, 0xFFFF, "process memory"),
];

/// The positions of the mailboxes in the process memory of the units.
#[derive(Clone, Debug, Default)]
pub(super) struct Mailboxes(Vec<(MailboxArea, &'static str)>);

impl Mailboxes {
    pub(super) fn of<'a>(devices: impl Iterator<Item = &'a DeviceDescription>) -> Self {
        let mailboxes = devices.filter_map(|device| device.mailbox.as_ref());
        let areas = mailboxes.flat_map(|mailbox| {
            [(mailbox.receive, "mailbox to the unit"), (mailbox.send, "mailbox to the master")]
        });
        let mut distinct = Vec::new();
        for area in areas {
            if !distinct.contains(&area) {
                distinct.push(area);
            }
        }
        Self(distinct)
    }

    /// The name of the area at this address.
    pub(super) fn name(&self, address: u16) -> &'static str {
        let offset = |area: &MailboxArea| address.checked_sub(area.start);
        let is_in = |area: &MailboxArea| offset(area).is_some_and(|offset| offset < area.length_bytes);
        let mailbox = self.0.iter().find(|(area, _)| is_in(area)).map(|(_, name)| *name);
        let area = AREAS.iter().find(|area| (area.first..=area.last).contains(&address));
        mailbox.or(area.map(|area| area.name)).unwrap_or("other registers")
    }
}

/// Whether none of these addresses depends on the time of the read.
pub(super) fn are_compared(first: u16, length_bytes: u16) -> bool {
    let last = first.saturating_add(length_bytes.saturating_sub(1));
    AREAS.iter().all(|area| area.is_compared || first > area.last || area.first > last)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_address_has_one_name_and_a_look_over_several_areas_counts_as_its_most_changeable() {
        let file =
            plant::UnitFile::parse("model = \"nx-ect101\"").unwrap_or_else(|errors| panic!("{errors}"));
        let description = file.section().description();
        let mailboxes = Mailboxes::of([&description, &description].into_iter());
        let name = |address| mailboxes.name(address);
        assert_eq!(
            (name(0x1000), name(0x118F), name(0x1190)),
            ("mailbox to the unit", "mailbox to the unit", "process memory")
        );
        assert_eq!(name(0x0130), "AL status");
        assert_eq!(name(0x1200), "mailbox to the master");
        assert_eq!(name(0x13A0), "process memory");
        assert_eq!(name(0x0180), "other registers");
        for (first, length_bytes, expected) in [
            (0x0120, 2, true),
            (0x0120, 0x11, false),
            (0x0135, 1, false),
            (0x0136, 2, true),
            (0xFFFF, 9, true),
        ] {
            assert_eq!(are_compared(first, length_bytes), expected, "{first:#06X}");
        }
    }
}
