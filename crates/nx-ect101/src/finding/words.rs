//! Messages of findings.

use wire::ObjectIndex;

use super::{Amount, Fact, Finding};
use crate::data_sets::{Assignment, DataSet, DataSetKind, Direction, Limits};
use crate::rule_kind::Side;
use crate::unit_file::EntryAddress;

impl Finding {
    /// The violation: place, value and limit, without a full stop.
    #[must_use]
    pub fn message(&self) -> String {
        let assignment = Assignment::of(self.direction).object;
        match self.fact {
            Fact::UnitStatusNotAssigned => {
                format!("{assignment} does not assign 0x1A00, NX Unit Status Information")
            }
            Fact::NotAssignable { place, pdo } => {
                format!("{assignment}:{:02X} assigns {pdo}, which is not one of its PDOs", place + 1)
            }
            Fact::BeyondMaximum { entries, maximum, .. } => {
                format!("{} has {entries} entries or one beyond subindex {maximum:02X}", self.subject())
            }
            Fact::TxPdosTooLong { size_bytes, limit_bytes } => {
                format!("the TxPDOs have {size_bytes} bytes, the unit sends {limit_bytes} at most")
            }
            Fact::NotAscending { place, pdo, after } => {
                format!("{assignment}:{:02X} assigns {pdo} after {after}", place + 1)
            }
            Fact::IllegalEntry { entry, .. } => {
                format!("{} has {}, which cannot be in it", self.subject(), shown(entry))
            }
            Fact::NotNext { entry, wanted, .. } => {
                let next = EntryAddress { sub: wanted, ..entry };
                format!("{} has {} where {} is expected", self.subject(), shown(entry), shown(next))
            }
            Fact::TooMuchData { size_bytes } => {
                let whose = if self.side == Side::IoEntry { "I/O entries" } else { "PDO entries" };
                let (way, limit) = (way(self.direction), Limits::of_model().exchange_bytes);
                format!("the {whose} {way} have {size_bytes} bytes, {limit} are exchanged at most")
            }
            Fact::OneSided { amounts } | Fact::Unequal { amounts } => self.differences(&amounts),
        }
    }

    /// The correction, a sentence.
    #[must_use]
    pub fn correction(&self) -> String {
        match self.fact {
            Fact::UnitStatusNotAssigned => "Assign 0x1A00 as the first TxPDO.".into(),
            Fact::NotAssignable { .. } => {
                format!("Assign only {}.", list(&Assignment::of(self.direction).allowed))
            }
            Fact::BeyondMaximum { maximum, .. } => {
                format!("Map {maximum} entries at most, subindexes 01 to {maximum:02X}.")
            }
            Fact::TxPdosTooLong { .. } => "Assign each status PDO once at most.".into(),
            Fact::NotAscending { .. } => {
                "Assign the PDOs in ascending order of their indexes, each once.".into()
            }
            Fact::IllegalEntry { wanted, .. } => {
                let highest = self.data_set().map_or(0, |set| set.max_count);
                format!("Use only entries of {wanted}, subindexes 01 to {highest:02X}.")
            }
            Fact::NotNext { .. } => {
                "List the entries from subindex 01 in ascending order without a gap.".into()
            }
            Fact::TooMuchData { size_bytes } => {
                let limit = usize::from(Limits::of_model().exchange_bytes);
                format!("Remove entries of {} bytes or more.", size_bytes.saturating_sub(limit))
            }
            Fact::OneSided { .. } => format!("Select the same data sets on both sides; {ON_PURPOSE}."),
            Fact::Unequal { .. } => format!("Set the same number of entries on both sides; {ON_PURPOSE}."),
        }
    }

    /// The mapping of the finding.
    fn subject(&self) -> String {
        let name = self.data_set().map_or("", |set| set.name.as_str());
        let index = self.data_set.unwrap_or_default();
        match self.side {
            Side::IoEntry => format!("I/O entry mapping {index} ({name})"),
            Side::PdoEntry | Side::Assignment => format!("PDO mapping object {index} ({name})"),
        }
    }

    fn differences(&self, amounts: &[Amount; 3]) -> String {
        let sets = DataSetKind::ALL.into_iter().zip(amounts);
        let different = sets.filter(|(_, amount)| amount.is_unequal());
        let told = different.map(|(kind, amount)| difference(DataSet::of(self.direction, kind), *amount));
        told.collect::<Vec<_>>().join("; ")
    }
}

const ON_PURPOSE: &str = "if they differ on purpose, make the event an observation";

fn difference(set: &DataSet, amount: Amount) -> String {
    let side = |name: &str, entries: usize| {
        let plural = if entries == 1 { "entry" } else { "entries" };
        format!("{entries} {name} {plural} ({} bytes)", entries * usize::from(set.entry_bytes))
    };
    let (pdo, io) = (side("PDO", amount.pdo_entries), side("I/O", amount.io_entries));
    format!("{}: {pdo} in {}, {io}", set.entry_name, set.pdo)
}

const fn way(direction: Direction) -> &'static str {
    match direction {
        Direction::MToC => "from master to CPU Unit",
        Direction::CToM => "from CPU Unit to master",
    }
}

/// An entry in the notation of a unit file.
fn shown(entry: EntryAddress) -> String {
    format!("{:04X}:{:02X}", entry.index.0, entry.sub.0)
}

fn list(pdos: &[ObjectIndex]) -> String {
    pdos.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
}
