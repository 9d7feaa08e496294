//! The allocator: from a configuration to its violations and the resulting exchange.

use coe_kit::pdo::PdoSettings;

use crate::allocation::IoAllocation;
use crate::amounts;
use crate::data_sets::{DataSet, Direction};
use crate::exchange::ExchangePlan;
use crate::finding::Finding;
use crate::pdo_settings;
use crate::rule_kind::RuleId;
use crate::rules;
use crate::unit_file::UnitFile;

/// The settings of the CPU Unit and of the master for one unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Configuration {
    /// I/O entry mappings, on the CPU Unit's side.
    pub io: IoAllocation,
    /// PDO mapping and assignment, on the master's side.
    pub pdo: PdoSettings,
}

impl Configuration {
    /// The factory setting of both sides.
    #[must_use]
    pub fn factory() -> Self {
        Self { io: IoAllocation::factory(), pdo: pdo_settings::factory() }
    }

    /// The settings in a unit file; values that are left out are those of the factory setting.
    #[must_use]
    pub fn from_unit_file(file: &UnitFile) -> Self {
        let pdo = file
            .pdo
            .as_ref()
            .map_or_else(pdo_settings::factory, |section| pdo_settings::of_section(&section.value));
        Self { io: file.io_allocation(), pdo }
    }

    /// Evaluates all setting rules.
    #[must_use]
    pub fn check(&self) -> Verdict {
        let mut findings = Vec::new();
        rules::check_all(&self.io, &self.pdo, &mut findings);
        let mut plan = ExchangePlan::empty();
        let exchanges = findings.iter().all(is_mismatch);
        if exchanges {
            let layouts = Direction::ALL.map(|direction| self.io.layout(direction));
            let [m_to_c, c_to_m] = &layouts;
            plan.rebuild(&self.pdo, m_to_c, c_to_m);
        }
        let data_sets = Direction::ALL.into_iter().flat_map(|direction| self.exchanged(direction, exchanges));
        let data_sets = data_sets.collect();
        Verdict { findings, plan, data_sets }
    }

    fn exchanged(&self, direction: Direction, exchanges: bool) -> impl Iterator<Item = ExchangedDataSet> {
        let sets = DataSet::all().iter().filter(move |set| set.direction == direction);
        sets.zip(amounts::of(&self.io, &self.pdo, direction)).map(move |(data_set, amount)| {
            let both = amount.io_entries.min(amount.pdo_entries);
            ExchangedDataSet {
                data_set,
                io_entries: amount.io_entries,
                pdo_entries: amount.pdo_entries,
                exchanged_entries: if exchanges { both } else { 0 },
            }
        })
    }
}

/// Whether data are exchanged despite the finding, as far as both sides match (manual, 5-3-5).
fn is_mismatch(finding: &Finding) -> bool {
    matches!(finding.rule, RuleId::Combination | RuleId::Matched)
}

/// The result of the rules for a configuration.
#[derive(Debug)]
pub struct Verdict {
    /// All findings: in the order of the rule table, then of sides and objects.
    pub findings: Vec<Finding>,
    /// The bytes that are copied from one image to the other; none if a rule prevents the start of the exchange.
    pub plan: ExchangePlan,
    /// The six data sets: M to C, then C to M.
    pub data_sets: Vec<ExchangedDataSet>,
}

impl Verdict {
    /// Whether all rules are satisfied.
    #[must_use]
    pub fn is_satisfied(&self) -> bool {
        self.findings.is_empty()
    }
}

/// The exchanged part of a data set.
#[derive(Clone, Copy, Debug)]
pub struct ExchangedDataSet {
    /// The data set.
    pub data_set: &'static DataSet,
    /// Entries that the CPU Unit has allocated.
    pub io_entries: usize,
    /// Entries that the assigned PDO maps.
    pub pdo_entries: usize,
    /// Entries that are exchanged, from subindex 1 on.
    pub exchanged_entries: usize,
}

impl ExchangedDataSet {
    /// Bytes that are exchanged.
    #[must_use]
    pub fn exchanged_bytes(&self) -> usize {
        self.exchanged_entries * usize::from(self.data_set.entry_bytes)
    }
}
