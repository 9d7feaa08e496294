//! States: the way up and down, refusals, acknowledges, time-outs.

use crate::bench::{channels, connected, connected_with, terminals};
use device::TransitionTimes;
use master::{AlReport, Failure, Habits, Master, StateRequest, Wait};
use nx_ect101::UnitSettings;
use time::Duration;
use wire::{AlControl, AlState, AlStatusCode, Command, SdoTarget, datagrams};

const WAY_UP: [AlState; 4] = [AlState::Init, AlState::PreOp, AlState::SafeOp, AlState::Op];

#[test]
fn every_state_is_reached_from_every_other_one() {
    let mut bench = connected(1);
    bench.search().expect("one slave");
    for from in WAY_UP {
        for to in WAY_UP {
            assert_eq!(bench.take_to(0, from), Ok(()), "{from}");
            assert_eq!(bench.take_to(0, to), Ok(()), "{from} to {to}");
            assert_eq!(bench.line.state(0), to);
            assert_eq!(bench.master.slaves()[0].state(), to);
            let is_exchanging = matches!(to, AlState::SafeOp | AlState::Op);
            assert_eq!(bench.master.is_exchanging(0), is_exchanging);
        }
    }
}

#[test]
fn many_slaves_come_to_op_at_the_same_time() {
    for count in [25, 100] {
        let mut bench = connected(count);
        bench.search().expect("slaves");
        let before = bench.now();
        assert_eq!(bench.take_all_to(AlState::Op), Ok(()));
        let elapsed = bench.now().saturating_since(before);
        assert!((0..count).all(|position| bench.line.state(position) == AlState::Op));
        assert!(elapsed < Duration::from_millis(50), "{elapsed}: one after the other it takes seconds");
    }
}

#[test]
fn a_slave_without_a_mailbox_comes_to_op() {
    let mut bench = terminals(Master::default(), &[(8, 0), (0, 8), (8, 8), (0, 0)]);
    assert_eq!(bench.search(), Ok(4));
    assert_eq!(bench.take_all_to(AlState::Op), Ok(()));
    let refused = bench.upload(0, SdoTarget::entry(0x1018, 1));
    assert_eq!(refused.map_err(|failure| failure.to_string()), Err("the slave has no mailbox".into()));
}

#[test]
fn a_description_sets_a_slave_up_as_its_sii_does_and_more() {
    let settings = UnitSettings::default();
    let description = nx_ect101::description(&settings);
    let mut bench = connected(1);
    bench.search().expect("one slave");
    let by_sii = bench.master.slaves()[0].settings().clone();
    bench.master.describe(0, &description);
    let by_description = bench.master.slaves()[0].settings().clone();
    assert_eq!(by_description.mailbox, by_sii.mailbox);
    assert_eq!(by_description.process_data, by_sii.process_data);
    assert_eq!(by_description.device_id, by_sii.device_id);
    assert_eq!(by_description.start_up.len(), description.init_commands.len());
    assert_eq!(bench.take_to(0, AlState::Op), Ok(()));
    let flags = bench.upload(0, SdoTarget::entry(0x10F3, 5));
    assert_eq!(flags, Ok(description.init_commands[0].data.clone()), "what the ESI asks for was written");
}

#[test]
fn a_terminals_description_says_what_its_sii_says() {
    let mut bench = terminals(Master::default(), &[(3, 12)]);
    bench.search().expect("one slave");
    let by_sii = bench.master.slaves()[0].settings().clone();
    assert_eq!(by_sii.process_data.iter().map(|area| area.bits).collect::<Vec<_>>(), [3, 12]);
    bench.master.describe(0, &digital::description(&channels(3, 12)));
    assert_eq!(bench.master.slaves()[0].settings(), &by_sii);
}

#[test]
fn a_wrong_sync_manager_is_refused_and_a_right_one_taken_afterwards() {
    let mut bench = connected(1);
    bench.search().expect("one slave");
    let set = |bench: &mut master::Connected<_>, length_bytes| {
        let settings = bench.master.settings_mut(0).expect("a slave");
        settings.process_data[0].sync_manager.length_bytes = length_bytes;
    };
    let right = bench.master.slaves()[0].settings().process_data[0].sync_manager.length_bytes;
    set(&mut bench, right - 1);
    let refusal = bench.take_to(0, AlState::Op);
    let Err(Failure::Refused(report)) = refusal else { panic!("{refusal:?}") };
    assert_eq!(report.code, AlStatusCode::INVALID_OUTPUT_CONFIGURATION);
    assert_eq!(report.status.state, AlState::PreOp);
    assert_eq!(bench.al_report(0), Ok(report), "nobody has acknowledged it yet");
    set(&mut bench, right);
    assert_eq!(bench.take_to(0, AlState::Op), Ok(()));
}

#[test]
fn a_state_that_takes_too_long_is_given_up_with_what_the_slave_shows() {
    let slow = |limit_ms: u32| {
        let mut bench = connected_with(Master::default(), 1, |_, config| {
            let mut times = TransitionTimes::default();
            times.set("IP", Duration::from_millis(1_000));
            config.conduct.transition_times = times;
        });
        bench.search().expect("one slave");
        let timeouts = &mut bench.master.settings_mut(0).expect("a slave").timeouts;
        timeouts.pre_op_ms = limit_ms;
        bench
    };
    assert_eq!(slow(1_100).take_to(0, AlState::PreOp), Ok(()));
    let result = slow(900).take_to(0, AlState::PreOp);
    let Err(Failure::NotReached(report)) = result else { panic!("{result:?}") };
    assert_eq!((report.status.state, report.status.error), (AlState::Init, false));
}

