//! docs/user/structured-text-reference.md agrees with the tables of the language.

use std::path::{Path, PathBuf};

use st::{Class, Elementary, Entry};

/// If this variable is set, the test writes the page instead of comparing it.
const BLESS: &str = "ECTWIN_BLESS";

const HEAD: &str = "<!-- Generated: cargo xtask bless -->
# Structured Text: types and library

Every elementary type, function and function block that a program can use. To start, read [run your PLC program](structured-text.md);
[the language](structured-text-language.md) has statements and operators.

The case of names is ignored. A name in parentheses is another name of the same input: the name in IEC 61131-3, if OMRON uses a different
one. Give inputs by name or in this order; if a list ends with `…`, any number of further inputs can follow. A fault
[ends the scan](structured-text.md#a-scan).

Inputs that take several types use the names of the standard: ANY_INT is SINT to ULINT, ANY_REAL is REAL and LREAL, ANY_NUM is both of them,
ANY_MAGNITUDE is ANY_NUM and TIME.
";

/// Generic types of IEC 61131-3, 6.4.3, and the lists that they replace; longer ones first.
const GENERIC_TYPES: [(&str, &str); 4] = [
    ("ANY_MAGNITUDE", "SINT … LINT, USINT … ULINT, REAL … LREAL, TIME"),
    ("ANY_NUM", "SINT … LINT, USINT … ULINT, REAL … LREAL"),
    ("ANY_INT", "SINT … LINT, USINT … ULINT"),
    ("ANY_REAL", "REAL … LREAL"),
];

const CONVERSIONS: &str = "
## conversions
| call | result |
|---|---|
| `INT_TO_REAL(x)`, and the same for every two types of the table above | x as a value of the other type |
| `TO_REAL(x)` | the same, for any type of x |
| `INT_TO_STRING(x)`, `TO_STRING(x)` | x as text: `-5`, `00FF` (a bit string, all its digits), `0.1`, `TRUE`, `T#1s500ms` |
| `STRING_TO_INT(x)` | the value of such a text; a text that is not a value of the type is a fault |
| `EnumToNum(x)` | the number of a value of an enumeration, as a DINT |
| `LOWER_BOUND(x, 1)`, `UPPER_BOUND(x, 1)` | the bounds of a dimension of an array, as DINTs |

Between integers and bit strings the low bits stay and the others are cut. A floating point number is rounded to the nearest integer, halves to the
even one; beyond the range of the type it becomes the limit, and NaN becomes 0. A bit string takes the rounded number as a bit pattern: `REAL_TO_WORD(-1.6)` is
16#FFFE. To BOOL, every value except 0 is TRUE. For dates, only `DT_TO_DATE` and `DT_TO_TOD` convert to another type.
";

fn page() -> String {
    let mut page = HEAD.to_owned();
    types(&mut page);
    page.push_str(CONVERSIONS);
    library(&mut page, &st::reference());
    page
}

fn types(page: &mut String) {
    let rows = Elementary::ALL.map(|elementary| {
        let bits = elementary.bits();
        [format!("`{elementary}`"), bits.to_string(), values(elementary, bits)]
    });
    section(page, "elementary types", ["type", "bits", "values"], rows);
}

fn values(elementary: Elementary, bits: u32) -> String {
    match elementary.class() {
        Class::Bool => "FALSE, TRUE".to_owned(),
        Class::BitString => format!("a string of {bits} bits, 16#0 to 16#{:X}", u64::MAX >> (64 - bits)),
        Class::Signed => format!("{} to {}", i64::MIN >> (64 - bits), i64::MAX >> (64 - bits)),
        Class::Unsigned => format!("0 to {}", u64::MAX >> (64 - bits)),
        Class::Real => format!("floating point numbers of IEEE 754, binary{bits}"),
        Class::Time => "durations of whole nanoseconds, about 292 years on both sides of zero".to_owned(),
        Class::Date => match elementary {
            Elementary::Date => "days, D#1970-01-01 to D#2106-02-06",
            Elementary::TimeOfDay => "also TOD: TOD#00:00:00 to TOD#23:59:59.999999999",
            _ => "also DT: DT#1970-01-01-00:00:00 to DT#2106-02-06-23:59:59.999999999",
        }
        .to_owned(),
    }
}

fn library(page: &mut String, entries: &[Entry]) {
    for entries in entries.chunk_by(|one, next| one.group == next.group) {
        let Some(first) = entries.first() else { continue };
        let rows = entries.iter().map(|entry| {
            [
                format!("`{}`", entry.name),
                shorter(&entry.inputs),
                entry.outputs.clone(),
                entry.does.to_owned(),
            ]
        });
        section(page, first.group, ["name", "inputs", "result or outputs", "what it does"], rows);
    }
}

/// With generic types instead of their lists.
fn shorter(inputs: &str) -> String {
    GENERIC_TYPES.iter().fold(inputs.to_owned(), |inputs, (name, list)| inputs.replace(list, name))
}

fn section<const N: usize>(
    page: &mut String,
    heading: &str,
    columns: [&str; N],
    rows: impl IntoIterator<Item = [String; N]>,
) {
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    page.push_str(&format!("\n## {heading}\n{}|{}\n", line(&columns.map(str::to_owned)), "---|".repeat(N)));
    rows.into_iter().for_each(|cells| page.push_str(&line(&cells)));
}

fn path() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/user/structured-text-reference.md")
}

#[test]
fn the_page_is_what_the_tables_say() {
    if std::env::var_os(BLESS).is_some() {
        std::fs::write(path(), page()).expect("the page can be written");
    }
    let written = std::fs::read_to_string(path()).expect("the page");
    assert_eq!(written, page(), "cargo xtask bless");
}

#[test]
fn no_cell_breaks_its_table() {
    for entry in st::reference() {
        let cells = [&entry.inputs, &entry.outputs, entry.name, entry.does];
        assert!(cells.iter().all(|cell| !cell.contains(['|', '\n'])), "{entry:?}");
    }
}
