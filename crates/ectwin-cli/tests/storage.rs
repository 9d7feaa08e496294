//! The non-volatile memory in a file: contents that a unit finds again, a damaged file, kills at any time.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

use std::fs;
use std::hint::black_box;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use ectwin::master::{Address, DirectAccess};
use ectwin::{Duration, EventLog, Fault, Setup, SetupError, Twin};
use nx_ect101::NonVolatileMemory;

const UNIT: &str = "model = \"nx-ect101\"\nstart_up = \"0ms\"\nid_switch = 0x00\nstorage = \"N1.nvm\"\n";
/// A word of the EEPROM without meaning.
const SPARE_WORD: u32 = 0x03F0;
const ALIAS_WORD: u32 = 4;

const UNIT_1: Address = Address::Position(0);
const STATION_ALIAS: u16 = 0x0012;
const AL_CONTROL: u16 = 0x0120;
const AL_STATUS: u16 = 0x0130;
const SII_CONTROL: u16 = 0x0502;

/// The folder of one test, empty at first.
fn folder_of(test: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).expect("a folder for temporary files");
    path
}

fn start(folder: &Path) -> Twin {
    let setup = Setup::from_toml(UNIT).expect("a right file").with_storage(folder);
    Twin::power_on([setup.expect("a usable folder")])
}

fn stored(folder: &Path) -> Option<NonVolatileMemory> {
    let bytes = fs::read(folder.join("N1.nvm")).ok()?;
    Some(NonVolatileMemory::decode(&bytes).expect("whole"))
}

fn access(twin: &mut Twin) -> DirectAccess<&mut Twin> {
    let now = twin.now();
    DirectAccess::new(twin, now)
}

/// AL status and AL status code.
fn al_status(twin: &mut Twin) -> (u8, u16) {
    let status = access(twin).read(UNIT_1, AL_STATUS, 6).0;
    (status[0], u16::from_le_bytes([status[4], status[5]]))
}

fn write_sii(twin: &mut Twin, word_address: u32, word: u16) {
    let command = 0x0201_u16.to_le_bytes();
    let write = [&command[..], &word_address.to_le_bytes(), &word.to_le_bytes()].concat();
    access(twin).write(UNIT_1, SII_CONTROL, &write);
}

/// Sets the station alias like a master's tool: word 4, and the checksum in word 7.
fn write_alias(twin: &mut Twin, folder: &Path, alias: u16) {
    let memory = stored(folder).expect("stored");
    let mut configuration: [u8; 14] = memory.sii_image()[..14].try_into().expect("14 bytes");
    configuration[8..10].copy_from_slice(&alias.to_le_bytes());
    write_sii(twin, ALIAS_WORD, alias);
    write_sii(twin, 7, u16::from(esi::sii::checksum(&configuration)));
}

#[test]
fn what_a_master_writes_outlives_power_off() {
    let folder = folder_of("outlives");
    drop(start(&folder));
    let mut twin = start(&folder);
    write_alias(&mut twin, &folder, 0x0456);
    write_sii(&mut twin, SPARE_WORD, 0xCAFE);
    drop(twin);

    let mut twin = start(&folder);
    assert_eq!(access(&mut twin).read(UNIT_1, STATION_ALIAS, 2).0, 0x0456_u16.to_le_bytes());
    drop(twin);
    let memory = stored(&folder).expect("stored");
    assert_eq!(memory.software_id(), 0x0456);
    assert_eq!(memory.sii_image()[2 * SPARE_WORD as usize..][..2], [0xFE, 0xCA]);
}

