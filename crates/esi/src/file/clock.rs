//! Distributed clocks: the operation modes of a device.

use wire::ObjectIndex;

use super::element::Element;
use super::place::Place;

/// An element `Dc`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ClockElement {
    /// Its place.
    pub place: Place,
    /// Whether the receive times are 32 bits wide only.
    pub unknown_64_bit: bool,
    /// Whether the device only measures the delay.
    pub time_loop_control_only: bool,
    /// Whether the device does not take the time from an FRMW.
    pub unknown_frmw: bool,
    /// The operation modes, the default one first.
    pub modes: Vec<OperationMode>,
}

/// An element `OpMode`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OperationMode {
    /// Its place.
    pub place: Place,
    /// Its name.
    pub name: String,
    /// Its description.
    pub description: String,
    /// The word that the master writes to 0x0980 for it; 0 without SYNC signals.
    pub assign_activate: Option<u16>,
    /// SYNC0.
    pub sync_0: SyncSignal,
    /// SYNC1.
    pub sync_1: SyncSignal,
    /// The SyncManagers whose settings depend on the mode.
    pub sync_managers: Vec<ModeSyncManager>,
}

/// The cycle of a SYNC signal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SyncSignal {
    /// Cycle time in nanoseconds; 0: from the factor.
    pub cycle_time_ns: u32,
    /// Factor of the master's cycle: n is n times as long, -n is the n-th part.
    pub factor: i32,
    /// Delay in nanoseconds.
    pub shift_time_ns: i32,
}

/// An element `Sm` of an operation mode.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ModeSyncManager {
    /// Its place.
    pub place: Place,
    /// The number of the SyncManager.
    pub number: u8,
    /// Its synchronization type, if indicated.
    pub sync_type: Option<u16>,
    /// The PDOs that are assigned in this mode, with their oversampling factors.
    pub pdos: Vec<(ObjectIndex, Option<u16>)>,
}

impl ClockElement {
    pub(super) fn read(element: Element<'_>) -> Self {
        Self {
            place: element.place(),
            unknown_64_bit: element.flag("Unknown64Bit"),
            time_loop_control_only: element.flag("TimeLoopControlOnly"),
            unknown_frmw: element.flag("UnknownFRMW"),
            modes: element.all("OpMode").map(OperationMode::read).collect(),
        }
    }

    /// Whether a mode uses SYNC signals.
    #[must_use]
    pub fn has_sync_signals(&self) -> bool {
        self.modes.iter().any(|mode| mode.assign_activate.is_some_and(|word| word != 0))
    }
}

impl OperationMode {
    fn read(element: Element<'_>) -> Self {
        Self {
            place: element.place(),
            name: element.localized("Name"),
            description: element.localized("Desc"),
            assign_activate: element.number_of("AssignActivate"),
            sync_0: SyncSignal::read(element, "CycleTimeSync0", "ShiftTimeSync0"),
            sync_1: SyncSignal::read(element, "CycleTimeSync1", "ShiftTimeSync1"),
            sync_managers: element.all("Sm").filter_map(ModeSyncManager::read).collect(),
        }
    }
}

impl SyncSignal {
    fn read(mode: Element<'_>, cycle: &'static str, shift: &'static str) -> Self {
        Self {
            cycle_time_ns: mode.number_of(cycle).unwrap_or(0),
            factor: mode.child(cycle).and_then(|cycle| cycle.number("Factor")).unwrap_or(0),
            shift_time_ns: mode.number_of(shift).unwrap_or(0),
        }
    }
}

impl ModeSyncManager {
    fn read(element: Element<'_>) -> Option<Self> {
        let pdo = |pdo: Element<'_>| Some((ObjectIndex(pdo.value().number()?), pdo.number("OSFac")));
        Some(Self {
            place: element.place(),
            number: element.number("No")?,
            sync_type: element.number_of("SyncType"),
            pdos: element.all("Pdo").filter_map(pdo).collect(),
        })
    }
}
