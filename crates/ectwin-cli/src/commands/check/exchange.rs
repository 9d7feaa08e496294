//! The resulting exchange.

use nx_ect101::pdo_settings::size_bytes;
use nx_ect101::{Configuration, Direction, EventLevel, Finding, Moment, RULES, Verdict};

/// The reaction of the unit to these settings, in a few words.
pub(super) fn consequence(verdict: &Verdict, level: impl Fn(&Finding) -> EventLevel) -> String {
    let at_power_on = verdict.findings.iter().any(|finding| {
        let rule = RULES.iter().find(|rule| rule.id == finding.rule);
        let mut events = rule.into_iter().flat_map(|rule| rule.events);
        events.any(|events| events.side == finding.side && events.moment == Moment::PowerOn)
    });
    let al_status_code = verdict.findings.iter().find_map(Finding::al_status_code);
    let mut parts = Vec::new();
    if at_power_on {
        parts.push("I/O refreshing does not start".to_owned());
    }
    if let Some(code) = al_status_code {
        parts.push(format!("the unit stays in PRE-OP with AL status code {code}"));
    }
    let is_warning = |finding| level(finding) == EventLevel::Observation;
    let noun = if verdict.findings.iter().all(is_warning) { "warning" } else { "finding" };
    let findings = match verdict.findings.len() {
        0 => return "the setting rules are satisfied".to_owned(),
        1 => format!("1 {noun}"),
        findings => format!("{findings} {noun}s"),
    };
    match parts.is_empty() {
        true => format!("{findings}; only what both sides have is exchanged"),
        false => format!("{findings}: {}; nothing is exchanged", parts.join(", ")),
    }
}

/// A line for each data set that is selected on a side, and the totals.
pub(super) fn table(configuration: &Configuration, verdict: &Verdict) -> String {
    let mut text = format!("  {:<18} {:>12} {:>12}   exchanged\n", "data set", "PDO entries", "I/O entries");
    let selected = verdict.data_sets.iter().filter(|set| set.io_entries > 0 || set.pdo_entries > 0);
    for set in selected {
        text.push_str(&format!(
            "  {:<18} {:>12} {:>12}   {} entries, {} bytes\n",
            set.data_set.entry_name,
            set.pdo_entries,
            set.io_entries,
            set.exchanged_entries,
            set.exchanged_bytes(),
        ));
    }
    let bytes = |direction| {
        let sets = verdict.data_sets.iter().filter(|set| set.data_set.direction == direction);
        sets.map(|set| set.exchanged_bytes()).sum::<usize>()
    };
    let (m_to_c, c_to_m) = (bytes(Direction::MToC), bytes(Direction::CToM));
    let pdo = &configuration.pdo;
    let (rx, tx) = (size_bytes(pdo, Direction::MToC), size_bytes(pdo, Direction::CToM));
    text.push_str(&format!(
        "  {m_to_c} bytes from master to CPU Unit (RxPDOs: {rx}), {c_to_m} bytes back (TxPDOs: {tx})\n"
    ));
    text
}
