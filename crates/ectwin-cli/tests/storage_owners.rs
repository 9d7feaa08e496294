//! A memory file has one owner, is replaced in its place, and survives full disks and kills.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

mod started;

use std::fs;
use std::hint::black_box;
use std::io::{Read, Write};
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::Path;
use std::process::{Child, Command, Stdio};

use ectwin::{Setup, SetupError, Twin};
use nx_ect101::NonVolatileMemory;
use started::{Ended, Started, ended, folder_of, free_link};
use testbed::{has_program, skip};
use wire::{Command as Datagram, FrameBuilder};

const UNIT: &str = "model = \"nx-ect101\"\nstorage = \"N1.nvm\"\n";

fn is_memory(path: &Path) -> bool {
    fs::read(path).is_ok_and(|bytes| NonVolatileMemory::decode(&bytes).is_ok())
}

/// `ectwin run` with these unit files, on a free port.
fn run<'a>(units: &[&'a str], link: &'a str) -> Vec<&'a str> {
    [&["run"], units, &["--link", link]].concat()
}

fn assert_refused(refused: &Ended, words: &str) {
    assert_eq!(refused.code, Some(2), "{}", refused.stderr);
    // A long message is broken into lines.
    let told = refused.stderr.split_whitespace().filter(|word| *word != "|").collect::<Vec<_>>().join(" ");
    assert!(told.contains(words), "`{words}` is not in:\n{}", refused.stderr);
}

#[test]
fn a_second_user_is_refused_with_the_place_while_the_first_one_runs() {
    let folder = folder_of("second");
    fs::write(folder.join("one.toml"), UNIT).unwrap();
    fs::create_dir(folder.join("below")).unwrap();
    fs::write(folder.join("below/link.toml"), UNIT.replace("N1.nvm", "link.nvm")).unwrap();
    symlink("../N1.nvm", folder.join("below/link.nvm")).unwrap();
    let link = free_link();
    let first = Started::new(&folder, "", &run(&["one.toml"], &link)).ready();
    for unit in ["one.toml", "below/link.toml", "below/../one.toml"] {
        let refused = ended(&folder, "", &run(&[unit], &free_link()));
        assert_refused(&refused, "another unit keeps its memory there");
        assert!(refused.stderr.contains(&format!("{unit}:2:")), "{}", refused.stderr);
    }
    assert_eq!(first.interrupt().code, Some(0));
    let second = Started::new(&folder, "", &run(&["below/link.toml"], &link)).ready();
    assert_eq!(second.interrupt().code, Some(0));
    assert!(is_memory(&folder.join("N1.nvm")));
    assert_eq!(fs::read_link(folder.join("below/link.nvm")).unwrap(), Path::new("../N1.nvm"));
}

#[test]
fn a_second_user_that_is_refused_leaves_its_capture_as_it_is() {
    let folder = folder_of("second-capture");
    fs::write(folder.join("one.toml"), UNIT).unwrap();
    // Longer than what a run without frames writes.
    let yesterday = "the capture of yesterday".repeat(1_000);
    fs::write(folder.join("old.pcapng"), &yesterday).unwrap();
    symlink("linked.pcapng", folder.join("link.pcapng")).unwrap();
    let first = Started::new(&folder, "", &run(&["one.toml"], &free_link())).ready();
    for capture in ["old.pcapng", "new.pcapng"] {
        let link = free_link();
        let refused = ended(&folder, "", &[&run(&["one.toml"], &link)[..], &["--pcap", capture]].concat());
        assert_refused(&refused, "another unit keeps its memory there");
    }
    assert_eq!(fs::read_to_string(folder.join("old.pcapng")).unwrap(), yesterday);
    assert!(!folder.join("new.pcapng").exists());
    assert_eq!(first.interrupt().code, Some(0));
    for capture in ["old.pcapng", "new.pcapng", "link.pcapng"] {
        let link = free_link();
        let arguments = [&run(&["one.toml"], &link)[..], &["--pcap", capture]].concat();
        assert_eq!(Started::new(&folder, "", &arguments).ready().interrupt().code, Some(0));
        let written = fs::read(folder.join(capture)).unwrap();
        assert_eq!(written[..4], *b"\x0A\x0D\x0D\x0A", "{capture}");
        assert!(!written.windows(9).any(|bytes| bytes == b"yesterday"), "nothing of the old one is left");
    }
}

