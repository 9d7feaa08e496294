//! Slaves with other layouts than mailbox, SyncManager 2 and SyncManager 3: the options of a description.

use crate::bench::{Bench, Digital8, config, process_data, sii_image};
use crate::bytes::Bytes;
use device::DataDirection::{Inputs, Outputs};
use device::DataLength::Fixed;
use device::{Buffers, ConfigError, DeviceConfig, ProcessDataConfig, RefreshCause, SmIndex, SyncMode, Unit};
use time::{Duration, Instant};
use wire::AlState::{Op, PreOp, SafeOp};
use wire::{Command, FrameBuilder};

fn described(process_data: impl IntoIterator<Item = ProcessDataConfig>) -> DeviceConfig {
    let process_data = process_data.into_iter().collect();
    DeviceConfig { sii_image: sii_image(), process_data, ..DeviceConfig::default() }
}

fn one_buffer(described: ProcessDataConfig) -> ProcessDataConfig {
    ProcessDataConfig { buffers: Buffers::One, ..described }
}

/// A slave in PRE-OP whose SyncManagers have these settings: start, length, control.
fn in_pre_op(config: DeviceConfig, settings: &[(u8, u16, u16, u8)]) -> Bench<Bytes> {
    let mut bench = Bench::of([(config, Bytes::default())]);
    bench.request(PreOp.bits());
    for &(sync_manager, start, length_bytes, control) in settings {
        set(&mut bench, sync_manager, start, length_bytes, control);
    }
    bench
}

fn set(bench: &mut Bench<Bytes>, sync_manager: u8, start: u16, length_bytes: u16, control: u8) {
    let [start, length] = [start, length_bytes].map(u16::to_le_bytes);
    let settings = [start[0], start[1], length[0], length[1], control, 0, 1, 0];
    bench.write(0x0800 + 8 * u16::from(sync_manager), &settings);
}

fn to_op(bench: &mut Bench<Bytes>) {
    for state in [SafeOp, Op] {
        bench.request(state.bits());
        assert_eq!(bench.status(), (state.bits(), 0));
    }
}

#[test]
fn process_data_lie_on_sync_managers_0_and_1_without_a_mailbox() {
    let config =
        described([process_data(0, Outputs, 0x1000, Fixed(2)), process_data(1, Inputs, 0x1100, Fixed(3))]);
    let mut bench = in_pre_op(config, &[(0, 0x1000, 2, 0x44), (1, 0x1100, 3, 0x00)]);
    bench.unit().inputs = vec![7, 8, 9];
    to_op(&mut bench);
    assert_eq!(bench.read(0x1100, 3), [7, 8, 9]);
    bench.write(0x1000, &[1, 2]);
    bench.run_for(Duration::from_millis(1));
    assert_eq!(bench.unit().outputs, Some(vec![1, 2]));
    bench.write(0x0806, &[0]);
    assert_eq!(bench.status(), (0x12, 0x1D));
}

/// The data of a direction follow each other by the numbers of their SyncManagers.
#[test]
fn several_sync_managers_of_a_direction_are_one_image() {
    let config = described([
        process_data(0, Outputs, 0x1000, Fixed(1)),
        process_data(1, Inputs, 0x1100, Fixed(2)),
        process_data(2, Outputs, 0x1200, Fixed(2)),
        process_data(5, Inputs, 0x1300, Fixed(1)),
    ]);
    let settings = [(0, 0x1000, 1, 0x44), (1, 0x1100, 2, 0x00), (2, 0x1200, 2, 0x44), (5, 0x1300, 1, 0x00)];
    let mut bench = in_pre_op(config, &settings);
    bench.unit().inputs = vec![7, 8, 9];
    to_op(&mut bench);
    assert_eq!((bench.read(0x1100, 2), bench.read(0x1300, 1)), (vec![7, 8], vec![9]));
    bench.write(0x1000, &[1]);
    bench.run_for(Duration::from_millis(1));
    assert_eq!(bench.unit().outputs, None, "only a part of the outputs has come");
    bench.write(0x1200, &[2, 3]);
    bench.run_for(Duration::from_millis(1));
    assert_eq!(bench.unit().outputs, Some(vec![1, 2, 3]));
}

/// C064: each of them.
#[test]
fn each_sync_manager_of_a_direction_is_checked_and_watched() {
    for (sync_manager, code) in [(0, 0x1D), (1, 0x1E), (2, 0x1D), (3, 0x1E)] {
        let config = described([
            process_data(0, Outputs, 0x1000, Fixed(1)),
            process_data(1, Inputs, 0x1100, Fixed(1)),
            process_data(2, Outputs, 0x1200, Fixed(1)),
            process_data(3, Inputs, 0x1300, Fixed(1)),
        ]);
        let settings =
            [(0, 0x1000, 1, 0x44), (1, 0x1100, 1, 0x00), (2, 0x1200, 1, 0x44), (3, 0x1300, 1, 0x00)];
        let mut bench = in_pre_op(config, &settings);
        let activation = 0x0806 + 8 * sync_manager;
        bench.write(activation, &[0]);
        bench.request(SafeOp.bits());
        assert_eq!(bench.status(), (0x12, code), "SyncManager {sync_manager}");
        bench.write(activation, &[1]);
        bench.request(SafeOp.bits() | 0x10);
        bench.request(Op.bits());
        assert_eq!(bench.status(), (0x08, 0));
        bench.write(activation, &[0]);
        assert_eq!(bench.status(), (0x12, code), "SyncManager {sync_manager}");
    }
}

