//! Several causes at once, intermittent causes, and the state after each kind of start.

use ectwin::{EventCode, EventLevel, Fault};
use nx_ect101::layout;
use wire::{Command, FrameBuilder};

use crate::stage::{INIT, OP, OUTPUTS_BYTES, PRE_OP, SAFE_OP, Stage};

/// The history by the upper four digits of the event codes, the oldest first.
fn text_ids(stage: &mut Stage) -> Vec<u16> {
    stage.history().iter().map(|record| u16::from_le_bytes([record[6], record[7]])).collect()
}

fn minor_faults(stage: &mut Stage) -> Vec<EventCode> {
    stage.unit().current_errors(EventLevel::MinorFault).iter().map(|error| error.event).collect()
}

fn reset_esc(stage: &mut Stage) {
    b"RES".iter().for_each(|byte| stage.write(0x0040, &[*byte]));
    stage.run_for_ms(2);
}

/// Writes words of the EEPROM.
fn write_sii(stage: &mut Stage, words: &[(u16, u16)]) {
    for (at, word) in words {
        let ([a0, a1], [w0, w1]) = (at.to_le_bytes(), word.to_le_bytes());
        stage.write(0x0502, &[0x01, 0x02, a0, a1, 0, 0, w0, w1]);
    }
}

#[test]
fn a_device_id_that_equals_the_code_of_a_fault_does_not_hide_it() {
    let mut stage = Stage::power_on("id_switch = 0x01");
    assert_eq!(stage.request(INIT | 0x20), (INIT | 0x20, 0x0001), "the ID");
    stage.unit().inject(Fault::Processing);
    stage.run_for_ms(2);
    assert_eq!(stage.al(), (INIT | 0x10, 0x0001), "NX Unit Processing Error");
}

#[test]
fn an_esc_error_does_not_hide_the_code_of_another_fault() {
    let mut stage = Stage::power_on("");
    stage.unit().inject(Fault::Esc);
    stage.unit().inject(Fault::Processing);
    stage.unit().cycle_power();
    stage.run_for_ms(2);
    assert_eq!(stage.al(), (INIT | 0x10, 0x0001));
    stage.unit().remove(Fault::Processing);
    stage.unit().cycle_power();
    stage.run_for_ms(2);
    assert_eq!(stage.al(), (INIT, 0), "it has no code of its own");
}

#[test]
fn no_status_is_older_than_the_response_to_what_changed_it() {
    let mut stage = Stage::power_on("");
    stage.enter_pre_op();
    stage.enter_op();
    let keep_alive = |stage: &mut Stage| stage.write(layout::OUTPUTS_START, &[0; OUTPUTS_BYTES as usize]);
    for (index, sub, value) in [(0x10F3, 3, &[6][..]), (0x10F3, 3, &[0]), (0x2100, 0, b"elcl")] {
        stage.unit().inject(Fault::MessageCommunications);
        assert_eq!(stage.exchange(&[0; 180])[182], 1, "1BFE is set");
        keep_alive(&mut stage);
        stage.download(index, sub, value).expect("taken");
        assert_eq!(stage.inputs()[182], 0, "1BFE with the response to {index:04X}:{sub:02X}");
        stage.download(0x2100, 0, b"elcl").expect("taken");
    }
    assert_eq!(stage.exchange(&[0; 180])[183], 0x10, "1BFF is set");
    keep_alive(&mut stage);
    stage.download(0x2002, 2, &[1]).expect("taken");
    assert_eq!(stage.inputs()[183], 0, "1BFF with the response to 2002:02");
}

#[test]
fn sync_managers_2_and_3_that_go_together_are_both_recorded() {
    let mut stage = Stage::power_on("");
    stage.enter_pre_op();
    stage.enter_op();
    let frame = FrameBuilder::new().physical(Command::Apwr, 0, 0x0816, &[0]);
    let mut frame = frame.physical(Command::Apwr, 0, 0x081E, &[0]).finish();
    stage.access.pass(&mut frame);
    assert_eq!(stage.al(), (PRE_OP | 0x10, 0x001D), "the first one");
    assert_eq!(text_ids(&mut stage), [0x3505, 0x3506]);
}

