//! The table in docs/user/behaviours.md is that of the code, and its example is the unit file.

use std::fs;
use std::path::{Path, PathBuf};

use plc::behaviour::{BEHAVIOURS, BehaviourRow, LeftOut};

const BLESS: &str = "ECTWIN_BLESS";
const BEGIN: &str = "<!-- behaviours: begin -->\n";
const END: &str = "<!-- behaviours: end -->\n";

fn table() -> String {
    let mut table = String::from("| behaviour | the value | keys | example |\n|---|---|---|---|\n");
    for BehaviourRow { name, meaning, keys, example } in BEHAVIOURS {
        let keys = keys.iter().map(|key| match key.left_out {
            LeftOut::Required => format!("`{}`: {}", key.name, key.values),
            left_out => format!("`{}`: {}; left out: {left_out}", key.name, key.values),
        });
        let keys = keys.collect::<Vec<_>>().join("<br>");
        table += &format!("| `{name}` | {meaning} | {keys} | `{example}` |\n");
    }
    table
}

fn file(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path)
}

#[test]
fn the_page_has_the_table_of_the_code() {
    let path = file("docs/user/behaviours.md");
    let page = fs::read_to_string(&path).unwrap();
    let (head, rest) = page.split_once(BEGIN).unwrap();
    let (_, foot) = rest.split_once(END).unwrap();
    let fresh = [head, BEGIN, &table(), END, foot].concat();
    if std::env::var_os(BLESS).is_some() {
        fs::write(&path, &fresh).unwrap();
    } else {
        assert_eq!(page, fresh, "docs/user/behaviours.md: cargo xtask bless");
    }
}

#[test]
fn the_example_of_the_page_is_the_unit_file() {
    let page = fs::read_to_string(file("docs/user/behaviours.md")).unwrap();
    let unit = fs::read_to_string(file("units/behaviours.toml")).unwrap();
    let (_, without_head) = unit.split_once('\n').unwrap();
    assert!(page.contains(&format!("```toml\n{without_head}```\n")), "{without_head}");
}
