//! docs/user/scenario-reference.md is what the tables of the language say.

use std::path::{Path, PathBuf};

use nx_ect101::{Event, Fault, Pattern};
use scenario::words::{CONDITIONS, CPU, LINE, MASTER, Place, Sentence, UNIT};

/// Set to anything, it makes the test write the page instead of comparing it.
const BLESS: &str = "ECTWIN_BLESS";

const HEAD: &str = r#"<!-- Generated: cargo xtask bless -->
# Scenario files

Every key, sentence, place and fault of a scenario file. [Write a scenario](write-a-scenario.md) begins from nothing.

## The file
| key | value | left out |
|---|---|---|
| `title` | what the scenario shows, as a sentence | refused: every file needs it |
| `seed` | seed of the dice, a number | 1 |
| `limit` | the moment behind which nothing goes on: who still waits then has waited in vain | `"60s"` |
| `cycle` | period of the process data | `"1ms"` |
| `cycle_phase` | where in its period the cycle lies, from the beginning | the seed decides |
| `units` | list of units, the one next to the master first: the path of a [unit file](unit-file.md), or its keys as a table; or a table of `file` and `program` (a path, or a list of paths), to run another program than that of the unit file | one unit at its factory setting |
| `master` | a table: the [user program of the master](#the-masters-user-program) | it only does what steps order |
| `capture` | a capture whose frames are sent again at their times: a recorded master | the scripted master alone |
| `steps` | list of steps | refused: every file needs it |

Paths are seen from the scenario file, the program of a unit file from that file. A unit may run the programs `"builtin:copy"`,
`"builtin:messages"` and `"builtin:pulse"`, or files in Structured Text: several, or a folder, are
[one program](structured-text.md#several-files).

## The master's user program
The scripted master can run a program in Structured Text of its own, as an NJ/NX-series CPU Unit does with its built-in port
(manual, A-4-3).

| key of `master` | value | left out |
|---|---|---|
| `program` | path of a program in Structured Text, or a list of paths | refused |
| `device_names` | names of the units as EtherCAT slaves, in the order of the line | `"E005"` for the node address 5 |
| `task_period` | 125us, or 250us to 32ms in steps of 250us | the cycle of the process data, in step with them |

The node address of a unit is the ID that its file gives it: the ID switch, or `alias` with the switch at 0 (manual, 3-3). With a
program, each unit needs an ID of its own, 1 to 192. A unit that gets another ID in a step keeps its node address: a master learns
it from its configuration.

In each period it takes in what the slaves have sent, runs once, and gives out what goes to them with the next cycle. It has

- each entry of an assigned PDO: `E001_UDINT_01_C_to_M`, AT `ECAT://node#1/UDINT 01 C to M`. Those M to C are written by it: they
  replace what steps set. An entry that is not mapped at the moment keeps its value;
- the bits of Sysmac Error Status that are ports: `E001_Observation`, AT `ECAT://node#1/Sysmac Error Status/Observation`, and
  `E001_Minor_Fault`;
- `_EC_PDSlavTbl[n]`: the slave with node address `n` is in OP and exchanges process data; `_EC_MBXSlavTbl[n]`: it is in PRE-OP,
  SAFE-OP or OP. For that the master reads AL status of each slave in each period; without an answer twice in a row, the slave is
  not there.

It has no NX bus: NX_ReadObj, NX_WriteObj and ResetNXBError end with an error (16#400).

## Steps
A step is a table, and happens behind the step in front of it. It tells one of these:

| key | who is told |
|---|---|
| `master` | the [scripted master](#master), which works off its orders one after the other |
| `unit` | hands on a [unit](#unit) |
| `cpu` | a [CPU Unit](#cpu) |
| `line` | the [line](#line): cables and frames |
| `expect` | nobody: the [condition](#conditions) has to hold now |
| `never` | nobody: the condition has to hold at no moment from now to the end |
| `random` | so many steps that the dice write, within the time of `within`; a scenario may have one such step |

When it is due; without any, at once:

| key | due |
|---|---|
| `at` | at this time from the beginning |
| `after` | so long after the step in front of it |
| `when` | as soon as this condition holds |

How long an `expect` has, and how often a step happens:

| key | meaning |
|---|---|
| `within` | the condition has to hold at some moment before this time has passed; the next step comes at that moment |
| `for` | it has to hold at every moment until this time has passed |
| `until` | it has to hold at every moment until this condition does; `never` takes it too |
| `repeat`, `every` | the step happens so many times in all, one so long after the other |
| `jitter` | each repetition comes earlier or later by at most this time, as the dice say |

Times have a unit: `20us`, `1.5ms`, `2s`.
"#;

fn page() -> String {
    let mut page = HEAD.to_owned();
    sentences(&mut page, "master", "What `master` may be told.", MASTER);
    sentences(&mut page, "unit", "What `unit` may be told.", UNIT);
    sentences(&mut page, "cpu", "What `cpu` may be told.", CPU);
    sentences(&mut page, "line", "What `line` may be told. Faults add up until the line is quiet.", LINE);
    sentences(&mut page, "conditions", "What `expect`, `never` and `when` take.", CONDITIONS);
    places(&mut page);
    faults(&mut page);
    patterns(&mut page);
    page
}

fn sentences<T>(page: &mut String, heading: &str, opening: &str, table: &[Sentence<T>]) {
    let rows = table.iter().map(|sentence| {
        [format!("`{}`", sentence.pattern), format!("`{}`", sentence.example), sentence.meaning.to_owned()]
    });
    section(page, heading, opening, ["sentence", "example", "meaning"], rows);
}

fn places(page: &mut String) {
    let rows = Place::all().iter().map(|place| [format!("`{{{}}}`", place.name), place.meaning.to_owned()]);
    section(page, "places", "What a sentence may have in its places.", ["place", "what stands there"], rows);
}

fn faults(page: &mut String) {
    let rows = Fault::ALL.iter().map(|fault| {
        let code = fault.event();
        let name = Event::find(code).map_or("", |event| event.name.as_str());
        [format!("`{fault:?}`"), format!("[{code}](../events/{code}.md) {name}")]
    });
    section(
        page,
        "faults",
        "What `break` and `mend` name, and the event that it raises.",
        ["fault", "event"],
        rows,
    );
}

fn patterns(page: &mut String) {
    let rows = Pattern::ALL.iter().map(|pattern| {
        let steps: Vec<String> = pattern.steps_ms().iter().map(u64::to_string).collect();
        let times = if steps.is_empty() { "steady".to_owned() } else { steps.join(", ") };
        [format!("`{}`", pattern.id()), times]
    });
    let opening = "What an indicator does; the times are lit, dark, lit, … in milliseconds.";
    section(page, "patterns", opening, ["pattern", "times"], rows);
}

fn section<const N: usize>(
    page: &mut String,
    heading: &str,
    opening: &str,
    columns: [&str; N],
    rows: impl Iterator<Item = [String; N]>,
) {
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    page.push_str(&format!("\n## {heading}\n{opening}\n\n"));
    page.push_str(&line(&columns.map(str::to_owned)));
    page.push_str(&format!("|{}\n", "---|".repeat(N)));
    rows.for_each(|cells| page.push_str(&line(&cells)));
}

fn path() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/user/scenario-reference.md")
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
fn every_place_of_a_sentence_is_in_the_table_of_places() {
    let page = page();
    let (sentences, places) = page.split_once("\n## places\n").expect("a table of places");
    for place in sentences.split('{').skip(1).filter_map(|rest| rest.split('}').next()) {
        assert!(places.contains(&format!("`{{{place}}}`")), "{place}");
    }
}
