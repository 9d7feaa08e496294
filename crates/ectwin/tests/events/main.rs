//! Every event of the manual: caused, reported on every channel in its row of the event table, and recovered
//! from as in the row.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

mod cases;
mod causes;
mod combinations;
mod expectations;
mod hostile;
mod recovery;
mod stage;

use std::collections::BTreeSet;

use ectwin::wire::Emergency;
use ectwin::{EventCode, EventLevel, Pattern};
use nx_ect101::{EcatEffect, Event, Notified};

use cases::{CASES, Case, When, state_before};
use expectations::Expected;
use stage::{INIT, OP, PRE_OP, SAFE_OP, Stage};

fn event(case: &Case) -> &'static Event {
    let code = u32::from_str_radix(case.code, 16).expect("eight digits");
    Event::find(EventCode(code)).expect("an event of the table")
}

/// Brings a unit to the state for the cause, and causes the event. Emergencies are enabled if possible.
fn caused(case: &Case) -> Stage {
    let mut stage = Stage::power_on(case.unit_file);
    match case.when {
        When::UnitFile | When::Start | When::Init => {}
        When::PreOp => stage.enter_pre_op(),
        When::Op => {
            stage.enter_pre_op();
            stage.enter_op();
        }
    }
    (case.cause)(&mut stage);
    stage
}

#[test]
fn every_event_has_a_case_and_a_page() {
    let table: BTreeSet<String> = Event::all().iter().map(|event| event.code.to_string()).collect();
    let cases: BTreeSet<String> = CASES.iter().map(|case| case.code.to_owned()).collect();
    assert_eq!((cases.len(), &cases), (CASES.len(), &table));
    for code in table {
        let page = format!("{}/../../docs/events/{code}.md", env!("CARGO_MANIFEST_DIR"));
        assert!(std::path::Path::new(&page).exists(), "no page {page}");
    }
}

#[test]
fn each_event_takes_ethercat_where_its_row_says() {
    for case in CASES {
        let (event, mut stage) = (event(case), caused(case));
        let code = event.al_status_code.map_or(0, |code| code.0);
        let error = if code == 0 { 0 } else { 0x10 };
        let state = match event.ecat_effect {
            EcatEffect::StopInit | EcatEffect::Restart => INIT,
            EcatEffect::StopPreop => PRE_OP,
            EcatEffect::EnterSafeop => SAFE_OP,
            EcatEffect::RetainState | EcatEffect::NotAffected => state_before(case.when),
        };
        assert_eq!(stage.al(), (state | error, code), "{} {}", case.code, event.name);
        // If the state is not stopped, the unit continues to OP; the master can correct 39340000, but not the others.
        if event.ecat_effect == EcatEffect::StopInit && case.code != "39340000" {
            stage.set_mailboxes();
            for state in [PRE_OP, PRE_OP | 0x10, SAFE_OP | 0x10, OP | 0x10] {
                assert_eq!(
                    stage.request(state),
                    (INIT | error, code),
                    "{}: asked for {state:02X}",
                    case.code
                );
            }
        }
        if matches!(case.when, When::UnitFile | When::Start) && event.ecat_effect == EcatEffect::NotAffected {
            stage.enter_pre_op();
            stage.enter_op();
            assert_eq!(stage.al(), (OP, 0), "{}: goes to OP", case.code);
        }
    }
}

#[test]
fn each_event_is_recorded_once_with_the_bytes_of_its_row() {
    for case in CASES {
        let (expected, mut stage) = (Expected::of(case, event(case)), caused(case));
        if case.when == When::UnitFile {
            // Sizes are compared on the way to SAFE-OP.
            stage.enter_pre_op();
            stage.enter_op();
        }
        let history = stage.history();
        let records: Vec<_> = history.iter().map(|record| (&record[..8], &record[16..])).collect();
        let wanted: Vec<_> =
            expected.diagnosis_message.iter().map(|record| (&record[..8], &record[16..])).collect();
        assert_eq!(records, wanted, "{}", case.code);
        for record in &history {
            let time_ns = u64::from_le_bytes(record[8..16].try_into().expect("8 bytes"));
            let now_ns = stage.access.now().as_nanos();
            let times = stage::SYSTEM_TIME_NS..=stage::SYSTEM_TIME_NS + now_ns;
            assert!(times.contains(&time_ns), "{}: {time_ns}", case.code);
        }
        let access: Vec<EventCode> =
            stage.unit().error_log().access.iter().map(|record| record.event).collect();
        assert_eq!(access, expected.access_log, "{}", case.code);
    }
}

