//! The state machine of reference 5: every transition, every refusal, the error and its acknowledge.

use crate::bench::{Bench, config};
use device::{Condition, DeviceConfig, PROCESS_DATA, Requirement, TRANSITIONS, condition};
use proptest::prelude::*;
use time::Duration;
use wire::AlState::{self, Boot, Init, Op, PreOp, SafeOp};
use wire::AlStatusCode;

/// C038, C042, C043, C044, C048, C049, C051, C057, C058, C059, C060, C061, C062: all states times all requests.
///
/// Rows are states, columns are requests INIT, PRE-OP, BOOT, SAFE-OP, OP, 0x5; each cell is AL status and AL status
/// code.
#[test]
fn the_whole_machine_in_one_table() {
    let requests = [Init, PreOp, Boot, SafeOp, Op, AlState::Other(5)];
    let table: Vec<String> = [Init, PreOp, SafeOp, Op]
        .into_iter()
        .map(|from| {
            let cells = requests.map(|request| {
                let mut bench = Bench::in_state(from);
                if request == SafeOp {
                    bench.set_process_data();
                }
                bench.request(request.bits());
                let (status, code) = bench.status();
                format!("{status:02X}/{code:02X}")
            });
            format!("{from:<7} {}", cells.join(" "))
        })
        .collect();
    assert_eq!(
        table,
        [
            "INIT    01/00 02/00 11/13 11/11 11/11 11/12",
            "PRE-OP  01/00 02/00 12/11 04/00 12/11 12/12",
            "SAFE-OP 01/00 02/00 14/11 04/00 08/00 14/12",
            "OP      01/00 02/00 14/11 04/00 08/00 14/12",
        ]
    );
}

#[test]
fn the_letters_of_a_row_are_those_of_its_states() {
    let letter = |state| match state {
        Init => 'I',
        PreOp => 'P',
        SafeOp => 'S',
        Op => 'O',
        Boot => 'B',
        other => panic!("{other} has no letter here"),
    };
    for row in TRANSITIONS {
        let letters: String = [letter(row.from), letter(row.to)].iter().collect();
        assert_eq!(row.letters, letters);
    }
}

/// C050: SyncManagers 2 and 3 must match the mapping exactly.
#[test]
fn wrong_process_data_sync_managers_are_refused() {
    let wrong: [(u16, [u8; 8], u16); 6] = [
        (0x0810, [0x00, 0x10, 2, 0, 0x64, 0, 1, 0], 0x1D),
        (0x0810, [0x02, 0x10, 1, 0, 0x64, 0, 1, 0], 0x1D),
        (0x0810, [0x00, 0x10, 1, 0, 0x60, 0, 1, 0], 0x1D),
        (0x0810, [0x00, 0x10, 1, 0, 0x64, 0, 0, 0], 0x1D),
        (0x0818, [0x00, 0x11, 2, 0, 0x20, 0, 1, 0], 0x1E),
        (0x0810, [0x00, 0x10, 1, 0, 0x66, 0, 1, 0], 0x29),
    ];
    for (offset, record, code) in wrong {
        let mut bench = Bench::in_state(PreOp);
        bench.set_process_data();
        bench.write(offset + 6, &[0]);
        bench.write(offset, &record);
        bench.request(SafeOp.bits());
        assert_eq!(bench.status(), (0x12, code), "{record:02X?}");
    }
}

/// C120: a unit that runs freely does not support DC.
#[test]
fn dc_activation_is_refused() {
    let mut bench = Bench::in_state(PreOp);
    bench.set_process_data();
    bench.write(0x0981, &[3]);
    bench.request(SafeOp.bits());
    assert_eq!(bench.status(), (0x12, 0x30));
}

#[test]
fn a_watchdog_time_without_trigger_is_refused_where_the_unit_checks_it() {
    const TRIGGER: &[Condition] =
        &[condition(Requirement::WatchdogTrigger, AlStatusCode::INVALID_WATCHDOG_CONFIGURATION)];
    for (checks, time, expected) in [
        (TRIGGER, [0xE8, 0x03], (0x12, 0x1F)),
        (TRIGGER, [0, 0], (0x04, 0)),
        (PROCESS_DATA, [0xE8, 0x03], (0x04, 0)),
    ] {
        let mut bench = Bench::with(DeviceConfig { checks, ..config() });
        bench.bring_to(PreOp);
        bench.set_process_data();
        bench.write(0x0816, &[0]);
        bench.write(0x0810, &[0x00, 0x10, 1, 0, 0x24, 0, 1, 0]);
        bench.write(0x0420, &time);
        bench.request(SafeOp.bits());
        assert_eq!(bench.status(), expected);
    }
}

/// C045, C046, C047: an error remains until it is acknowledged; INIT needs no acknowledge.
#[test]
fn an_error_has_to_be_acknowledged() {
    let mut bench = Bench::in_state(PreOp);
    bench.request(Op.bits());
    assert_eq!(bench.status(), (0x12, 0x11));
    bench.request(PreOp.bits());
    assert_eq!(bench.status(), (0x12, 0x11), "without acknowledge nothing changes");
    bench.request(PreOp.bits() | 0x10);
    assert_eq!(bench.status(), (0x02, 0));
    bench.request(Op.bits());
    bench.request(Init.bits());
    assert_eq!(bench.status(), (0x01, 0));
}

#[test]
fn acknowledge_and_another_state_in_one_request() {
    let mut bench = Bench::in_state(SafeOp);
    bench.request(Boot.bits());
    bench.request(Op.bits() | 0x10);
    assert_eq!(bench.status(), (0x08, 0));
}

