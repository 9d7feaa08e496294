//! The table of requests in docs/user/control-channel.md is that of the code.

use std::fmt::Write;
use std::path::PathBuf;

use control::messages::VERBS;

const BEGIN: &str = "<!-- requests: begin -->\n";
const END: &str = "<!-- requests: end -->\n";

/// If this is set, the test writes the table instead of comparing it.
const BLESS: &str = "ECTWIN_BLESS";

fn table() -> String {
    let mut table = String::from("| request | does | its answer also has |\n|---|---|---|\n");
    for row in VERBS {
        let members: Vec<String> = row.answer.iter().map(|member| format!("`{member}`")).collect();
        let members = if members.is_empty() { "–".to_owned() } else { members.join(", ") };
        let _written = writeln!(table, "| `{}` | {} | {members} |", row.example, row.meaning);
    }
    table
}

#[test]
fn the_table_of_requests_is_fresh() {
    let path = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/user/control-channel.md"));
    let page = std::fs::read_to_string(&path).expect("the page");
    let (before, rest) = page.split_once(BEGIN).expect("the table's begin");
    let (_, after) = rest.split_once(END).expect("the table's end");
    let fresh = format!("{before}{BEGIN}{}{END}{after}", table());
    if std::env::var_os(BLESS).is_some() {
        std::fs::write(&path, fresh).expect("written");
    } else {
        assert_eq!(page, fresh, "docs/user/control-channel.md: cargo xtask bless");
    }
}