#[test]
fn one_memory_for_two_units_of_a_line_is_refused() {
    let folder = folder_of("line");
    fs::write(folder.join("one.toml"), UNIT).unwrap();
    fs::write(folder.join("same.toml"), UNIT.replace("N1.nvm", "./N1.nvm")).unwrap();
    fs::write(folder.join("hard.toml"), UNIT.replace("N1.nvm", "hard.nvm")).unwrap();
    let link = free_link();
    for second in ["one.toml", "same.toml"] {
        assert_refused(&ended(&folder, "", &run(&["one.toml", second], &link)), "another unit keeps");
        assert!(!folder.join("N1.nvm").exists(), "nothing is made");
    }
    Started::new(&folder, "", &run(&["one.toml"], &link)).ready().interrupt();
    fs::hard_link(folder.join("N1.nvm"), folder.join("hard.nvm")).unwrap();
    assert_refused(&ended(&folder, "", &run(&["one.toml", "hard.toml"], &link)), "another unit keeps");
}

#[test]
fn a_file_that_is_no_memory_is_refused_and_left_as_it_is() {
    let folder = folder_of("foreign");
    fs::write(folder.join("unit.toml"), UNIT).unwrap();
    for contents in [&b"my notes"[..], b"", UNIT.as_bytes(), b"ectwnvm"] {
        fs::write(folder.join("N1.nvm"), contents).unwrap();
        assert_refused(
            &ended(&folder, "", &run(&["unit.toml"], &free_link())),
            "is not the memory of a unit",
        );
        assert_eq!(fs::read(folder.join("N1.nvm")).unwrap(), contents);
    }
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 2);
}

#[test]
fn permissions_stay() {
    let folder = folder_of("mode");
    fs::write(folder.join("unit.toml"), UNIT).unwrap();
    let mode = |mode| fs::set_permissions(folder.join("N1.nvm"), fs::Permissions::from_mode(mode)).unwrap();
    for serial in 1..3 {
        // Another serial number is a change, so that the file is replaced.
        fs::write(folder.join("unit.toml"), format!("{UNIT}serial = {serial}\n")).unwrap();
        Started::new(&folder, "", &run(&["unit.toml"], &free_link())).ready().interrupt();
        if serial == 1 {
            mode(0o604);
        }
    }
    assert_eq!(fs::metadata(folder.join("N1.nvm")).unwrap().permissions().mode() & 0o7777, 0o604);
}

#[test]
fn a_full_disk_is_reported_at_once_and_the_memory_is_stored_once_there_is_room() {
    if !has_program("prlimit") {
        return skip("a_full_disk_is_reported_at_once_…", "prlimit is not installed");
    }
    let folder = folder_of("full");
    fs::write(folder.join("unit.toml"), UNIT).unwrap();
    // No file may grow: a write fails like on a full disk, without a full disk.
    let link = free_link();
    let mut unit = Started::new(&folder, "ulimit -S -f 0;", &run(&["unit.toml"], &link)).ready();
    unit.wait_for("N1.nvm: not stored: ");
    assert!(!folder.join("N1.nvm").exists());
    let made_room =
        Command::new("prlimit").args(["--fsize=unlimited:", "--pid", &unit.id()]).status().unwrap();
    assert!(made_room.success());
    unit.wait_for("N1.nvm: stored again");
    assert!(is_memory(&folder.join("N1.nvm")));
    assert_eq!(unit.interrupt().code, Some(0));
}

#[test]
fn a_folder_that_cannot_be_flushed_has_the_memory() {
    // The superuser without the right to read every folder.
    const LIKE_A_USER: &str = "[ \"$(id -u)\" != 0 ] || \
        exec setpriv --bounding-set=-dac_override,-dac_read_search \"$0\" \"$@\";";
    let folder = folder_of("unreadable");
    fs::write(folder.join("unit.toml"), UNIT).unwrap();
    let mode = |mode| fs::set_permissions(&folder, fs::Permissions::from_mode(mode)).unwrap();
    mode(0o333);
    let link = free_link();
    let ended = Started::new(&folder, LIKE_A_USER, &run(&["unit.toml"], &link)).ready().interrupt();
    mode(0o777);
    assert_eq!((ended.code, ended.stderr.as_str()), (Some(0), ""));
    assert!(is_memory(&folder.join("N1.nvm")));
}

#[test]
fn a_disk_that_stays_full_loses_nothing_that_was_stored() {
    let folder = folder_of("stays-full");
    fs::write(folder.join("unit.toml"), UNIT).unwrap();
    Started::new(&folder, "", &run(&["unit.toml"], &free_link())).ready().interrupt();
    let stored = fs::read(folder.join("N1.nvm")).unwrap();
    fs::write(folder.join("unit.toml"), format!("{UNIT}serial = 7\n")).unwrap();
    let link = free_link();
    let mut unit = Started::new(&folder, "ulimit -f 0;", &run(&["unit.toml"], &link)).ready();
    unit.wait_for("N1.nvm: not stored: ");
    let ended = unit.interrupt();
    assert!(ended.stderr.contains("the last changes are lost"), "{}", ended.stderr);
    assert!(ended.stderr.contains("error: cannot write "), "{}", ended.stderr);
    assert_eq!(ended.code, Some(2), "{}", ended.stderr);
    assert_eq!(fs::read(folder.join("N1.nvm")).unwrap(), stored);
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 2, "nothing else is left");
}

