//! docs/user/scenario-values.md agrees with the types and the tables of sentences.

use std::fs;
use std::path::{Path, PathBuf};

use scenario::words::{CONDITIONS, CPU, LINE, MASTER, Sentence, Spoken, UNIT};
use serde::Serialize;

/// If this variable is set, the test writes the page instead of comparing it.
const BLESS: &str = "ECTWIN_BLESS";

const HEAD: &str = r##"<!-- Generated: cargo xtask bless -->
# Typed values of scenarios

Programs build steps as data: the order or the condition of a step is a typed value, and its sentence is one spelling of it.
[The reference](scenario-reference.md) has the sentences.

## In a file
Where a text is a sentence, a table is a typed value. Both can stand in one list of steps:

```toml typed.toml
title = "a unit reaches OP, and the cable is unplugged"
steps = [
  { master = { take = { units = "all", state = "OP" } } },
  { expect = "unit 1 is in OP", within = "100ms" },
  { when = "the master has nothing to do", line = { unplug = { cable = 1 } } },
  { expect = { state = { units = 1, state = "SAFE-OP", al_status_code = 0x001B } }, within = "110ms" },
]
```

```console
$ ectwin replay typed.toml
ok      typed.toml: a unit reaches OP, and the cable is unplugged (…ms)
1 case: 1 ok, 0 failed
```

The conditions of `not`, `all_of` and `any_of` are sentences or typed values too:

```toml logic.toml
title = "in OP, or on the way to it, but never with an error"
steps = [
  { master = "take unit 1 to OP" },
  { never = { not = "unit 1 has no error" } },
  { expect = { all_of = ["unit 1 is in OP", { not = { cycles = { at_least = 500 } } }] }, within = "100ms" },
]
```

```console
$ ectwin replay logic.toml
ok      logic.toml: in OP, or on the way to it, but never with an error (…ms)
1 case: 1 ok, 0 failed
```

Messages and the trace show a typed value as its sentence. A value that no sentence can say, such as mailbox counter 8, is refused.

## In JSON
The keys are the same. `Script` is a whole scenario, `Step` one step:

```json
{
  "title": "a unit reaches OP",
  "units": ["units/nx-ect101.toml"],
  "steps": [
    { "master": { "take": { "units": "all", "state": "OP" } } },
    { "expect": { "state": { "units": 1, "state": "OP" } }, "within": "100ms" }
  ]
}
```

## In other languages
`ectwin replay` reads TOML. A program in any language writes typed values as JSON values of the tables below, with `=` in place of the `:`
behind a key. In Python:

```python cables.py
import json


def toml(value):
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {toml(each)}" for key, each in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    return json.dumps(value, ensure_ascii=False)


steps = [
    {"master": {"take": {"units": "all", "state": "OP"}}},
    {"expect": {"state": {"units": "all", "state": "OP"}}, "within": "200ms"},
    {"when": {"master_idle": {}}, "line": {"unplug": {"cable": 2}}},
    {"expect": {"state": {"units": 2, "state": "SAFE-OP", "al_status_code": 0x1B}}, "within": "110ms"},
]
units = [{"model": "nx-ect101", "name": name, "serial": at + 1} for at, name in enumerate(["N1", "N2"])]
print('title = "cable 2 is unplugged"', f"units = {toml(units)}", f"steps = {toml(steps)}", sep="\n")
```

```console
$ python3 cables.py > cables.toml
$ ectwin replay cables.toml
ok      cables.toml: cable 2 is unplugged (…ms)
1 case: 1 ok, 0 failed
```

## In Rust
`ScenarioBuilder` takes sentences and typed values. `Scenario::of` takes a `Script`, whose types implement serde:

"##;

/// The example in Rust, which is also a test.
const IN_RUST: &str = include_str!("../../ectwin/tests/guide/scenario_values.rs");

