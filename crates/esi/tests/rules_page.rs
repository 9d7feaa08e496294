//! The table of rules in docs/user/esi-files.md agrees with the code.

use std::path::PathBuf;

use esi::lint::rules::RULES;

const BEGIN: &str = "<!-- rules: begin -->\n";
const END: &str = "<!-- rules: end -->\n";

/// If this is set, the test writes the table instead of comparing it.
const BLESS: &str = "ECTWIN_BLESS";

#[test]
fn the_table_of_the_rules_is_fresh() {
    let path = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/user/esi-files.md"));
    let page = std::fs::read_to_string(&path).unwrap();
    let (before, rest) = page.split_once(BEGIN).unwrap();
    let (_, after) = rest.split_once(END).unwrap();
    let fresh = format!("{before}{BEGIN}{}{END}{after}", table());
    if std::env::var_os(BLESS).is_some() {
        std::fs::write(&path, fresh).unwrap();
    } else {
        assert_eq!(page, fresh, "`cargo xtask bless` writes it");
    }
}

fn table() -> String {
    let head = "| rule | level | demand | correction | source |\n|---|---|---|---|---|\n";
    let rows = RULES.iter().map(|rule| {
        let cells = [rule.code, &rule.level.to_string(), rule.demands, rule.correction, rule.source];
        format!("| {} |\n", cells.join(" | "))
    });
    head.to_owned() + &rows.collect::<String>()
}