#[test]
fn sii_and_mailbox_that_are_both_wrong_are_both_recorded() {
    let mut stage = Stage::power_on("");
    stage.unit().inject(Fault::SiiVerification);
    assert_eq!(stage.request(PRE_OP), (INIT | 0x10, 0x0014), "no SyncManagers either");
    assert_eq!(text_ids(&mut stage), [0x0946, 0x3934]);
    assert_eq!(stage.request(PRE_OP | 0x10), (INIT | 0x10, 0x0014));
    assert_eq!(text_ids(&mut stage), [0x0946, 0x3934], "once");
}

/// Vendor, product and revision: SII words 8 to 0x0D.
#[test]
fn the_sii_of_another_product_is_an_sii_verification_error() {
    for word in 8..0x0E {
        let mut stage = Stage::power_on("");
        write_sii(&mut stage, &[(word, 0x5678)]);
        stage.set_mailboxes();
        assert_eq!(stage.request(PRE_OP), (PRE_OP, 0), "what was loaded at power-on counts");
        stage.unit().cycle_power();
        stage.run_for_ms(2);
        stage.set_mailboxes();
        assert_eq!(stage.request(PRE_OP), (INIT | 0x10, 0x0014), "word {word:#04X}");
        assert_eq!(text_ids(&mut stage), [0x0946]);
    }
    let mut stage = Stage::power_on("");
    write_sii(&mut stage, &[(0x0E, 0x5678)]);
    stage.unit().cycle_power();
    stage.run_for_ms(2);
    stage.set_mailboxes();
    assert_eq!(stage.request(PRE_OP), (PRE_OP, 0), "the serial number may be any");
}

#[test]
fn two_restarts_in_a_row_are_two_records() {
    let mut stage = Stage::power_on("");
    let before_ns = stage.access.now().as_nanos() + crate::stage::SYSTEM_TIME_NS;
    stage.unit().restart();
    stage.unit().restart();
    stage.unit().cycle_power();
    let side = stage.unit();
    let access = &side.error_log().access;
    assert_eq!(access.iter().map(|record| record.event.to_string()).collect::<Vec<_>>(), ["94B80000"; 2]);
    let times = before_ns - 2_000_000..=before_ns;
    assert!(access.iter().all(|record| times.contains(&record.time_ns)), "{access:?}");
}

/// Manual, 8-6: errors persist until they are reset, the power is cycled or the unit is restarted.
#[test]
fn a_reset_of_the_esc_keeps_errors_faults_and_flags() {
    let mut stage = Stage::power_on("");
    stage.enter_pre_op();
    stage.request(OP);
    reset_esc(&mut stage);
    assert_eq!(stage.al(), (INIT, 0));
    assert_eq!(minor_faults(&mut stage), [EventCode(0x350B_0000)]);
    stage.set_mailboxes();
    assert_eq!(stage.request(PRE_OP), (PRE_OP, 0));
    assert_eq!((stage.upload(0x10F3, 5), stage.upload(0x2002, 1)), (vec![1, 0], vec![0x20]));
    assert_eq!(stage.history().len(), 1, "it is no event");

    stage.unit().inject(Fault::ClockNotSynchronized);
    stage.run_for_ms(2);
    stage.unit().remove(Fault::ClockNotSynchronized);
    reset_esc(&mut stage);
    assert_eq!(stage.al(), (INIT | 0x10, 0x8004), "the fault is still found");
    assert_eq!(stage.history().len(), 2);
    stage.unit().cycle_power();
    stage.run_for_ms(2);
    assert_eq!((stage.al(), minor_faults(&mut stage)), ((INIT, 0), vec![]));
}

#[test]
fn a_reset_without_the_cause_keeps_a_fault_and_does_not_record_it() {
    let mut stage = Stage::power_on("");
    stage.unit().inject(Fault::Processing);
    stage.run_for_ms(2);
    stage.unit().reset_errors();
    assert_eq!(text_ids(&mut stage), [0x4020, 0x4020], "its cause is there");
    stage.unit().remove(Fault::Processing);
    for _ in 0..3 {
        stage.unit().reset_errors();
        stage.run_for_ms(2);
    }
    assert_eq!(text_ids(&mut stage), [0x4020, 0x4020], "it does not occur again");
    assert_eq!(minor_faults(&mut stage), [EventCode(0x4020_0000)], "and lasts until the unit starts");
    assert_eq!((stage.al(), stage.unit().error_status()), ((INIT | 0x10, 0x0001), 0x20));
    stage.unit().cycle_power();
    stage.run_for_ms(2);
    assert_eq!((stage.al(), minor_faults(&mut stage)), ((INIT, 0), vec![]));
}

