//! All images are consistent: all bytes of the outputs that a unit receives, and of the inputs that a master
//! reads, belong to the same write.
//!
//! Checked for units whose images have equal bytes, while only the scripted master has set up their
//! SyncManagers and FMMUs, and has completed the writes to their outputs.

use std::ops::Range;

use device::{DataDirection, DeviceConfig};
use wire::{AlState, Command, Returned};

use super::units::Units;
use super::watched::length_bytes;

/// The known state of the images of each unit.
pub(super) struct Images {
    units: Vec<Image>,
}

struct Image {
    outputs: Range<u32>,
    inputs: Range<u32>,
    is_even: bool,
    /// The SyncManagers and FMMUs are those of the scripted master.
    is_set_up: bool,
    /// The last outputs received were complete and had equal bytes.
    has_whole_outputs: bool,
    /// That byte, if outputs have been received.
    byte: Option<u8>,
}

impl Image {
    /// The second and the third buffer of outputs and inputs, which a master can access as RAM (reference 3.4).
    fn behind(&self) -> [Range<u32>; 2] {
        [&self.outputs, &self.inputs].map(|first| first.end..first.end + 2 * (first.end - first.start))
    }
}

/// FMMUs and SyncManagers, and registers that reset them.
const SETUP: [Range<u32>; 3] = [0x0040..0x0041, 0x0600..0x0700, 0x0800..0x0880];

impl Images {
    pub(super) fn of(configs: &[DeviceConfig], network: &Units) -> Self {
        let image = |(config, position): (&DeviceConfig, usize)| {
            let unit = network.device(position).map(|device| &**device.unit());
            // Units whose images are checked have one area in each direction.
            let area = |direction| {
                let described = config.process_data.iter().find(|described| described.direction == direction);
                let area = described.zip(unit).map(|(described, unit)| {
                    let start = u32::from(described.start);
                    start..start + u32::from(length_bytes(unit, described))
                });
                area.unwrap_or_default()
            };
            Image {
                outputs: area(DataDirection::Outputs),
                inputs: area(DataDirection::Inputs),
                is_even: unit.is_some_and(|unit| unit.has_even_images()),
                is_set_up: false,
                has_whole_outputs: false,
                byte: None,
            }
        };
        Self { units: configs.iter().zip(0..).map(image).collect() }
    }

    /// Nothing is known about a unit any more.
    pub(super) fn forget(&mut self, unit: usize) {
        if let Some(image) = self.units.get_mut(unit) {
            image.is_set_up = false;
            image.has_whole_outputs = false;
        }
    }

    /// The scripted master has set up a unit, which has not received outputs since.
    pub(super) fn is_set_up(&mut self, unit: usize) {
        if let Some(image) = self.units.get_mut(unit) {
            image.is_set_up = true;
            image.has_whole_outputs = true;
            image.byte = None;
        }
    }

    /// These datagrams were sent.
    pub(super) fn master_sent(&mut self, datagrams: &[Returned]) {
        for datagram in datagrams.iter().filter(|datagram| writes(datagram.header.command)) {
            let logical = matches!(datagram.header.command, Command::Lwr | Command::Lrw);
            let bytes = physical_bytes(datagram);
            let touches = |area: &Range<u32>| bytes.start < area.end && area.start < bytes.end;
            let sets_up = !logical && SETUP.iter().any(touches);
            for image in &mut self.units {
                let ends_outputs = logical || bytes.contains(&image.outputs.end.saturating_sub(1));
                let reaches_behind = !logical && image.behind().iter().any(touches);
                image.is_set_up &= !sets_up && !reaches_behind;
                image.has_whole_outputs &= !ends_outputs;
            }
        }
    }

