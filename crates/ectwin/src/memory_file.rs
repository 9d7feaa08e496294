//! The non-volatile memory of units in files.

use std::io;
use std::path::Path;

use esc::Esc;
use storage::{ChangesLost, StoredFile};
use unit_model::{MemoryAtPowerOn, MemoryDamage, ModelUnit, UnitSection};

/// The contents of a unit's file, and its owner from now on.
#[derive(Debug)]
pub(crate) struct MemoryFile {
    found: MemoryAtPowerOn,
    writer: storage::Writer,
}

impl MemoryFile {
    /// Claims the file for this unit, and reads it. A damaged file is renamed and not changed; the unit starts
    /// with the fault in the manual, and stores a new memory after its power was cycled. A file that has never
    /// been a memory is refused, and not changed.
    pub(crate) fn open(path: &Path, section: &dyn UnitSection) -> io::Result<Self> {
        let file = StoredFile::claim(path)?;
        let found = match file.read()?.map(|bytes| section.check_memory(&bytes).map(|()| bytes)) {
            None => MemoryAtPowerOn::Factory,
            Some(Ok(bytes)) => MemoryAtPowerOn::Stored(bytes),
            Some(Err(MemoryDamage::NoMemory)) => return Err(no_memory()),
            Some(Err(damage @ MemoryDamage::Damaged(_))) => {
                let aside = file.set_aside()?;
                tracing::error!("{}: {damage}; renamed to {}", path.display(), aside.display());
                MemoryAtPowerOn::Damaged
            }
        };
        let writer = storage::Writer::start(file, section.memory_bytes_max(&found))?;
        Ok(Self { found, writer })
    }

    /// The contents, and the writer.
    pub(crate) fn into_parts(self) -> (MemoryAtPowerOn, storage::Writer) {
        (self.found, self.writer)
    }
}

/// Whether a unit can keep its memory in this file, which is neither made nor changed nor claimed. A damaged memory is
/// no reason against it.
pub(crate) fn check(path: &Path, section: &dyn UnitSection) -> io::Result<()> {
    match StoredFile::peek(path)?.map(|bytes| section.check_memory(&bytes)) {
        Some(Err(MemoryDamage::NoMemory)) => Err(no_memory()),
        None | Some(Ok(()) | Err(MemoryDamage::Damaged(_))) => Ok(()),
    }
}

fn no_memory() -> io::Error {
    let words = "it exists, but it is not the memory of a unit; it is not changed";
    io::Error::new(io::ErrorKind::InvalidData, words)
}

/// Stores the memory of one unit in its file.
#[derive(Debug)]
pub(crate) struct Keeper(storage::Writer);

impl Keeper {
    /// Stores a memory by this writer.
    pub(crate) const fn new(writer: storage::Writer) -> Self {
        Self(writer)
    }

    /// Passes the memory of the unit to its writer, if it has changed. This does not wait for the disk.
    pub(crate) fn keep(&mut self, unit: &mut dyn ModelUnit, esc: &Esc) {
        if unit.take_memory_change(esc.sii_image(), esc.sii_words_written()) {
            self.0.store(|bytes| unit.encode_memory(bytes));
        }
    }

    /// Waits until the last change is stored, or refused again.
    pub(crate) fn finish(self) -> Result<(), ChangesLost> {
        self.0.finish()
    }
}