/// C066, C067: the outputs stop; the slave falls back and closes them until the master acknowledges.
#[test]
fn the_watchdog_takes_op_to_safe_op() {
    let mut bench = Bench::in_state(Op);
    assert_eq!(bench.cycle(1).1, 3);
    bench.run_for(Duration::from_micros(99_999));
    assert_eq!(bench.status(), (0x08, 0));
    bench.run_for(Duration::from_micros(2));
    assert_eq!(bench.status(), (0x14, 0x1B));
    assert_eq!(bench.cycle(1).1, 1, "the working counter shows it");
    bench.request(Op.bits() | 0x10);
    assert_eq!(bench.status(), (0x08, 0));
    assert_eq!(bench.cycle(1).1, 3);
}

/// C068: a watchdog time of 0 never expires.
#[test]
fn a_watchdog_that_is_off_never_expires() {
    let mut bench = Bench::in_state(Op);
    bench.write(0x0420, &[0, 0]);
    bench.cycle(1);
    bench.run_for(Duration::from_secs(10));
    assert_eq!(bench.status(), (0x08, 0));
}

/// C063: an unknown request in OP drops to SAFE-OP, and the working counter shows it.
#[test]
fn an_unknown_request_in_op_closes_the_outputs() {
    let mut bench = Bench::in_state(Op);
    bench.cycle(1);
    bench.request(5);
    assert_eq!(bench.status(), (0x14, 0x12));
    assert_eq!(bench.cycle(1).1, 1);
}

/// C053, C064: SyncManagers that become invalid take the slave to PRE-OP.
#[test]
fn a_sync_manager_that_is_taken_away_takes_the_slave_down() {
    for (state, offset, code) in [(SafeOp, 0x0816, 0x1D), (Op, 0x0816, 0x1D), (Op, 0x081E, 0x1E)] {
        let mut bench = Bench::in_state(state);
        bench.write(offset, &[0]);
        assert_eq!(bench.status(), (0x12, code));
    }
}

/// C073, C074: the Explicit Device ID by AL control bit 5, and not over an error.
#[test]
fn the_explicit_device_id_is_told_and_taken_back() {
    let mut bench = Bench::in_state(PreOp);
    bench.request(0x22);
    assert_eq!(bench.status(), (0x22, 5));
    bench.request(0x02);
    assert_eq!(bench.status(), (0x02, 0));
    bench.request(0x28);
    assert_eq!(bench.status(), (0x12, 0x11));
    bench.request(0x22);
    assert_eq!(bench.status(), (0x12, 0x11));
}

#[test]
fn res_restarts_the_slave() {
    let mut bench = Bench::in_state(Op);
    b"RES".iter().for_each(|byte| {
        bench.write(0x0040, &[*byte]);
    });
    assert_eq!(bench.status(), (0x01, 0));
    assert_eq!(bench.word(0x0810), 0);
    bench.bring_to(Op);
}

/// An EEPROM that cannot be loaded keeps the slave in INIT.
#[test]
fn without_sii_there_is_no_pre_op() {
    let mut bench = Bench::with(DeviceConfig { sii_image: vec![0xFF; 128], ..config() });
    bench.request(PreOp.bits());
    assert_eq!(bench.status(), (0x11, 0x51));
}

/// C069: an expired watchdog is shown until outputs are received again, also while the fall-back keeps them closed.
#[test]
fn an_expired_watchdog_shows_in_its_status() {
    let mut bench = Bench::in_state(Op);
    bench.cycle(1);
    bench.run_for(Duration::from_millis(101));
    assert_eq!((bench.word(0x0440), bench.word(0x0442) & 0xFF), (0, 1));
}

/// Expiry is checked first, so that a late write cannot mask the time-out, even if there was no poll in between.
#[test]
fn late_outputs_do_not_hide_an_expiry() {
    let mut bench = Bench::in_state(Op);
    bench.cycle(1);
    bench.now += Duration::from_secs(5);
    bench.cycle(2);
    assert_eq!(bench.status(), (0x14, 0x1B));
}

/// C064: the buffer mode is monitored too.
#[test]
fn a_sync_manager_that_becomes_a_mailbox_takes_the_slave_down() {
    let mut bench = Bench::in_state(Op);
    bench.write(0x0810, &[0x00, 0x10, 1, 0, 0x66, 0, 0, 0]);
    bench.write(0x0816, &[1]);
    assert_eq!(bench.status(), (0x12, 0x1D));
}

/// Two requests in one frame: the last one counts.
#[test]
fn the_last_al_control_of_a_frame_wins() {
    let mut bench = Bench::new();
    let mut frame = wire::FrameBuilder::new()
        .physical(wire::Command::Bwr, 0, 0x0120, &[1, 0])
        .physical(wire::Command::Bwr, 0, 0x0120, &[2, 0])
        .finish();
    bench.network.frame(bench.now, &mut frame);
    bench.network.poll(bench.now);
    assert_eq!(bench.status(), (0x02, 0));
}

proptest! {
    /// C071: for any sequence of requests, AL status is a state of the standard, an error has a code, and
    /// without an error there is none.
    #[test]
    fn any_requests_leave_a_state_of_the_standard(requests in prop::collection::vec(any::<u8>(), 1..60)) {
        let mut bench = Bench::new();
        bench.set_process_data();
        for request in requests {
            bench.request(u16::from(request & !0x20));
            bench.cycle(1);
            let (status, code) = bench.status();
            prop_assert!(matches!(status & 0x0F, 1 | 2 | 4 | 8), "{status:02X}");
            prop_assert_eq!(status & 0x10 != 0, code != 0);
        }
    }
}
