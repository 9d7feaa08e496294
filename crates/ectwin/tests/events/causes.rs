//! Causes that are not injected: actions of a master, a CPU Unit and a user; and the manual's statements on the
//! channels that concern more than a single event.

use ectwin::{EventCode, EventLevel, Indicators, Pattern};

use crate::stage::{INIT, INPUTS_BYTES, OP, OUTPUTS_BYTES, PRE_OP, SAFE_OP, Stage};

/// The history by the upper four digits of the event codes, the oldest first.
fn text_ids(stage: &mut Stage) -> Vec<u16> {
    stage.history().iter().map(|record| u16::from_le_bytes([record[6], record[7]])).collect()
}

fn indicators(stage: &mut Stage) -> Indicators {
    stage.unit().indicators()
}

#[test]
fn a_master_that_spoils_the_sii_has_a_unit_that_stays_in_init() {
    let mut stage = Stage::power_on("");
    // Word 7 of the EEPROM, the checksum: address, then write with write enable.
    stage.write(0x0502, &[0x01, 0x02, 7, 0, 0, 0, 0xAA, 0]);
    stage.set_mailboxes();
    assert_eq!(stage.request(PRE_OP), (PRE_OP, 0), "what was loaded at power-on counts");
    stage.unit().cycle_power();
    stage.run_for_ms(2);
    assert_eq!(stage.al(), (INIT, 0));
    stage.set_mailboxes();
    assert_eq!(stage.request(PRE_OP), (INIT | 0x10, 0x0014));
    assert_eq!(stage.request(PRE_OP | 0x10), (INIT | 0x10, 0x0014));
    assert_eq!(text_ids(&mut stage), [0x0946], "recorded once, however often the master asks");
    assert_eq!(indicators(&mut stage).err, Pattern::Blinking);
}

#[test]
fn a_cpu_unit_that_stops_io_refreshing_is_an_io_communications_error() {
    let mut stage = Stage::power_on("");
    stage.enter_pre_op();
    stage.enter_op();
    stage.unit().cpu().set_io_refreshing(false);
    let inputs = stage.exchange(&[1; 180]);
    assert_eq!(inputs[0] & 0x06, 0, "no data is valid");
    assert_eq!((text_ids(&mut stage), stage.al()), (vec![0x8020], (OP, 0)));
    assert_eq!(indicators(&mut stage).ts_red, Pattern::Flashing1s);
    stage.unit().reset_errors();
    assert_eq!(text_ids(&mut stage), [0x8020, 0x8020], "the cause is still there");

    stage.unit().cpu().set_io_refreshing(true);
    let inputs = stage.exchange(&[2; 180]);
    assert_eq!(inputs[0] & 0x06, 0, "until the error is reset");
    assert_eq!(stage.download(0x2002, 2, &[1]), Ok(()));
    let inputs = stage.exchange(&[3; 180]);
    assert_eq!((inputs[0] & 0x06, stage.unit().outputs()), (0x06, &[3; 180][..]));
    assert_eq!(indicators(&mut stage).ts_green, Pattern::Lit);
}

#[test]
fn everything_that_is_wrong_is_recorded_and_the_first_is_shown() {
    let mut stage = Stage::power_on("io_allocation.m_to_c.uints = 4\nio_allocation.c_to_m.uints = 6");
    stage.enter_pre_op();
    stage.assign(0x1C13, &[0x1A01, 0x1BFE]);
    stage.set_sync_manager(2, 0x13A0, OUTPUTS_BYTES + 1, 0x26);
    stage.set_sync_manager(3, 0x21B0, INPUTS_BYTES, 0x20);
    stage.write(0x0981, &[1]);
    assert_eq!(stage.request(SAFE_OP), (PRE_OP | 0x10, 0x0024));
    // Mapping, SyncManagers 2 and 3, DC, 3-buffer mode, watchdog, sizes.
    assert_eq!(text_ids(&mut stage), [0x3509, 0x3505, 0x3506, 0x3518, 0x3933, 0x3507, 0x3917]);
    assert_eq!(stage.upload(0x2004, 0), [7]);
}

