//! Single accesses and dialogues without a master.

use device::StartUp;
use master::{Address, DirectAccess, RegisterRead, StateRequest, Wait};
use nx_ect101::{NxEct101, UnitSettings, device_config};
use time::{Duration, Instant};
use wire::{AlState, AlStatusCode};

use crate::bench::Slaves;

const PATIENCE: Duration = Duration::from_millis(10);

/// One NX-ECT101 that nobody has searched.
fn line() -> DirectAccess<Slaves<NxEct101>> {
    let settings = UnitSettings::default();
    let (unit, _) = NxEct101::power_on(&settings);
    let mut config = device_config(&settings);
    config.start_up = StartUp::default();
    DirectAccess::new(Slaves::power_on([(config, unit)]), Instant::ZERO)
}

#[test]
fn a_state_is_requested_without_its_set_up() {
    let mut access = line();
    let mut request = StateRequest::new(AlState::PreOp, Wait::PreOp);
    assert!(access.execute(Address::Position(0), &mut request, PATIENCE));
    assert!(!request.is_reached());
    assert_eq!(request.report().code, AlStatusCode::INVALID_MAILBOX_CONFIGURATION_PREOP);
}

#[test]
fn a_dialogue_without_an_answer_ends_with_its_patience() {
    let mut access = line();
    let mut read = RegisterRead::new(0x0130, 2);
    assert!(!access.execute(Address::Position(1), &mut read, PATIENCE), "there is no second slave");
    let waited = access.now().saturating_since(Instant::ZERO);
    assert!(waited > PATIENCE && waited <= PATIENCE + Duration::from_micros(100), "{waited}");
    assert_eq!(access.read(Address::Position(1), 0x0130, 2), (vec![0, 0], 0));
}

#[test]
fn every_access_takes_its_time() {
    let mut access = line();
    access.pace = Duration::from_micros(250);
    assert_eq!(access.read(Address::All, 0x0130, 2), (vec![1, 0], 1));
    assert_eq!(access.write(Address::Position(0), 0x0010, &[5, 0]), 1);
    assert_eq!(access.read(Address::Station(5), 0x0010, 2), (vec![5, 0], 1));
    assert_eq!(access.now(), Instant::ZERO + Duration::from_micros(750));
}
