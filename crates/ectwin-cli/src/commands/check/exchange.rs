//! The resulting exchange.

use unit_model::SettingsCheck;

/// A line for each data set that is selected on a side, and the totals.
pub(super) fn table(check: &SettingsCheck) -> String {
    let mut text = format!("  {:<18} {:>12} {:>12}   exchanged\n", "data set", "PDO entries", "I/O entries");
    let selected = check.data_sets.iter().filter(|set| set.io_entries > 0 || set.pdo_entries > 0);
    for set in selected {
        text.push_str(&format!(
            "  {:<18} {:>12} {:>12}   {} entries, {} bytes\n",
            set.name,
            set.pdo_entries,
            set.io_entries,
            set.exchanged_entries,
            set.exchanged_bytes(),
        ));
    }
    let SettingsCheck { m_to_c, c_to_m, .. } = check;
    text.push_str(&format!(
        "  {} bytes from master to CPU Unit (RxPDOs: {}), {} bytes back (TxPDOs: {})\n",
        m_to_c.exchanged_bytes, m_to_c.pdo_bytes, c_to_m.exchanged_bytes, c_to_m.pdo_bytes
    ));
    text
}
