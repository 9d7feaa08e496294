use device::{Buffers, DataDirection, DataLength, DeviceConfig, ProcessDataConfig, SmIndex};
use esi::{
    DeviceDescription, FmmuUsage, Group, Pdo, PdoEntry, PortPhysics, SyncManager, SyncManagerType, Vendor,
};
use wire::{DataType, ObjectIndex, SubIndex};

/// Start of the inputs in the memory of the slave controller, and their length.
const INPUTS_START: u16 = 0x1000;
pub(crate) const INPUTS_BYTES: u16 = 2;

/// For ESI and SII: the identity, one SyncManager and one PDO.
pub(crate) fn description() -> DeviceDescription {
    DeviceDescription {
        vendor: Vendor { id: 0xEC70_0000, name: "ectwin".into() },
        group: Group { group_type: "Counter".into(), name: "Counters".into() },
        order_code: "COUNTER".into(),
        name: "Counter".into(),
        product_code: 0x0002_0000,
        revision: 1,
        ports: [PortPhysics::Mii, PortPhysics::Mii, PortPhysics::Unused, PortPhysics::Unused],
        eeprom_bytes: 2_048,
        fmmus: vec![FmmuUsage::Inputs],
        sync_managers: vec![SyncManager {
            usage: SyncManagerType::Inputs,
            start: INPUTS_START,
            default_bytes: INPUTS_BYTES,
            min_bytes: None,
            max_bytes: None,
            control: 0x20, // three buffers, the master reads
            enable: 1,
        }],
        tx_pdos: vec![Pdo {
            index: ObjectIndex(0x1A00),
            name: "Count".into(),
            entries: vec![PdoEntry {
                index: ObjectIndex(0x6000),
                sub: SubIndex(1),
                name: "Count".into(),
                data_type: DataType::UNSIGNED16,
                bit_length: 16,
            }],
            sync_manager: Some(0),
            fixed: true,
            mandatory: true,
        }],
        ..DeviceDescription::default()
    }
}

/// For the slave stack: no mailbox, inputs at SyncManager 0. A master gets everything else from the SII.
pub(crate) fn device_config() -> DeviceConfig {
    let inputs = ProcessDataConfig {
        sync_manager: SmIndex(0),
        direction: DataDirection::Inputs,
        start: INPUTS_START,
        length: DataLength::Fixed(INPUTS_BYTES),
        buffers: Buffers::Three,
    };
    DeviceConfig {
        sii_image: esi::sii::image(&description()),
        process_data: [inputs].into_iter().collect(),
        ..DeviceConfig::default()
    }
}
