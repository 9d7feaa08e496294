//! A unit whose images show whether they are complete: all bytes of an image are equal.

use device::{
    Buffers, DataDirection, DataLength, DeviceConfig, Exchange, OutputsBeforeOp, ProcessDataConfig, SmIndex,
    Unit,
};
use time::{Duration, Instant};
use wire::AlState;

use super::watched::Watched;

const IMAGE_BYTES: u16 = 64;
const OUTPUTS_START: u16 = 0x1000;
const INPUTS_START: u16 = 0x1100;

/// 64 bytes in each direction, without mailbox. It fills its inputs with the number of the refresh.
#[derive(Debug, Default)]
pub(super) struct Even {
    refreshes: u8,
    /// The outputs of the last refresh, if it had any.
    outputs: Option<Vec<u8>>,
    /// The error of a refresh.
    wrong: Option<String>,
}

impl Unit for Even {
    fn refresh_period(&self) -> Option<Duration> {
        Some(Duration::from_millis(1))
    }

    fn refresh(&mut self, _now: Instant, exchange: Exchange<'_>) {
        let Exchange { state, outputs, inputs, .. } = exchange;
        self.refreshes = self.refreshes.wrapping_add(1);
        inputs.fill(self.refreshes);
        self.outputs = outputs.map(<[u8]>::to_vec);
        let has_inputs = matches!(state, AlState::SafeOp | AlState::Op);
        if outputs.is_some() && state != AlState::Op {
            self.wrong = Some(format!("the unit gets outputs in {state}"));
        } else if !has_inputs && !inputs.is_empty() {
            self.wrong = Some(format!("the unit is to fill inputs in {state}"));
        }
    }
}

impl Watched for Even {
    fn take_wrong(&mut self) -> Option<String> {
        self.wrong.take()
    }

    fn take_outputs(&mut self) -> Option<Vec<u8>> {
        self.outputs.take()
    }

    fn has_even_images(&self) -> bool {
        true
    }
}

/// Its stack. Units differ in the choices that the standard leaves open.
pub(super) fn config(number: usize) -> DeviceConfig {
    let mut sii_image = vec![0; 256];
    sii_image[14] = wire::sii_checksum(&[0; 14]);
    let is_even = number.is_multiple_of(2);
    let described = |sync_manager, direction, start| ProcessDataConfig {
        sync_manager: SmIndex(sync_manager),
        direction,
        start,
        length: DataLength::Fixed(IMAGE_BYTES),
        buffers: Buffers::Three,
    };
    // A unit without mailbox may have its process data on the first SyncManagers.
    let first = if is_even { 2 } else { 0 };
    let process_data = [
        described(first, DataDirection::Outputs, OUTPUTS_START),
        described(first + 1, DataDirection::Inputs, INPUTS_START),
    ];
    let outputs_before_op = if is_even {
        OutputsBeforeOp::Within(Duration::from_millis(20))
    } else {
        OutputsBeforeOp::NotRequired
    };
    DeviceConfig {
        sii_image,
        process_data: process_data.into_iter().collect(),
        outputs_before_op,
        ..DeviceConfig::default()
    }
}