#[test]
fn each_event_is_a_current_error_where_its_row_says() {
    for case in CASES {
        let (expected, mut stage) = (Expected::of(case, event(case)), caused(case));
        if case.when == When::UnitFile {
            stage.enter_pre_op();
            stage.enter_op();
        }
        let side = stage.unit();
        assert_eq!(side.error_status(), expected.error_status, "{}", case.code);
        let listed = [EventLevel::Observation, EventLevel::MinorFault].map(|level| {
            side.current_errors(level).iter().map(nx_ect101::current_error_bytes).collect::<Vec<_>>()
        });
        assert_eq!(listed, expected.current_errors, "{}", case.code);
        assert_eq!(side.io().unit_error(), expected.unit_error, "{}", case.code);
        assert_eq!(side.io().io_data_active(), expected.io_data_active, "{}", case.code);
        if stage.has_mailbox() {
            expected.compare_by_sdo(&mut stage, case.code);
        }
    }
}

#[test]
fn the_master_sees_each_event_in_its_process_data() {
    for case in CASES {
        let (expected, mut stage) = (Expected::of(case, event(case)), caused(case));
        if case.when == When::UnitFile || case.code == "10410000" {
            stage.enter_pre_op();
            stage.enter_op();
        }
        if stage.al().0 & 0x0C == 0 {
            continue;
        }
        let is_op = stage.al().0 == OP;
        // After a watchdog error the outputs are closed until the master acknowledges.
        let inputs = if is_op { stage.exchange(&[0x5A; 180]) } else { stage.inputs() };
        assert_eq!(inputs[182], u8::from(expected.diagnosis_message.is_some()), "{}: 1BFE", case.code);
        assert_eq!(inputs[183], expected.error_status, "{}: 1BFF", case.code);
        let valid = expected.io_data_active;
        assert_eq!(inputs[0] & 0x02 != 0, valid, "{}: C to M valid", case.code);
        assert_eq!(inputs[0] & 0x04 != 0, valid && is_op, "{}: M to C valid", case.code);
        let moved = stage.unit().outputs().first() == Some(&0x5A);
        assert_eq!(moved, valid && is_op, "{}: data M to C", case.code);
    }
}

#[test]
fn the_indicators_show_each_event_as_its_row_says() {
    for case in CASES {
        let (event, mut stage) = (event(case), caused(case));
        if case.when == When::UnitFile {
            stage.enter_pre_op();
            stage.enter_op();
        }
        let state = stage.al().0 & 0x0F;
        let shown = stage.unit().indicators();
        // The rows of 10410000 and 80200000 have RUN not lit, which means INIT: they do not affect EtherCAT (A21).
        let run = match state {
            OP => Pattern::Lit,
            SAFE_OP => Pattern::SingleFlash,
            PRE_OP => Pattern::Blinking,
            _ => Pattern::NotLit,
        };
        assert_eq!(shown.run, run, "{}: RUN", case.code);
        let columns = [
            ("RUN", shown.run, event.run),
            ("ERR", shown.err, event.err),
            ("TS green", shown.ts_green, event.ts_green),
            ("TS red", shown.ts_red, event.ts_red),
        ];
        let contradicted = ["10410000", "80200000"].contains(&case.code);
        for (name, shown, column) in columns {
            let open = contradicted && name == "RUN" && state != INIT;
            if let Some(pattern) = column.pattern().filter(|_| !open) {
                assert_eq!(shown, pattern, "{}: {name}", case.code);
            }
        }
        assert_eq!((shown.la_in, shown.la_out), (Pattern::Flickering, Pattern::NotLit), "{}", case.code);
    }
}

#[test]
fn emergencies_are_sent_where_the_row_says_and_only_if_they_are_enabled() {
    for case in CASES {
        let event = event(case);
        let mut stage = caused(case);
        if case.when == When::UnitFile || case.code == "10410000" {
            stage.enter_pre_op();
            stage.enter_op();
        }
        if !stage.has_mailbox() {
            assert_eq!(stage.emergencies, [], "{}", case.code);
            continue;
        }
        // Events from before emergencies could be enabled occur again at a reset while their cause persists.
        let mut emergencies = stage.take_emergencies();
        if emergencies.is_empty() {
            stage.download(0x2002, 2, &[1]).expect("a reset");
            emergencies = stage.take_emergencies();
        }
        let wanted = match (event.emergency_notified, event.emergency_code) {
            (Notified::Possible, Some(code)) => {
                let [e0, e1, e2, e3] = event.code.0.to_le_bytes();
                vec![Emergency { code, error_register: 0, manufacturer: [0, e0, e1, e2, e3] }]
            }
            _ => vec![],
        };
        assert_eq!(emergencies, wanted, "{}", case.code);
        stage.download(0x10F3, 5, &[0, 0]).expect("10F3:05");
        stage.download(0x2002, 2, &[1]).expect("a reset");
        assert_eq!(stage.take_emergencies(), [], "{}: off", case.code);
    }
}
