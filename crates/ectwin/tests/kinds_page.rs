//! The kinds of records in docs/user/watch-and-steer.md are those of the code.

use std::fmt::Write;
use std::path::PathBuf;

use ectwin::happenings::{COMMON, FieldRow, KINDS, Presence};

const BEGIN: &str = "<!-- kinds: begin -->\n";
const END: &str = "<!-- kinds: end -->\n";

/// If this is set, the test writes the table instead of comparing it.
const BLESS: &str = "ECTWIN_BLESS";

fn table() -> String {
    let mut table = String::from("| kind | log | field | type | |\n|---|---|---|---|---|\n");
    COMMON.iter().for_each(|field| row(&mut table, "all", "", field));
    for kind in KINDS {
        let _written = writeln!(table, "| `{}` | {} | | | **{}** |", kind.name, kind.shown_by, kind.meaning);
        kind.fields.iter().for_each(|field| row(&mut table, "", "", field));
    }
    table
}

fn row(table: &mut String, kind: &str, log: &str, field: &FieldRow) {
    let optional = if field.presence == Presence::Optional { ", optional" } else { "" };
    let (name, form, meaning) = (field.name, field.form.words(), field.meaning);
    let _written = writeln!(table, "| {kind} | {log} | `{name}` | {form}{optional} | {meaning} |");
}

#[test]
fn the_table_of_the_kinds_is_fresh() {
    let path = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/user/watch-and-steer.md"));
    let page = std::fs::read_to_string(&path).expect("the page");
    let (before, rest) = page.split_once(BEGIN).expect("the table's begin");
    let (_, after) = rest.split_once(END).expect("the table's end");
    let fresh = format!("{before}{BEGIN}{}{END}{after}", table());
    if std::env::var_os(BLESS).is_some() {
        std::fs::write(&path, fresh).expect("written");
    } else {
        assert_eq!(page, fresh, "docs/user/watch-and-steer.md: cargo xtask bless");
    }
}
