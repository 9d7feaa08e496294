//! The reference pages of scenarios agree with the tables of the language: files, sentences, random steps.

use std::path::{Path, PathBuf};

use coe_kit::indicators::Pattern;
use nx_ect101::{Event, Fault, Outage};
use scenario::pool::{GROUPS, MARKS};
use scenario::words::{ACTS, CONDITIONS, CPU, LINE, MASTER, Place, QUANTITIES, Sentence, UNIT};

/// If this variable is set, the test writes the page instead of comparing it.
const BLESS: &str = "ECTWIN_BLESS";

const FILES: &str = r#"<!-- Generated: cargo xtask bless -->
# Scenario files

Every key of a scenario file and of a step. To start, read [write a scenario](write-a-scenario.md); the sentences are in the
[reference of sentences](scenario-reference.md).

## The file
| key | value | default |
|---|---|---|
| `title` | what the scenario shows, as a sentence | none: every file needs it |
| `seed` | seed of the random generator, a number | 1 |
| `limit` | the latest time at which the scenario ends; a step that has not ended by then is a failure; above 0, at most 48 hours | `"60s"` |
| `cycle` | period of the process data, at least 10us | `"1ms"` |
| `cycle_phase` | phase of the cycle in its period, from the beginning | the seed decides |
| `calendar` | date and time at the beginning, UTC, 1970 to 2078: object 10F8, time stamps, times in captures | `"2026-01-01T00:00:00"` |
| `units` | list of units, the one next to the master first: the path of a [unit file](unit-file.md), or its keys as a table; or a table of `file` and `program` (a path, or a list of paths), to run another program than that of the unit file. Two units cannot have the same `name`; without names, no step can name a variable that two of them have | one unit at its factory setting |
| `master` | a table: the [user program of the master](#the-masters-user-program) | no program: the master only follows the steps |
| `use` | a [prelude](#preludes), or a list of them: files with keys and steps that several scenarios share | none |
| `with` | a table of [parameters](#parameters), each with the list of its values | no parameters: the file is one case |
| `capture` | a capture whose frames are sent again at their times: a recorded master | only the scripted master |
| `steps` | list of steps, at least one | none: every file needs it |

Paths are relative to the folder of the scenario file; the program of a unit file is relative to the unit file. A unit can run the
programs `"builtin:copy"`, `"builtin:messages"` and `"builtin:pulse"`, or files in Structured Text: several, or a folder, are
[one program](structured-text.md#several-files).

## Preludes
`use = "common.toml"` names a prelude: a file with the keys of a scenario, none of which is required. They apply where the scenario itself does
not set them (`units` as a whole); if several preludes set a key, the first of them counts. The steps of preludes come first, in the order of the list;
a prelude that is twice in the list has its steps twice.
Paths in a prelude are relative to it, and preludes can use preludes, up to 16 in a row and 100 in all. The texts of a prelude can use the
[parameters](#parameters) of the scenario. A prelude has no parameters and no random steps of its own. A failed step of a prelude is shown with the
line of `use` and its place in the prelude, such as `common.toml:5: all units are in OP`.

A folder is replayed with all files that end with `.toml`: give a prelude there another ending, such as `common.prelude`.

## Parameters
`with` makes a case of each combination of values, at most 10,000 of a file. `{loss}` in any text of the file is replaced by the value of
the parameter `loss`:

```toml parameters.toml
title = "{state} is reached with {loss} % loss"
with = { loss = [0, 1, 5], state = ["SAFE-OP", "OP"] }
steps = [
  { line = "lose {loss} % of the frames" },
  { master = "take unit 1 to {state}" },
  { expect = "unit 1 is in {state}", within = "5s" },
]
```

These are six cases, named `FILE (loss = 0, state = SAFE-OP)` and so on; `ectwin replay --case "loss = 1, state = OP"` replays one of them.
A value is a number, a text, `true`, `false`, or a range of numbers up to 65535 such as `{ from = 3, to = 5 }`, which is the same as `3, 4, 5`. A text that is only `{loss}` becomes the value itself: `seed = "{loss}"` is a number. Keys
are not replaced. `{{loss}}` is the text `{loss}`. A parameter that no text uses, and a name in braces that is no parameter, are mistakes.

## The master's user program
The scripted master can run its own program in Structured Text, like an NJ/NX-series CPU Unit with its built-in port
(manual, A-4-3).

| key of `master` | value | default |
|---|---|---|
| `program` | path of a program in Structured Text, or a list of paths | none: required |
| `device_names` | names of the units as EtherCAT slaves, in the order of the line | `"E005"` for the node address 5 |
| `task_period` | 125us, or 250us to 32ms in steps of 250us | the cycle of the process data, in step with them |

The node address of a unit is the ID in its file: the ID switch, or `alias` with the switch at 0 (manual, 3-3). If the master has a
program, each unit needs a different ID, 1 to 192. A unit that gets another ID in a step keeps its node address, because a master
has the address from its configuration.

In each period the program reads the data of the slaves, runs once, and outputs the data that go to them with the next cycle. It has

- each entry of an assigned PDO: `E001_UDINT_01_C_to_M`, AT `ECAT://node#1/UDINT 01 C to M`. The program writes the entries M to C:
  they replace the values that steps set. An entry that is not mapped at the moment keeps its value;
- the bits of Sysmac Error Status that are ports, if TxPDO 1BFF is assigned: `E001_Observation`, AT
  `ECAT://node#1/Sysmac Error Status/Observation`, and `E001_Minor_Fault`;
- `_EC_PDSlavTbl[n]`: the slave with node address `n` is in OP and exchanges process data; `_EC_MBXSlavTbl[n]`: it is in PRE-OP,
  SAFE-OP or OP. For this the master reads AL status of each slave in each period. A slave that does not answer twice in a row counts
  as absent.

It has no NX bus: NX_ReadObj, NX_WriteObj and ResetNXBError end with an error (16#400).

## Steps
A step is a table. It happens after the step before it, and has one of these keys:

| key | what it is for |
|---|---|
| `master` | the [scripted master](scenario-reference.md#master), which carries out its orders one after the other |
| `unit` | a manual operation at a [unit](scenario-reference.md#unit) |
| `cpu` | a [CPU Unit](scenario-reference.md#cpu) |
| `line` | the [line](scenario-reference.md#line): cables and frames |
| `expect` | the [condition](scenario-reference.md#conditions) has to hold now |
| `never` | the condition must not hold at any moment from now to the end; the next step does not wait |
| `steps`, `together` | a [group](#groups) of steps |
| `random` | [random steps](random-steps.md), within the time of `within` |

These keys say when a step is due; without them it is due at once:

| key | due |
|---|---|
| `at` | at this time from the beginning |
| `after` | this time after the step before it |
| `when` | as soon as this condition holds |

These keys give the time of an `expect`, and the repetition of a step:

| key | meaning |
|---|---|
| `within` | the condition has to hold at some moment before this time has passed; the next step comes at that moment |
| `for` | it has to hold at every moment until this time has passed |
| `until` | it has to hold at every moment until this condition holds, which must not hold at once. `never` takes this key too: the condition must not hold until then. The next step waits for the end |
| `while` | it has to hold at every moment at which this condition holds, to the end of the run; this condition has to hold at some moment. The next step does not wait |
| `repeat`, `every` | total number of times that the step happens, and the time from one to the next |
| `jitter` | each repetition is earlier or later by at most this time, chosen at random |

The next step waits for the last repetition of a step. A run ends after the last step, when the master has nothing to do; if an
order, a `never` or a `while` is the last step, 200 ms later at the earliest. If `limit` comes before that, the scenario fails. After such a step the
run also waits, at most until `limit`, for what is pending: a transition that takes its time, a watchdog that runs, faults of frames that will end by
themselves or whose frames are still to come.

If an order changes what an expectation behind it is about, the state before the order does not fulfil it: after `request OP of unit 1`, the
condition `unit 1 is in SAFE-OP` with `within` has to be false before it counts. Such orders are requests, writes, faults of units, what ends process
data (`stop process data`, a pulled cable, power off, lost frames), and the I/O refreshing and the task of a CPU Unit. This applies to expectations
that follow at once, with or without other orders between them, in groups and behind groups. `for` checks that a state stays as it is.

### Warnings
A file can pass and still test less than it seems to. `ectwin replay` prints a warning for

- an expectation with `within` whose condition was true before the orders directly before it, and still was after them. In rounds it is named only if
  this is so each time. An event that was recorded once stays recorded: `has recorded … again` and `has given up again` count only what has come since
  the orders directly before the step;
- a fault of frames that no frame has met, with or without a name, unless a probability selects them;
- an order that the master has given up, if no later expectation is about this unit or about the orders of the master;
- a step with `at` that comes later than its time, because the steps before it have lasted until then;
- an order that finds nothing to do: `be quiet` without a fault, a mode, a task or I/O refreshing that is so already, `stop process data` twice, `release`
  of what no step has forced. In groups and after random steps it is not known, and not named;
- a file without any expectation or `when`, unless it has a golden trace.

Files with random steps have only the warnings of orders. `ectwin replay --vacuous` fails if there is a warning.

### Groups
A group is a step with steps of its own. `at`, `after` and `when` say when it begins. Groups can be in groups, up to 16 deep.

| group | what happens |
|---|---|
| `{ steps = [a, b] }` | the steps one after the other |
| `{ repeat = 20, every = "100ms", steps = [a, b] }` | 20 rounds. Each begins 100 ms after the beginning of the one before; a round that has not ended by then is a failure. With `jitter`, at most half of `every`, each round but the first is earlier or later than its time by at most this. The next step waits for the end of the last round |
| `{ together = [a, [b, c], d] }` | three sequences that begin at the same time; a list is a sequence. The next step waits for the last of them |
| `{ for.unit = [2, 3], steps = [a, b] }` | the steps for each value: `{unit}` in a text is replaced by it. With several names (`for.unit = [2, 3], for.cable = [1, 2]`) for each combination. Together with `repeat` each round has all of them; with `together` the sequences of all values begin at the same time. A value can be a range of numbers, the name of a unit and the value of a parameter, which a range can have too: `for.unit = [2, { from = 4, to = "{last}" }, "Conveyor", "{first}"]`. At most 10,000 steps |

```toml groups.toml
title = "contacts of two cables are loose at the same time, ten times"
units = [{ model = "nx-ect101" }, { model = "nx-ect101", name = "N2", serial = 2 }]
steps = [
  { master = "take all units to OP" },
  { expect = "all units are in OP", within = "1s" },
  { repeat = 10, every = "100ms", jitter = "20ms", steps = [
    { for.cable = [1, 2], together = [
      [{ line = "unplug cable {cable}" }, { after = "{cable}ms", line = "plug cable {cable}" }],
    ] },
    { expect = "all units are in OP", for = "30ms" },
  ] },
]
```

### Units
Sentences name units by their numbers, 1 for the one next to the master, or by the `name` in their unit files: `unit 3`, `unit Conveyor`,
`units 3 to 5`, `units 2, 4 and Conveyor`, `all units`. Upper and lower case are the same. A name means the place of that unit in the line, also
after another unit was put there. What has one value, such as an object or a register, is of one unit: `for.unit` repeats the step for several.

```toml units.toml
title = "only the units behind the infeed are taken to OP"
units = [
  { model = "nx-ect101", name = "Infeed" },
  { model = "nx-ect101", name = "Conveyor", serial = 2 },
  { model = "digital", name = "Lamps", outputs = 8 },
  { model = "digital", name = "Doors", inputs = 8 },
]
steps = [
  { master = "take units Conveyor, 3 to 4 to OP" },
  { expect = "units 2 to 4 are in OP", within = "1s" },
  { for.unit = ["Lamps", "Doors"], steps = [{ expect = "unit {unit} has recorded nothing" }] },
  { expect = "unit Infeed is in INIT" },
]
```

### Times
Times have a unit: `20us`, `1.5ms`, `2s`. A sentence has at most 65,536 bytes.

The scripted master waits 10 s for each state of a `take`, 5 s for an SDO, a register or a mailbox message, and 2 ms for a frame. Then it
gives up the order and continues with the next one.

A unit without power does nothing: an order that its software would carry out has no effect, and the trace says so. Actions by hand
have an effect: power, the ID switch, the SII, causes of hardware faults, settings of its conduct. A condition on its inside (states,
errors, objects, registers, events, logs, diagnosis, lost emergencies, outputs, the validity of its data) fails while it has no power;
of a value that is compared or `changes`, and of the diagnosis (`is contradictory`), `not (…)` fails too.

Values compare as numbers by their type: those of a variable and of an object with a signed or real type as such, bytes otherwise as unsigned
little-endian numbers. `is` and `is not` keep the notation of the sentence with `is`: bytes of objects, registers and process data are hexadecimal,
the numbers of the other comparisons decimal unless they begin with `0x` or `16#`. A comparison that every value passes, or none, is a mistake.

Conditions combine: `not (…)`, `all of (…; …)`, `any of (…; …)`, at most 16 deep. A condition on what is not there, such as a byte beyond
the process data, is neither true nor false: `not` leaves it so, `all of` is false if another part is, `any of` true if another part is. `never`
checks that its condition is false, which is what `not` checks at one moment.

An expectation that cannot fail, or that can never hold, is a mistake in the file: a condition on the program of a unit that has none at that
time, `0 cycles are done`, the validity of data that a terminal does not have, bytes beyond the process data, `any of (A; not (A))`, a
`never` of two states of one unit at the same time, a `while` or `until` that is the expected condition itself. Orders on such bytes, and on
what a unit does not have (a mailbox, the state BOOT, the ID switch), are mistakes too. So are AL status codes, abort codes and registers that
no unit has, more records than a log holds, and `the last SDO …`, `the last frame …` and their kind if no step orders one.

An order that does nothing is a mistake: a cable that is unplugged already, a unit that has power already, the cause of a fault that is there.
In a group, and after a group or random steps, it is not known, and nothing is refused.

A condition on a variable of a program is checked with the program that the unit has at that step, of `never` also with those
that later steps load. If the variable is not there when the condition is checked, the step fails.
"#;

/// The pages, by their names.
fn pages() -> [(&'static str, String); 3] {
    [("scenario-files", FILES.to_owned()), ("scenario-reference", reference()), ("random-steps", pool())]
}

const SENTENCES: &str = r"<!-- Generated: cargo xtask bless -->
# Sentences of scenarios

Every sentence, placeholder and fault of a scenario. [Scenario files](scenario-files.md) has the keys of files and steps, and
[random steps](random-steps.md) what random steps are drawn from.
";

fn reference() -> String {
    let mut page = SENTENCES.to_owned();
    sentences(&mut page, "master", "The sentences of `master`.", MASTER);
    sentences(&mut page, "unit", "The sentences of `unit`.", UNIT);
    sentences(&mut page, "cpu", "The sentences of `cpu`.", CPU);
    sentences(&mut page, "line", "The sentences of `line`. Faults accumulate until the line is quiet.", LINE);
    sentences(
        &mut page,
        "conditions",
        "The conditions of `expect`, `never`, `when`, `until` and `while`.",
        CONDITIONS,
    );
    let opening = "What has a value: the placeholder `{quantity}` of conditions. A variable with brackets is an element.";
    sentences(&mut page, "quantities", opening, QUANTITIES);
    let opening = "What a master can do to a unit: the placeholder `{act}` of conditions. It is seen by frames and by what units report, whichever \
                   master it is; frames that a fault of the line loses count as sent.";
    sentences(&mut page, "acts", opening, ACTS);
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

/// The pool of random steps.
fn pool() -> String {
    let mut page = RANDOM.to_owned();
    for group in GROUPS {
        page.push_str(&format!("| `{}` | {} |\n", group.name, group.meaning));
    }
    page.push_str("\n| mark | drawn |\n|---|---|\n");
    for mark in MARKS {
        page.push_str(&format!("| `{}` | {} |\n", mark.word, mark.meaning));
    }
    for group in GROUPS {
        page.push_str(&format!("\n## {}\n| key | sentence | weight |\n|---|---|---|\n", group.name));
        for row in group.rows() {
            page.push_str(&format!("| `{}` | `{}` | {} |\n", row.key, row.sentence, row.weight));
        }
    }
    page
}

const RANDOM: &str = r#"<!-- Generated: cargo xtask bless -->
# Random steps

`{ random = 30, within = "3s" }` is replaced by 30 steps that the seed chooses, after pauses that together take at most 3 s. A scenario can
have several of them. With a table the steps are drawn from groups of the pool, or from own sentences:

```text
{ random = { steps = 30, from = ["line", "sdo", "break Processing of unit #"], weights = [3, 2, 1] }, within = "3s" }
```

| key of `random` | value | default |
|---|---|---|
| `steps` | number of steps, 1 to 10,000 | none: required |
| `from` | list of groups, and of own sentences of `master`, `unit`, `cpu` and `line` | `["everyday"]` |
| `weights` | one for each of `from`, 1 to 1,000,000: how often a step is drawn from it | 1 for each |

A sentence is drawn only for units that have what it names; a sentence that no unit can carry out is left out. A sentence has marks for the
values that are drawn. `end NAME` can be drawn if a step before gives a fault this name; a drawn fault has no name of its own:

| group | sentences about |
|---|---|
"#;

fn places(page: &mut String) {
    let rows = Place::all().iter().map(|place| [format!("`{{{}}}`", place.name), place.meaning.to_owned()]);
    section(
        page,
        "places",
        "The placeholders of the sentences, and their values.",
        ["placeholder", "value"],
        rows,
    );
}

fn faults(page: &mut String) {
    let rows = Fault::ALL.iter().map(|fault| {
        let code = fault.event();
        let name = Event::find(code).map_or("", |event| event.name.as_str());
        [format!("`{fault:?}`"), format!("[{code}](../events/{code}.md) {name}")]
    });
    // Only the indicators show these.
    let outages = Outage::ALL.iter().map(|outage| {
        [format!("`{outage:?}`"), format!("no event: {}, on the [indicators](indicators.md)", outage.words())]
    });
    section(
        page,
        "faults",
        "The faults of `break` and `repair`, and the events that they raise.",
        ["fault", "event"],
        rows.chain(outages),
    );
}

fn patterns(page: &mut String) {
    let rows = Pattern::ALL.iter().map(|pattern| {
        let steps: Vec<String> = pattern.steps_ms().iter().map(u64::to_string).collect();
        let times = if steps.is_empty() { "steady".to_owned() } else { steps.join(", ") };
        [format!("`{}`", pattern.id()), times]
    });
    let opening = "The patterns of an indicator; the times are lit, not lit, lit, … in milliseconds.";
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

fn path(page: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/user").join(page).with_extension("md")
}

#[test]
fn the_pages_are_what_the_tables_say() {
    for (name, page) in pages() {
        let path = path(name);
        if std::env::var_os(BLESS).is_some() {
            std::fs::write(&path, &page).expect("the page can be written");
        }
        let written = std::fs::read_to_string(&path).expect("the page");
        assert_eq!(written, page, "cargo xtask bless");
    }
}

#[test]
fn every_place_of_a_sentence_is_in_the_table_of_places() {
    let page = reference();
    let (sentences, places) = page.split_once("\n## places\n").expect("a table of places");
    for place in sentences.split('{').skip(1).filter_map(|rest| rest.split('}').next()) {
        assert!(places.contains(&format!("`{{{place}}}`")), "{place}");
    }
}
