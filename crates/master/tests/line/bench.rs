//! Slaves in the same process: NX-ECT101, and terminals without a mailbox.

use device::{DeviceConfig, Network, StartUp, Unit};
use digital::{BitImages, Channels, Terminal, TerminalSettings};
use master::{Connected, Line, Master};
use nx_ect101::{NxEct101, UnitSettings, device_config};
use segment::FrameFate;
use time::Instant;
use wire::AlState;

/// Slaves with power, and every frame that the master has sent.
pub(crate) struct Slaves<U> {
    pub(crate) network: Network<U>,
    pub(crate) frames: Vec<Vec<u8>>,
}

impl<U: Unit> Slaves<U> {
    pub(crate) fn power_on(units: impl IntoIterator<Item = (DeviceConfig, U)>) -> Self {
        Self { network: Network::power_on(units, Instant::ZERO), frames: Vec::new() }
    }

    pub(crate) fn state(&self, position: usize) -> AlState {
        self.network.device(position).map_or(AlState::Other(0), |device| device.al_status().state)
    }
}

impl<U: Unit> Line for Slaves<U> {
    fn frame(&mut self, now: Instant, frame: &mut [u8]) -> bool {
        self.frames.push(frame.to_vec());
        self.network.frame(now, frame) == FrameFate::Returned
    }

    fn poll(&mut self, now: Instant) {
        self.network.poll(now);
    }

    fn deadline(&self) -> Instant {
        self.network.deadline()
    }
}

/// A master with this many NX-ECT101 in the factory setting, changed by `change`.
pub(crate) fn connected_with(
    master: Master,
    count: usize,
    change: impl Fn(usize, &mut DeviceConfig),
) -> Connected<Slaves<NxEct101>> {
    let settings = UnitSettings::default();
    let units = (0..count).map(|position| {
        let (unit, _) = NxEct101::power_on(&settings);
        let mut config = device_config(&settings);
        config.start_up = StartUp::default();
        change(position, &mut config);
        (config, unit)
    });
    Connected::new(master, Slaves::power_on(units), Instant::ZERO)
}

/// A master with this many NX-ECT101.
pub(crate) fn connected(count: usize) -> Connected<Slaves<NxEct101>> {
    connected_with(Master::default(), count, |_, _| {})
}

/// The settings of a terminal with this number of outputs and inputs; without any it is a coupler.
pub(crate) fn channels(outputs: u8, inputs: u8) -> TerminalSettings {
    let channels = |count| Channels::new(count).expect("0 to 64");
    TerminalSettings { outputs: channels(outputs), inputs: channels(inputs), ..TerminalSettings::default() }
}

/// A master with terminals of these numbers of outputs and inputs.
pub(crate) fn terminals(master: Master, bits: &[(u8, u8)]) -> Connected<Slaves<Terminal<BitImages>>> {
    let powered = bits.iter().map(|&(outputs, inputs)| {
        let settings = channels(outputs, inputs);
        (digital::device_config(&settings), Terminal::power_on(&settings, BitImages::default()))
    });
    Connected::new(master, Slaves::power_on(powered), Instant::ZERO)
}
