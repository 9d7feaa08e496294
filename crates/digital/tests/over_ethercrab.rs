//! A line of terminals with ethercrab as its master, in one process.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

use std::future::Future;
use std::pin::pin;
use std::sync::{Arc, Mutex};
use std::task::{Context, Poll, Wake, Waker};
use std::time::Duration as StdDuration;

use device::{Network, Unit};
use digital::{BitImages, Channels, Terminal, TerminalSettings, Wiring, device_config};
use ethercrab::{MainDevice, MainDeviceConfig, PduRx, PduStorage, PduTx, Timeouts};
use time::{Duration, Instant};

static STORAGE: PduStorage<16, { PduStorage::element_size(256) }> = PduStorage::new();

/// Wiring to which the test keeps a handle.
#[derive(Clone, Default)]
struct Shared(Arc<Mutex<BitImages>>);

impl Wiring for Shared {
    fn inputs(&mut self) -> u64 {
        self.0.lock().expect("nobody panics while it looks").inputs
    }

    fn set_outputs(&mut self, levels: u64) {
        self.0.lock().expect("nobody panics while it looks").outputs = levels;
    }
}

/// The other end of ethercrab's frames: a line in virtual time, 100 microseconds per frame.
struct Line<'s> {
    network: Network<Box<dyn Unit>>,
    now: Instant,
    tx: PduTx<'s>,
    rx: PduRx<'s>,
}

impl Line<'_> {
    /// Answers all waiting frames. Returns whether there were any.
    fn answer(&mut self) -> bool {
        let mut answered = false;
        while let Some(frame) = self.tx.next_sendable_frame() {
            let mut bytes = Vec::new();
            let sent = frame.send_blocking(|frame| {
                bytes.extend_from_slice(frame);
                Ok(frame.len())
            });
            sent.expect("the line takes every frame");
            self.now += Duration::from_micros(100);
            self.network.poll(self.now);
            self.network.frame(self.now, &mut bytes);
            self.network.poll(self.now);
            self.rx.receive_frame(&bytes).expect("an answer to a frame of ethercrab");
            answered = true;
        }
        answered
    }
}

struct NoWaker;

impl Wake for NoWaker {
    fn wake(self: Arc<Self>) {}
}

/// Runs the master, and lets the line answer whenever the master waits.
fn run<T>(line: &mut Line<'_>, master: impl Future<Output = T>) -> T {
    let waker = Waker::from(Arc::new(NoWaker));
    let (mut master, mut context) = (pin!(master), Context::from_waker(&waker));
    loop {
        if let Poll::Ready(result) = master.as_mut().poll(&mut context) {
            return result;
        }
        line.answer();
    }
}

fn terminal(outputs: u8, inputs: u8) -> TerminalSettings {
    let channels = |count| Channels::new(count).expect("0 to 64 channels");
    TerminalSettings { outputs: channels(outputs), inputs: channels(inputs), ..TerminalSettings::default() }
}

#[test]
fn ethercrab_takes_a_line_of_terminals_to_op() {
    let settings = [terminal(0, 0), terminal(8, 0), terminal(0, 8), terminal(0, 16)];
    let wirings = [(); 4].map(|()| Shared::default());
    let powered = settings.iter().zip(&wirings).map(|(settings, wiring)| {
        let unit: Box<dyn Unit> = Box::new(Terminal::power_on(settings, wiring.clone()));
        (device_config(settings), unit)
    });
    let network = Network::power_on(powered, Instant::ZERO);
    let (tx, rx, pdu_loop) = STORAGE.try_split().expect("the storage is split once");
    let mut line = Line { network, now: Instant::ZERO, tx, rx };

    let patience = StdDuration::from_secs(20);
    let timeouts = Timeouts { pdu: patience, eeprom: patience, ..Timeouts::default() };
    let config = MainDeviceConfig { dc_static_sync_iterations: 10, ..MainDeviceConfig::default() };
    let master = MainDevice::new(pdu_loop, timeouts, config);
    let [_, outputs, inputs, more_inputs] = &wirings;
    inputs.0.lock().expect("it is ours").inputs = 0x5A;
    more_inputs.0.lock().expect("it is ours").inputs = 0xC001;

    let (names, read) = run(&mut line, async {
        let group = master.init_single_group::<4, 64>(ethercrab::std::ethercat_now).await?;
        let names: Vec<String> = group.iter(&master).map(|unit| unit.name().to_owned()).collect();
        let group = group.into_op(&master).await?;
        group.subdevice(&master, 1)?.outputs_raw_mut()[0] = 0xA5;
        for _ in 0..30 {
            assert_eq!(group.tx_rx(&master).await?.working_counter, 4);
        }
        let read = [2, 3].map(|at| group.subdevice(&master, at).map(|unit| unit.inputs_raw().to_vec()));
        Ok::<_, ethercrab::error::Error>((names, read))
    })
    .expect("ethercrab finds nothing wrong");
    assert_eq!(names, ["COUPLER", "DO8", "DI8", "DI16"]);
    assert_eq!(read, [Ok(vec![0x5A]), Ok(vec![0x01, 0xC0])]);
    assert_eq!(outputs.0.lock().expect("it is ours").outputs, 0xA5);
}
