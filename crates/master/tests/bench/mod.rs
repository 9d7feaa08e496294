//! A line of NX-ECT101 in the same process, and what the tests say of it.

use device::{DeviceConfig, Network};
use master::{Connected, Line, Master};
use nx_ect101::{NxEct101, UnitSettings, device_config};
use segment::FrameFate;
use time::Instant;

/// Units under power.
pub(crate) struct Units(pub(crate) Network<NxEct101>);

impl Units {
    /// This many with the factory setting, changed as `change` says.
    pub(crate) fn with(count: usize, change: impl Fn(usize, &mut DeviceConfig)) -> Self {
        let settings = UnitSettings::default();
        let units = (0..count).map(|position| {
            let (unit, _) = NxEct101::power_on(&settings);
            let mut config = device_config(&settings);
            change(position, &mut config);
            (config, unit)
        });
        Self(Network::power_on(units, Instant::ZERO))
    }
}

impl Line for Units {
    fn frame(&mut self, now: Instant, frame: &mut [u8]) -> bool {
        self.0.frame(now, frame) == FrameFate::Returned
    }

    fn poll(&mut self, now: Instant) {
        self.0.poll(now);
    }

    fn deadline(&self) -> Instant {
        self.0.deadline()
    }
}

/// A master and this many units.
pub(crate) fn connected(count: usize) -> Connected<Units> {
    Connected::new(Master::default(), Units::with(count, |_, _| {}), Instant::ZERO)
}
