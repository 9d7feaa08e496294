//! The tables of the model: its indicators. A terminal has no objects, events or rules.

use std::sync::LazyLock;

use unit_model::ModelTables;
use unit_model::tables::IndicatorRow;

use crate::unit_file;

pub(crate) const RUN: &str = "RUN";
pub(crate) const PORT_IN: &str = "L/A IN";
pub(crate) const PORT_OUT: &str = "L/A OUT";

static TABLES: LazyLock<ModelTables> = LazyLock::new(|| ModelTables {
    device: "digital terminal",
    indicators: vec![IndicatorRow::run(RUN), IndicatorRow::link_activity(vec![PORT_IN, PORT_OUT])],
    keys: unit_file::all_keys().into_iter().map(str::to_owned).collect(),
    ..ModelTables::default()
});

pub(crate) fn tables() -> &'static ModelTables {
    &TABLES
}

#[cfg(test)]
mod tests {
    use unit_model::Model;

    use super::*;

    #[test]
    fn the_table_has_the_indicators_of_the_model() {
        let names: Vec<&str> = TABLES.indicators.iter().flat_map(|row| row.names.clone()).collect();
        assert_eq!(names, crate::MODEL.indicators());
    }
}