/// One buffer with handshake: outputs wait until the slave takes them, inputs until the master does.
#[test]
fn a_single_buffer_is_handed_over() {
    let config = described([
        one_buffer(process_data(0, Outputs, 0x1000, Fixed(2))),
        one_buffer(process_data(1, Inputs, 0x1100, Fixed(2))),
    ]);
    let mut bench = in_pre_op(config, &[(0, 0x1000, 2, 0x46), (1, 0x1100, 2, 0x02)]);
    bench.unit().inputs = vec![7, 8];
    to_op(&mut bench);
    assert_eq!(bench.write(0x1000, &[1, 2]), 1);
    assert_eq!(bench.write(0x1000, &[3, 4]), 0, "full");
    bench.unit().inputs = vec![9, 9];
    bench.run_for(Duration::from_millis(1));
    assert_eq!(bench.unit().outputs, Some(vec![1, 2]));
    bench.run_for(Duration::from_millis(1));
    assert_eq!(bench.unit().outputs, Some(vec![1, 2]), "they stay as long as nothing new comes");
    assert_eq!(bench.read(0x1100, 2), [7, 8], "as the master has left them");
    bench.run_for(Duration::from_millis(1));
    assert_eq!(bench.read(0x1100, 2), [9, 9]);
    assert_eq!(bench.write(0x1000, &[3, 4]), 1);
}

#[test]
fn a_buffer_mode_that_is_not_described_is_refused() {
    let cases = [
        (Buffers::Three, 0x46, (0x12, 0x29)),
        (Buffers::Three, 0x44, (0x04, 0)),
        (Buffers::One, 0x44, (0x12, 0x29)),
        (Buffers::One, 0x46, (0x04, 0)),
        (Buffers::OneOrThree, 0x44, (0x04, 0)),
        (Buffers::OneOrThree, 0x46, (0x04, 0)),
        (Buffers::OneOrThree, 0x45, (0x12, 0x29)),
    ];
    for (buffers, control, expected) in cases {
        let outputs = ProcessDataConfig { buffers, ..process_data(0, Outputs, 0x1000, Fixed(2)) };
        let mut bench = in_pre_op(described([outputs]), &[(0, 0x1000, 2, control)]);
        bench.request(SafeOp.bits());
        assert_eq!(bench.status(), expected, "{buffers:?}, control {control:#04X}");
    }
}

fn sm_synchronous() -> DeviceConfig {
    let sync_modes = &[SyncMode::FreeRun, SyncMode::SmSynchronous];
    let outputs = process_data(0, Outputs, 0x1000, Fixed(1));
    DeviceConfig { sync_modes, ..described([outputs, process_data(1, Inputs, 0x1100, Fixed(1))]) }
}

/// The refresh of the frame, in addition to those of the timer.
#[test]
fn an_sm_synchronous_slave_follows_the_outputs() {
    let mut bench = in_pre_op(sm_synchronous(), &[(0, 0x1000, 1, 0x64), (1, 0x1100, 1, 0x20)]);
    bench.unit().sync_mode = Some(SyncMode::SmSynchronous);
    to_op(&mut bench);
    bench.unit().refreshes.clear();
    bench.unit().inputs = vec![0x77];
    bench.write(0x1000, &[0x55]);
    assert_eq!(bench.unit().refreshes, [RefreshCause::SyncManager]);
    assert_eq!(bench.unit().outputs, Some(vec![0x55]));
    assert_eq!(bench.read(0x1100, 1), [0x77]);
    assert_eq!(bench.unit().refreshes.len(), 1, "reading the inputs is no event for it");
    bench.request(PreOp.bits());
    bench.unit().refreshes.clear();
    bench.write(0x1000, &[0x66]);
    assert_eq!(bench.unit().refreshes, []);
}

/// Like digital outputs without a processor: the control byte has no PDI interrupt.
#[test]
fn outputs_may_go_out_with_the_end_of_the_frame() {
    let config = DeviceConfig { sync_modes: &[SyncMode::EndOfFrame], ..sm_synchronous() };
    let mut bench = in_pre_op(config, &[(0, 0x1000, 1, 0x44), (1, 0x1100, 1, 0x00)]);
    to_op(&mut bench);
    bench.unit().refreshes.clear();
    bench.write(0x1000, &[0x55]);
    assert_eq!(bench.unit().refreshes, [RefreshCause::SyncManager]);
    assert_eq!(bench.unit().outputs, Some(vec![0x55]));
    bench.read(0x1100, 1);
    assert_eq!(bench.unit().refreshes.len(), 1, "inputs follow the timer");
}

