//! Emergencies.

use mailbox::EmergencyLost;
use wire::{CoeService, Emergency};

use crate::bench::{Bench, coe_message};

#[test]
fn emergencies_go_out_in_order_and_those_beyond_the_queue_are_counted() {
    let mut bench = Bench::in_pre_op();
    let emergency = |code| Emergency { code, error_register: 1, manufacturer: [1, 2, 3, 4, 5] };
    for code in 0..16 {
        assert_eq!(bench.mailbox.queue_emergency(emergency(code)), Ok(()));
    }
    assert_eq!(bench.mailbox.queue_emergency(emergency(16)), Err(EmergencyLost));
    assert_eq!(bench.mailbox.emergencies_lost(), 1);
    for code in 0..16 {
        let (service, data) = coe_message(&bench.unsolicited().unwrap());
        assert_eq!((service, data.len()), (CoeService::Emergency, 8));
        assert_eq!(Emergency::parse(&data), Some(emergency(code)));
    }
    assert_eq!(bench.unsolicited(), None);
}

#[test]
fn a_reset_drops_what_waits() {
    let mut bench = Bench::in_pre_op();
    bench.mailbox.queue_emergency(Emergency::default()).unwrap();
    bench.mailbox.reset();
    assert!(!bench.mailbox.has_unsolicited());
    assert_eq!(bench.unsolicited(), None);
}
