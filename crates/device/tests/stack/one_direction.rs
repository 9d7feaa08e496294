//! Slaves with only outputs or only inputs.

use crate::bench::{Bench, Digital8};
use time::Duration;
use wire::AlState::{Op, PreOp, SafeOp};

/// What makes a digital unit a slave of one direction.
type Change = fn(&mut Digital8);

/// A slave in PRE-OP, with both SyncManagers enabled.
fn in_pre_op(change: Change) -> Bench {
    let mut bench = Bench::in_state(PreOp);
    let Some(device) = bench.network.device_mut(0) else { panic!("there is one unit") };
    change(device.unit_mut());
    bench.set_process_data();
    bench
}

/// C063: the inputs of a slave without outputs.
#[test]
fn a_drop_out_of_op_closes_the_inputs_where_there_are_no_outputs() {
    let mut bench = in_pre_op(|unit| unit.without_outputs = true);
    for output_setting in [0x0816, 0x060C] {
        bench.write(output_setting, &[0]);
    }
    bench.request(SafeOp.bits());
    bench.request(Op.bits());
    assert_eq!((bench.status(), bench.cycle(0).1), ((0x08, 0), 1));
    bench.request(5);
    bench.run_for(Duration::from_secs(1));
    assert_eq!((bench.status(), bench.cycle(0).1), ((0x14, 0x12), 0));
    bench.request(Op.bits() | 0x10);
    assert_eq!((bench.status(), bench.cycle(0).1), ((0x08, 0), 1));
}

/// C072: before SAFE-OP and in it.
#[test]
fn the_sync_manager_without_data_is_disabled_and_the_other_one_enabled() {
    let cases: [(Change, [(u16, u16); 2]); 2] = [
        (|unit| unit.without_outputs = true, [(0x0816, 0x1D), (0x081E, 0x1E)]),
        (|unit| unit.without_inputs = true, [(0x081E, 0x1E), (0x0816, 0x1D)]),
    ];
    for (change, [(without, its_code), (with, other_code)]) in cases {
        let mut bench = in_pre_op(change);
        bench.request(SafeOp.bits());
        assert_eq!(bench.status(), (0x12, its_code), "enabled");
        bench.write(without, &[0]);
        bench.request(SafeOp.bits() | 0x10);
        assert_eq!(bench.status(), (0x04, 0));
        bench.write(without, &[1]);
        assert_eq!(bench.status(), (0x12, its_code), "enabled in SAFE-OP");
        bench.write(without, &[0]);
        bench.write(with, &[0]);
        bench.request(SafeOp.bits() | 0x10);
        assert_eq!(bench.status(), (0x12, other_code), "disabled");
    }
}
