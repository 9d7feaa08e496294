//! The positions of the channels, and the identity of a terminal.
//!
//! The layout is that of simple terminals in the field (EL1008, EL2008): outputs of one byte are the digital
//! output data of the controller, inputs are at the start of the process RAM, and the outputs come first if
//! there are both.

use device::{Buffers, DataDirection, DataLength, ProcessDataConfig, SmIndex};

use crate::channels::Channels;
use crate::settings::TerminalSettings;

/// Vendor ID in SII and ESI. The EtherCAT Technology Group has not assigned it.
pub const VENDOR_ID: u32 = 0xEC70_0000;
/// Vendor name.
pub(crate) const VENDOR_NAME: &str = "ectwin";
/// Product code without its channels: outputs are added in bits 15 to 8, inputs in bits 7 to 0.
const PRODUCT_FAMILY: u32 = 0x0001_0000;
/// Revision number.
pub(crate) const REVISION: u32 = 0x0001_0000;

/// Digital output data of the controller: one byte of outputs.
const OUTPUT_BYTE_START: u16 = 0x0F00;
/// Outputs of several bytes, with three buffers.
const OUTPUT_BYTES_START: u16 = 0x1100;
/// Inputs, with three buffers for two bytes or more.
const INPUTS_START: u16 = 0x1000;
/// Control byte of outputs: buffered, the master writes, watchdog trigger.
pub(crate) const OUTPUTS_CONTROL: u8 = 0x44;
/// Control byte of inputs: buffered, the master reads.
pub(crate) const INPUTS_CONTROL: u8 = 0x00;

/// Length of the EEPROM: 2 KiB, or 4 KiB if the channels do not fit into that.
pub(crate) fn eeprom_bytes(settings: &TerminalSettings) -> u32 {
    const CHANNELS_IN_2_KIB: u8 = 48;
    let channels = settings.inputs.count() + settings.outputs.count();
    if channels <= CHANNELS_IN_2_KIB { 2_048 } else { 4_096 }
}

pub(crate) fn product_code(settings: &TerminalSettings) -> u32 {
    let [inputs, outputs] = [settings.inputs, settings.outputs].map(Channels::count);
    PRODUCT_FAMILY | u32::from(outputs) << 8 | u32::from(inputs)
}

/// The SyncManagers: outputs, then inputs, if they exist.
pub(crate) fn process_data(settings: &TerminalSettings) -> impl Iterator<Item = ProcessDataConfig> {
    let (outputs, inputs) = (settings.outputs, settings.inputs);
    let outputs_start = if outputs.length_bytes() == 1 { OUTPUT_BYTE_START } else { OUTPUT_BYTES_START };
    let directions =
        [(outputs, DataDirection::Outputs, outputs_start), (inputs, DataDirection::Inputs, INPUTS_START)];
    let with_channels = directions.into_iter().filter(|(channels, ..)| !channels.is_none());
    (0..).map(SmIndex).zip(with_channels).map(|(sync_manager, (channels, direction, start))| {
        let length = DataLength::Fixed(channels.length_bytes());
        ProcessDataConfig { sync_manager, direction, start, length, buffers: Buffers::Three }
    })
}
