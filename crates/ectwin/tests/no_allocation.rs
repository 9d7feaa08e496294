//! After power-on nothing is allocated: not for frames, not for refresh and CPU Unit, not for SDOs, not for an ESC reset.

use allocation_counter::measure;
use ectwin::master::{Connected, Master};
use ectwin::plant::line::{Choice, Disturbance, FrameFault, FrameKind, Frames};
use ectwin::{AlState, Duration, EventLog, Fault, FrameFate, Setup, Twin};
use wire::{Command, FrameBuilder};

const UNIT: &str =
    "model = \"nx-ect101\"\noutputs_before_op = \"not-required\"\n[cpu]\nprogram = \"builtin:copy\"";
const RECEIVE: u16 = 0x1000;
const SEND: u16 = 0x1200;
const MAILBOX_BYTES: usize = 400;
/// Outputs and inputs of the unit, one after the other as the master maps them.
const PROCESS_DATA_BYTES: usize = 180 + 183;

fn apwr(offset: u16, data: &[u8]) -> Vec<u8> {
    FrameBuilder::new().physical(Command::Apwr, 0, offset, data).finish()
}

/// Sends a copy of a frame, like a master that reuses its buffer.
fn send(twin: &mut Twin, frame: &[u8], buffer: &mut [u8; 1518]) {
    let buffer = &mut buffer[..frame.len()];
    buffer.copy_from_slice(frame);
    assert_eq!(twin.frame(buffer), FrameFate::Returned);
}

/// Takes the unit to OP with its factory setting, and enables the events of the AL status in the IRQ field.
fn to_op(twin: &mut Twin) {
    let now = twin.now();
    let mut bench = Connected::new(Master::default(), twin, now);
    assert_eq!(bench.search(), Ok(1));
    assert_eq!(bench.take_to(0, AlState::Op), Ok(()));
    assert_eq!(bench.write(0, 0x0200, &[0xFF, 0x0F]), Ok(()));
}

/// A mailbox message: an SDO request with mailbox header, counter 0.
fn sdo(request: &[u8]) -> Vec<u8> {
    let mut message = vec![0; MAILBOX_BYTES];
    message[0] = (2 + request.len()) as u8;
    message[5] = 3;
    message[7] = 0x20;
    message[8..8 + request.len()].copy_from_slice(request);
    apwr(RECEIVE, &message)
}

#[test]
fn frames_refresh_and_cpu_unit_allocate_nothing() {
    let mut twin = Twin::from_toml(UNIT).expect("the unit file is good");
    to_op(&mut twin);
    let frames = [
        FrameBuilder::new()
            .logical(Command::Lrw, 0, &[1; PROCESS_DATA_BYTES])
            .physical(Command::Frmw, 0, 0x0910, &[0; 8])
            .finish(),
        FrameBuilder::new().physical(Command::Brd, 0, 0x0130, &[0; 2]).finish(),
        FrameBuilder::new().physical(Command::Aprd, 0, 0x0800, &[0; 64]).finish(),
        FrameBuilder::new().physical(Command::Apwr, 0, 0x0300, &[0; 8]).finish(),
        FrameBuilder::new().physical(Command::Bwr, 0, 0x0900, &[0; 4]).finish(),
        vec![0xFF; 20],
    ];
    let mut buffer = [0; 1518];
    let counted = measure(|| {
        for _ in 0..2_000 {
            for frame in &frames {
                let buffer = &mut buffer[..frame.len()];
                buffer.copy_from_slice(frame);
                let _ = twin.frame(buffer);
            }
            twin.run_for(Duration::from_millis(1));
        }
    });
    assert_eq!((counted.count_total, counted.bytes_total), (0, 0));
    assert_eq!(twin.unit(0).state(), AlState::Op);
}

