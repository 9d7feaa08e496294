//! A line of units in real time, and the access to it from other threads.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use ectwin::link::memory::{MemoryPort, pair};
use ectwin::link::{FRAME_BUFFER_BYTES, FramePort};
use ectwin::{AlState, AlStatusCode, Duration, Live, Setup, Twin, UnitStatus};
use wire::{Command, FrameBuilder};

const COUPLER: &str = "model = \"digital\"\nname = \"K1\"";
const AL_CONTROL: u16 = 0x0120;

fn served(setup: Setup) -> (Live, MemoryPort) {
    let (ours, units) = pair();
    (Twin::power_on([setup]).serve(units).unwrap(), ours)
}

/// Requests a state of the first unit, and waits for the return of the frame.
fn request(port: &mut MemoryPort, al_control: u16) {
    port.send(
        &FrameBuilder::new().physical(Command::Apwr, 0, AL_CONTROL, &al_control.to_le_bytes()).finish(),
    )
    .unwrap();
    while port.receive(&mut [0; FRAME_BUFFER_BYTES], Duration::from_secs(5)).unwrap().is_none() {}
}

/// A thread of the units that sleeps up to 100 ms on a silent link would need minutes for these.
#[test]
fn access_to_a_unit_does_not_wait_for_a_frame() {
    let (live, _ours) = served(Setup::from_toml(COUPLER).unwrap());
    for _ in 0..5_000 {
        assert_eq!(live.look(0, |unit| unit.state()), AlState::Init);
    }
    live.stop().unwrap();
}

#[test]
fn threads_that_access_a_unit_at_the_same_time_wait_for_each_other_and_frames_are_answered() {
    let (live, mut ours) = served(Setup::from_toml("model = \"nx-ect101\"").unwrap());
    let inside = &AtomicBool::new(false);
    std::thread::scope(|scope| {
        for _ in 0..4 {
            let handle = live.handle();
            scope.spawn(move || {
                for _ in 0..200 {
                    handle.look(0, |_| {
                        assert!(!inside.swap(true, Ordering::SeqCst), "another thread has access");
                        std::thread::yield_now();
                        inside.store(false, Ordering::SeqCst);
                    });
                }
            });
        }
        (0..200).for_each(|_| request(&mut ours, 1));
    });
    assert_eq!(live.stop().unwrap().frames, 200);
}

#[test]
fn the_status_of_a_unit_is_published() {
    let (live, mut ours) = served(Setup::from_toml(COUPLER).unwrap());
    let status = |live: &Live| {
        // What was requested before an access is done and published after it.
        live.look(0, |unit| unit.state());
        live.status(0)
    };
    let init = live.status(0);
    assert!(init.has_power);
    assert_eq!((init.al_status.state, init.al_status_code), (AlState::Init, AlStatusCode(0)));
    request(&mut ours, 2);
    assert_eq!(status(&live).al_status.state, AlState::PreOp);
    request(&mut ours, 3);
    let UnitStatus { al_status, al_status_code, .. } = status(&live);
    assert_eq!((al_status.state, al_status.error, al_status_code.0 != 0), (AlState::PreOp, true, true));
    live.look(0, |unit| unit.cycle_power());
    assert_eq!(live.status(0).al_status.state, AlState::Init);
}

#[test]
#[should_panic = "there is no unit at position 1: the line has 1"]
fn the_status_of_a_unit_beyond_the_line_is_a_mistake_of_the_caller() {
    let (live, _ours) = served(Setup::from_toml(COUPLER).unwrap());
    let _ = live.status(1);
}

#[test]
fn units_are_accessible_after_the_link_was_closed() {
    let (live, mut ours) = served(Setup::from_toml(COUPLER).unwrap());
    let handle = live.handle();
    request(&mut ours, 2);
    drop(ours);
    live.stop().unwrap();
    assert_eq!(handle.look(0, |unit| unit.state()), AlState::PreOp);
    handle.look(0, |unit| unit.cycle_power());
    assert_eq!(handle.status(0).al_status.state, AlState::Init);
}

/// The folder of one test, empty at first.
fn folder_of(test: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    path
}

#[test]
fn a_changed_program_is_reloaded_on_a_served_link_too() {
    let program = folder_of("a_changed_program").join("program.st");
    let write = |value: u8| fs::write(&program, format!("I1_Input_1 := {value} = 1;")).unwrap();
    write(0);
    let setup = Setup::from_toml("model = \"digital\"\nname = \"I1\"\ninputs = 8").unwrap();
    let (live, mut ours) = served(setup.program_file(&program).unwrap());
    let input =
        |live: &Live| live.look(0, |unit| unit.io().read(unit.io().find("I1_Input_1").unwrap()).unwrap()[0]);
    assert_eq!(input(&live), 0);
    write(1);
    // The test ends by its own limit if the program is not reloaded.
    while input(&live) == 0 {
        ours.receive(&mut [0; FRAME_BUFFER_BYTES], Duration::from_millis(10)).unwrap();
    }
}
