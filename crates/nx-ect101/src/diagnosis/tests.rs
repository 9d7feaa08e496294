//! The corner cases of the manual, by name (8-3-2, 8-4, 8-6, A-6-4, A-6-7).

use super::*;
use crate::fault::Fault;

/// Minor faults of the setting rules, each with the index of a mapping as attached information 1.
const ORDER: EventCode = EventCode(0x3914_0000);
/// A minor fault whose level can be changed, and which emergencies report.
const MISMATCH: EventCode = EventCode(0x3917_0000);
/// A minor fault without attached information.
const WATCHDOG: EventCode = EventCode(0x8500_0000);

fn order_of(mapping: u32) -> Occurrence {
    Occurrence::new(ORDER, [mapping])
}

/// A unit that has started, with this event set to observation by its user.
fn with_observation(code: EventCode) -> Diagnosis {
    let mut levels = EventLevels::default();
    levels.set(code, EventLevel::Observation).expect("changeable");
    let mut diagnosis = Diagnosis::default();
    diagnosis.start(levels, NewestAcknowledged::NewestRecord);
    diagnosis
}

/// A unit with this number of minor faults, all different.
fn with_minor_faults(count: u32) -> Diagnosis {
    let mut diagnosis = with_observation(MISMATCH);
    (0..count).for_each(|mapping| diagnosis.raise(order_of(mapping)));
    diagnosis
}

/// Attached information 1 of the minor faults, in their order.
fn minor_faults(diagnosis: &Diagnosis) -> Vec<u32> {
    diagnosis.current(EventLevel::MinorFault).iter().filter_map(|error| error.detail).collect()
}

fn observations(diagnosis: &Diagnosis) -> Vec<EventCode> {
    diagnosis.current(EventLevel::Observation).iter().map(|error| error.event).collect()
}

fn newest_message(diagnosis: &Diagnosis) -> [u8; DIAGNOSIS_MESSAGE_BYTES] {
    diagnosis.log().record_at(diagnosis.log().system.newest).expect("a record").diagnosis_message()
}

#[test]
fn the_33rd_record_goes_to_subindex_06() {
    let mut diagnosis = with_minor_faults(32);
    assert_eq!(diagnosis.log().system.newest, 0x25);
    diagnosis.raise(order_of(32));
    let log = diagnosis.log();
    assert_eq!((log.system.newest, log.system.len()), (0x06, 32));
    let detail = |sub| log.record_at(sub).map(|record| record.details[0]);
    assert_eq!((detail(0x06), detail(0x07), detail(0x25)), (Some(32), Some(1), Some(31)));
    let in_order: Vec<u32> = log.history().map(|record| record.details[0]).collect();
    assert_eq!(in_order, (1..=32).collect::<Vec<_>>());
}

#[test]
fn the_11th_minor_fault_is_in_the_history_alone() {
    let diagnosis = with_minor_faults(11);
    assert_eq!(minor_faults(&diagnosis), (0..10).collect::<Vec<_>>());
    assert_eq!((diagnosis.log().system.len(), diagnosis.error_status()), (11, 0x20));
}

#[test]
fn a_minor_fault_takes_the_place_of_the_newest_observation() {
    let mut diagnosis = with_observation(MISMATCH);
    diagnosis.inject(Fault::MessageCommunications);
    diagnosis.raise(Occurrence::bare(MISMATCH));
    (0..8).for_each(|mapping| diagnosis.raise(order_of(mapping)));
    let discarded = Event::MESSAGE_COMMUNICATIONS_ERROR;
    assert_eq!(observations(&diagnosis), [discarded, MISMATCH]);
    diagnosis.raise(order_of(8));
    assert_eq!(observations(&diagnosis), [discarded]);
    diagnosis.raise(order_of(9));
    assert_eq!((observations(&diagnosis), minor_faults(&diagnosis).len()), (vec![], 10));
    assert_eq!(diagnosis.error_status(), 0x30, "the observations that found no room are told too");
}

#[test]
fn an_observation_takes_the_place_of_nothing() {
    let mut diagnosis = with_minor_faults(10);
    diagnosis.raise(Occurrence::bare(MISMATCH));
    assert_eq!((observations(&diagnosis), minor_faults(&diagnosis).len()), (vec![], 10));
    assert_eq!((diagnosis.error_status(), diagnosis.log().system.len()), (0x30, 11));
    let mut mixed = with_minor_faults(9);
    mixed.raise(Occurrence::bare(MISMATCH));
    mixed.inject(Fault::MessageCommunications);
    assert_eq!(observations(&mixed), [MISMATCH], "the older one stays");
}