#[test]
fn a_damaged_file_is_a_fault_and_is_kept_aside() {
    let folder = folder_of("damaged");
    drop(start(&folder));
    let path = folder.join("N1.nvm");
    let mut damaged = fs::read(&path).expect("stored");
    damaged[200] ^= 1;
    fs::write(&path, &damaged).expect("writable");

    let mut twin = start(&folder);
    assert_eq!(al_status(&mut twin), (0x11, 0x0002));
    access(&mut twin).write(UNIT_1, AL_CONTROL, &[0x12, 0]);
    assert_eq!(al_status(&mut twin), (0x11, 0x0002), "no way out of INIT");
    write_sii(&mut twin, SPARE_WORD, 1);
    drop(twin);
    assert!(!path.exists(), "a unit with a damaged memory stores nothing");
    assert_eq!(fs::read(folder.join("N1.nvm.damaged-1")).expect("kept"), damaged);

    let mut twin = start(&folder);
    assert_eq!(al_status(&mut twin), (0x01, 0x0000), "new memory");
}

/// The system events in the file.
fn stored_events(folder: &Path) -> Vec<String> {
    let memory = stored(folder).expect("stored");
    memory.error_log().history().map(|record| record.event.to_string()).collect()
}

#[test]
fn what_happens_right_before_power_off_is_stored() {
    let folder = folder_of("before_power_off");
    let mut twin = start(&folder);
    twin.unit(0).inject(Fault::IoCommunications);
    drop(twin);
    assert_eq!(stored_events(&folder), ["80200000"]);

    let (near, far) = ectwin::link::memory::pair();
    let live = start(&folder).serve(far).expect("threads");
    live.look(0, |unit| unit.inject(Fault::IoCommunications));
    drop((live, near));
    assert_eq!(stored_events(&folder), ["80200000"; 2]);
}

#[test]
fn what_changes_while_the_memory_is_broken_is_stored_once_it_is_sound() {
    let folder = folder_of("broken");
    let mut twin = start(&folder);
    twin.unit(0).inject(Fault::IoCommunications);
    twin.unit(0).inject(Fault::NonVolatileMemory);
    twin.unit(0).cycle_power();
    twin.run_for(Duration::from_millis(2));
    twin.unit(0).clear_event_log(EventLog::System);
    twin.run_for(Duration::from_millis(2));
    twin.unit(0).remove(Fault::IoCommunications);
    twin.unit(0).remove(Fault::NonVolatileMemory);
    twin.unit(0).cycle_power();
    let in_use = twin.unit(0).error_log().clone();
    drop(twin);
    assert_eq!(stored(&folder).expect("stored").error_log(), &in_use);
    assert_eq!(stored_events(&folder).last().map(String::as_str), Some("90400000"));
}

#[test]
fn a_damaged_memory_is_new_when_the_power_was_cycled() {
    let folder = folder_of("new");
    let path = folder.join("N1.nvm");
    drop(start(&folder));
    let mut damaged = fs::read(&path).expect("stored");
    damaged.truncate(100);
    fs::write(&path, &damaged).expect("writable");
    let mut twin = start(&folder);
    twin.unit(0).remove(Fault::NonVolatileMemory);
    twin.unit(0).restart();
    assert_eq!(al_status(&mut twin), (0x11, 0x0002), "a restart does not mend it, nor is it injected");
    twin.run_for(Duration::from_millis(2));
    assert!(!path.exists(), "nothing is stored in a broken memory");
    twin.unit(0).cycle_power();
    assert_eq!(al_status(&mut twin), (0x01, 0x0000));
    twin.unit(0).inject(Fault::IoCommunications);
    drop(twin);
    assert_eq!(stored_events(&folder), ["80200000"]);
    assert_eq!(fs::read(folder.join("N1.nvm.damaged-1")).expect("kept"), damaged);
}

#[test]
fn a_folder_that_is_missing_is_an_error() {
    let folder = folder_of("missing").join("nowhere");
    let setup = Setup::from_toml(UNIT).expect("a right file").with_storage(&folder);
    assert!(matches!(setup, Err(SetupError::Storage { .. })));
}

