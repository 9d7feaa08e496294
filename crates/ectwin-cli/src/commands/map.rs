//! `ectwin map FILE`: the I/O map of a unit, with the Modbus addresses of its variables.

use std::fmt::Write;

use ectwin::modbus::{MapRow, ModbusMap};
use plc::{DeviceVariables, NodeLocation, Variable, VariableAccess};
use serde::Serialize;

use crate::cli::MapArgs;
use crate::failure::Failure;
use crate::failure_document::or_document;
use crate::{output, unit_files};

/// The JSON document.
#[derive(Serialize)]
struct Document {
    variables: Vec<Row>,
}

/// A variable. The CSV file has these columns in this order; missing values are empty.
#[derive(Serialize)]
struct Row {
    port: Option<String>,
    variable: String,
    at: Option<String>,
    r#type: String,
    direction: Option<&'static str>,
    access: &'static str,
    modbus_table: Option<&'static str>,
    modbus_first: Option<u16>,
    modbus_last: Option<u16>,
    forced_first: Option<u16>,
    forced_last: Option<u16>,
    nx_object: Option<String>,
    pdo_entry: Option<String>,
}

const COLUMNS: [&str; 13] = [
    "port",
    "variable",
    "at",
    "type",
    "direction",
    "access",
    "modbus_table",
    "modbus_first",
    "modbus_last",
    "forced_first",
    "forced_last",
    "nx_object",
    "pdo_entry",
];

pub(crate) fn run(args: &MapArgs) -> Result<(), Failure> {
    let (file, _) = or_document(args.json, unit_files::parse(&args.unit))?;
    let rows = rows(file.variables());
    let text = match (args.json, args.csv) {
        (true, _) => output::json(&Document { variables: rows })?,
        (false, true) => as_csv(&rows),
        (false, false) => as_text(&rows),
    };
    output::print(text.as_bytes())
}

fn rows(variables: &DeviceVariables) -> Vec<Row> {
    let map = ModbusMap::of(variables);
    let addresses = |id| map.rows().iter().find(|row| row.variable == id);
    let rows = variables.iter().map(|(id, variable)| row(variable, addresses(id)));
    rows.chain([node_location(variables.node_location())]).collect()
}

/// A variable only for programs: a structure, which has no position in an image and no Modbus address.
fn node_location(location: NodeLocation) -> Row {
    Row {
        port: Some(location.port.to_owned()),
        variable: location.name,
        at: Some(location.at),
        r#type: location.type_name.to_owned(),
        direction: None,
        access: "RO",
        modbus_table: None,
        modbus_first: None,
        modbus_last: None,
        forced_first: None,
        forced_last: None,
        nx_object: None,
        pdo_entry: None,
    }
}

fn row(variable: &Variable, addresses: Option<&MapRow>) -> Row {
    let forced = addresses.and_then(|row| row.forced.as_ref());
    Row {
        port: variable.port.clone(),
        variable: variable.name.clone(),
        at: variable.at.clone(),
        r#type: variable.variable_type.to_string(),
        direction: variable.place.area.direction_id(),
        access: match variable.access {
            VariableAccess::ReadOnly => "RO",
            VariableAccess::ReadWrite => "RW",
        },
        modbus_table: addresses.map(|row| row.table.id()),
        modbus_first: addresses.map(|row| *row.addresses.start()),
        modbus_last: addresses.map(|row| *row.addresses.end()),
        forced_first: forced.map(|forced| *forced.start()),
        forced_last: forced.map(|forced| *forced.end()),
        nx_object: variable.nx_object.map(|address| address.to_string()),
        pdo_entry: variable.pdo_entry.map(|address| address.to_string()),
    }
}

impl Row {
    /// In the order of [`COLUMNS`].
    fn cells(&self) -> [String; 13] {
        let text = |text: &Option<String>| text.clone().unwrap_or_default();
        let word = |word: Option<&str>| word.unwrap_or_default().to_owned();
        let number = |number: Option<u16>| number.map(|number| number.to_string()).unwrap_or_default();
        [
            text(&self.port),
            self.variable.clone(),
            text(&self.at),
            self.r#type.clone(),
            word(self.direction),
            self.access.to_owned(),
            word(self.modbus_table),
            number(self.modbus_first),
            number(self.modbus_last),
            number(self.forced_first),
            number(self.forced_last),
            text(&self.nx_object),
            text(&self.pdo_entry),
        ]
    }
}