#[test]
fn a_request_that_is_not_taken_is_given_up() {
    let mut bench = connected_with(Master::default(), 1, |_, config| {
        config.conduct.transition_times = TransitionTimes::every(Duration::from_secs(20));
    });
    assert_eq!(bench.search(), Err(Failure::NoAnswer), "INIT to INIT takes 20 s");
    assert_eq!(bench.take_to(0, AlState::PreOp), Err(Failure::NoAnswer));
}

#[test]
fn an_acknowledge_that_is_ignored_ends_the_way() {
    let mut bench =
        connected_with(Master::default(), 1, |_, config| config.conduct.ignores_acknowledge = true);
    bench.search().expect("one slave");
    bench.request_state(0, StateRequest::new(AlState::Op, Wait::SafeOpOp)).expect_err("INIT to OP");
    let result = bench.take_to(0, AlState::PreOp);
    let Err(Failure::NotReached(report)) = result else { panic!("{result:?}") };
    assert_eq!(report.code, AlStatusCode::INVALID_REQUESTED_STATE_CHANGE);
}

/// AL control as written, in order.
fn al_controls(frames: &[Vec<u8>]) -> Vec<AlControl> {
    let written = frames.iter().flat_map(|frame| datagrams(frame)).filter(|datagram| {
        datagram.header.offset == 0x0120 && matches!(datagram.header.command, Command::Fpwr | Command::Apwr)
    });
    written
        .map(|datagram| AlControl::from_bits(u16::from_le_bytes([datagram.data[0], datagram.data[1]])))
        .collect()
}

#[test]
fn a_building_block_does_what_it_says_and_nothing_else() {
    let mut bench = connected(1);
    bench.search().expect("one slave");
    bench.line.frames.clear();
    let result = bench.request_state(0, StateRequest::new(AlState::Other(5), Wait::PreOp));
    let Err(Failure::Refused(report)) = result else { panic!("{result:?}") };
    assert_eq!(report.code, AlStatusCode::UNKNOWN_REQUESTED_STATE);
    let again = bench.request_state(0, StateRequest::new(AlState::PreOp, Wait::PreOp));
    assert_eq!(again, Err(Failure::Refused(report)), "without an acknowledge nothing moves");
    let acknowledged = bench.request_state(0, StateRequest::acknowledge(report)).expect("acknowledged");
    assert_eq!(acknowledged.status.state, AlState::Init);
    let states: Vec<_> = al_controls(&bench.line.frames).iter().map(|control| control.bits()).collect();
    assert_eq!(states, [0x05, 0x02, 0x11]);
}

#[test]
fn the_explicit_device_id_is_asked_for_and_taken_back() {
    let mut bench = connected(1);
    bench.search().expect("one slave");
    let id = UnitSettings::default().explicit_device_id();
    for state in WAY_UP {
        bench.take_to(0, state).expect("a state");
        assert_eq!(bench.device_id(0), Ok(id), "{state}");
        let shown = bench.al_report(0).expect("AL status");
        assert_eq!((shown.code, shown.status.device_id_loaded), (AlStatusCode::NO_ERROR, false));
    }
}

#[test]
fn a_slave_that_falls_back_is_taken_up_again() {
    let mut bench = connected(2);
    bench.search().expect("two slaves");
    bench.take_all_to(AlState::Op).expect("OP");
    bench.master.stop_exchange();
    bench.run_for(Duration::from_millis(200));
    let report = bench.al_report(1).expect("AL status");
    assert_eq!((report.status.state, report.code), (AlState::SafeOp, AlStatusCode::SYNC_MANAGER_WATCHDOG));
    let now = bench.now();
    bench.master.exchange(now, Duration::from_millis(2));
    assert_eq!(bench.take_all_to(AlState::Op), Ok(()));
    assert_eq!(bench.al_report(1).map(AlReport::is_good), Ok(true));
}

#[test]
fn periods_of_no_length_are_very_short_ones() {
    let habits = Habits {
        answer_patience: Duration::ZERO,
        poll_period: Duration::ZERO,
        listen_period: Some(Duration::ZERO),
        ..Habits::default()
    };
    let mut bench = connected_with(Master::new(habits), 1, |_, config| {
        let mut times = TransitionTimes::default();
        times.set("IP", Duration::from_micros(100));
        config.conduct.transition_times = times;
    });
    assert_eq!(bench.search(), Ok(1));
    assert_eq!(bench.take_to(0, AlState::PreOp), Ok(()), "polled while time passes");
    bench.run_for(Duration::from_micros(100));
}

#[test]
fn process_data_longer_than_an_fmmu_are_refused() {
    let mut bench = connected(1);
    bench.search().expect("one slave");
    let areas = &mut bench.master.settings_mut(0).expect("a slave").process_data;
    areas.first_mut().expect("outputs").bits = 8 * 65_536;
    assert_eq!(bench.take_to(0, AlState::SafeOp), Err(Failure::AreaTooLong { length_bytes: 65_536 }));
    let areas = &mut bench.master.settings_mut(0).expect("a slave").process_data;
    areas.first_mut().expect("outputs").bits = 8 * 65_535;
    let result = bench.take_to(0, AlState::SafeOp);
    assert!(!matches!(result, Err(Failure::AreaTooLong { .. })), "an FMMU can map them: {result:?}");
}
