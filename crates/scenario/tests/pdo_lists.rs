//! Long lists of PDO entries and of PDOs in the orders of a scenario.

use scenario::{Recording, Scenario};

/// The longest list of entries, 254.
const ENTRIES_254: &str = "7000:01..FE";

fn parsed(units: &str, orders: &[String], end: &str) -> Result<Scenario, String> {
    let steps: Vec<String> = orders.iter().map(|order| format!("  {{ master = {order} }},\n")).collect();
    let text = format!(
        "title = \"t\"\nunits = [{units}]\nsteps = [\n{}  {{ master = \"take all units to OP\" }},\n  \
         {{ after = \"2s\", expect = \"{end}\" }},\n]\n",
        steps.concat()
    );
    Scenario::parse(&text, |path| Err(path.to_owned())).map_err(|errors| errors.to_string())
}

fn map(entries: &str) -> String {
    format!("\"let unit 1 map 0x1601 as {entries}\"")
}

fn assign(object: &str, pdo: &str, count: usize) -> String {
    format!("\"let unit 1 assign to {object} the PDOs {}\"", [pdo].repeat(count).join(" "))
}

fn typed(pdo: &str, count: usize) -> String {
    let pdos = vec![format!("\"{pdo}\""); count].join(", ");
    format!("{{ assign_pdos = {{ unit = 1, object = \"0x1C13\", pdos = [{pdos}] }} }}")
}

#[test]
fn a_list_that_no_object_has_room_for_is_refused_with_its_place() {
    for (order, expected) in [
        (
            map("7000:01..FF"),
            "at most 254 entries such as 7000:01..06 or 7000:01 7000:02, found `7000:01..FF`",
        ),
        (map("7000:01..80 7010:01..7F"), "found `7010:01..7F`"),
        (map("7000:01..FF 7000:01..FF 7000:01..FF"), "found `7000:01..FF`"),
        (
            assign("0x1C13", "1A00", 255),
            "at most 254 PDO numbers such as 1601 1602, hexadecimal, found `1A00`",
        ),
        (assign("0x1C13", "1A00", 300), "at most 254 PDO numbers"),
        (typed("0x1A00", 255), "at most 254 PDO numbers"),
    ] {
        let scenario = parsed("", core::slice::from_ref(&order), "unit 1 is in OP");
        let errors = scenario.err().unwrap_or_default();
        assert!(errors.contains("line 4, column ") && errors.contains(expected), "{order}\n{errors}");
    }
}

/// What the unit shows at the end, after these orders.
fn shown(unit: &str, orders: &[String]) -> Result<String, String> {
    let report = parsed(unit, orders, "unit 1 is in OP")?.replay(1, Recording::new(false, false));
    Ok(report.failure.map_or_else(String::new, |failure| failure.seen))
}

#[test]
fn the_longest_lists_are_written_and_the_unit_refuses_their_result() {
    let nx = "{ model = \"nx-ect101\" }";
    for (orders, code) in [
        (vec![map(ENTRIES_254)], "0x001D"),
        (vec![assign("0x1C13", "1A00", 254)], "0x0024"),
        (vec![typed("0x1A00", 254)], "0x0024"),
        (vec![map(ENTRIES_254), assign("0x1C12", "1601", 254)], "0x001D"),
    ] {
        let expected = format!("unit 1 is in PRE-OP with AL status code {code}");
        assert_eq!(shown(nx, &orders), Ok(expected), "{orders:?}");
    }
}

#[test]
fn a_terminal_refuses_the_length_that_follows_from_a_long_list() {
    let orders = ["0x1C10", "0x1C11", "0x1C12"].map(|object| assign(object, "1600", 254));
    assert_eq!(
        shown("{ model = \"digital\", outputs = 64 }", &orders),
        Ok("unit 1 is in PRE-OP with AL status code 0x001D".to_owned())
    );
}
