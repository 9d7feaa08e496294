use std::time::Duration;

use ectwin::{AlState, Setup, Twin};
use ethercrab::{MainDevice, MainDeviceConfig, PduStorage, Timeouts};

static STORAGE: PduStorage<16, { PduStorage::element_size(1100) }> = PduStorage::new();

#[tokio::test]
async fn our_application_brings_the_unit_to_op() {
    // The unit. Its file has no program, so the test sets its inputs.
    let setup = Setup::from_toml("model = \"nx-ect101\"").unwrap();
    let (tx, rx, pdu_loop) = STORAGE.try_split().unwrap();
    let live = Twin::power_on([setup]).serve_ethercrab(tx, rx).unwrap();
    live.look(0, |unit| unit.io_mut().set_uints(1, [0x1234; 15]));

    // The master, as in any program with ethercrab. Test machines are busy, so the time-outs are long.
    let patience = Duration::from_secs(5);
    let timeouts =
        Timeouts { pdu: patience, eeprom: patience, mailbox_response: patience, ..Timeouts::default() };
    let config = MainDeviceConfig { dc_static_sync_iterations: 0, ..MainDeviceConfig::default() };
    let master = MainDevice::new(pdu_loop, timeouts, config);
    let group = master.init_single_group::<2, 512>(ethercrab::std::ethercat_now).await.unwrap();
    let unit = group.subdevice(&master, 0).unwrap();
    assert_eq!(unit.sdo_read::<u32>(0x1018, 2).await.unwrap(), 0x017C);
    // A unit waits for outputs on its way to OP, so process data start in SAFE-OP, with a cycle of 1 ms.
    let mut ticks = tokio::time::interval(Duration::from_millis(1));
    let group = group.into_safe_op(&master).await.unwrap().request_into_op(&master).await.unwrap();
    while !group.tx_rx(&master).await.unwrap().all_op() {
        ticks.tick().await;
    }
    assert_eq!(live.look(0, |unit| unit.state()), AlState::Op);

    // Until the values have arrived on both sides.
    group.subdevice(&master, 0).unwrap().outputs_raw_mut()[..2].copy_from_slice(&[0x78, 0x56]);
    for _ in 0..1000 {
        ticks.tick().await;
        assert_eq!(group.tx_rx(&master).await.unwrap().working_counter, 3);
        let inputs = group.subdevice(&master, 0).unwrap().inputs_raw().to_vec();
        let arrived = live.look(0, |unit| unit.io().uints(1).unwrap()[0] == 0x5678);
        // Two bytes of status, then the first UINT array.
        if arrived && inputs[2..4] == [0x34, 0x12] {
            return;
        }
    }
    panic!("the values did not arrive within 1,000 cycles");
}
