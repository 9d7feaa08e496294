//! Units by their names, ranges and lists: each form in a scenario that passes and in one that fails, and its mistakes.

use scenario::model::{Condition, MasterOrder, Order, Script, ScriptStep, UnitNumber, UnitSet, WhichUnit};
use scenario::words::Spoken;
use scenario::{Recording, Scenario};

/// Units 2, 4 and 5 are in OP, units 1 and 3 in INIT.
const LINE: &str = r#"title = "t"
units = [
  { model = "nx-ect101", name = "Infeed" },
  { model = "nx-ect101", name = "Conveyor", serial = 2 },
  { model = "digital", name = "K3", inputs = 8 },
  { model = "digital", name = "K4", inputs = 8 },
  { model = "digital", name = "Outfeed", outputs = 8 },
]
"#;

fn read(steps: &str) -> Result<Scenario, Vec<String>> {
    let text = format!("{LINE}steps = [\n{steps}\n]\n");
    let read = Scenario::parse(&text, |name| Err(format!("{name} is another file")));
    read.map_err(|errors| errors.iter().map(ToString::to_string).collect())
}

/// The failure of a scenario; none if it passes.
fn failure(steps: &str) -> Option<String> {
    let scenario = read(steps).unwrap_or_else(|errors| panic!("{steps}\n{}", errors.join("\n")));
    scenario.replay(1, Recording::new(false, false)).failure.map(|failure| failure.seen)
}

fn taken(expectation: &str) -> String {
    format!(
        "{{ master = \"take units 2, 4 to 5 to OP\" }},\n{{ expect = {expectation}, within = \"500ms\" }}"
    )
}

#[test]
fn each_form_holds_and_fails() {
    for (holds, fails) in [
        ("\"units 4 to 5 are in OP\"", "\"units 3 to 5 are in OP\""),
        ("\"units 2 and 5 are in OP\"", "\"units 2, 3 and 5 are in OP\""),
        ("\"units 2, 4 to 5 are in OP\"", "\"units 1, 4 to 5 are in OP\""),
        ("\"unit Conveyor is in OP\"", "\"unit Infeed is in OP\""),
        ("\"unit conveyor is in OP\"", "\"unit INFEED is in OP\""),
        ("\"units Outfeed, 2 and K4 are in OP\"", "\"units Outfeed, 2, and K3 are in OP\""),
        ("{ state = { units = [2, 5], state = \"OP\" } }", "{ state = { units = [2, 3], state = \"OP\" } }"),
        (
            "{ state = { units = [\"Conveyor\", { from = 4, to = 5 }], state = \"OP\" } }",
            "{ state = { units = [\"Infeed\", { from = 4, to = 5 }], state = \"OP\" } }",
        ),
        (
            "{ state = { units = { from = 4, to = 5 }, state = \"OP\" } }",
            "{ state = { units = { from = 1, to = 2 }, state = \"OP\" } }",
        ),
        (
            "{ state = { units = \"Outfeed\", state = \"OP\" } }",
            "{ state = { units = \"K3\", state = \"OP\" } }",
        ),
        ("\"RUN of units 2, 4 and 5 is lit\"", "\"RUN of units 2 to 4 is lit\""),
        (
            "\"object 1018:04 of unit Conveyor is 02 00 00 00\"",
            "\"object 1018:04 of unit Infeed is 02 00 00 00\"",
        ),
        (
            "\"object 1018:04 of unit Conveyor is at least 2\"",
            "\"object 1018:04 of unit Infeed is at least 2\"",
        ),
        (
            "\"any of (unit K3 is in OP; units 4 and Conveyor are in OP)\"",
            "\"all of (unit K4 is in OP; unit K3 is in OP)\"",
        ),
    ] {
        assert_eq!(failure(&taken(holds)), None, "{holds}");
        assert!(failure(&taken(fails)).is_some(), "{fails}");
    }
}

/// A part of a condition, a moment, the end and the span of an expectation, and a group.
#[test]
fn names_are_read_at_every_place_of_a_step() {
    let steps = |name: &str| {
        format!(
            r#"{{ master = "take units 2 and 5 to OP" }},
               {{ when = "unit {name} is in OP", steps = [{{ expect = "not (unit {name} is in INIT)", until = "200 cycles are done" }}] }},
               {{ line = "lose all frames of unit {name} called storm" }},
               {{ expect = "unit {name} is in SAFE-OP with AL status code 0x001B", within = "200ms" }},
               {{ never = "unit {name} is in OP", until = "900 cycles are done" }}"#
        )
    };
    assert_eq!(failure(&steps("Conveyor")), None);
    assert!(failure(&steps("Infeed")).is_some());
}