const VALUES: &str = r##"
## Values
| value | written as |
|---|---|
| `units` | `"all"`, a `unit`, a range such as `{ "from": 3, "to": 5 }`, or a list of units and ranges: `[2, "Conveyor", { "from": 4, "to": 6 }]` |
| `unit` | the number of a unit, 1 for the one next to the master, or its name: `3`, `"Conveyor"` |
| `cable` | a number from 1 |
| `controller` | `"master"`, or a `unit`: `{ "unit": 1 }` |
| a state | `"INIT"`, `"PRE-OP"`, `"SAFE-OP"`, `"OP"`, `"BOOT"`; in `request` also a number as a text: `"0x05"` |
| a code, a register, a PDO | a text in hexadecimal such as `"0x001B"`, or a number |
| bytes | a text in hexadecimal: `"01 FF"` |
| an entry of an object | `"10F3:05"` |
| an amount that is compared | a number, or a text: `5`, `"-3"`, `"1.5"`, `"T#20ms"` |
| a time | a text with a unit: `"1.5ms"` |
| `choice` of frames | `"all"`, `{ "next": 3 }`, `{ "percent": 5 }`, `{ "per_mille": 5 }`, `{ "every": 10 }`, `{ "behind": { "skip": 2, "count": 7 } }` |
| `kind` of frames | `"any"` (the default), `"process_data"`, `"mailbox"`, `"sii"`, or a command: `"brd"` |
| `unit` of frames | the unit that they address; left out: all |
| `way` of a fault | `{ "cable": 3, "direction": "back" }`; `"outward"` and the place between master and line are the default |
| `for` and `name` of a fault | `"3s"`, `"storm"`; both can be left out |
| `by` of a delay | `"1ms"`, `"1ms to 3ms"`, `"2ms ± 1ms"` or `"2ms ± 1ms normal"`; `+-` is read as `±` |

A value without fields has an empty table, such as `{ "behave": {} }`: a text is always a sentence.

The conditions are on [a page of their own](scenario-values-of-conditions.md).
"##;

const HEAD_OF_CONDITIONS: &str = "<!-- Generated: cargo xtask bless -->\n\
    # Typed values of conditions\n\
    What `expect`, `never`, `until`, `while` and `when` can check, as a sentence and as data. \
    [Typed values of scenarios](scenario-values.md) has the orders, the values and how to use them from TOML, JSON and Rust.\n";

fn page_of_orders() -> String {
    let mut page = format!("{HEAD}```rust\n{IN_RUST}```\n{VALUES}");
    values(&mut page, "master", MASTER);
    values(&mut page, "unit", UNIT);
    values(&mut page, "cpu", CPU);
    values(&mut page, "line", LINE);
    page
}

fn page_of_conditions() -> String {
    let mut page = HEAD_OF_CONDITIONS.to_owned();
    values(&mut page, "conditions", CONDITIONS);
    page
}

fn values<T: Spoken + Serialize>(page: &mut String, heading: &str, table: &[Sentence<T>]) {
    page.push_str(&format!("\n## {heading}\n| sentence | typed value |\n|---|---|\n"));
    for Sentence { example, .. } in table.iter().filter(|row| !row.is_old) {
        let json = T::from_sentence(example).ok().and_then(|value| serde_json::to_string(&value).ok());
        page.push_str(&format!("| `{example}` | `{}` |\n", json.unwrap_or_default()));
    }
}

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/user").join(name)
}

#[test]
fn the_pages_are_what_the_types_say() {
    let pages = [
        ("scenario-values.md", page_of_orders()),
        ("scenario-values-of-conditions.md", page_of_conditions()),
    ];
    for (name, page) in pages {
        if std::env::var_os(BLESS).is_some() {
            fs::write(path(name), &page).unwrap_or_else(|error| panic!("{error}"));
        }
        let written = fs::read_to_string(path(name)).unwrap_or_else(|error| panic!("{error}"));
        assert!(written == page, "{name}: cargo xtask bless");
    }
}