/// A line that is long enough for the index of its segment. Addresses and mappings change, of one unit and of all.
#[test]
fn a_line_whose_addresses_change_allocates_nothing() {
    let setups = (0..20).map(|_| Setup::from_toml(UNIT).expect("the unit file is good"));
    let mut twin = Twin::power_on(setups);
    let fmmu = |logical: u8| [logical, 0, 0, 0, 4, 0, 0, 7, 0xA0, 0x13, 0, 2, 1, 0, 0, 0];
    let eighth = 7u16.wrapping_neg();
    let frames = [
        FrameBuilder::new().physical(Command::Apwr, eighth, 0x0010, &[7, 0]).finish(),
        FrameBuilder::new().physical(Command::Fpwr, 7, 0x0600, &fmmu(28)).finish(),
        FrameBuilder::new().physical(Command::Fprd, 7, 0x0130, &[0; 2]).finish(),
        FrameBuilder::new().logical(Command::Lrw, 28, &[1; 4]).finish(),
        FrameBuilder::new().physical(Command::Bwr, 0, 0x0600, &fmmu(0)).finish(),
        FrameBuilder::new().physical(Command::Bwr, 0, 0x0103, &[1]).finish(),
        FrameBuilder::new().physical(Command::Bwr, 0, 0x0200, &[0xFF; 2]).finish(),
        FrameBuilder::new().physical(Command::Bwr, 0, 0x0010, &[1, 0]).finish(),
        FrameBuilder::new().physical(Command::Bwr, 0, 0x0600, &[0; 16]).finish(),
    ];
    let mut buffer = [0; 1518];
    let mut counters = [0; 9];
    let counted = measure(|| {
        for _ in 0..20 {
            for (frame, counter) in frames.iter().zip(&mut counters) {
                send(&mut twin, frame, &mut buffer);
                *counter += u32::from(buffer[frame.len() - 2]);
                twin.run_for(Duration::from_micros(200));
            }
        }
    });
    assert_eq!((counted.count_total, counted.bytes_total), (0, 0));
    assert_eq!(counters, [1, 1, 1, 2, 20, 20, 20, 20, 20].map(|units| 20 * units));
}

#[test]
fn sdos_allocate_nothing() {
    let mut twin = Twin::from_toml(UNIT).expect("the unit file is good");
    to_op(&mut twin);
    let read_reply = FrameBuilder::new().physical(Command::Aprd, 0, SEND, &[0; MAILBOX_BYTES]).finish();
    let requests = [
        sdo(&[0x40, 0x18, 0x10, 1, 0, 0, 0, 0]),
        sdo(&[0x50, 0x00, 0x1C, 0, 0, 0, 0, 0]),
        sdo(&[0x40, 0x08, 0x10, 0, 0, 0, 0, 0]),
        sdo(&[0x40, 0xFF, 0xFF, 0, 0, 0, 0, 0]),
        sdo(&[0x2B, 0xF3, 0x10, 5, 1, 0, 0, 0]),
    ];
    let mut buffer = [0; 1518];
    let mut replies = 0;
    let counted = measure(|| {
        for _ in 0..200 {
            for request in &requests {
                send(&mut twin, request, &mut buffer);
                twin.run_for(Duration::from_millis(3));
                send(&mut twin, &read_reply, &mut buffer);
                let working_counter_at = read_reply.len() - 2;
                replies += u32::from(buffer[working_counter_at]);
            }
        }
    });
    assert_eq!(replies, 1_000);
    assert_eq!((counted.count_total, counted.bytes_total), (0, 0));
}

/// "RES" in three frames: the controller and its unit restart, and reach OP again.
#[test]
fn an_esc_reset_allocates_nothing() {
    let mut twin = Twin::from_toml(UNIT).expect("the unit file is good");
    to_op(&mut twin);
    let letters = [*b"R", *b"E", *b"S"].map(|letter| apwr(0x0040, &letter));
    let mut buffer = [0; 1518];
    let counted = measure(|| {
        for letter in &letters {
            send(&mut twin, letter, &mut buffer);
            twin.run_for(Duration::from_millis(1));
        }
    });
    assert_eq!((counted.count_total, counted.bytes_total), (0, 0));
    assert_eq!(twin.unit(0).state(), AlState::Init);
    twin.run_for(Duration::from_secs(1));
    to_op(&mut twin);
}

