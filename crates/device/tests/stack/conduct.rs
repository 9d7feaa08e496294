//! Slaves that are slow, refuse states, or ignore acknowledges.

use crate::bench::{Bench, config};
use device::{Conduct, Device, DeviceConfig, TRANSITIONS, TransitionTimes};
use time::Duration;
use wire::AlState::{Boot, Init, Op, PreOp, SafeOp};
use wire::AlStatusCode;

const SLOW: Duration = Duration::from_millis(50);

fn device(bench: &mut Bench) -> &mut Device<crate::bench::Digital8> {
    let Some(device) = bench.network.device_mut(0) else { panic!("there is one unit") };
    device
}

/// Every transition takes its time, during which AL status does not change and AL control accepts nothing.
#[test]
fn a_transition_takes_its_time() {
    for row in TRANSITIONS.iter().filter(|row| !row.needs_boot()) {
        let mut bench = Bench::in_state(row.from);
        if row.letters == "PS" {
            bench.set_process_data();
        }
        bench.write(0x0420, &[0, 0]);
        assert!(device(&mut bench).conduct_mut().transition_times.set(row.letters, SLOW));
        assert_eq!(bench.write(0x0120, &row.to.bits().to_le_bytes()), 1);
        assert_eq!(
            bench.write(0x0120, &Init.bits().to_le_bytes()),
            0,
            "{}: a second one counts 0",
            row.letters
        );
        bench.run_for(SLOW - Duration::from_micros(1));
        assert_eq!(bench.status(), (row.from.bits(), 0), "{}", row.letters);
        bench.run_for(Duration::from_micros(1));
        assert_eq!(bench.status(), (row.to.bits(), 0), "{}", row.letters);
        assert_eq!(bench.write(0x0120, &row.to.bits().to_le_bytes()), 1);
    }
}

/// The time belongs to the transition, not to a following refusal; a request that is not a transition takes none.
#[test]
fn a_refusal_comes_when_the_time_is_over() {
    let mut bench = Bench::in_state(PreOp);
    device(&mut bench).conduct_mut().transition_times = TransitionTimes::every(SLOW);
    bench.request(SafeOp.bits());
    assert_eq!(bench.status(), (0x02, 0));
    bench.run_for(SLOW);
    assert_eq!(bench.status(), (0x12, 0x1D), "there is no SyncManager 2");
    bench.request(Op.bits() | 0x10);
    assert_eq!(bench.status(), (0x12, 0x11));
}

#[test]
fn each_state_may_be_refused_with_a_code() {
    for (from, state) in [(PreOp, Init), (Init, PreOp), (PreOp, SafeOp), (SafeOp, Op)] {
        let mut bench = Bench::in_state(from);
        bench.set_process_data();
        assert!(device(&mut bench).conduct_mut().refusals.set(state, Some(AlStatusCode(0x8042))));
        bench.request(state.bits());
        assert_eq!(bench.status(), (from.bits() | 0x10, 0x8042), "{state}");
        device(&mut bench).conduct_mut().refusals.set(state, None);
        bench.request(state.bits() | 0x10);
        assert_eq!(bench.status(), (state.bits(), 0), "{state}");
    }
}

/// In OP the state is kept too: the request is refused, but it is not an invalid one.
#[test]
fn a_refused_way_down_keeps_op() {
    let mut bench = Bench::in_state(Op);
    device(&mut bench).conduct_mut().refusals.set(SafeOp, Some(AlStatusCode(0x8042)));
    bench.request(SafeOp.bits());
    assert_eq!(bench.status(), (0x18, 0x8042));
    assert_eq!(bench.cycle(1).1, 3, "its outputs stay open");
}

#[test]
fn an_acknowledge_may_be_ignored() {
    let mut bench = Bench::in_state(PreOp);
    device(&mut bench).conduct_mut().ignores_acknowledge = true;
    bench.request(Boot.bits());
    assert_eq!(bench.status(), (0x12, 0x11));
    for request in [0x12, 0x14, 0x11] {
        bench.request(request);
        assert_eq!(bench.status(), (0x12, 0x11));
    }
    bench.request(Init.bits());
    assert_eq!(bench.status(), (0x01, 0), "INIT needs no acknowledge");
    bench.request(PreOp.bits() | 0x10);
    assert_eq!(bench.status(), (0x02, 0), "without an error there is nothing to ignore");
}

/// The configured conduct is restored, including the SII's time.
#[test]
fn it_behaves_again() {
    let conduct = Conduct { ignores_acknowledge: true, ..Conduct::default() };
    let mut bench = Bench::with(DeviceConfig { conduct: conduct.clone(), ..config() });
    let Some((device, esc)) = bench.network.slave_mut(0) else { panic!("there is one unit") };
    *device.conduct_mut() = Conduct { transition_times: TransitionTimes::every(SLOW), ..Conduct::default() };
    esc.set_sii_timing(device::SiiTiming::Busy(SLOW));
    device.behave(esc);
    assert_eq!(*device.conduct_mut(), conduct);
    bench.request(PreOp.bits());
    assert_eq!(bench.status(), (0x02, 0));
    bench.write(0x0502, &[0, 1, 0, 0, 0, 0]);
    assert_eq!(bench.word(0x0502) & 0x8000, 0);
}

/// A restart begins without a request; the conduct of the slave is kept.
#[test]
fn a_restart_forgets_a_request_that_waits() {
    let mut bench = Bench::new();
    device(&mut bench).conduct_mut().transition_times = TransitionTimes::every(SLOW);
    bench.request(PreOp.bits());
    bench.network.restart(0, bench.now, device::Start::PowerOn);
    bench.run_for(SLOW * 2);
    assert_eq!(bench.status(), (0x01, 0));
    bench.request(PreOp.bits());
    assert_eq!(bench.status(), (0x01, 0));
    bench.run_for(SLOW);
    assert_eq!(bench.status(), (0x02, 0));
}
