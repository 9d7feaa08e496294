//! A line of units of several models with ethercrab as its master, in one process.

use std::time::Duration;

use ectwin::{AlState, Setup, Twin};
use ethercrab::{MainDevice, MainDeviceConfig, PduStorage, Timeouts};

static STORAGE: PduStorage<16, { PduStorage::element_size(1100) }> = PduStorage::new();

/// A coupler, 8 outputs, 8 inputs, an NX-ECT101, 16 inputs.
const LINE: [&str; 5] = [
    "model = \"digital\"\nname = \"K1\"",
    "model = \"digital\"\nname = \"O1\"\noutputs = 8",
    "model = \"digital\"\nname = \"I1\"\ninputs = 8",
    "model = \"nx-ect101\"",
    "model = \"digital\"\nname = \"I2\"\ninputs = 16",
];

#[tokio::test]
async fn a_line_of_several_models_reaches_op() {
    let setups: Vec<Setup> = LINE.iter().map(|text| Setup::from_toml(text).unwrap()).collect();
    let (tx, rx, pdu_loop) = STORAGE.try_split().unwrap();
    let live = Twin::power_on(setups).serve_ethercrab(tx, rx).unwrap();
    let patience = Duration::from_secs(5);
    let timeouts =
        Timeouts { pdu: patience, eeprom: patience, mailbox_response: patience, ..Timeouts::default() };
    let config = MainDeviceConfig { dc_static_sync_iterations: 0, ..MainDeviceConfig::default() };
    let master = MainDevice::new(pdu_loop, timeouts, config);
    let group = master.init_single_group::<8, 512>(ethercrab::std::ethercat_now).await.unwrap();
    assert_eq!(group.len(), LINE.len());
    let mut ticks = tokio::time::interval(Duration::from_millis(1));
    let group = group.into_safe_op(&master).await.unwrap().request_into_op(&master).await.unwrap();
    while !group.tx_rx(&master).await.unwrap().all_op() {
        ticks.tick().await;
    }
    for position in 0..LINE.len() {
        assert_eq!(live.look(position, |unit| unit.state()), AlState::Op, "{position}");
    }
    assert_eq!(live.look(1, |unit| unit.indicator("RUN").unwrap().id().to_owned()), "lit");
    assert_eq!(live.look(1, |unit| unit.indicator("TS green")), None);

    // Outputs arrive at the variables of their unit, and variables at the master.
    live.look(4, |unit| {
        let input = unit.io().find("I2_Input_13").unwrap();
        unit.io_mut().write(input, &[1]).unwrap();
    });
    group.subdevice(&master, 1).unwrap().outputs_raw_mut()[0] = 0xA5;
    for _ in 0..1000 {
        ticks.tick().await;
        group.tx_rx(&master).await.unwrap();
        let inputs = group.subdevice(&master, 4).unwrap().inputs_raw().to_vec();
        let output =
            |name: &str| live.look(1, |unit| unit.io().read(unit.io().find(name).unwrap()).unwrap()[0]);
        if (output("O1_Output_1"), output("O1_Output_2")) == (1, 0) && inputs == [0x00, 0x10] {
            return;
        }
    }
    panic!("the values did not arrive within 1,000 cycles");
}
