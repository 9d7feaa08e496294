//! The wiring of a terminal's channels.

/// The other side of the channels. Channel 1 is bit 0; the terminal sends 0 in bits beyond the channels, and
/// ignores them when it reads.
pub trait Wiring {
    /// The present levels at the inputs.
    fn inputs(&mut self) -> u64;

    /// Sets the levels of the outputs.
    fn set_outputs(&mut self, levels: u64);
}

/// A plain pair of images: inputs that the user sets, outputs that the user reads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BitImages {
    /// The levels at the inputs.
    pub inputs: u64,
    /// The levels of the outputs.
    pub outputs: u64,
}

impl Wiring for BitImages {
    fn inputs(&mut self) -> u64 {
        self.inputs
    }

    fn set_outputs(&mut self, levels: u64) {
        self.outputs = levels;
    }
}
