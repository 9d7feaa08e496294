//! The table of the rules in docs/user/allocate-io.md agrees with the code.

use std::fmt::Write;
use std::path::PathBuf;

use nx_ect101::{Direction, Event, EventCode, Moment, RULES, Rule, Side};

const BEGIN: &str = "<!-- rules: begin -->\n";
const END: &str = "<!-- rules: end -->\n";

/// If this is set, the test writes the table instead of comparing it.
const BLESS: &str = "ECTWIN_BLESS";

fn table() -> String {
    let mut table = String::from(
        "| rule | manual | what it asks for | side | event M→C, C→M | AL status code |\n|---|---|---|---|---|---|\n",
    );
    RULES.iter().for_each(|rule| rows(rule, &mut table));
    table
}

fn rows(rule: &Rule, table: &mut String) {
    for (at, events) in rule.events.iter().enumerate() {
        let first = |text: &'static str| if at == 0 { text } else { "" };
        let side = match (events.side, events.moment) {
            (Side::IoEntry, _) => "I/O entries",
            (Side::PdoEntry, _) => "PDO entries",
            (Side::Assignment, _) => "PDO assignment",
        };
        let moment = match events.moment {
            Moment::PowerOn => "power-on",
            Moment::PreOpToSafeOp => "PRE-OP to SAFE-OP",
        };
        let [m_to_c, c_to_m] = Direction::ALL.map(|direction| events.of(direction));
        let id = first(rule.id.id());
        let (section, text) = (first(rule.section), first(rule.text));
        let codes = al_status_codes([m_to_c, c_to_m]);
        let cells =
            [id, section, text, &format!("{side}, at {moment}"), &format!("{m_to_c}, {c_to_m}"), &codes];
        let _written = writeln!(table, "| {} |", cells.join(" | "));
    }
}

fn al_status_codes(events: [EventCode; 2]) -> String {
    let codes = events.map(|code| Event::find(code).and_then(|event| event.al_status_code));
    match codes {
        [Some(m_to_c), Some(c_to_m)] => format!("{:04X}, {:04X}", m_to_c.0, c_to_m.0),
        _ => "none".to_owned(),
    }
}

#[test]
fn the_table_of_the_rules_is_fresh() {
    let path = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/user/allocate-io.md"));
    let page = std::fs::read_to_string(&path).expect("the page");
    let (before, rest) = page.split_once(BEGIN).expect("the table's begin");
    let (_, after) = rest.split_once(END).expect("the table's end");
    let fresh = format!("{before}{BEGIN}{}{END}{after}", table());
    if std::env::var_os(BLESS).is_some() {
        std::fs::write(&path, fresh).expect("written");
    } else {
        assert_eq!(page, fresh, "the first line of the page says how to make the table again");
    }
}
