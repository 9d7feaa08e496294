//! The contents of a unit's addresses, and whether they are the same in two runs of the same master.

use nx_ect101::layout;

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

const fn mailbox(start: u16, name: &'static str) -> Area {
    compared(start, start + layout::MAILBOX_BYTES - 1, name)
}

/// In the order of their addresses, except for the mailboxes, which are in the process memory.
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
    mailbox(layout::MAILBOX_RECEIVE_START, "mailbox to the unit"),
    mailbox(layout::MAILBOX_SEND_START, "mailbox to the master"),
    compared(0x1000, 0xFFFF, "process memory"),
];

/// The name of the area at this address.
pub(super) fn name(address: u16) -> &'static str {
    let area = AREAS.iter().find(|area| (area.first..=area.last).contains(&address));
    area.map_or("other registers", |area| area.name)
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
