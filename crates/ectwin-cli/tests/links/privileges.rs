//! The permissions of the process after its links have been opened.

use std::fs;
use std::os::unix::fs::{MetadataExt, PermissionsExt, chown};
use std::path::{Path, PathBuf};

use testbed::{add_veth_pair, in_network_namespace, ip, skip};

use crate::bench::{Master, Twin};

/// Bits of CAP_CHOWN, CAP_DAC_OVERRIDE and CAP_FOWNER.
const CHOWN: u64 = 1 << 0;
const DAC_OVERRIDE: u64 = 1 << 1;
const FOWNER: u64 = 1 << 3;
const NOBODY: u32 = 65_534;

/// A folder of this test, with a unit file that refers to a storage file beside it.
fn unit_with_storage(name: &str) -> (PathBuf, PathBuf) {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _gone = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    let unit = folder.join("unit.toml");
    fs::write(&unit, "model = \"nx-ect101\"\nstorage = \"unit.nvm\"\n").unwrap();
    (folder, unit)
}

/// The lines of each thread that begin with `Cap`, without the name, and whether it can gain new privileges.
fn privileges(process: u32) -> Vec<(Vec<u64>, bool)> {
    let tasks = fs::read_dir(format!("/proc/{process}/task")).unwrap();
    tasks
        .map(|task| {
            let status = fs::read_to_string(task.unwrap().path().join("status")).unwrap();
            let field = |name: &str| {
                status.lines().find_map(|line| line.strip_prefix(name)).map(str::trim).unwrap().to_owned()
            };
            let sets = ["CapInh:", "CapPrm:", "CapEff:", "CapAmb:"];
            let sets = sets.map(|set| u64::from_str_radix(&field(set), 16).unwrap());
            (sets.to_vec(), field("NoNewPrivs:") == "0")
        })
        .collect()
}

#[test]
fn no_thread_has_a_capability_once_the_links_are_open() {
    in_network_namespace("privileges::no_thread_has_a_capability_once_the_links_are_open", || {
        ip(&["link", "set", "lo", "up"]);
        add_veth_pair("m0", "u0");
        let (folder, unit) = unit_with_storage("no-capability");
        let program = folder.join("program.st");
        fs::write(&program, "PROGRAM P\nEND_PROGRAM\n").unwrap();
        let [unit, program, pcap] =
            [unit, program, folder.join("run.pcapng")].map(|path| path.display().to_string());
        // A port below 1024 requires a capability too.
        let arguments =
            [&unit, "--link", "raw:u0", "--modbus", "502", "--program", &program, "--pcap", &pcap];
        let twin = Twin::start_units("no-capability", &arguments.map(|argument| argument as &str));
        // All threads have started when a frame has been answered.
        Master::at("m0").read::<1>(0);
        let threads = privileges(twin.id());
        assert!(threads.len() >= 6, "{threads:?}");
        for thread in threads {
            assert_eq!(thread, (vec![0; 4], false));
        }
        twin.end();
    });
}

#[test]
fn the_superuser_keeps_only_the_way_to_files_of_others() {
    const TEST: &str = "privileges::the_superuser_keeps_only_the_way_to_files_of_others";
    let (folder, unit) = unit_with_storage("of-others");
    if chown(&folder, Some(NOBODY), None).is_err() {
        return skip(TEST, "only the superuser has files of others");
    }
    let unit = unit.display().to_string();
    let twin = Twin::start_units("of-others", &[&unit, "--link", "udp:127.0.0.1:0"]);
    for (sets, may_get_new) in privileges(twin.id()) {
        assert_eq!((sets, may_get_new), (vec![0, DAC_OVERRIDE, DAC_OVERRIDE, 0], false));
    }
    twin.end();
    assert!(folder.join("unit.nvm").exists());
}

#[test]
fn a_memory_file_of_another_user_stays_with_that_user() {
    const TEST: &str = "privileges::a_memory_file_of_another_user_stays_with_that_user";
    let (folder, unit) = unit_with_storage("of-another");
    let memory = folder.join("unit.nvm");
    let unit_name = unit.display().to_string();
    let arguments = [&unit_name, "--link", "udp:127.0.0.1:0"];
    Twin::start_units("of-another", &arguments).end();
    // A folder like /tmp, in which nobody may replace files of others.
    fs::set_permissions(&folder, fs::Permissions::from_mode(0o1777)).unwrap();
    if chown(&folder, Some(NOBODY), None).and_then(|()| chown(&memory, Some(NOBODY), Some(NOBODY))).is_err() {
        return skip(TEST, "only the superuser has files of others");
    }
    for (serial, mode, kept) in [(7, 0o600, CHOWN | DAC_OVERRIDE | FOWNER), (8, 0o666, CHOWN | FOWNER)] {
        fs::set_permissions(&memory, fs::Permissions::from_mode(mode)).unwrap();
        let before = fs::read(&memory).unwrap();
        fs::write(&unit, format!("model = \"nx-ect101\"\nstorage = \"unit.nvm\"\nserial = {serial}\n"))
            .unwrap();
        let twin = Twin::start_units("of-another", &arguments);
        for (sets, may_get_new) in privileges(twin.id()) {
            assert_eq!((sets, may_get_new), (vec![0, kept, kept, 0], false));
        }
        twin.end();
        assert_ne!(fs::read(&memory).unwrap(), before);
        let stored = fs::metadata(&memory).unwrap();
        assert_eq!((stored.uid(), stored.gid(), stored.mode() & 0o7777), (NOBODY, NOBODY, mode));
    }
}

#[test]
fn the_superuser_keeps_the_way_to_the_program_of_a_unit_file() {
    const TEST: &str = "privileges::the_superuser_keeps_the_way_to_the_program_of_a_unit_file";
    for program in ["home/program.st", "home"] {
        let (folder, unit) = unit_with_storage("program-of-another");
        let home = folder.join("home");
        fs::create_dir(&home).unwrap();
        fs::write(home.join("program.st"), "PROGRAM P\nEND_PROGRAM\n").unwrap();
        fs::write(&unit, format!("model = \"nx-ect101\"\n[cpu]\nprogram = \"{program}\"\n")).unwrap();
        fs::set_permissions(&home, fs::Permissions::from_mode(0o700)).unwrap();
        if chown(&home, Some(NOBODY), None).is_err() {
            return skip(TEST, "only the superuser has files of others");
        }
        let unit = unit.display().to_string();
        let twin = Twin::start_units("program-of-another", &[&unit, "--link", "udp:127.0.0.1:0"]);
        for (sets, may_get_new) in privileges(twin.id()) {
            assert_eq!((sets, may_get_new), (vec![0, DAC_OVERRIDE, DAC_OVERRIDE, 0], false));
        }
        twin.end();
    }
}