#[test]
fn io_communications_that_fail_again_are_recorded_again_without_a_reset() {
    let mut stage = Stage::power_on("");
    for _ in 0..3 {
        stage.unit().cpu().set_io_refreshing(false);
        stage.run_for_ms(5);
        stage.unit().cpu().set_io_refreshing(true);
        stage.run_for_ms(5);
    }
    stage.unit().inject(Fault::IoCommunications);
    stage.unit().inject(Fault::IoCommunications);
    assert_eq!(text_ids(&mut stage), [0x8020; 4]);
    assert_eq!(minor_faults(&mut stage), [EventCode(0x8020_0000)], "listed once");
}

#[test]
fn emergencies_that_are_lost_are_counted() {
    let six = "io_allocation.m_to_c = { uints = [\"6000:02\"], bytes = [\"6001:02\"], udint = [\"6002:02\"] }\n\
               io_allocation.c_to_m = { uints = [\"7000:02\"], bytes = [\"7001:02\"], udint = [\"7002:02\"] }";
    for resets_at_once in [1, 20] {
        let mut stage = Stage::power_on(six);
        stage.enter_pre_op();
        for _ in 0..20 / resets_at_once {
            (0..resets_at_once).for_each(|_| stage.unit().reset_errors());
            stage.run_for_ms(1);
        }
        let occurred = 20 * minor_faults(&mut stage).len() as u64;
        let received = stage.take_emergencies().len() as u64;
        let lost = stage.unit().emergencies_lost();
        assert_eq!((received + lost, lost > 0), (occurred, true), "{resets_at_once} at once");
    }
}

#[test]
fn op_without_process_data_ends_when_there_were_some() {
    let mut stage = Stage::power_on("");
    stage.enter_pre_op();
    assert_eq!(stage.request(SAFE_OP), (SAFE_OP, 0));
    stage.exchange(&[1; 180]);
    stage.run_for_ms(300);
    assert_eq!(stage.request(OP), (OP, 0), "the watchdog has expired in SAFE-OP");
    stage.run_for_ms(110);
    assert_eq!(stage.al(), (SAFE_OP | 0x10, 0x001B));
    assert_eq!(text_ids(&mut stage), [0x8500]);
    assert_eq!(stage.request(OP | 0x10), (SAFE_OP, 0), "an acknowledged fall-back waits for new ones");
    stage.exchange(&[2; 180]);
    stage.run_for_ms(90);
    assert_eq!(stage.al().0, OP);
    stage.run_for_ms(20);
    assert_eq!(stage.al(), (SAFE_OP | 0x10, 0x001B));
    assert_eq!(text_ids(&mut stage), [0x8500; 2]);
}

#[test]
fn op_without_any_process_data_is_refused_when_the_time_of_the_esi_is_over() {
    let mut stage = Stage::power_on("");
    stage.enter_pre_op();
    assert_eq!(stage.request(SAFE_OP), (SAFE_OP, 0));
    assert_eq!(stage.request(OP), (SAFE_OP, 0));
    stage.run_for_ms(8990);
    assert_eq!((stage.al(), stage.history().len()), ((SAFE_OP, 0), 0));
    stage.run_for_ms(10);
    assert_eq!(stage.al(), (SAFE_OP | 0x10, 0x001B));
    assert_eq!(text_ids(&mut stage), [0x8500]);
}

#[test]
fn op_may_come_before_the_first_process_data_and_waits_for_them() {
    let mut stage = Stage::power_on("outputs_before_op = \"not-required\"");
    stage.enter_pre_op();
    assert_eq!(stage.request(SAFE_OP), (SAFE_OP, 0));
    assert_eq!(stage.request(OP), (OP, 0));
    stage.run_for_ms(2000);
    assert_eq!((stage.al(), stage.history().len()), ((OP, 0), 0));
}

#[test]
fn a_watchdog_that_is_turned_off_and_on_watches_again() {
    let mut stage = Stage::power_on("");
    stage.enter_pre_op();
    stage.enter_op();
    stage.write(0x0420, &[0, 0]);
    stage.run_for_ms(500);
    assert_eq!(stage.al(), (OP, 0));
    stage.write(0x0420, &[0xE8, 0x03]);
    stage.run_for_ms(110);
    assert_eq!(stage.al(), (SAFE_OP | 0x10, 0x001B));
}
