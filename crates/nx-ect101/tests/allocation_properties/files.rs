//! Settings from a unit file: the order of its tables and keys changes nothing.

use nx_ect101::Configuration;
use nx_ect101::unit_file::UnitFile;
use proptest::prelude::*;

use crate::CASES;
use crate::configurations::{Address, Settings, any_settings};
use crate::model::pdo;

const KEYS: [&str; 3] = ["uints", "bytes", "udint"];

/// The settings as tables of a unit file, each with its lines.
fn tables(settings: &Settings) -> Vec<(String, Vec<String>)> {
    let mut tables = Vec::new();
    for (way, name) in ["m_to_c", "c_to_m"].into_iter().enumerate() {
        let lines = (0..3).map(|set| format!("{} = {}", KEYS[set], entries(&settings.io[way][set])));
        tables.push((format!("[io_allocation.{name}]"), lines.collect()));
    }
    let assigned = |way: usize| {
        let indexes: Vec<String> =
            settings.assigned[way].iter().map(|index| format!("0x{index:04X}")).collect();
        format!("[{}]", indexes.join(", "))
    };
    let assign = vec![format!("rx = {}", assigned(0)), format!("tx = {}", assigned(1))];
    tables.push(("[pdo.assign]".to_owned(), assign));
    let sets = (0..2).flat_map(|way| (0..3).map(move |set| (way, set)));
    let lines =
        sets.map(|(way, set)| format!("{:04X} = {}", pdo(way, set), entries(&settings.pdo[way][set])));
    tables.push(("[pdo.mapping]".to_owned(), lines.collect()));
    tables
}

fn entries(list: &[Address]) -> String {
    let entries: Vec<String> = list.iter().map(|(index, sub)| format!("\"{index:04X}:{sub:02X}\"")).collect();
    format!("[{}]", entries.join(", "))
}

fn file(tables: &[(String, Vec<String>)]) -> String {
    let tables = tables.iter().map(|(head, lines)| format!("{head}\n{}\n", lines.join("\n")));
    format!("model = \"nx-ect101\"\n{}", tables.collect::<String>())
}

/// The tables, and the same in another order, including their lines.
fn two_orders() -> impl Strategy<Value = (Settings, String)> {
    any_settings().prop_flat_map(|settings| {
        let shuffled = tables(&settings)
            .into_iter()
            .map(|(head, lines)| (Just(head), Just(lines).prop_shuffle()))
            .collect::<Vec<_>>();
        let text = shuffled.prop_shuffle().prop_map(|tables| file(&tables));
        (Just(settings), text)
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(CASES / 40))]

    #[test]
    fn findings_do_not_depend_on_the_order_of_tables((settings, text) in two_orders()) {
        let file = UnitFile::parse(&text).unwrap_or_else(|errors| panic!("{errors}\n{text}"));
        let configuration = Configuration::from_unit_file(&file);
        prop_assert_eq!(&configuration, &settings.configuration());
        prop_assert_eq!(configuration.check().findings, settings.configuration().check().findings);
    }
}