/// A restart from outside, and a cycle of the power.
#[test]
fn a_restart_allocates_nothing() {
    let mut twin = Twin::from_toml(UNIT).expect("the unit file is good");
    to_op(&mut twin);
    let counted = measure(|| {
        twin.unit(0).restart();
        twin.run_for(Duration::from_secs(20));
        twin.unit(0).cycle_power();
        twin.run_for(Duration::from_secs(20));
    });
    assert_eq!((counted.count_total, counted.bytes_total), (0, 0));
    to_op(&mut twin);
}

/// Events on every channel, and storing them. No event has occurred in this process before.
#[test]
fn events_allocate_nothing() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("no_allocation");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder for temporary files");
    let setup = Setup::from_toml(&format!("storage = \"N1.nvm\"\n{UNIT}")).expect("the unit file is good");
    let mut twin = Twin::power_on([setup.with_storage(&folder).expect("a usable folder")]);
    to_op(&mut twin);
    let mut buffer = [0; 1518];
    let outputs = FrameBuilder::new().logical(Command::Lrw, 0, &[1; PROCESS_DATA_BYTES]).finish();
    let requests = [[0x05, 0], [0x13, 0], [0x18, 0]].map(|request| apwr(0x0120, &request));
    let counted = measure(|| {
        for _ in 0..60 {
            send(&mut twin, &outputs, &mut buffer);
            // The watchdog, then a state that does not exist, one that the unit does not have, and back to OP.
            twin.run_for(Duration::from_millis(150));
            for request in &requests {
                send(&mut twin, request, &mut buffer);
                twin.run_for(Duration::from_millis(1));
            }
            let mut unit = twin.unit(0);
            unit.inject(Fault::MessageCommunications);
            unit.inject(Fault::IoCommunications);
            unit.remove(Fault::IoCommunications);
            unit.reset_errors();
            unit.clear_event_log(EventLog::Access);
        }
    });
    assert_eq!((counted.count_total, counted.bytes_total), (0, 0));
    assert_eq!(twin.unit(0).error_log().system.len(), 32);
    assert_eq!(twin.unit(0).state(), AlState::Op);
}

/// A fault that no frame meets, and faults that have ended.
#[test]
fn frames_that_meet_no_fault_allocate_nothing() {
    let mut twin = Twin::from_toml(UNIT).expect("the unit file is good");
    to_op(&mut twin);
    let mut buffer = [0; 1518];
    let outputs = FrameBuilder::new().logical(Command::Lrw, 0, &[1; PROCESS_DATA_BYTES]).finish();
    let of = |choice, kind| Frames::of(choice).with_kind(kind);
    for disturbance in [
        Disturbance::new(FrameFault::Duplicate, of(Choice::Next(1), FrameKind::Any)),
        Disturbance::new(FrameFault::LowerWorkingCounter, of(Choice::All, FrameKind::Any))
            .called("all".parse().expect("a name")),
        Disturbance::new(FrameFault::Lose, of(Choice::All, FrameKind::Sii)),
        Disturbance::new(FrameFault::Lose, of(Choice::Every(1_000_000), FrameKind::Any)),
    ] {
        assert_eq!(twin.disturb(disturbance), Ok(()));
    }
    send(&mut twin, &outputs, &mut buffer);
    assert_eq!(twin.end_fault(&"all".parse().expect("a name")), Ok(()));
    let run = |twin: &mut Twin, buffer: &mut [u8; 1518]| {
        for _ in 0..1_000 {
            send(twin, &outputs, buffer);
            twin.run_for(Duration::from_millis(1));
        }
    };
    let beside_faults = measure(|| run(&mut twin, &mut buffer));
    twin.be_quiet();
    let without = measure(|| run(&mut twin, &mut buffer));
    assert_eq!((beside_faults.count_total, without.count_total), (0, 0));
}
