//! Channels that are wired to a CPU Unit.

use nx_bus::{CpuEnd, UnitEnd, UnitHeader};

use crate::channels::Channels;
use crate::wiring::Wiring;

/// The channels of a terminal as the variables of a CPU Unit.
#[derive(Debug)]
pub struct BusWiring {
    outputs: Channels,
    inputs: Channels,
    bus: UnitEnd,
}

impl BusWiring {
    /// The wiring of these channels, and its other end.
    #[must_use]
    pub fn connect(outputs: Channels, inputs: Channels) -> (Self, CpuEnd) {
        let (bus, cpu) = nx_bus::connect(outputs.length_bytes().into(), inputs.length_bytes().into());
        let mut wiring = Self { outputs, inputs, bus };
        wiring.set_outputs(0);
        (wiring, cpu)
    }
}

impl Wiring for BusWiring {
    fn inputs(&mut self) -> u64 {
        self.inputs.levels(self.bus.c_to_m.newest().bytes())
    }

    fn set_outputs(&mut self, levels: u64) {
        let error_resets = self.bus.c_to_m.newest().header.error_resets;
        let header = UnitHeader { io_data_active: true, error_resets, ..UnitHeader::default() };
        let mut bytes = [0; 8];
        let length_bytes = usize::from(self.outputs.length_bytes());
        self.outputs.put(levels, &mut bytes[..length_bytes]);
        self.bus.m_to_c.publish(header, &bytes[..length_bytes]);
    }
}

#[cfg(test)]
mod tests {
    use nx_bus::CpuHeader;

    use super::*;

    #[test]
    fn levels_go_to_the_cpu_unit_and_come_from_it() {
        let channels = |count| Channels::new(count).expect("0 to 64");
        let (mut wiring, mut cpu) = BusWiring::connect(channels(12), channels(8));
        assert!(cpu.m_to_c.newest().header.io_data_active);
        wiring.set_outputs(0xFFFF);
        assert_eq!(cpu.m_to_c.newest().bytes(), [0xFF, 0x0F]);
        cpu.c_to_m.publish(CpuHeader::default(), &[0x81]);
        assert_eq!(wiring.inputs(), 0x81);
    }
}