#[test]
fn a_full_disk_under_the_capture_is_reported_at_once_and_the_units_go_on() {
    let folder = folder_of("capture");
    fs::write(folder.join("unit.toml"), "model = \"nx-ect101\"\n").unwrap();
    let link = free_link();
    let arguments = [run(&["unit.toml"], &link), vec!["--pcap", "/dev/full"]].concat();
    let mut unit = Started::new(&folder, "", &arguments).ready();
    // No frame has been received yet.
    unit.wait_for("the capture /dev/full cannot be written: No space left on device");
    let ended = unit.interrupt();
    assert_eq!(ended.code, Some(2), "{}", ended.stderr);
    assert!(ended.stderr.contains("cannot write /dev/full"), "{}", ended.stderr);
}

/// The folder for the child. Without it [`the_owner_that_is_killed`] does nothing.
const CHILD: &str = "ECTWIN_TEST_OWNER_CHILD";
const KILLS: u64 = 100;

/// The messages of a child, as bytes that no test harness prints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Said {
    Refused = 1,
    Owner = 2,
    Damaged = 3,
    FrameSent = 4,
}

fn say(said: Said) {
    let mut out = std::io::stdout().lock();
    out.write_all(&[said as u8]).and_then(|()| out.flush()).unwrap();
}

/// The child of the test below: claims the memory repeatedly until it gets it, and then changes it continuously.
#[test]
fn the_owner_that_is_killed() {
    let Some(folder) = std::env::var_os(CHILD) else { return };
    let folder = Path::new(&folder);
    let mut twin = loop {
        match Setup::from_toml(UNIT).unwrap().with_storage(folder) {
            Ok(setup) => break Twin::power_on([setup]),
            Err(SetupError::Storage { reason, .. }) if reason.contains("another unit") => say(Said::Refused),
            Err(error) => panic!("{error}"),
        }
        // Until the parent has killed the owner.
        std::io::stdin().read_exact(&mut [0]).unwrap();
    };
    let aside = fs::read_dir(folder)
        .unwrap()
        .any(|entry| entry.unwrap().path().to_string_lossy().contains("damaged"));
    say(if aside { Said::Damaged } else { Said::Owner });
    for word in (0..=u16::MAX).cycle() {
        let write = [&[0x01, 0x02][..], &0x03F0_u32.to_le_bytes(), &word.to_le_bytes()].concat();
        let mut frame = FrameBuilder::new().physical(Datagram::Apwr, 0, 0x0502, &write).finish();
        twin.frame(&mut frame);
        say(Said::FrameSent);
    }
}

struct Owner(Child);

impl Owner {
    fn start(folder: &Path) -> Self {
        let mut program = Command::new(std::env::current_exe().unwrap());
        program.args(["--exact", "the_owner_that_is_killed", "--nocapture"]).env(CHILD, folder);
        Self(program.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::inherit()).spawn().unwrap())
    }

    /// Its next message.
    fn said(&mut self) -> Said {
        loop {
            let mut byte = [0];
            self.0.stdout.as_mut().unwrap().read_exact(&mut byte).unwrap();
            let all = [Said::Refused, Said::Owner, Said::Damaged, Said::FrameSent];
            if let Some(said) = all.into_iter().find(|said| *said as u8 == byte[0]) {
                return said;
            }
        }
    }
}

impl Drop for Owner {
    fn drop(&mut self) {
        // An error means that it has ended.
        let _ = self.0.kill().and_then(|()| self.0.wait());
    }
}

#[test]
fn of_two_processes_with_one_memory_the_second_waits_and_after_each_kill_it_finds_a_whole_one() {
    let folder = folder_of("killed");
    let mut owner = Owner::start(&folder);
    assert_eq!(owner.said(), Said::Owner);
    for kill in 0..KILLS {
        let mut second = Owner::start(&folder);
        assert_eq!(second.said(), Said::Refused, "kill {kill}");
        // A different time in each run: a number of frames, and a short wait.
        for _ in 0..=(kill * 7919) % 300 {
            assert_eq!(owner.said(), Said::FrameSent);
        }
        for spin in 0..(kill * 104_729) % 2_000_000 {
            black_box(spin);
        }
        drop(owner);
        second.0.stdin.as_mut().unwrap().write_all(&[0]).unwrap();
        assert_eq!(second.said(), Said::Owner, "kill {kill}");
        owner = second;
    }
    drop(owner);
    assert!(is_memory(&folder.join("N1.nvm")));
    // An owner that ends normally does not change the memory.
    drop(Setup::from_toml(UNIT).unwrap().with_storage(&folder).unwrap());
    let names: Vec<_> = fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(names, ["N1.nvm"]);
}
