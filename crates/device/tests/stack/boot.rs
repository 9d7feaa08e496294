//! BOOT, for slaves that support it (reference 5.2, 5.4).

use std::sync::Arc;

use crate::bench::{Bench, sii_image};
use device::{AbortProfile, Area, DeviceConfig, Exchange, MailboxAreas, MailboxConfig, Unit};
use objects::{Dictionary, ObjectServer, ObjectTable};
use time::{Duration, Instant};
use wire::AlState::{self, Boot, Init, Op, PreOp, SafeOp};

/// A unit with a mailbox and without process data.
struct Bootable(Dictionary);

impl Unit for Bootable {
    fn objects(&mut self) -> Option<&mut dyn ObjectServer> {
        Some(&mut self.0)
    }

    fn refresh_period(&self) -> Option<Duration> {
        None
    }

    fn refresh(&mut self, _now: Instant, _exchange: Exchange<'_>) {}
}

const fn areas(receive: u16, send: u16, length_bytes: u16) -> MailboxAreas {
    MailboxAreas { receive: Area { start: receive, length_bytes }, send: Area { start: send, length_bytes } }
}

const STANDARD: MailboxAreas = areas(0x1000, 0x1100, 128);
const BOOTSTRAP: MailboxAreas = areas(0x1400, 0x1800, 256);

fn bench(bootstrap: Option<MailboxAreas>) -> Bench<Bootable> {
    let mailbox = MailboxConfig {
        standard: STANDARD,
        bootstrap,
        response_time: Duration::ZERO,
        aborts: AbortProfile::CIA_301,
    };
    let config = DeviceConfig { sii_image: sii_image(), mailbox: Some(mailbox), ..DeviceConfig::default() };
    Bench::of([(config, Bootable(Dictionary::new(Arc::new(ObjectTable::new(vec![])))))])
}

fn set_mailbox(bench: &mut Bench<Bootable>, areas: MailboxAreas) {
    for (offset, area, control) in [(0x0800, areas.receive, 0x26), (0x0808, areas.send, 0x22)] {
        let [start, length] = [area.start, area.length_bytes].map(u16::to_le_bytes);
        bench.write(offset + 6, &[0]);
        bench.write(offset, &[start[0], start[1], length[0], length[1], control, 0, 1, 0]);
    }
}

fn in_state(bootstrap: Option<MailboxAreas>, state: AlState) -> Bench<Bootable> {
    let mut bench = bench(bootstrap);
    set_mailbox(&mut bench, if state == Boot { BOOTSTRAP } else { STANDARD });
    let way: &[AlState] = match state {
        Boot => &[Boot],
        PreOp => &[PreOp],
        SafeOp => &[PreOp, SafeOp],
        Op => &[PreOp, SafeOp, Op],
        Init | AlState::Other(_) => &[],
    };
    for step in way {
        bench.request(step.bits());
        assert_eq!(bench.status(), (step.bits(), 0));
    }
    bench
}

/// C041, C042, C061: all states times all requests, with BOOT and without.
///
/// Rows are states, columns are requests INIT, PRE-OP, BOOT, SAFE-OP, OP.
#[test]
fn the_whole_machine_with_boot() {
    let table = |bootstrap: Option<MailboxAreas>, states: &[AlState]| {
        let row = |&from: &AlState| {
            let cells = AlState::ALL.map(|request| {
                let mut bench = in_state(bootstrap, from);
                if (from, request) == (Init, Boot) {
                    set_mailbox(&mut bench, BOOTSTRAP);
                }
                bench.request(request.bits());
                let (status, code) = bench.status();
                format!("{status:02X}/{code:02X}")
            });
            format!("{from:<7} {}", cells.join(" "))
        };
        states.iter().map(row).collect::<Vec<_>>()
    };
    assert_eq!(
        table(Some(BOOTSTRAP), &[Init, PreOp, Boot, SafeOp, Op]),
        [
            "INIT    01/00 02/00 03/00 11/11 11/11",
            "PRE-OP  01/00 02/00 12/11 04/00 12/11",
            "BOOT    01/00 13/11 03/00 13/11 13/11",
            "SAFE-OP 01/00 02/00 14/11 04/00 08/00",
            "OP      01/00 02/00 14/11 04/00 08/00",
        ]
    );
    assert_eq!(
        table(None, &[Init, PreOp]),
        ["INIT    01/00 02/00 11/13 11/11 11/11", "PRE-OP  01/00 02/00 12/11 04/00 12/11"]
    );
}

/// C041: the mailbox of BOOT, not that of PRE-OP.
#[test]
fn the_mailbox_of_boot_is_checked_and_watched() {
    let mut bench = bench(Some(BOOTSTRAP));
    set_mailbox(&mut bench, STANDARD);
    bench.request(Boot.bits());
    assert_eq!(bench.status(), (0x11, 0x15));
    set_mailbox(&mut bench, BOOTSTRAP);
    bench.request(PreOp.bits() | 0x10);
    assert_eq!(bench.status(), (0x11, 0x16));
    bench.request(Boot.bits() | 0x10);
    assert_eq!(bench.status(), (0x03, 0));
    bench.write(0x080E, &[0]);
    assert_eq!(bench.status(), (0x11, 0x15));
}

/// BOOT has FoE only, which the mailbox does not support: it answers with an error.
#[test]
fn a_message_in_boot_is_answered() {
    let mut bench = in_state(Some(BOOTSTRAP), Boot);
    let mut message = vec![0; 256];
    message[..14].copy_from_slice(&[8, 0, 0, 0, 0, 0x13, 0x00, 0x20, 0x40, 0x18, 0x10, 1, 0, 0]);
    assert_eq!(bench.write(0x1400, &message), 1);
    let reply = bench.read(0x1800, 256);
    assert_eq!(reply[5] & 0x0F, 0, "an error reply");
    assert_eq!(reply[6..10], [0x01, 0x00, 0x02, 0x00], "unsupported protocol");
}