    /// A cycle of the scripted master has returned: outputs and inputs of a unit.
    pub(super) fn cycle_came_back(
        &mut self,
        unit: usize,
        byte: u8,
        returned: &[Returned],
        network: &Units,
    ) -> Result<(), String> {
        let are_all_set_up = self.units.iter().all(|image| image.is_set_up);
        let [outputs, inputs] = returned else { return Ok(()) };
        let Some(image) = self.units.get_mut(unit).filter(|image| image.is_set_up) else { return Ok(()) };
        // If no other unit maps the same addresses, the counter belongs to this unit.
        let was_written = are_all_set_up && outputs.working_counter == 1;
        image.has_whole_outputs |= was_written;
        image.byte = was_written.then_some(byte);
        let was_read = are_all_set_up && inputs.working_counter == 1;
        if image.is_even && was_read && has_inputs(network, unit) {
            even(&inputs.data).map_err(|reason| format!("the inputs of unit {unit} are torn: {reason}"))?;
        }
        Ok(())
    }

    /// Reads that begin with the first byte of a unit's inputs return inputs of one refresh.
    pub(super) fn check_inputs(
        &self,
        sent: &[Returned],
        returned: &[Returned],
        network: &Units,
    ) -> Result<(), String> {
        for (sent, returned) in sent.iter().zip(returned) {
            let is_read = matches!(sent.header.command, Command::Aprd | Command::Fprd);
            if !is_read || returned.working_counter.wrapping_sub(sent.working_counter) != 1 {
                continue;
            }
            let bytes = physical_bytes(sent);
            for (unit, image) in self.units.iter().enumerate() {
                let begins = bytes.start == image.inputs.start && bytes.end <= image.inputs.end;
                let all_even = self.units.iter().all(|image| image.is_even && image.is_set_up);
                if begins && all_even && (0..self.units.len()).all(|unit| has_inputs(network, unit)) {
                    even(&returned.data)
                        .map_err(|reason| format!("inputs of unit {unit} are torn: {reason}"))?;
                }
            }
        }
        Ok(())
    }

    /// The outputs of the last refresh of each unit.
    pub(super) fn check_outputs(&self, network: &mut Units) -> Result<(), String> {
        for (unit, image) in self.units.iter().enumerate() {
            let Some((device, _)) = network.slave_mut(unit) else { continue };
            if let Some(wrong) = device.unit_mut().take_wrong() {
                return Err(format!("unit {unit}: {wrong}"));
            }
            let outputs = device.unit_mut().take_outputs();
            let Some(outputs) = outputs.filter(|_| image.is_set_up && image.has_whole_outputs) else {
                continue;
            };
            even(&outputs).map_err(|reason| format!("the outputs of unit {unit} are torn: {reason}"))?;
            if outputs.len() != image.outputs.len() {
                return Err(format!("unit {unit} gets {} bytes of outputs", outputs.len()));
            }
            if image.byte.is_some() && image.byte != outputs.first().copied() {
                return Err(format!(
                    "unit {unit} gets outputs of {:02X?}, sent was {:02X?}",
                    outputs[0], image.byte
                ));
            }
        }
        Ok(())
    }
}

fn has_inputs(network: &Units, unit: usize) -> bool {
    let device = network.device(unit).filter(|device| !device.is_off());
    device.is_some_and(|device| matches!(device.al_status().state, AlState::SafeOp | AlState::Op))
}

/// The memory that a datagram with a physical address accesses.
fn physical_bytes(datagram: &Returned) -> Range<u32> {
    let start = u32::from(datagram.header.offset);
    start..start + datagram.data.len() as u32
}

const fn writes(command: Command) -> bool {
    !matches!(
        command,
        Command::Nop | Command::Aprd | Command::Fprd | Command::Brd | Command::Lrd | Command::Other(_)
    )
}

fn even(image: &[u8]) -> Result<(), String> {
    let first = image.first().copied().unwrap_or_default();
    match image.iter().position(|byte| *byte != first) {
        None => Ok(()),
        Some(at) => Err(format!("byte 0 is {first:02X}, byte {at} is {:02X}", image[at])),
    }
}
