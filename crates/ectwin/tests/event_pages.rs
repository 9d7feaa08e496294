//! docs/events has one page for each event with the output of `ectwin explain`, and no other pages.

use std::collections::BTreeSet;
use std::io;
use std::path::{Path, PathBuf};

use ectwin::explain::event_pages;

/// If this is set, the test writes the pages instead of comparing them.
const BLESS: &str = "ECTWIN_BLESS";

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/events")
}

fn files() -> io::Result<BTreeSet<String>> {
    let names = std::fs::read_dir(folder())?
        .map(|entry| entry.map(|entry| entry.file_name().to_string_lossy().into_owned()));
    names.collect()
}

fn bless() -> io::Result<()> {
    std::fs::create_dir_all(folder())?;
    for file in files()? {
        std::fs::remove_file(folder().join(file))?;
    }
    event_pages().into_iter().try_for_each(|page| std::fs::write(folder().join(page.file_name), page.text))
}

#[test]
fn every_event_has_its_page_and_there_is_no_other() {
    if std::env::var_os(BLESS).is_some() {
        bless().expect("docs/events can be written");
    }
    let pages = event_pages();
    let expected: BTreeSet<String> = pages.iter().map(|page| page.file_name.clone()).collect();
    assert_eq!((pages.len(), expected.len()), (39, 39), "38 events and the index");
    assert_eq!(files().expect("docs/events"), expected, "missing or superfluous: cargo xtask bless");
    for page in pages {
        let written = std::fs::read_to_string(folder().join(&page.file_name)).expect("the page");
        assert_eq!(written, page.text, "{}: cargo xtask bless", page.file_name);
    }
}
