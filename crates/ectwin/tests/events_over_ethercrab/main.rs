//! Events with ethercrab: read and reset while process data are exchanged, faults that end in INIT, restarts.

#![cfg(feature = "ethercrab")]
#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

#[path = "../patient_master/mod.rs"]
mod patient_master;
mod stage;

use ectwin::{AlState, EventCode, Fault};
use ethercrab::subdevice_group::Op;
use ethercrab::{AlStatusCode, SubDeviceState};

use stage::{Emergency, Group, Stage};

const IO_COMMUNICATIONS_ERROR: EventCode = EventCode(0x8020_0000);
const PROCESSING_ERROR: EventCode = EventCode(0x4020_0000);
const NX_UNIT_RESTART: EventCode = EventCode(0x94B8_0000);

const TOLD: Emergency = Emergency { code: 0xFF20, register: 0, event: IO_COMMUNICATIONS_ERROR };
/// 80200000 in the history: diagnosis code, flags, text, and no parameters after the time stamp.
const MESSAGE_HEAD: [u8; 8] = [0x00, 0xE8, 0x20, 0xFF, 0x12, 0x00, 0x20, 0x80];
const CURRENT_ERROR: [u8; 12] = [0x00, 0x00, 0x20, 0x80, 0x00, 0x00, 0x07, 0x00, 0x00, 0x00, 0x00, 0x00];
const MINOR_FAULT: u8 = 0x20;
/// Data … Valid, both directions, in the first byte of the inputs.
const VALID: u8 = 0b110;

/// Data … Valid, and New Messages Available after the data sets.
fn flags(inputs: &[u8]) -> (u8, u8) {
    (inputs[0] & VALID, inputs[inputs.len() - 1])
}

async fn write<T>(stage: &Stage, group: &Group<Op>, object: (u16, u8), value: T)
where
    T: ethercrab::EtherCrabWireWrite,
{
    let unit = group.subdevice(&stage.master, 0).unwrap();
    unit.sdo_write(object.0, object.1, value).await.unwrap();
}

#[tokio::test]
async fn a_fault_in_op_is_told_on_every_channel_while_process_data_run() {
    let stage = Stage::power_on();
    let group = stage.op().await;
    let walk = async {
        write(&stage, &group, (0x10F3, 5), 1_u16).await;
        stage.wait_for_inputs(|inputs| flags(inputs) == (VALID, 0)).await;
        assert_eq!(stage.history(&group).await, [0, 0, 0, 0]);

        stage.live.look(0, |unit| unit.inject(Fault::IoCommunications));
        assert_eq!(stage.emergency(&group).await, TOLD);
        stage.wait_for_inputs(|inputs| flags(inputs) == (0, 1)).await;
        assert_eq!(stage.history(&group).await, [1, 6, 6, 1]);
        expect_objects(&stage, &group).await;

        write(&stage, &group, (0x10F3, 3), 6_u8).await;
        stage.wait_for_inputs(|inputs| flags(inputs) == (0, 0)).await;
        write(&stage, &group, (0x2002, 2), 1_u8).await;
        assert_eq!(stage.emergency(&group).await, TOLD, "the cause is still there");
        assert_eq!(stage.history(&group).await, [2, 7, 7, 1]);

        stage.live.look(0, |unit| unit.remove(Fault::IoCommunications));
        write(&stage, &group, (0x2002, 2), 1_u8).await;
        stage.wait_for_inputs(|inputs| flags(inputs) == (VALID, 1)).await;
        stage.expect_no_emergency(&group).await;
        let unit = group.subdevice(&stage.master, 0).unwrap();
        assert_eq!(unit.sdo_read::<u8>(0x2004, 0).await.unwrap(), 0);
        assert_eq!(unit.status().await.unwrap(), (SubDeviceState::Op, AlStatusCode::NoError));
    };
    stage.while_exchanging(&group, walk).await;
}

