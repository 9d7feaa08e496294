//! The process data of a slave as its unit sees them: all outputs as one block, all inputs as one block.

use arrayvec::ArrayVec;
use esc::{Pdi, SmIndex, SmMode};

use crate::sync_managers::{Buffers, DataDirection, ProcessDataConfig, SYNC_MANAGERS_MAX};

/// The location of outputs and inputs while the unit accesses them.
#[derive(Debug)]
pub(crate) enum ProcessImage {
    /// In the buffers of the controller: one SyncManager of three buffers in each direction, or none.
    InPlace { outputs: Option<SmIndex>, inputs: Option<SmIndex> },
    /// In separate memory, collected from several SyncManagers, or from single buffers.
    Gathered { outputs: Gathered, inputs: Gathered },
}

impl ProcessImage {
    /// The image of these SyncManagers. All the memory that it ever uses is allocated here.
    pub(crate) fn new(process_data: &[ProcessDataConfig]) -> Self {
        let of = |direction| process_data.iter().filter(move |described| described.direction == direction);
        let in_place = |direction| {
            let mut all = of(direction);
            let first = all.next();
            let is_alone = all.next().is_none() && first.is_none_or(|only| only.buffers == Buffers::Three);
            is_alone.then(|| first.map(|only| only.sync_manager))
        };
        match (in_place(DataDirection::Outputs), in_place(DataDirection::Inputs)) {
            (Some(outputs), Some(inputs)) => Self::InPlace { outputs, inputs },
            _ => Self::Gathered {
                outputs: Gathered::new(of(DataDirection::Outputs)),
                inputs: Gathered::new(of(DataDirection::Inputs)),
            },
        }
    }

    /// Gives the newest complete outputs to the unit and lets it fill the inputs, which the master gets afterwards.
    pub(crate) fn exchange(&mut self, pdi: &mut Pdi<'_>, exchange: impl FnOnce(&[u8], &mut [u8])) {
        match self {
            Self::InPlace { outputs, inputs } => pdi.exchange(*outputs, *inputs, exchange),
            Self::Gathered { outputs, inputs } => {
                outputs.take_from(pdi);
                exchange(outputs.bytes(pdi), inputs.bytes_mut(pdi));
                inputs.give_to(pdi);
            }
        }
    }
}

/// The data of one direction.
#[derive(Debug)]
pub(crate) struct Gathered {
    sync_managers: ArrayVec<SmIndex, SYNC_MANAGERS_MAX>,
    bytes: Box<[u8]>,
}

impl Gathered {
    fn new<'a>(described: impl Iterator<Item = &'a ProcessDataConfig> + Clone) -> Self {
        let max_bytes = described.clone().map(|one| usize::from(one.length.max_bytes())).sum();
        Self {
            sync_managers: described.map(|one| one.sync_manager).collect(),
            bytes: vec![0; max_bytes].into_boxed_slice(),
        }
    }

    fn bytes(&self, pdi: &Pdi<'_>) -> &[u8] {
        self.bytes.get(..self.length_bytes(pdi)).unwrap_or(&self.bytes)
    }

    fn bytes_mut(&mut self, pdi: &Pdi<'_>) -> &mut [u8] {
        let length_bytes = self.length_bytes(pdi).min(self.bytes.len());
        &mut self.bytes[..length_bytes]
    }

    fn length_bytes(&self, pdi: &Pdi<'_>) -> usize {
        self.sync_managers.iter().map(|&index| set_bytes(pdi, index)).sum()
    }

    /// Completely received data replace the previous data; a single buffer is free again.
    fn take_from(&mut self, pdi: &mut Pdi<'_>) {
        let mut at = 0;
        for &index in &self.sync_managers {
            let length_bytes = set_bytes(pdi, index);
            let part = self.bytes.get_mut(at..at + length_bytes).unwrap_or_default();
            at += length_bytes;
            if pdi.sync_manager(index).mode == SmMode::Mailbox {
                let Some(outputs) = pdi.mailbox(index) else { continue };
                copy(outputs, part);
                pdi.release_mailbox(index);
            } else {
                copy(pdi.read_buffer(index).0, part);
            }
        }
    }

    /// A single buffer that the master has not read yet keeps its older inputs.
    fn give_to(&self, pdi: &mut Pdi<'_>) {
        let mut at = 0;
        for &index in &self.sync_managers {
            let length_bytes = set_bytes(pdi, index);
            let part = self.bytes.get(at..at + length_bytes).unwrap_or_default();
            at += length_bytes;
            if pdi.sync_manager(index).mode == SmMode::Mailbox {
                pdi.fill_mailbox(index, part);
            } else {
                pdi.write_buffer(index, part);
            }
        }
    }
}

/// The bytes of a SyncManager as set by the master, whether it is closed or not.
fn set_bytes(pdi: &Pdi<'_>, index: SmIndex) -> usize {
    let set = pdi.sync_manager(index);
    if set.enabled { usize::from(set.length_bytes) } else { 0 }
}

fn copy(from: &[u8], to: &mut [u8]) {
    if from.len() == to.len() {
        to.copy_from_slice(from);
    }
}
