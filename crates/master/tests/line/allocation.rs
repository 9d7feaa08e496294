//! The cyclic exchange allocates nothing, in the master and in the slaves.

use crate::bench::connected_with;
use allocation_counter::measure;
use master::{Habits, Line, Master, StatusRead};
use time::Duration;
use wire::AlState;

#[test]
fn a_cycle_allocates_nothing() {
    let mut habits = Habits { listen_period: None, ..Habits::default() };
    habits.exchange.status = StatusRead::EachSlave;
    let mut bench = connected_with(Master::new(habits), 10, |_, _| {});
    bench.search().expect("ten units");
    bench.take_all_to(AlState::Op).expect("OP");
    bench.run_for(Duration::from_millis(10));
    let (mut frame, mut now) = (Vec::with_capacity(wire::FRAME_BYTES_MAX), bench.now());
    let before = bench.master.cycle().cycles;
    let counted = measure(|| {
        for _ in 0..1_000 {
            now = now.max(bench.master.deadline());
            bench.line.network.poll(now);
            bench.master.outputs_mut(3)[0] ^= 1;
            while let Some(ticket) = bench.master.transmit(now, &mut frame) {
                bench.line.network.frame(now, &mut frame);
                bench.master.receive(now, ticket, &frame);
            }
        }
    });
    assert_eq!((counted.count_total, counted.bytes_total), (0, 0));
    let report = bench.master.cycle();
    assert_eq!((report.cycles - before, report.working_counter, report.expected), (1_000, 30, 30));
    bench.line.poll(now);
}