#[test]
fn an_error_that_exists_is_recorded_again_and_listed_once() {
    let mut diagnosis = with_minor_faults(1);
    diagnosis.raise(order_of(0));
    diagnosis.raise(order_of(7));
    assert_eq!((minor_faults(&diagnosis), diagnosis.log().system.len()), (vec![0, 7], 3));
}

#[test]
fn acknowledging_an_older_record_leaves_new_messages_available() {
    let mut diagnosis = with_minor_faults(3);
    assert_eq!(diagnosis.acknowledge(0x07), Ok(()));
    assert!(diagnosis.has_new_messages());
    assert_eq!(diagnosis.acknowledge(0x08), Ok(()));
    assert!(!diagnosis.has_new_messages());
    diagnosis.raise(order_of(3));
    assert!(diagnosis.has_new_messages());
}

#[test]
fn acknowledging_a_subindex_without_a_record_is_refused() {
    let mut diagnosis = with_minor_faults(3);
    for sub in (0x01..=0x05).chain(0x09..=0xFF) {
        assert_eq!(diagnosis.acknowledge(sub), Err(SdoAbort::VALUE_OUT_OF_RANGE), "{sub:02X}");
    }
    assert!(diagnosis.has_new_messages());
}

#[test]
fn acknowledging_0_clears_the_history_and_no_error() {
    let mut diagnosis = with_minor_faults(40);
    assert_eq!(diagnosis.acknowledge(0), Ok(()));
    assert_eq!((diagnosis.log().system.len(), diagnosis.log().system.newest), (0, 0));
    assert_eq!((diagnosis.has_new_messages(), minor_faults(&diagnosis).len()), (false, 10));
    diagnosis.raise(order_of(40));
    assert_eq!(diagnosis.log().system.newest, 0x06);
}

#[test]
fn newest_acknowledged_message_reads_the_newest_record_or_what_was_written() {
    let mut diagnosis = with_minor_faults(3);
    diagnosis.acknowledge(0x07).expect("a record");
    assert_eq!(diagnosis.newest_acknowledged(), 0x08);
    diagnosis.start(EventLevels::default(), NewestAcknowledged::LastAcknowledged);
    assert_eq!(diagnosis.newest_acknowledged(), 0);
    diagnosis.acknowledge(0x07).expect("a record");
    assert_eq!(diagnosis.newest_acknowledged(), 0x07);
    diagnosis.clear_history();
    assert_eq!(diagnosis.newest_acknowledged(), 0);
}

#[test]
fn a_diagnosis_message_without_attached_information_ends_in_zeros() {
    let mut diagnosis = Diagnosis::default();
    diagnosis.set_time(0x0102_0304_0506_0708);
    diagnosis.raise(Occurrence::bare(WATCHDOG));
    let expected = [
        [0x00, 0xE8, 0x13, 0xFF, 0x12, 0x00, 0x00, 0x85],
        [0x08, 0x07, 0x06, 0x05, 0x04, 0x03, 0x02, 0x01],
        [0; 8],
    ];
    assert_eq!(newest_message(&diagnosis), expected.concat()[..]);
}

#[test]
fn one_piece_of_attached_information_is_32_bits_wide() {
    let mut diagnosis = Diagnosis::default();
    diagnosis.raise(order_of(0x1601));
    let expected = [
        [0x00, 0xE8, 0x00, 0xA0, 0x12, 0x01, 0x14, 0x39],
        [0; 8],
        [0x07, 0x00, 0x01, 0x16, 0x00, 0x00, 0x00, 0x00],
    ];
    assert_eq!(newest_message(&diagnosis), expected.concat()[..]);
}

#[test]
fn two_pieces_of_attached_information_are_16_bits_wide() {
    let mut diagnosis = Diagnosis::default();
    diagnosis.raise(Occurrence::new(Event::MESSAGE_COMMUNICATIONS_ERROR, [0x1234, 0xFFFF]));
    let expected = [
        [0x00, 0xE8, 0x22, 0xFF, 0x11, 0x02, 0x22, 0x80],
        [0; 8],
        [0x06, 0x00, 0x34, 0x12, 0x06, 0x00, 0xFF, 0xFF],
    ];
    assert_eq!(newest_message(&diagnosis), expected.concat()[..]);
}

#[test]
fn of_four_pieces_of_attached_information_two_fit() {
    let mut diagnosis = Diagnosis::default();
    diagnosis.raise(Occurrence::new(Event::PROCESSING_ERROR, [1, 2, 3, 4]));
    let expected = [
        [0x00, 0xE8, 0x50, 0x61, 0x12, 0x02, 0x20, 0x40],
        [0; 8],
        [0x06, 0x00, 0x01, 0x00, 0x06, 0x00, 0x02, 0x00],
    ];
    assert_eq!(newest_message(&diagnosis), expected.concat()[..]);
}