#[test]
fn the_level_of_a_mismatch_can_be_observation_from_the_next_start_on() {
    let code = EventCode(0x3917_0000);
    let four = "io_allocation.m_to_c.uints = 4\nio_allocation.c_to_m.uints = 6";
    let mut stage = Stage::power_on(four);
    let mut side = stage.unit();
    assert!(side.set_event_level(EventCode(0x3919_0000), EventLevel::Observation).is_err());
    assert!(side.set_event_level(code, EventLevel::Information).is_err());
    side.set_event_level(code, EventLevel::Observation).expect("changeable");
    stage.enter_pre_op();
    stage.enter_op();
    assert_eq!(stage.upload(0x2002, 1), [0x20], "not before the start");
    assert_eq!(stage.take_emergencies().len(), 1);
    stage.unit().restart();
    stage.run_for_ms(2);
    stage.enter_pre_op();
    stage.enter_op();
    compare_observation(&mut stage);
    assert_eq!(stage.history().last().map(|record| record[4]), Some(0x11));

    let mut stage = Stage::power_on(&format!("event_levels.39170000 = \"observation\"\n{four}"));
    stage.enter_pre_op();
    stage.enter_op();
    compare_observation(&mut stage);
}

fn compare_observation(stage: &mut Stage) {
    assert_eq!(stage.upload(0x2002, 1), [0x10]);
    assert_eq!((stage.upload(0x2003, 0), stage.upload(0x2004, 0)), (vec![1], vec![0]));
    assert_eq!(stage.upload(0x2003, 1)[..4], 0x3917_0000_u32.to_le_bytes());
    assert_eq!(stage.take_emergencies().len(), 1, "an emergency tells it whatever its level");
}

#[test]
fn the_history_outlives_the_power_and_the_current_errors_do_not() {
    let mut stage = Stage::power_on("");
    stage.enter_pre_op();
    stage.request(OP);
    let before = (stage.upload(0x10F3, 6), stage.upload(0x10F3, 2), stage.upload(0x2004, 0));
    assert_eq!((&before.1[..], &before.2[..], stage.upload(0x10F3, 5)), (&[6][..], &[1][..], vec![1, 0]));
    stage.unit().cycle_power();
    stage.run_for_ms(2);
    stage.set_mailboxes();
    assert_eq!(stage.request(PRE_OP), (PRE_OP, 0));
    let after = (stage.upload(0x10F3, 6), stage.upload(0x10F3, 2), stage.upload(0x2004, 0));
    assert_eq!(after, (before.0, vec![6], vec![0]));
    assert_eq!((stage.upload(0x10F3, 4), stage.upload(0x10F3, 5)), (vec![1], vec![0, 0]), "still new; off");
}

#[test]
fn the_master_acknowledges_and_clears_by_the_rules_of_the_manual() {
    let mut stage = Stage::power_on("");
    stage.enter_pre_op();
    assert_eq!(stage.download(0x10F3, 3, &[6]), Err(0x0609_0030), "there is no record");
    for _ in 0..2 {
        stage.request(OP);
        stage.request(PRE_OP | 0x10);
    }
    let flags = |stage: &mut Stage| [1, 2, 3, 4].map(|sub| stage.upload(0x10F3, sub)[0]);
    assert_eq!(flags(&mut stage), [2, 7, 7, 1]);
    for refused in [1, 5, 8, 0x25, 0x26, 0xFF] {
        assert_eq!(stage.download(0x10F3, 3, &[refused]), Err(0x0609_0030), "{refused}");
    }
    assert_eq!(stage.download(0x10F3, 3, &[6]), Ok(()));
    assert_eq!(flags(&mut stage), [2, 7, 7, 1], "an older record");
    assert_eq!(stage.download(0x10F3, 3, &[7]), Ok(()));
    assert_eq!(flags(&mut stage), [2, 7, 7, 0]);
    assert_eq!(stage.download(0x2100, 0, &[0x65, 0x6C, 0x63, 0x6D]), Err(0x0609_0030));
    assert_eq!(stage.download(0x2100, 0, b"elcl"), Ok(()));
    assert_eq!((flags(&mut stage), stage.upload(0x10F3, 6)), ([0, 0, 0, 0], vec![0; 24]));
    assert_eq!(stage.upload(0x2004, 0), [1], "the current error stays");
    stage.request(OP);
    assert_eq!(flags(&mut stage), [1, 6, 6, 1]);
    assert_eq!(stage.download(0x10F3, 3, &[0]), Ok(()));
    assert_eq!(flags(&mut stage), [0, 0, 0, 0]);
    assert_eq!(stage.download(0x2002, 2, &[0]), Err(0x0609_0030));
    assert_eq!((stage.download(0x2002, 2, &[1]), stage.upload(0x2004, 0)), (Ok(()), vec![0]));
    assert!(stage.unit().error_log().access.is_empty(), "the master's clearing is no user's");
}
