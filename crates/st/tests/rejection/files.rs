//! The files under `tests/broken`.

use std::fs;
use std::path::Path;

use crate::problems;

const FILES_MIN: usize = 130;

#[test]
fn each_broken_file_gets_its_problems() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/broken");
    let entries = fs::read_dir(folder).expect("the broken files").map(|entry| entry.expect("a file").path());
    let mut files: Vec<_> =
        entries.filter(|path| path.extension().is_some_and(|ending| ending == "st")).collect();
    files.sort();
    assert!(files.len() >= FILES_MIN, "{} files are found", files.len());
    for file in files {
        // Invalid bytes are replaced, as when a file is read.
        let source = String::from_utf8_lossy(&fs::read(&file).expect("a file")).into_owned();
        problems(&file.display().to_string(), &source);
    }
}
