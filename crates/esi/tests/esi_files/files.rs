//! The ESI files of the project.

use std::fs;
use std::path::PathBuf;

use esi::file::EsiFile;

/// Those that describe devices.
pub(crate) const NAMES: [&str; 12] = [
    "analog-inputs.xml",
    "boot.xml",
    "coupler.xml",
    "digital-terminals.xml",
    "drive.xml",
    "encoder.xml",
    "minimal.xml",
    "mixed-bits.xml",
    "modular.xml",
    "sensor.xml",
    "two-input-areas.xml",
    "valves.xml",
];

/// The contents of a file.
pub(crate) fn bytes(name: &str) -> Vec<u8> {
    fs::read(folder().join(name)).unwrap()
}

/// A file that has been read, with the files that it names.
pub(crate) fn read(name: &str) -> EsiFile {
    EsiFile::read(&bytes(name), &external).unwrap()
}

/// A file beside the others.
pub(crate) fn external(name: &str) -> Option<Vec<u8>> {
    fs::read(folder().join(name)).ok()
}

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../units/esi")
}
