//! A line of coupler, 8 outputs, 8 inputs and 16 inputs, stored as units of any model.

use device::{Network, Unit};
use digital::{BitImages, Terminal, TerminalSettings, Wiring, device_config};
use std::sync::{Arc, Mutex};
use time::{Duration, Instant};

use crate::bench::{Bench, terminal};

/// Wiring to which a test keeps a handle.
#[derive(Clone, Default)]
struct Shared(Arc<Mutex<BitImages>>);

impl Shared {
    fn images(&self) -> std::sync::MutexGuard<'_, BitImages> {
        self.0.lock().expect("no test panics while it looks")
    }
}

impl Wiring for Shared {
    fn inputs(&mut self) -> u64 {
        self.images().inputs
    }

    fn set_outputs(&mut self, levels: u64) {
        self.images().outputs = levels;
    }
}

/// A line of units of any model, with the wiring of each.
fn line<const N: usize>(settings: [TerminalSettings; N]) -> (Bench<Box<dyn Unit>>, [Shared; N]) {
    let wirings = [(); N].map(|()| Shared::default());
    let powered = settings.iter().zip(&wirings).map(|(settings, wiring)| {
        let unit: Box<dyn Unit> = Box::new(Terminal::power_on(settings, wiring.clone()));
        (device_config(settings), unit)
    });
    (Bench::around(Network::power_on(powered, Instant::ZERO)), wirings)
}

/// The bits of all units, one after the other.
fn to_op(bench: &mut Bench<Box<dyn Unit>>) -> u32 {
    let stations = u16::try_from(bench.access.line.network.len()).expect("a short line");
    let bits = (0..stations).fold(0, |at_bit, position| bench.set_up(position, at_bit));
    for state in [2, 4, 8] {
        bench.request_all(state);
        for position in 0..stations {
            assert_eq!(bench.status(position), (state, 0), "position {position}");
        }
    }
    bits
}

#[test]
fn a_line_of_terminals_exchanges_its_bits() {
    let (mut bench, [_, outputs, inputs, more_inputs]) =
        line([terminal(0, 0), terminal(8, 0), terminal(0, 8), terminal(0, 16)]);
    assert_eq!(to_op(&mut bench), 32);
    inputs.images().inputs = 0x5A;
    more_inputs.images().inputs = 0xC001;
    bench.access.run_for(Duration::from_millis(1));
    assert_eq!(bench.cycle(&[0xA5, 0, 0, 0]), (vec![0xA5, 0x5A, 0x01, 0xC0], 4));
    assert_eq!(outputs.images().outputs, 0xA5);
}

/// Four terminals in two bytes: each has its bits of them, and leaves those of the others unchanged.
#[test]
fn terminals_share_a_byte_of_logical_memory() {
    let (mut bench, [a, b, c, d]) = line([terminal(4, 0), terminal(2, 0), terminal(0, 3), terminal(1, 2)]);
    assert_eq!(to_op(&mut bench), 12);
    c.images().inputs = 0b101;
    d.images().inputs = 0b10;
    bench.access.run_for(Duration::from_millis(1));
    // Bits 0 to 3 and 4 to 5 are outputs, 6 to 8 inputs, 9 an output, 10 and 11 inputs.
    let (returned, working_counter) = bench.cycle(&[0b0010_1001, 0b0000_0010]);
    assert_eq!(working_counter, 2 + 2 + 1 + 3);
    assert_eq!(returned, [0b0110_1001, 0b0000_1011]);
    let levels = [&a, &b, &d].map(|wiring| wiring.images().outputs);
    assert_eq!(levels, [0b1001, 0b10, 0b1]);
    bench.cycle(&[0b0001_0110, 0]);
    let levels = [&a, &b, &d].map(|wiring| wiring.images().outputs);
    assert_eq!(levels, [0b0110, 0b01, 0b0]);
}

/// The line ends before a terminal that is cut off.
#[test]
fn a_terminal_without_power_ends_the_line() {
    let (mut bench, [_, outputs, _]) = line([terminal(0, 0), terminal(8, 0), terminal(8, 0)]);
    to_op(&mut bench);
    assert_eq!(bench.cycle(&[1, 2]).1, 4);
    let now = bench.access.now();
    bench.access.line.network.power_off(2, now);
    assert_eq!(bench.cycle(&[1, 2]).1, 2);
    assert_eq!(outputs.images().outputs, 1);
}
