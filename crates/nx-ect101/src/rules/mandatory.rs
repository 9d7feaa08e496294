//! The requirements for every PDO setting: 1A00, PDOs of the correct direction, sizes that exist (manual,
//! 7-5-2, 7-5-4).
//!
//! Passes: 1C13 = 1A00, 1A01; 1602 with the entries 01 to 0A; TxPDOs of 1,204 bytes.
//! Fails:  1C13 = 1A01; 1C12 = 1A00; 1602 with the entries 01 to 0B; TxPDOs of 1,205 bytes by status assigned
//! twice. The rule `total` covers more data than 1,200 bytes.

use coe_kit::pdo::PdoSettings;

use crate::data_sets::{DataSet, Direction, Limits, StatusPdo};
use crate::finding::{Fact, Finding, FindingPlace};
use crate::pdo_settings::{assigned_entries, data_bytes, is_assignable, size_bytes};
use crate::rule::{Check, Rule};
use crate::rule_kind::{RuleEvents, RuleId, Side};

/// RxPDO Mapping Error and TxPDO Mapping Error.
const ASSIGNMENT: RuleEvents = RuleEvents::at_safe_op(Side::Assignment, 0x350A_0000, 0x3509_0000);
const PDO: RuleEvents = RuleEvents { side: Side::PdoEntry, ..ASSIGNMENT };

pub(super) const RULE: Rule = Rule {
    id: RuleId::Mandatory,
    section: "7-5-2, 7-5-4",
    text: "0x1A00 is assigned; assigned PDOs exist and have no more entries than their maximum; the TxPDOs have \
           1,204 bytes at most",
    events: &[ASSIGNMENT, PDO],
    checks: &[Check::Pdo(check)],
};

fn check(pdo: &PdoSettings, findings: &mut Vec<Finding>) {
    for direction in Direction::ALL {
        let place = FindingPlace::Direction(direction);
        let status = unit_status(pdo).filter(|_| direction == Direction::CToM);
        let assignment = status.into_iter().chain(stray(pdo, direction));
        findings.extend(assignment.map(|fact| Finding::new(RULE.id, &ASSIGNMENT, place, fact)));
        for set in DataSet::all().iter().filter(|set| set.direction == direction) {
            let fact = beyond_maximum(pdo, set);
            findings.extend(fact.map(|fact| Finding::new(RULE.id, &PDO, FindingPlace::DataSet(set), fact)));
        }
        let fact = too_long(pdo).filter(|_| direction == Direction::CToM);
        findings.extend(fact.map(|fact| Finding::new(RULE.id, &PDO, place, fact)));
    }
}

fn unit_status(pdo: &PdoSettings) -> Option<Fact> {
    let mut mandatory = StatusPdo::all().iter().filter(|status| status.mandatory);
    let assigned =
        |status: &StatusPdo| pdo.assigned(Direction::CToM.assignment()).any(|pdo| pdo == status.index);
    (!mandatory.all(assigned)).then_some(Fact::UnitStatusNotAssigned)
}

fn stray(pdo: &PdoSettings, direction: Direction) -> Option<Fact> {
    let mut elements = pdo.assignment(direction.assignment()).iter().enumerate();
    let (place, &pdo) = elements.find(|(_, pdo)| pdo.0 != 0 && !is_assignable(direction, **pdo))?;
    Some(Fact::NotAssignable { place, pdo })
}

/// The first entry that the data set does not have, or for which its mapping object has no room.
fn beyond_maximum(pdo: &PdoSettings, set: &DataSet) -> Option<Fact> {
    let entries = assigned_entries(pdo, set);
    let missing = entries.iter().position(|entry| entry.index == set.pdo_entry && !set.has(entry.sub));
    let room = usize::from(set.max_count);
    let place = missing.or((entries.len() > room).then_some(room))?;
    Some(Fact::BeyondMaximum { place, entries: entries.len(), maximum: set.max_count })
}

fn too_long(pdo: &PdoSettings) -> Option<Fact> {
    let Limits { exchange_bytes, txpdo_bytes: limit_bytes, .. } = Limits::of_model();
    let size_bytes = size_bytes(pdo, Direction::CToM);
    let by_status = data_bytes(pdo, Direction::CToM) <= usize::from(exchange_bytes);
    let too_long = by_status && size_bytes > usize::from(limit_bytes);
    too_long.then_some(Fact::TxPdosTooLong { size_bytes, limit_bytes })
}