#[test]
fn values_of_for_are_names_and_ranges() {
    let steps = |values: &str| {
        format!(
            "{{ master = \"take units Conveyor, K4 and Outfeed to OP\" }},\n{{ after = \"500ms\", for.unit = {values}, steps = [{{ expect = \"unit {{unit}} is in OP\" }}] }}"
        )
    };
    for values in [r#"["Conveyor", { from = 4, to = 5 }]"#, "{ from = 4, to = 5 }"] {
        assert_eq!(failure(&steps(values)), None, "{values}");
    }
    for values in [r#"["Infeed", { from = 4, to = 5 }]"#, "{ from = 3, to = 5 }"] {
        assert!(failure(&steps(values)).is_some(), "{values}");
    }
    for (values, message) in [
        ("{ from = 5, to = 4 }", "`for.unit` is no range from 5 to 4"),
        ("{ from = 5, to = 3 }", "the smaller number is first: `{ from = 3, to = 5 }`"),
        ("{ from = 5, to = 5 }", "one value is `[5]`"),
        ("{ from = 1, to = 100000 }", "a range has at most 10000 numbers"),
        ("[4, { from = 3, to = 5 }]", "has the value 4 twice"),
        ("{ from = 4, to = 6 }", "unit 6 does not exist"),
        ("[\"Convyor\"]", "did you mean `Conveyor`?"),
        ("[{ first = 4, to = 6 }]", "unknown"),
    ] {
        let told = read(&steps(values)).expect_err(values).join("\n");
        assert!(told.contains(message), "{values}: {told}");
    }
}

