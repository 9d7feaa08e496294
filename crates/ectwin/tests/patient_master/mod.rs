//! The ethercrab master of these tests: with long time-outs, because the machine may be busy with other tests.

use std::time::Duration;

use ethercrab::subdevice_group::{Op, PreOp, SubDeviceGroup};
use ethercrab::{DefaultLock, MainDevice, MainDeviceConfig, PduLoop, PduRx, PduStorage, PduTx, Timeouts};

/// Maximum length of the process data of one frame; longer process data are split.
pub(crate) const FRAME_DATA_BYTES: usize = 1100;

type Storage = PduStorage<16, { PduStorage::element_size(FRAME_DATA_BYTES) }>;

/// The ends of a master's frames, which are kept until the process ends.
pub(crate) fn frames() -> (PduTx<'static>, PduRx<'static>, PduLoop<'static>) {
    let storage: &'static Storage = Box::leak(Box::new(Storage::new()));
    storage.try_split().unwrap()
}

/// Takes a group to OP while process data are exchanged: a unit waits for outputs.
pub(crate) async fn into_op<const UNITS: usize, const BYTES: usize>(
    group: SubDeviceGroup<UNITS, BYTES, DefaultLock, PreOp>,
    master: &MainDevice<'static>,
) -> SubDeviceGroup<UNITS, BYTES, DefaultLock, Op> {
    let group = group.into_safe_op(master).await.unwrap().request_into_op(master).await.unwrap();
    let mut ticks = tokio::time::interval(Duration::from_millis(1));
    let in_op = async {
        while !group.tx_rx(master).await.unwrap().all_op() {
            ticks.tick().await;
        }
    };
    tokio::time::timeout(Duration::from_secs(10), in_op).await.unwrap();
    group
}

/// A master for these frames that reads the clocks of the units this number of times when it starts.
pub(crate) fn master(pdu_loop: PduLoop<'static>, dc_static_sync_iterations: u32) -> MainDevice<'static> {
    let patience = Duration::from_secs(5);
    let timeouts = Timeouts {
        pdu: patience,
        eeprom: patience,
        state_transition: patience,
        mailbox_echo: patience,
        mailbox_response: patience,
        ..Timeouts::default()
    };
    let config = MainDeviceConfig { dc_static_sync_iterations, ..MainDeviceConfig::default() };
    MainDevice::new(pdu_loop, timeouts, config)
}
