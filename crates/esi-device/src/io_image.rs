//! The process data of a device: what the master has sent, and what it reads.

use device::{DataDirection, DataLength, DeviceConfig, Exchange, Start, Unit};
use time::{Duration, Instant};
use wire::AlStatusCode;

/// Time between two looks at the inputs.
const INPUT_PERIOD: Duration = Duration::from_millis(1);

/// The process data, byte by byte as in the SyncManagers of a direction one after the other. Outputs are 0 without valid
/// process data: below OP, and after the watchdog has expired.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct IoImage {
    outputs: Box<[u8]>,
    inputs: Box<[u8]>,
}

impl IoImage {
    /// The process data of a device with this configuration, all 0.
    #[must_use]
    pub fn power_on(config: &DeviceConfig) -> Self {
        let of = |direction| vec![0; length_bytes(config, direction)].into_boxed_slice();
        Self { outputs: of(DataDirection::Outputs), inputs: of(DataDirection::Inputs) }
    }

    /// The outputs, as the master has set them.
    #[must_use]
    pub const fn outputs(&self) -> &[u8] {
        &self.outputs
    }

    /// The inputs, which the master reads.
    pub const fn inputs_mut(&mut self) -> &mut [u8] {
        &mut self.inputs
    }
}

impl Unit for IoImage {
    /// Outputs are applied with the frame, so that only inputs need a timer.
    fn refresh_period(&self) -> Option<Duration> {
        (!self.inputs.is_empty()).then_some(INPUT_PERIOD)
    }

    fn refresh(&mut self, _now: Instant, exchange: Exchange<'_>) {
        match exchange.outputs {
            Some(outputs) if outputs.len() == self.outputs.len() => self.outputs.copy_from_slice(outputs),
            _ => self.outputs.fill(0),
        }
        if exchange.inputs.len() == self.inputs.len() {
            exchange.inputs.copy_from_slice(&self.inputs);
        }
    }

    fn restart(&mut self, _now: Instant, _start: Start, _sii_image: &mut [u8]) -> Option<AlStatusCode> {
        self.outputs.fill(0);
        None
    }

    fn power_off(&mut self, _now: Instant) {
        self.outputs.fill(0);
    }
}

fn length_bytes(config: &DeviceConfig, wanted: DataDirection) -> usize {
    let of_direction = config.process_data.iter().filter(|described| described.direction == wanted);
    of_direction
        .map(|described| match described.length {
            DataLength::Fixed(bytes) | DataLength::Mapped { max_bytes: bytes } => usize::from(bytes),
        })
        .sum()
}