#[test]
fn an_information_has_level_0_and_is_no_error() {
    let mut diagnosis = Diagnosis::default();
    diagnosis.clear_log(EventLog::Access);
    let expected = [
        [0x00, 0xE8, 0x00, 0xFF, 0x10, 0x01, 0x40, 0x90],
        [0; 8],
        [0x07, 0x00, 0x02, 0x00, 0x00, 0x00, 0x00, 0x00],
    ];
    assert_eq!(newest_message(&diagnosis), expected.concat()[..]);
    assert_eq!((diagnosis.error_status(), diagnosis.log().access.len()), (0, 1));
}

#[test]
fn a_current_error_has_twelve_bytes_with_attached_information_1_alone() {
    let bytes = |detail| current_error_bytes(&CurrentError { event: EventCode(0x3914_0000), detail });
    assert_eq!(bytes(None), [0, 0, 0x14, 0x39, 0, 0, 7, 0, 0, 0, 0, 0]);
    assert_eq!(bytes(Some(0x1601)), [0, 0, 0x14, 0x39, 1, 4, 7, 0, 0x01, 0x16, 0, 0]);
    let mut diagnosis = Diagnosis::default();
    diagnosis.raise(Occurrence::new(Event::PROCESSING_ERROR, [9, 8, 7, 6]));
    let current = current_error_bytes(&diagnosis.current(EventLevel::MinorFault)[0]);
    assert_eq!(current, [0, 0, 0x20, 0x40, 1, 4, 7, 0, 9, 0, 0, 0]);
}

#[test]
fn the_sixth_access_event_pushes_the_oldest_out() {
    let mut diagnosis = Diagnosis::default();
    diagnosis.raise(Occurrence::bare(Event::UNIT_RESTART));
    (0..5).for_each(|_| diagnosis.clear_log(EventLog::System));
    let events: Vec<EventCode> = diagnosis.log().access.iter().map(|record| record.event).collect();
    assert_eq!(events, [Event::EVENT_LOG_CLEARED; 5]);
}

#[test]
fn emergencies_are_sent_once_enabled_and_never_after_a_start() {
    let mut diagnosis = Diagnosis::default();
    diagnosis.raise(Occurrence::bare(MISMATCH));
    assert_eq!(diagnosis.take_emergency(), None);
    diagnosis.enable_emergencies(true);
    diagnosis.raise(Occurrence::bare(WATCHDOG));
    assert_eq!(diagnosis.take_emergency(), None, "its notification is not possible");
    diagnosis.raise(Occurrence::bare(MISMATCH));
    let octets = diagnosis.take_emergency().map(Emergency::pack);
    assert_eq!(octets, Some([0x30, 0xFF, 0, 0, 0x00, 0x00, 0x17, 0x39]));
    diagnosis.start(EventLevels::default(), NewestAcknowledged::NewestRecord);
    diagnosis.raise(Occurrence::bare(MISMATCH));
    assert_eq!((diagnosis.emergencies_enabled(), diagnosis.take_emergency()), (false, None));
}

#[test]
fn a_fault_between_start_and_first_refresh_is_told_once() {
    let mut diagnosis = Diagnosis::default();
    diagnosis.inject(Fault::ControlParameters);
    diagnosis.start(EventLevels::default(), NewestAcknowledged::NewestRecord);
    diagnosis.inject(Fault::Processing);
    diagnosis.reset_errors();
    diagnosis.tell_start();
    let events: Vec<EventCode> = diagnosis.log().history().map(|record| record.event).collect();
    let processing = Event::PROCESSING_ERROR;
    // The cause persists at the reset; the other fault was not reported before.
    assert_eq!(events, [processing, processing, Event::CONTROL_PARAMETER_ERROR]);
}

#[test]
fn an_io_communications_error_stays_while_one_of_its_causes_is_there() {
    let fault = Fault::IoCommunications;
    let mut diagnosis = Diagnosis::default();
    diagnosis.inject(fault);
    diagnosis.see(fault);
    diagnosis.see_no_more(fault);
    diagnosis.reset_errors();
    assert_eq!(diagnosis.found().collect::<Vec<_>>(), [fault]);
    diagnosis.remove(fault);
    diagnosis.reset_errors();
    assert_eq!((diagnosis.found().count(), diagnosis.error_status()), (0, 0));
    assert_eq!(diagnosis.log().system.len(), 2);
}