#[test]
fn the_command_points_at_a_storage_that_it_cannot_use() {
    let folder = folder_of("command");
    let file = folder.join("unit.toml");
    fs::write(&file, "model = \"nx-ect101\"\nstorage = \"nowhere/N1.nvm\"\n").expect("writable");
    let mut ectwin = Command::new(env!("CARGO_BIN_EXE_ectwin"));
    let output = ectwin.arg("run").arg(&file).args(["--link", "udp:127.0.0.1:0"]).output().expect("runs");
    assert_eq!(output.status.code(), Some(2));
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(told.contains("nowhere/N1.nvm cannot be used") && told.contains("unit.toml:2:"), "{told}");
}

/// The folder for the child. Without it [`the_writer_that_is_killed`] does nothing.
const CHILD: &str = "ECTWIN_TEST_STORAGE_CHILD";
/// The child has sent one more frame.
const PROGRESS: u8 = 0x01;
const KILLS: u64 = 200;

/// The child of the test below: a master that writes the EEPROM continuously.
#[test]
fn the_writer_that_is_killed() {
    let Some(folder) = std::env::var_os(CHILD) else { return };
    let mut twin = start(Path::new(&folder));
    for generation in 0..=u16::MAX {
        write_sii(&mut twin, SPARE_WORD, generation);
        write_sii(&mut twin, SPARE_WORD + 1, !generation);
        let mut out = std::io::stdout().lock();
        out.write_all(&[PROGRESS]).and_then(|()| out.flush()).expect("the parent listens");
    }
    // Until the kill comes.
    std::thread::park();
}

/// Starts the child, waits until it has sent `frames` frames, waits for `spins` iterations and kills it (SIGKILL).
fn kill_a_writer(folder: &Path, frames: u64, spins: u64) {
    let program = std::env::current_exe().expect("this test");
    let mut child = Command::new(program)
        .args(["--exact", "the_writer_that_is_killed", "--nocapture"])
        .env(CHILD, folder)
        .stdout(Stdio::piped())
        .spawn()
        .expect("a child");
    // Open until the kill: a child whose output is closed would end without the kill.
    let mut out = child.stdout.take().expect("piped");
    let mut sent = 0;
    while sent < frames {
        let mut byte = [0];
        out.read_exact(&mut byte).expect("the child lives");
        sent += u64::from(byte == [PROGRESS]);
    }
    for spin in 0..spins {
        black_box(spin);
    }
    child.kill().expect("killed");
    assert_eq!(child.wait().expect("ended").code(), None, "ended by the signal");
}

/// The same numbers in every run (SplitMix64).
fn random(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let mixed = (*state ^ *state >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
    mixed ^ mixed >> 31
}

#[test]
fn a_kill_at_any_moment_leaves_a_whole_state() {
    let folder = folder_of("killed");
    let mut seed = 1;
    let mut states = std::collections::BTreeSet::new();
    for kill in 0..KILLS {
        // Enough frames that the disk has stored some, even on a machine with other load.
        let (frames, spins) = (1 + random(&mut seed) % 4_000, random(&mut seed) % 3_000_000);
        kill_a_writer(&folder, frames, spins);
        let mut twin = start(&folder);
        assert_eq!(al_status(&mut twin), (0x01, 0x0000), "after kill {kill}");
        drop(twin);
        let image = stored(&folder).expect("stored at the start").sii_image().to_vec();
        let spare = &image[2 * SPARE_WORD as usize..][..4];
        let generation = u16::from_le_bytes([spare[0], spare[1]]);
        states.insert(generation);
        let second = u16::from_le_bytes([spare[2], spare[3]]);
        // Each word is a separate change: the second one is from this generation or from the one before.
        let erased = (generation, second) == (0xFFFF, 0xFFFF);
        let whole = second == !generation || second == !generation.wrapping_sub(1);
        assert!(erased || whole || generation == 0, "after kill {kill}: {generation:#06X}, {second:#06X}");
    }
    assert!(states.len() > KILLS as usize / 4, "only {} different moments", states.len());
    let names = fs::read_dir(&folder).expect("readable").map(|entry| entry.expect("readable").file_name());
    assert!(names.map(|name| name.to_string_lossy().into_owned()).all(|name| !name.contains("damaged")));
}
