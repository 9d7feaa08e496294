//! SOEM sends the process data of a cycle at once: with 1,000 units about 250 frames, before it receives the first.

use testbed::{add_veth_pair, in_network_namespace};

use crate::bench::{LRW, Master, Twin, UNIT, count, frame};
use ectwin::Duration;

const FRAMES: u16 = 250;
const DATA_BYTES: usize = 1486;

#[test]
fn a_burst_of_250_full_frames_comes_back_whole_from_1000_units() {
    const TEST: &str = "burst::a_burst_of_250_full_frames_comes_back_whole_from_1000_units";
    in_network_namespace(TEST, || {
        add_veth_pair("m0", "u0");
        let mut arguments = vec![UNIT; 1000];
        arguments.extend(["--link", "raw:u0"]);
        let twin = Twin::start_units("burst", &arguments);
        let mut master = Master::at("m0");
        for _ in 0..3 {
            for number in 0..FRAMES {
                let [low, high] = number.to_le_bytes();
                assert!(master.send(&frame(LRW, low, [low, high, 0, 0], &[high; DATA_BYTES])));
            }
            for number in 0..FRAMES {
                let answer = master.receive(Duration::from_secs(20));
                let answer = answer.unwrap_or_else(|| panic!("{number} of {FRAMES} came back"));
                // In order, with the mark of the units.
                assert_eq!((answer.len(), &answer[18..20]), (28 + DATA_BYTES, &number.to_le_bytes()[..]));
                assert_eq!(answer[6] & 2, 2);
            }
        }
        assert_eq!(count(&twin.end(), "frames=750 destroyed=0 dropped=0 unsent=0"), 1);
    });
}
