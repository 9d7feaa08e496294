//! The non-volatile memory of units in files.

use std::io;
use std::path::Path;

use device::Network;
use nx_ect101::{Damage, MemoryAtPowerOn, NonVolatileMemory, NxEct101, UnitSettings};
use storage::{ChangesLost, StoredFile};

/// The contents of a unit's file, and its owner from now on.
#[derive(Debug)]
pub(crate) struct MemoryFile {
    found: MemoryAtPowerOn,
    /// None for a memory without a file.
    writer: Option<storage::Writer>,
}

impl MemoryFile {
    /// A memory without a file: it is new, and it is not stored.
    pub(crate) const fn none() -> Self {
        Self { found: MemoryAtPowerOn::Factory, writer: None }
    }

    /// Claims the file for this unit, and reads it. A damaged file is renamed and not changed; the unit starts
    /// with the fault in the manual, and stores a new memory after its power was cycled. A file that has never
    /// been a memory is refused, and not changed.
    pub(crate) fn open(path: &Path) -> io::Result<Self> {
        let file = StoredFile::claim(path)?;
        let found = match file.read()?.map(|bytes| NonVolatileMemory::decode(&bytes)) {
            None => MemoryAtPowerOn::Factory,
            Some(Ok(memory)) => MemoryAtPowerOn::Stored(Box::new(memory)),
            Some(Err(Damage::NoMemory)) => {
                let words = "it is there, and is not the memory of a unit; it is left as it is";
                return Err(io::Error::new(io::ErrorKind::InvalidData, words));
            }
            Some(Err(damage)) => {
                let aside = file.set_aside()?;
                tracing::error!("{}: {damage}; kept as {}", path.display(), aside.display());
                MemoryAtPowerOn::Damaged
            }
        };
        let writer = storage::Writer::start(file, room_bytes(&found))?;
        Ok(Self { found, writer: Some(writer) })
    }

    /// The contents, and the writer.
    pub(crate) fn into_parts(self) -> (MemoryAtPowerOn, Option<storage::Writer>) {
        (self.found, self.writer)
    }
}

/// Room for the memory with full logs, so that storing it allocates nothing.
fn room_bytes(found: &MemoryAtPowerOn) -> usize {
    match found {
        MemoryAtPowerOn::Stored(memory) => memory.encoded_bytes_max(),
        MemoryAtPowerOn::Factory | MemoryAtPowerOn::Damaged => {
            NonVolatileMemory::factory(&UnitSettings::default()).encoded_bytes_max()
        }
    }
}

/// Stores the memory of one unit in its file.
#[derive(Debug)]
pub(crate) struct Keeper {
    position: usize,
    writer: storage::Writer,
}

impl Keeper {
    /// Stores the memory of the unit at `position`, counted from the master.
    pub(crate) const fn new(position: usize, writer: storage::Writer) -> Self {
        Self { position, writer }
    }

    /// Passes the memory to its writer, if it has changed. This does not wait for the disk.
    pub(crate) fn keep(&mut self, network: &mut Network<NxEct101>) {
        let Some((device, esc)) = network.slave_mut(self.position) else { return };
        let unit = device.unit_mut();
        if unit.take_memory_change(esc.sii_image(), esc.sii_words_written()) {
            self.writer.store(|bytes| unit.memory().encode_into(bytes));
        }
    }

    /// Waits until the last change is stored, or refused again.
    pub(crate) fn finish(self) -> Result<(), ChangesLost> {
        self.writer.finish()
    }
}
