//! The SyncManagers with process data.

use device::{Buffers, DataDirection, DataLength, ProcessDataConfig, ProcessDataList, SmIndex};
use esi::{DeviceDescription, Pdo, SyncManager, SyncManagerType};

use crate::not_yet::NotYet;

/// Digital outputs of the controller, below its user memory.
const MEMORY_START: u16 = 0x0F00;
/// Bit of `Enable`: a SyncManager without memory.
const VIRTUAL: u8 = 0x04;
/// Bits of the control byte: the mode.
const MODE: u8 = 0x03;
/// One buffer with handshake.
const ONE_BUFFER: u8 = 0x02;

/// The process data of a device. The direction of a SyncManager and its length follow from the PDOs that are assigned to
/// it; without PDOs its default length counts.
pub(crate) fn process_data(described: &DeviceDescription) -> Result<ProcessDataList, NotYet> {
    let mut list = ProcessDataList::new();
    for (sync_manager, number) in described.sync_managers.iter().zip(0..) {
        let Some((direction, pdos)) = direction(described, sync_manager) else { continue };
        let length_bytes = length_bytes(pdos, number).unwrap_or_else(|| sync_manager.default_bytes.into());
        if length_bytes == 0 {
            continue;
        }
        if sync_manager.enable & VIRTUAL != 0 || sync_manager.start < MEMORY_START {
            return Err(NotYet::NoMemory { sync_manager: number });
        }
        let length = u16::try_from(length_bytes).map_err(|_| NotYet::TooLong { sync_manager: number })?;
        let count = described.sync_managers.len();
        list.try_push(ProcessDataConfig {
            sync_manager: SmIndex(number),
            direction,
            start: sync_manager.start,
            length: DataLength::Fixed(length),
            buffers: buffers(sync_manager),
        })
        .map_err(|_| NotYet::SyncManagers { count })?;
    }
    Ok(list)
}

fn direction<'a>(
    described: &'a DeviceDescription,
    sync_manager: &SyncManager,
) -> Option<(DataDirection, &'a [Pdo])> {
    match sync_manager.usage {
        SyncManagerType::Outputs => Some((DataDirection::Outputs, &described.rx_pdos)),
        SyncManagerType::Inputs => Some((DataDirection::Inputs, &described.tx_pdos)),
        _ => None,
    }
}

/// The PDOs of a SyncManager follow each other without gaps; none if it has no PDO.
fn length_bytes(pdos: &[Pdo], sync_manager: u8) -> Option<u32> {
    let assigned = pdos.iter().filter(|pdo| pdo.sync_manager == Some(sync_manager));
    assigned.map(Pdo::bit_length).reduce(|bits, more| bits + more).map(|bits| bits.div_ceil(8))
}

const fn buffers(sync_manager: &SyncManager) -> Buffers {
    if sync_manager.control & MODE == ONE_BUFFER { Buffers::One } else { Buffers::Three }
}
