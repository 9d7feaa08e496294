//! The diagnosis, compared with an independent model: every channel after every step of random sequences.

#![expect(clippy::expect_used, reason = "a panic here is a failed test")]

mod bench;
mod compare;
mod log;
mod model;
mod operations;
mod rows;
mod run;
mod sdo;
mod settings;

use std::collections::BTreeSet;

use nx_ect101::Event;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

use model::Situation;
use operations::{sequences, setups};
use run::Run;

/// Sequences of operations.
const SEQUENCES: u32 = 5_000;

/// The property would prove little about situations that random sequences never reach.
#[test]
fn random_sequences_come_by_every_event_and_every_corner() {
    let mut runner = TestRunner::deterministic();
    let mut seen = BTreeSet::new();
    for _ in 0..1_600 {
        let (setup, sequence) = (setups(), sequences()).new_tree(&mut runner).unwrap().current();
        let mut run = Run::power_on(&setup);
        sequence.iter().for_each(|operation| run.step(operation).unwrap());
        seen.append(&mut run.model.seen);
    }
    let corners = [
        Situation::HistoryWrapped,
        Situation::MinorFaultTookPlace,
        Situation::EleventhMinorFault,
        Situation::ObservationWithoutRoom,
        Situation::ObservationBesideOthersWithoutRoom,
        Situation::AccessLogFull,
        Situation::EmergencyLost,
        Situation::OlderAcknowledged,
        Situation::EmptySlotAcknowledged,
        Situation::RecordedWhileMemoryBroken,
        Situation::OneOfTwoIoCausesGone,
        Situation::IoCauseCameAgain,
        Situation::CauseGoneBeforeReset,
    ];
    let events = Event::all().iter().map(|event| Situation::Event(event.code.0));
    let missing: Vec<Situation> =
        events.chain(corners).filter(|situation| !seen.contains(situation)).collect();
    assert_eq!(missing, []);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(SEQUENCES))]

    /// C109: 10F3 is one of the channels.
    #[test]
    fn every_channel_tells_what_the_model_tells(setup in setups(), sequence in sequences()) {
        let mut run = Run::power_on(&setup);
        run.compare()?;
        for operation in &sequence {
            run.step(operation)?;
            run.compare()?;
        }
    }
}