#[test]
fn an_sm_synchronous_slave_needs_the_interrupt() {
    let mut bench = in_pre_op(sm_synchronous(), &[(0, 0x1000, 1, 0x44), (1, 0x1100, 1, 0x00)]);
    bench.unit().sync_mode = Some(SyncMode::SmSynchronous);
    to_op(&mut bench);
    bench.unit().refreshes.clear();
    bench.write(0x1000, &[0x55]);
    bench.request(Op.bits());
    assert_eq!(bench.unit().refreshes, [], "nor when it is looked at for another reason");
    bench.run_for(Duration::from_millis(1));
    assert_eq!(bench.unit().refreshes, [RefreshCause::Period]);
}

#[test]
fn a_slave_with_inputs_only_follows_the_inputs() {
    let config = DeviceConfig {
        sync_modes: &[SyncMode::SmSynchronous],
        ..described([process_data(0, Inputs, 0x1000, Fixed(1))])
    };
    let mut bench = in_pre_op(config, &[(0, 0x1000, 1, 0x20)]);
    to_op(&mut bench);
    bench.unit().refreshes.clear();
    bench.read(0x1000, 1);
    assert_eq!(bench.unit().refreshes, [RefreshCause::SyncManager]);
}

#[test]
fn a_free_running_slave_waits_for_its_timer() {
    let mut bench = in_pre_op(sm_synchronous(), &[(0, 0x1000, 1, 0x64), (1, 0x1100, 1, 0x20)]);
    to_op(&mut bench);
    bench.unit().refreshes.clear();
    bench.write(0x1000, &[0x55]);
    assert_eq!(bench.unit().refreshes, []);
    bench.run_for(Duration::from_millis(1));
    assert_eq!(bench.unit().refreshes, [RefreshCause::Period]);
}

#[test]
fn a_synchronisation_mode_that_is_not_described_is_refused() {
    for (sync_mode, code) in
        [(SyncMode::FreeRun, 0x27), (SyncMode::SmSynchronous, 0x28), (SyncMode::Dc, 0x30)]
    {
        let others: &[SyncMode] = match sync_mode {
            SyncMode::FreeRun | SyncMode::Dc => &[SyncMode::SmSynchronous],
            SyncMode::SmSynchronous | SyncMode::EndOfFrame => &[SyncMode::FreeRun],
        };
        let mut bench = in_pre_op(DeviceConfig { sync_modes: others, ..described([]) }, &[]);
        bench.unit().sync_mode = Some(sync_mode);
        bench.request(SafeOp.bits());
        assert_eq!(bench.status(), (0x12, code), "{sync_mode}");
    }
}

/// Such as a coupler: it has nothing to exchange.
#[test]
fn a_slave_without_process_data_comes_to_op_and_sleeps() {
    let mut bench = Bench::of([(described([]), Bytes { period: None, ..Bytes::default() })]);
    bench.request(PreOp.bits());
    to_op(&mut bench);
    assert_eq!(bench.network.deadline(), Instant::NEVER);
    bench.request(5);
    assert_eq!(bench.status(), (0x14, 0x12));
}

#[test]
fn a_line_holds_units_of_many_models() {
    let inputs = DeviceConfig { ..described([process_data(0, Inputs, 0x1000, Fixed(1))]) };
    let units: [(DeviceConfig, Box<dyn Unit>); 2] =
        [(config(), Box::new(Digital8::default())), (inputs, Box::new(Bytes::default()))];
    let mut bench: Bench<Box<dyn Unit>> = Bench::of(units);
    let frame = FrameBuilder::new().physical(Command::Brd, 0, 0x0130, &[0, 0]);
    assert_eq!(bench.exchange(frame).working_counter, 2);
    bench.run_for(Duration::from_millis(2));
    bench.request(PreOp.bits());
    assert_eq!(bench.status(), (0x02, 0));
}

#[test]
fn a_description_that_contradicts_itself_is_refused() {
    let error = |config: DeviceConfig| config.validate().err();
    let on = |sync_managers: &[u8]| {
        described(sync_managers.iter().map(|&index| process_data(index, Inputs, 0x1000, Fixed(1))))
    };
    assert_eq!(error(on(&[0, 7])), None);
    let beyond = ConfigError::NoSuchSyncManager { sync_manager: SmIndex(8), count: 8 };
    assert_eq!(error(on(&[8])), Some(beyond));
    assert_eq!(error(on(&[3, 3])), Some(ConfigError::SyncManagerOutOfOrder(SmIndex(3))));
    assert_eq!(error(DeviceConfig { sync_modes: &[], ..on(&[0]) }), Some(ConfigError::NoSyncMode));
    let dc = DeviceConfig { sync_modes: &[SyncMode::Dc], ..on(&[0]) };
    assert_eq!(error(dc), Some(ConfigError::SyncModeNotImplemented(SyncMode::Dc)));
}
