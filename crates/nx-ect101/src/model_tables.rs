//! The tables of the model for lists, explanations and pages.

mod al_status;
mod channels;
mod entries;
mod event;
mod rules;
mod words;

use std::sync::LazyLock;

use unit_model::ModelTables;
use unit_model::tables::{IndicatorRow, StatusRow};
use variables::VariableTable;

use crate::data_sets::{DataSet, Direction};
use crate::events::Event;
use crate::indicators::{Indicator, IndicatorMeaning, pattern_sources};
use crate::named_bits::NAMED_BITS;
use crate::nx_objects::nx_objects;
use crate::rules::RULES;
use crate::tables::object_table;
use crate::unit_file::{DataSetEntries, Entries, IoAllocationSection, Located, UnitFile, keys};

static TABLES: LazyLock<ModelTables> = LazyLock::new(|| ModelTables {
    device: "NX-ECT101",
    objects: object_table(),
    named_bits: NAMED_BITS,
    entry_facts: entries::of_dictionary(),
    nx_objects: nx_objects(),
    nx_entry_facts: entries::of_nx_objects(),
    events: Event::all().iter().map(event::row).collect(),
    emergencies_are_sent: channels::EMERGENCIES_ARE_SENT,
    al_status_codes: al_status::VENDOR_CODES,
    al_status_notes: al_status::NOTES,
    indicators: Indicator::all().iter().map(indicator).collect(),
    pattern_sources: pattern_sources(),
    rules: RULES.iter().map(rules::row).collect(),
    keys: keys(),
});

pub(crate) fn tables() -> &'static ModelTables {
    &TABLES
}

fn indicator(indicator: &'static Indicator) -> IndicatorRow {
    IndicatorRow {
        names: indicator.names.iter().map(String::as_str).collect(),
        shows: &indicator.shows,
        status: indicator.status.iter().map(status).collect(),
    }
}

fn status(status: &'static IndicatorMeaning) -> StatusRow {
    StatusRow {
        colour: status.colour,
        pattern: status.pattern,
        meaning: status.meaning.iter().map(String::as_str).collect(),
        events: status.events().collect(),
    }
}

/// The variables of units that together have every I/O entry: one data set each, because all of them exceed one unit.
pub(crate) fn every_variable() -> Vec<VariableTable> {
    let Ok(file) = UnitFile::parse("model = \"nx-ect101\"") else { return Vec::new() };
    let with = |set: &DataSet| {
        let all = Located::left_out(Entries::Count(set.max_count));
        let entries = vec![DataSetEntries { kind: set.kind, entries: all }];
        let section = match set.direction {
            Direction::MToC => IoAllocationSection { m_to_c: entries, c_to_m: Vec::new() },
            Direction::CToM => IoAllocationSection { m_to_c: Vec::new(), c_to_m: entries },
        };
        let file = UnitFile { io_allocation: Some(Located::left_out(section)), ..file.clone() };
        file.variable_table()
    };
    DataSet::all().iter().map(with).collect()
}
