//! Outages: what fails without an event, so that only the indicators show it (manual, 8-2-2).

use crate::indicators::NxCondition;

/// Something that fails without an event. The unit is in INIT, without an AL status code, and refreshes no I/O until it
/// starts again without the cause.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outage {
    /// The hardware of the unit.
    Hardware,
    /// The CPU Unit.
    CpuUnit,
}

impl Outage {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Hardware, Self::CpuUnit];

    /// Its name, such as `Hardware`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Hardware => "Hardware",
            Self::CpuUnit => "CpuUnit",
        }
    }

    /// The outage with this name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|outage| outage.name() == name)
    }

    /// The row of 8-2-2: its cause in the words of the manual.
    #[must_use]
    pub const fn words(self) -> &'static str {
        match self {
            Self::Hardware => "hardware failure",
            Self::CpuUnit => "malfunction of the CPU Unit",
        }
    }

    /// What TS shows.
    pub(crate) const fn condition(self) -> NxCondition {
        match self {
            Self::Hardware => NxCondition::HardwareFailure,
            Self::CpuUnit => NxCondition::CpuUnitMalfunction,
        }
    }
}

/// The outages of one unit.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Outages {
    /// Those whose causes are there.
    present: [bool; Outage::ALL.len()],
    /// Those from which the unit has not recovered.
    found: [bool; Outage::ALL.len()],
}

impl Outages {
    /// The cause appears; the outage begins immediately.
    pub(crate) const fn begin(&mut self, outage: Outage) {
        self.present[outage as usize] = true;
        self.found[outage as usize] = true;
    }

    /// The cause disappears; the outage lasts until the next start.
    pub(crate) const fn end(&mut self, outage: Outage) {
        self.present[outage as usize] = false;
    }

    /// The unit starts.
    pub(crate) const fn start(&mut self) {
        self.found = self.present;
    }

    /// Whether the cause is there.
    pub(crate) const fn is_present(&self, outage: Outage) -> bool {
        self.present[outage as usize]
    }

    /// Whether any cause is there.
    pub(crate) fn has_cause(&self) -> bool {
        self.present.contains(&true)
    }

    /// Whether there is any.
    pub(crate) fn is_any(&self) -> bool {
        self.found.contains(&true)
    }

    /// What TS shows for each.
    pub(crate) fn conditions(&self) -> impl Iterator<Item = NxCondition> + '_ {
        Outage::ALL.into_iter().filter(|outage| self.found[*outage as usize]).map(Outage::condition)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_outage_lasts_until_a_start_without_its_cause() {
        let mut outages = Outages::default();
        assert!(!outages.is_any());
        outages.begin(Outage::CpuUnit);
        assert_eq!(outages.conditions().collect::<Vec<_>>(), [NxCondition::CpuUnitMalfunction]);
        outages.start();
        assert!(outages.is_any(), "the cause persists");
        outages.end(Outage::CpuUnit);
        assert!(outages.is_any(), "until the start");
        outages.start();
        assert!(!outages.is_any());
    }

    #[test]
    fn each_has_its_name() {
        assert!(Outage::ALL.into_iter().all(|outage| Outage::named(outage.name()) == Some(outage)));
        assert!(Outage::ALL.into_iter().all(|outage| crate::Fault::named(outage.name()).is_none()));
    }
}