#[test]
fn mistakes_have_their_place_and_a_way_out() {
    let known = "the units are named Infeed, Conveyor, K3, K4, Outfeed";
    for (step, message, help) in [
        (
            r#"{ expect = "unit Convyor is in OP" }"#,
            "no unit is named Convyor",
            "did you mean `Conveyor`? the units are",
        ),
        (r#"{ expect = "unit Press is in OP" }"#, "no unit is named Press", known),
        (r#"{ line = "lose all frames of unit K9" }"#, "no unit is named K9", "did you mean `K3`?"),
        (
            r#"{ unit = "restart units 5 to 3" }"#,
            "`5 to 3` is no range of units",
            "the smaller number is first: `units 3 to 5`",
        ),
        (r#"{ unit = "restart units 3 to 3" }"#, "`3 to 3` is no range of units", "one unit is `unit 3`"),
        (
            r#"{ unit = "restart units 3 to 6" }"#,
            "unit 6 does not exist",
            "the line has 5 units, counted from 1",
        ),
        (r#"{ cpu = "stop the task of units 2 and 9" }"#, "unit 9 does not exist", "the line has 5 units"),
        (
            r#"{ master = "take units 2, 3 to 5 and 4 to OP" }"#,
            "unit 4 is twice among them",
            "name each unit once",
        ),
        (
            r#"{ master = "take units 2 and Conveyor to OP" }"#,
            "unit 2 is twice among them",
            "name each unit once",
        ),
        (r#"{ master = "take units 2 to OP" }"#, "found `to`", "the sentence is `take {units} to {state}`"),
        (
            r#"{ master = "take units 2, and to OP" }"#,
            "found `to`",
            "the sentence is `take {units} to {state}`",
        ),
        (r#"{ expect = "unit is in OP" }"#, "found `is`", "{units} is in {state}"),
        (
            r#"{ expect = "unit is is in OP" }"#,
            "found `is`",
            "`is` is a word of the sentences: a unit with this name has its number",
        ),
        (
            r#"{ master = "take unit to to OP" }"#,
            "found `to`",
            "`to` is a word of the sentences: a unit with this name has its number",
        ),
        (r#"{ expect = "unit 0 is in OP" }"#, "found `0`", "{units} is in {state}"),
        (r#"{ expect = "register 0x0300 of units 1 and 2 is 00" }"#, "found `units`", "{unit} is {bytes}"),
        (
            r#"{ expect = "object 1018:04 of units 1 to 2 is at least 2" }"#,
            "found `units`",
            "for.unit = [2, 3]",
        ),
        (r#"{ expect = "the outputs of all units begin with 00" }"#, "found `all`", "for.unit = [2, 3]"),
        (r#"{ master = "read SDO 1018:04 of units 1 and 2" }"#, "found `units`", "for.unit = [2, 3]"),
        (r#"{ expect = { state = { units = [], state = "OP" } } }"#, "a list without units", ""),
        (
            r#"{ expect = { state = { units = [2, 2], state = "OP" } } }"#,
            "unit 2 is twice",
            "name each unit once",
        ),
        (r#"{ expect = { state = { units = "is", state = "OP" } } }"#, "found `is`", "{units} is in {state}"),
        (r#"{ never = { not = "unit K7 is in OP" } }"#, "no unit is named K7", known),
        (r#"{ when = "unit K7 is in OP", line = "be quiet" }"#, "no unit is named K7", known),
        (r#"{ expect = "unit 1 is in INIT", while = "unit K7 is in OP" }"#, "no unit is named K7", known),
        (r#"{ expect = "unit 1 is in INIT", until = "unit K7 is in OP" }"#, "no unit is named K7", known),
    ] {
        let told = read(step).expect_err(step).join("\n");
        assert!(told.contains(message) && told.contains(help), "{step}: {told}");
        assert!(told.starts_with("line 10, column"), "{told}");
    }
}

/// A name that the model gave to several units.
#[test]
fn a_name_of_several_units_is_refused() {
    let text = "title = \"t\"\nunits = [{ model = \"nx-ect101\" }, { model = \"nx-ect101\" }]\nsteps = [{ expect = \"unit N1 is in INIT\" }]";
    let told = Scenario::parse(text, |_| Err(String::new())).expect_err("two of them").to_string();
    assert!(told.contains("line 3, column 21: units 1 and 2 are named N1"), "{told}");
    assert!(told.contains("give each of them another `name`, or write its number"), "{told}");
    let alone = text.replace("{ model = \"nx-ect101\" }, ", "");
    assert!(Scenario::parse(&alone, |_| Err(String::new())).is_ok());
}

#[test]
fn names_ranges_and_lists_are_the_same_in_sentences_and_in_json() {
    for (sentence, json) in [
        ("take unit Conveyor to OP", r#"{"take":{"units":"Conveyor","state":"OP"}}"#),
        ("take unit all to OP", r#"{"take":{"units":["all"],"state":"OP"}}"#),
        ("take units 3 to 5 to OP", r#"{"take":{"units":{"from":3,"to":5},"state":"OP"}}"#),
        ("take units 2, 4 and K5 to OP", r#"{"take":{"units":[2,4,"K5"],"state":"OP"}}"#),
        ("take units 2 and 4 to 6 to OP", r#"{"take":{"units":[2,{"from":4,"to":6}],"state":"OP"}}"#),
        ("read SDO 1018:04 of unit K5", r#"{"read_sdo":{"unit":"K5","entry":"1018:04"}}"#),
    ] {
        let order = MasterOrder::from_sentence(sentence).expect(sentence);
        assert_eq!(order.sentence(), sentence);
        assert_eq!(serde_json::to_string(&order).expect(sentence), json);
        assert_eq!(serde_json::from_str::<MasterOrder>(json).expect(json), order);
    }
    let one_of_a_list: Condition = serde_json::from_str(r#"{"has_no_error":{"units":[3]}}"#).expect("a list");
    let third = UnitSet::One(WhichUnit::Number(UnitNumber::at(2)));
    assert_eq!(one_of_a_list, Condition::HasNoError { units: third });
}

/// A script keeps the names that it has; the run sees numbers.
#[test]
fn a_script_keeps_names() {
    let text = format!("{LINE}steps = [{{ master = \"take unit Conveyor to OP\" }}]\n");
    let script = Script::parse(&text).expect("a script");
    let ScriptStep::Step(step) = &script.steps[0] else { panic!("{:?}", script.steps) };
    let Order::Master(MasterOrder::Take { units, .. }) = &step.order else { panic!("{step:?}") };
    assert_eq!(units.to_string(), "unit Conveyor");
    let scenario = read("{ master = \"take unit Conveyor to OP\" }").expect("a scenario");
    let Order::Master(MasterOrder::Take { units, .. }) = &scenario.each_step()[0].step.order else {
        panic!()
    };
    assert_eq!(units.to_string(), "unit 2");
}

/// Own sentences of random steps.
#[test]
fn random_steps_name_units_too() {
    let steps = |name: &str| {
        format!(
            "{{ random = {{ steps = 3, from = [\"take unit {name} to OP\"] }}, within = \"30ms\" }},\n{{ expect = \"unit Conveyor is in OP\", within = \"500ms\" }}"
        )
    };
    assert_eq!(failure(&steps("Conveyor")), None);
    assert!(failure(&steps("Infeed")).is_some());
    let told = read(&steps("Press")).expect_err("no such unit").join("\n");
    assert!(told.contains("no unit is named Press"), "{told}");
}

/// A name means a place in the line, also after another unit is there.
#[test]
fn a_name_means_the_place_of_the_unit_at_the_beginning() {
    let text = format!(
        "{LINE}steps = [{{ unit = \"replace unit K4 by other.toml\" }}, {{ expect = \"unit K4 is in INIT\", within = \"10ms\" }}]\n"
    );
    let other = "model = \"digital\"\ninputs = 16\nname = \"Other\"\n";
    let scenario = Scenario::parse(&text, |_| Ok(other.to_owned())).expect("a scenario");
    assert_eq!(scenario.replay(1, Recording::new(false, false)).failure, None);
    let told = Scenario::parse(&text.replace("unit K4 is", "unit Other is"), |_| Ok(other.to_owned()));
    assert!(told.expect_err("a new name").to_string().contains("no unit is named Other"));
}

#[test]
fn what_is_seen_names_a_unit_as_its_step_does() {
    for (step, expected) in [
        ("{ expect = \"unit Conveyor is in OP\" }", "unit Conveyor is in INIT"),
        ("{ expect = \"unit 2 is in OP\" }", "unit 2 is in INIT"),
        (
            "{ expect = \"unit conveyor has recorded 85000000\" }",
            "unit Conveyor has recorded it 0 times; nothing is recorded",
        ),
        (
            "{ expect = \"any of (unit Conveyor is in OP; unit 3 is in OP)\" }",
            "`unit Conveyor is in OP`: unit Conveyor is in INIT; `unit 3 is in OP`: unit 3 is in INIT",
        ),
    ] {
        assert_eq!(failure(step).as_deref(), Some(expected), "{step}");
    }
}
