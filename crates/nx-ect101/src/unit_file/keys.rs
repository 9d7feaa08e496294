//! The keys of the unit file, section by section: those that the reader accepts and [`keys`] lists.

use unit_model::keys::{Shape, refuse_keys, times_keys, transition_keys};

use crate::data_sets::{DataSet, DataSetKind};
use crate::events::{Event, EventCode};

/// The unit has a mailbox and no BOOT.
pub(super) const SHAPE: Shape = Shape { mailbox: true, boot: false };

/// Keys and sections of the file itself.
pub(super) const UNIT: [&str; 25] = [
    "model",
    "name",
    "unit_number",
    "serial",
    "id_switch",
    "alias",
    "device_type",
    "unit_version",
    "lot_number",
    "hardware_version",
    "software_version",
    "timing",
    "start_up",
    "refresh_phase",
    "outputs_before_op",
    "blank_sii",
    "times",
    "refuse",
    "storage",
    "io_allocation",
    "pdo",
    "event_levels",
    "cpu",
    "behaviour",
    "loopback",
];

/// The keys at the top of a file.
pub(crate) const fn top_keys() -> &'static [&'static str] {
    &UNIT
}

pub(super) const IO_ALLOCATION: [&str; 2] = ["m_to_c", "c_to_m"];
pub(super) const DATA_SETS: [(&str, DataSetKind); 3] =
    [("uints", DataSetKind::Uints), ("bytes", DataSetKind::Bytes), ("udint", DataSetKind::Udint)];
pub(super) const PDO: [&str; 2] = ["assign", "mapping"];
pub(super) const ASSIGN: [&str; 2] = ["rx", "tx"];

/// The mapping objects whose entries a master may set, ascending.
pub(super) fn mappings() -> Vec<String> {
    let mut names: Vec<String> = DataSet::all().iter().map(|set| format!("{:04X}", set.pdo.0)).collect();
    names.sort_unstable();
    names
}

/// The events whose level a user may change.
pub(super) fn changeable_events() -> impl Iterator<Item = EventCode> {
    Event::all().iter().filter(|event| event.changeable_level).map(|event| event.code)
}

/// Every key and every section of the unit file, as a path with dots: `start_up`, `times`, `times.sii`. Of `cpu` it has
/// only the section: the CPU Unit reads its keys.
#[must_use]
pub fn keys() -> Vec<String> {
    let owned = |keys: &[&str]| keys.iter().map(|key| (*key).to_owned()).collect::<Vec<_>>();
    let data_sets = || DATA_SETS.iter().map(|(key, _)| (*key).to_owned()).collect();
    let sections: [(&str, Vec<String>); 10] = [
        ("times", owned(times_keys(SHAPE))),
        ("times.transitions", owned(&transition_keys(SHAPE))),
        ("refuse", owned(&refuse_keys(SHAPE))),
        ("io_allocation", owned(&IO_ALLOCATION)),
        ("io_allocation.m_to_c", data_sets()),
        ("io_allocation.c_to_m", data_sets()),
        ("pdo", owned(&PDO)),
        ("pdo.assign", owned(&ASSIGN)),
        ("pdo.mapping", mappings()),
        ("event_levels", changeable_events().map(|code| code.to_string()).collect()),
    ];
    let within =
        sections.iter().flat_map(|(section, keys)| keys.iter().map(move |key| format!("{section}.{key}")));
    owned(&UNIT).into_iter().chain(within).collect()
}

#[cfg(test)]
mod tests {
    use std::collections::{BTreeMap, BTreeSet};

    use super::super::UnitFile;
    use super::keys;

    /// The names that the reader accepts in a section, as its message for an unknown key lists them.
    fn accepted_in(section: &str) -> BTreeSet<String> {
        let header = if section.is_empty() { String::new() } else { format!("[{section}]\n") };
        let text = format!("{header}key-of-nobody = 1\n");
        let Err(errors) = UnitFile::parse(&text) else { panic!("{section}: a key of nobody is taken") };
        let unknown = errors.iter().find(|error| error.message.contains("key-of-nobody"));
        let Some(unknown) = unknown else { panic!("{section}: {errors}") };
        unknown.expected.split('`').skip(1).step_by(2).map(str::to_owned).collect()
    }

    #[test]
    fn the_list_is_what_the_reader_takes_in_each_section() {
        let mut sections: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
        for path in keys() {
            let (section, key) = path.rsplit_once('.').unwrap_or(("", &path));
            assert!(sections.entry(section.to_owned()).or_default().insert(key.to_owned()), "{path} twice");
        }
        for (section, keys) in &sections {
            assert_eq!(accepted_in(section), *keys, "[{section}]");
        }
    }

    /// A section is a key of the section that contains it.
    #[test]
    fn every_section_is_a_key_itself() {
        let all = keys();
        for (section, _) in all.iter().filter_map(|path| path.rsplit_once('.')) {
            assert!(all.iter().any(|path| path == section), "{section}");
        }
    }
}
