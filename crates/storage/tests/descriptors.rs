//! A file is replaced even if the process has no file descriptor left. Alone in its process, which it exhausts.

use std::fs::{self, File};

use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};
use storage::StoredFile;

/// More than the test needs at its start.
const DESCRIPTORS: u64 = 64;

#[test]
fn a_file_is_written_again_and_again_without_a_free_descriptor() {
    let folder = std::env::temp_dir().join(format!("ectwin-descriptors-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("a folder for temporary files");
    fs::write(folder.join("old.nvm"), "old").expect("writable");
    let names = ["old.nvm", "new.nvm"];
    let mut files = names.map(|name| StoredFile::claim(&folder.join(name)).expect("free"));
    let limit = getrlimit(Resource::Nofile);
    setrlimit(Resource::Nofile, Rlimit { current: Some(DESCRIPTORS), ..limit }).expect("lower than before");
    let mut clients = Vec::new();
    while let Ok(client) = File::open("/dev/null") {
        clients.push(client);
    }
    for contents in ["first", "second", "third"] {
        for file in &mut files {
            file.write(contents.as_bytes()).expect("a descriptor in reserve");
            assert!(File::open("/dev/null").is_err(), "the reserve is kept, so nobody else can use it");
        }
    }
    drop((files, clients));
    for name in names {
        assert_eq!(fs::read(folder.join(name)).expect("there"), b"third");
    }
    fs::remove_dir_all(&folder).expect("ours");
}
