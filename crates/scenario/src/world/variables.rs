//! Device variables of the CPU Units, by the names that the manual gives them (A-3-2).

use super::World;

impl World {
    /// The bytes of a variable or of an element such as `N1_UINTs_01_M_to_C[3]`, little endian; none if no CPU Unit
    /// has it.
    pub(crate) fn variable(&self, name: &str) -> Option<Vec<u8>> {
        self.cpus.iter().find_map(|cpu| {
            let io = cpu.unit.io();
            let target = io.variables().find_target(name).ok()?;
            io.read(target).ok().map(|value| value.to_vec())
        })
    }
}