/// As in RFC 4180, except for the line end.
fn as_csv(rows: &[Row]) -> String {
    let mut text = COLUMNS.join(",") + "\n";
    for row in rows {
        text.push_str(&row.cells().map(|cell| quoted(&cell)).join(","));
        text.push('\n');
    }
    text
}

fn quoted(cell: &str) -> String {
    if cell.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", cell.replace('"', "\"\""))
    } else {
        cell.to_owned()
    }
}

fn as_text(rows: &[Row]) -> String {
    let width = |cell: fn(&Row) -> usize| rows.iter().map(cell).max().unwrap_or(0);
    let (names, types) = (width(|row| row.variable.len()), width(|row| row.r#type.len()));
    let mut text = format!("{:names$}  {:types$}  access  modbus\n", "variable", "type");
    for row in rows {
        let Row { variable, r#type, access, .. } = row;
        let modbus = match (row.modbus_table, row.modbus_first, row.modbus_last) {
            (Some(table), Some(first), Some(last)) => {
                format!("{} {}", table.replace('_', " "), range(first, last))
            }
            _ => "-".to_owned(),
        };
        let forced = match (row.forced_first, row.forced_last) {
            (Some(first), Some(last)) => format!(", forced at {}", range(first, last)),
            _ => String::new(),
        };
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{variable:names$}  {type:types$}  {access:<6}  {modbus}{forced}");
    }
    text
}

fn range(first: u16, last: u16) -> String {
    if first == last { first.to_string() } else { format!("{first}..{last}") }
}

#[cfg(test)]
mod tests {
    use plant::UnitFile;

    use super::*;

    fn factory() -> Vec<Row> {
        let Ok(file) = UnitFile::parse("model = \"nx-ect101\"") else { panic!("the shortest unit file") };
        rows(file.variables())
    }

    #[test]
    fn the_csv_has_a_line_for_each_variable_with_every_column() {
        let csv = as_csv(&factory());
        let mut lines = csv.lines();
        assert_eq!(lines.next(), Some(COLUMNS.join(",").as_str()));
        assert!(lines.clone().all(|line| line.split(',').count() == COLUMNS.len()));
        assert_eq!(
            lines.nth(1),
            Some(
                "UINTs 02 M to C,N1_UINTs_02_M_to_C,IOBus://unit#1/UINTs 02 M to C,ARRAY[0..14] OF UINT,m_to_c,RO,\
                 input_register,15,29,20015,20029,6000:02,7000:02"
            )
        );
        assert_eq!(quoted("a \"b\", c"), "\"a \"\"b\"\", c\"");
    }

    #[test]
    fn the_columns_are_the_keys_of_the_document() {
        let rows = factory();
        let json = serde_json::to_value(&rows[0]).unwrap();
        let mut keys: Vec<_> = json.as_object().unwrap().keys().cloned().collect();
        let mut columns = COLUMNS.to_vec();
        keys.sort();
        columns.sort_unstable();
        assert_eq!(keys, columns);
    }

    #[test]
    fn the_status_word_has_its_nx_object_and_the_unit_its_location() {
        let rows = factory();
        let of_status = |row: &&Row| row.nx_object.as_deref() == Some("6003:01");
        let names: Vec<_> = rows.iter().filter(of_status).map(|row| row.variable.as_str()).collect();
        assert_eq!(names.len(), 8, "the word and seven bits: {names:?}");
        assert_eq!(names.first(), Some(&"N1_EtherCAT_Slave_Status"));
        let location = rows.last().expect("rows");
        assert_eq!(
            (location.variable.as_str(), location.at.as_deref(), location.r#type.as_str()),
            ("N1_Node_location_information", Some("IOBus://unit#1/Node location information"), "_sNXUNIT_ID")
        );
    }

    #[test]
    fn the_text_has_a_line_for_each_variable_below_its_head() {
        let rows = factory();
        assert_eq!(as_text(&rows).lines().count(), rows.len() + 1);
    }
}
