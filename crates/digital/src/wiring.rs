//! What is wired to the channels of a terminal.

/// The other side of the channels. Channel 1 is bit 0; bits beyond the channels are 0 from the terminal, and are not
/// looked at by it.
pub trait Wiring {
    /// The levels at the inputs now.
    fn inputs(&mut self) -> u64;

    /// The outputs have these levels from now on.
    fn set_outputs(&mut self, levels: u64);
}

/// A plain pair of images: inputs that are set by hand, outputs to look at.
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