/// One minor fault, in the history, among the current errors and in the error status; OP is kept.
async fn expect_objects(stage: &Stage, group: &Group<Op>) {
    let unit = group.subdevice(&stage.master, 0).unwrap();
    let message: [u8; 24] = unit.sdo_read(0x10F3, 6).await.unwrap();
    assert_eq!((&message[..8], &message[16..]), (&MESSAGE_HEAD[..], &[0; 8][..]));
    assert_eq!(unit.sdo_read::<u8>(0x2002, 1).await.unwrap(), MINOR_FAULT);
    assert_eq!(unit.sdo_read::<u8>(0x2003, 0).await.unwrap(), 0);
    assert_eq!(unit.sdo_read::<u8>(0x2004, 0).await.unwrap(), 1);
    assert_eq!(unit.sdo_read::<[u8; 12]>(0x2004, 1).await.unwrap(), CURRENT_ERROR);
    assert_eq!(unit.status().await.unwrap(), (SubDeviceState::Op, AlStatusCode::NoError));
}

#[tokio::test]
async fn a_unit_that_fails_stays_in_init_until_it_is_restarted() {
    let stage = Stage::power_on();
    let group = stage.op().await;
    write(&stage, &group, (0x10F3, 5), 1_u16).await;
    stage.live.look(0, |unit| unit.inject(Fault::Processing));
    assert_eq!(stage.al_after(0x0008).await, (0x0011, 0x0001));
    let unit = group.subdevice(&stage.master, 0).unwrap();
    unit.register_write(0x0120_u16, 0x0012_u16).await.unwrap();
    assert_eq!(stage.al().await, (0x0011, 0x0001), "no way to PRE-OP");

    stage.live.look(0, |unit| {
        unit.remove(Fault::Processing);
        unit.restart();
    });
    assert_eq!(stage.al().await, (0x0011, 0x0060), "restarted");
    let group = stage.op().await;
    let walk = async {
        stage.wait_for_inputs(|inputs| flags(inputs) == (VALID, 1)).await;
        assert_eq!(stage.history(&group).await, [1, 6, 6, 1], "a restart is no system event");
        let unit = group.subdevice(&stage.master, 0).unwrap();
        assert_eq!(unit.sdo_read::<u16>(0x10F3, 5).await.unwrap(), 0, "emergencies are off");
        assert_eq!(unit.sdo_read::<u8>(0x2004, 0).await.unwrap(), 0);
    };
    stage.while_exchanging(&group, walk).await;
    stage.live.look(0, |unit| {
        let log = unit.error_log();
        assert_eq!(log.system.iter().map(|record| record.event).collect::<Vec<_>>(), [PROCESSING_ERROR]);
        assert_eq!(log.access.iter().map(|record| record.event).collect::<Vec<_>>(), [NX_UNIT_RESTART]);
        assert_eq!(unit.state(), AlState::Op);
    });
}

#[tokio::test]
async fn a_lost_memory_is_in_the_al_status_code_and_in_no_log() {
    let stage = Stage::power_on();
    stage.live.look(0, |unit| {
        unit.inject(Fault::NonVolatileMemory);
        unit.cycle_power();
    });
    assert_eq!(stage.al().await, (0x0011, 0x0002));
    stage.live.look(0, |unit| {
        unit.remove(Fault::NonVolatileMemory);
        unit.cycle_power();
    });
    assert_eq!(stage.al().await, (0x0001, 0x0000));
    let group = stage.op().await;
    let history = stage.while_exchanging(&group, stage.history(&group)).await;
    assert_eq!(history, [0, 0, 0, 0]);
    stage.live.look(0, |unit| {
        let log = unit.error_log();
        assert_eq!((log.system.len(), log.access.len()), (0, 0), "{log:?}");
    });
}

/// ethercrab 0.7 empties the mailbox up to ten times before an SDO, and asserts that the message after that is
/// not an emergency. docs/user/events.md describes this; if this test fails, ethercrab has changed.
#[tokio::test]
#[should_panic(expected = "left: Emergency")]
async fn ethercrab_panics_where_an_emergency_comes_in_place_of_an_sdo_response() {
    let stage = Stage::power_on();
    let group = stage.op().await;
    write(&stage, &group, (0x10F3, 5), 1_u16).await;
    stage.live.look(0, |unit| {
        unit.inject(Fault::IoCommunications);
        (0..14).for_each(|_| unit.reset_errors());
    });
    let unit = group.subdevice(&stage.master, 0).unwrap();
    let read = unit.sdo_read::<u8>(0x2004, 0).await;
    assert!(read.is_ok(), "{read:?}");
}
