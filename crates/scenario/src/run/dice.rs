//! The scenario's random generators, each with its own seed.

pub(crate) use plant::Dice;

/// Makes a different seed for random steps, so that a fault of the line does not change them.
pub(crate) const DICE_OF_STEPS: u64 = 0x5EED_0000_57E9_5000;

/// Makes a different seed for the phases of units, tasks and master, so that they change neither steps nor faults.
const DICE_OF_PHASES: u64 = 0x5EED_0000_0F00_A5E5;

/// The generator for the phases of one participant: the master is 0, the units count from 1.
pub(crate) fn dice_of_phases(seed: u64, participant: u64) -> Dice {
    let mut dice = Dice::new(seed ^ DICE_OF_PHASES);
    Dice::new(dice.next().wrapping_add(participant))
}
