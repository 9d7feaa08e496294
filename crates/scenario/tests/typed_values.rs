//! Typed values: each has a sentence and a form in JSON and TOML, and all of them are the same value.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

use std::collections::BTreeSet;

use proptest::prelude::*;
use proptest::sample::select;
use proptest::test_runner::TestRunner;
use scenario::model::{Condition, ConductOrder, CpuOrder, FrameFault, LineOrder, MasterOrder, UnitOrder};
use scenario::words::{ACTS, Place, QUANTITIES, Spoken};
use serde::Serialize;
use serde::de::DeserializeOwned;

/// The names of the variants of a type, which serde lists for an unknown one.
fn variants<T: DeserializeOwned + core::fmt::Debug>() -> BTreeSet<String> {
    let refusal = serde_json::from_str::<T>(r#"{ "?": {} }"#).expect_err("no variant").to_string();
    let names = refusal.split('`').skip(1).step_by(2).skip(1);
    names.map(str::to_owned).collect()
}

/// The values with keys of these names anywhere in the examples of a type.
fn keys<T: Spoken + Serialize>() -> BTreeSet<String> {
    fn collect(value: &serde_json::Value, keys: &mut BTreeSet<String>) {
        match value {
            serde_json::Value::Object(map) => {
                keys.extend(map.keys().cloned());
                map.values().for_each(|value| collect(value, keys));
            }
            serde_json::Value::String(text) => drop(keys.insert(text.clone())),
            _ => {}
        }
    }
    let mut keys = BTreeSet::new();
    for sentence in T::SENTENCES {
        let value = T::from_sentence(sentence.example).expect("an example is a sentence");
        collect(&serde_json::to_value(value).expect("a value is JSON"), &mut keys);
    }
    keys
}

#[test]
fn every_variant_has_a_sentence() {
    fn missing<T: DeserializeOwned + core::fmt::Debug, U: Spoken + Serialize>() -> Vec<String> {
        let variants = variants::<T>();
        assert!(variants.len() > 5, "{variants:?}");
        variants.difference(&keys::<U>()).cloned().collect()
    }
    assert_eq!(missing::<MasterOrder, MasterOrder>(), [""; 0]);
    assert_eq!(missing::<UnitOrder, UnitOrder>(), [""; 0]);
    assert_eq!(missing::<ConductOrder, UnitOrder>(), [""; 0]);
    assert_eq!(missing::<CpuOrder, CpuOrder>(), [""; 0]);
    assert_eq!(missing::<FrameFault, LineOrder>(), [""; 0]);
    assert_eq!(missing::<Condition, Condition>(), [""; 0]);
    let lines = variants::<LineOrder>();
    assert_eq!(lines.difference(&keys::<LineOrder>()).count(), 0);
}

/// A value is the same from its sentence, JSON and TOML.
fn is_one_value<T>(text: &str)
where
    T: Spoken + Serialize + DeserializeOwned + PartialEq,
{
    #[derive(Serialize, serde::Deserialize)]
    struct Table<T> {
        value: T,
    }
    let value = T::from_sentence(text).unwrap_or_else(|problem| panic!("{text}: {problem:?}"));
    let sentence = value.sentence();
    assert_eq!(T::from_sentence(&sentence).as_ref(), Ok(&value), "{text} is written as {sentence}");
    let json = serde_json::to_string(&value).expect("a value is JSON");
    assert!(json.starts_with('{'), "a text is always a sentence: {json}");
    assert_eq!(serde_json::from_str::<T>(&json).expect(&json), value);
    let table = toml::to_string(&Table { value }).expect("a value is TOML");
    let back: Table<T> = toml::from_str(&table).unwrap_or_else(|error| panic!("{table}\n{error}"));
    assert_eq!(back.value.sentence(), sentence);
}

#[test]
fn every_sentence_is_one_value_with_its_json_and_toml() {
    fn all<T: Spoken + Serialize + DeserializeOwned + PartialEq>() {
        let mut runner = TestRunner::deterministic();
        for sentence in T::SENTENCES {
            is_one_value::<T>(sentence.example);
            let run = runner.run(&sentences(sentence.pattern), |text| {
                is_one_value::<T>(&text);
                Ok(())
            });
            run.unwrap_or_else(|failure| panic!("{}: {failure}", sentence.pattern));
        }
    }
    all::<MasterOrder>();
    all::<UnitOrder>();
    all::<CpuOrder>();
    all::<LineOrder>();
    all::<Condition>();
}

/// Sentences of a pattern, with any values in their places.
fn sentences(pattern: &str) -> impl Strategy<Value = String> + use<> {
    let parts: Vec<BoxedStrategy<String>> = pattern
        .split_whitespace()
        .map(|part| match part.strip_prefix('{').and_then(|part| part.strip_suffix('}')) {
            Some(place) => words(place),
            None => Just(part.to_owned()).boxed(),
        })
        .collect();
    parts.prop_map(|words| words.join(" "))
}

/// Words that a place reads.
fn words(place: &str) -> BoxedStrategy<String> {
    let number = |most: u64| {
        prop_oneof![
            (0..=most).prop_map(|n| n.to_string()),
            (0..=most).prop_map(|n| format!("{n:#X}").replace("0X", "0x"))
        ]
    };
    let entry = || (any::<u16>(), any::<u8>()).prop_map(|(index, sub)| format!("{index:04X}:{sub:02X}"));
    let range = || {
        let range = (any::<u16>(), 0..=0x7F_u8, 0..=0x7F_u8);
        range.prop_map(|(index, first, more)| format!("{index:04X}:{first:02X}..{:02X}", first + more))
    };
    let one_of = |texts: &[&str]| select(texts.iter().map(|&text| text.to_owned()).collect::<Vec<_>>());
    let bytes = || proptest::collection::vec(any::<u8>(), 1..9);
    match place {
        "units" => {
            prop_oneof![Just("all units".to_owned()), (1..99_u8).prop_map(|n| format!("unit {n}"))].boxed()
        }
        "unit" => (1..99_u8).prop_map(|n| format!("unit {n}")).boxed(),
        "controller" => {
            prop_oneof![Just("the master".to_owned()), (1..99_u8).prop_map(|n| format!("unit {n}"))].boxed()
        }
        "state" => one_of(&["INIT", "PRE-OP", "SAFE-OP", "OP", "BOOT", "4", "0x08"]).boxed(),
        "request" => one_of(&["INIT", "PRE-OP", "SAFE-OP", "OP", "BOOT", "0x05", "15", "4", "0x00"]).boxed(),
        "transition" => one_of(&["IP", "PS", "SO", "OI"]).boxed(),
        "number" => number(u64::MAX).boxed(),
        "times" => {
            prop_oneof![Just("once".to_owned()), (0..=u64::MAX).prop_map(|count| format!("{count} times")),]
                .boxed()
        }
        "byte" => number(0xFF).boxed(),
        "word" => number(0xFFFF).boxed(),
        "dword" => number(0xFFFF_FFFF).boxed(),
        "counter" | "channel" => number(7).boxed(),
        "cable" => (1..=0xFFFF_u16).prop_map(|n| n.to_string()).boxed(),
        "error" => (1..=40_000_u16).prop_map(|n| format!("16#{n:x}")).boxed(),
        "period" => one_of(&["1ms", "1.5ms", "250us", "2s", "1ns"]).boxed(),
        "time" => (0..=60_000_000_000_u64).prop_map(|n| format!("{n}ns")).boxed(),
        "pause" => (1..=60_000_000_000_u64).prop_map(|n| format!("{n}ns")).boxed(),
        "code" => (1..=0xFFFF_u16).prop_map(|n| format!("0x{n:04X}")).boxed(),
        "record" => (1..=250_u8).prop_map(|n| n.to_string()).boxed(),
        "file" => one_of(&["units/a.toml", "a.bin"]).boxed(),
        "size" => (1..=1486_u16).prop_map(|n| n.to_string()).boxed(),
        "length" => (14..=1513_u16).prop_map(|n| n.to_string()).boxed(),
        "bytes" | "first-bytes" => bytes()
            .prop_map(|bytes| bytes.iter().map(|byte| format!("0x{byte:x}")).collect::<Vec<_>>().join(" "))
            .boxed(),
        "entry" => entry().boxed(),
        "entries" => proptest::collection::vec(prop_oneof![entry(), range()], 1..4)
            .prop_map(|all| all.join(" "))
            .boxed(),
        "numbers" => proptest::collection::vec(any::<u16>(), 1..5)
            .prop_map(|all| all.iter().map(|n| format!("{n:X}")).collect::<Vec<_>>().join(" "))
            .boxed(),
        "event" => one_of(&["85000000", "09450000", "94B80000"]).boxed(),
        "fault" => one_of(&["Processing", "Esc", "IoCommunications"]).boxed(),
        "pattern" => one_of(&["lit", "not_lit", "flashing_1s", "double_flash"]).boxed(),
        "indicator" => one_of(&["RUN", "ERR", "L/A IN", "L/A OUT", "TS green", "TS red"]).boxed(),
        "frames" => {
            let count = || 1..=u64::from(u32::MAX);
            let choice = prop_oneof![
                Just("all".to_owned()),
                count().prop_map(|n| format!("the next {n}")),
                (1..=100_u8).prop_map(|n| format!("{n} % of the")),
                (1..=100_u8).prop_map(|n| format!("{n}% of the")),
                (1..=1000_u16).prop_map(|n| format!("{n} ‰ of the")),
                (1..=1000_u16).prop_map(|n| format!("{n} per mille of the")),
                (1..=999_u16).prop_map(|n| format!("every {n}0th of the")),
                one_of(&["every 1st of the", "every 22nd of the", "every 113th of the"]),
                count().prop_map(|n| format!("number {n} of the")),
                (count(), count()).prop_map(|(n, more)| format!("numbers {n} to {} of the", n + more)),
            ];
            let kind = one_of(&[
                "frames",
                "frame",
                "process data frames",
                "mailbox frames",
                "SII frames",
                "BRD frames",
                "FPRD frame",
            ]);
            let unit = prop_oneof![Just(String::new()), (1..99_u8).prop_map(|n| format!(" of unit {n}"))];
            (choice, kind, unit).prop_map(|(choice, kind, unit)| format!("{choice} {kind}{unit}")).boxed()
        }
        "way" => {
            one_of(&["", "outward", "on the way back", "on cable 3", "on cable 12 on the way back"]).boxed()
        }
        "direction" => one_of(&["", "outward", "on the way back"]).boxed(),
        "delay" => {
            one_of(&["1ms", "1ms to 3ms", "0ns to 3ms", "2ms ± 1ms", "2ms ± 2ms", "20us ± 1ns normal"])
                .boxed()
        }
        "lasting" => one_of(&["", "for 3s", "for 1ns"]).boxed(),
        "called" => one_of(&["", "called storm", "called S-2_x"]).boxed(),
        "fault-name" => one_of(&["storm", "S-2_x"]).boxed(),
        "lowering" => (1..=0xFFFF_u16).prop_map(|n| n.to_string()).boxed(),
        "variable" => one_of(&["N1_UINTs_01_M_to_C", "N1_x[3]", "_EC_PDSlavTbl[2]"]).boxed(),
        "name" => one_of(&["counter", "Main.counter", "timer.Q"]).boxed(),
        "program" => one_of(&["programs/a-3-3.st", "a.st"]).boxed(),
        "value" => one_of(&["5", "16#1F", "TRUE", "[1, 2,  13(0)]", "'a text'"]).boxed(),
        "position" => {
            (1..999_usize, 1..999_usize).prop_map(|(line, column)| format!("{line}:{column}")).boxed()
        }
        "amount" => one_of(&["5", "-3", "0x1F", "16#1F", "1.5", "-0.25", "T#20ms"]).boxed(),
        "other" => one_of(&["01 FF", "5", "TRUE"]).boxed(),
        "quantity" => select(QUANTITIES.iter().map(|row| row.pattern).collect::<Vec<_>>())
            .prop_flat_map(sentences)
            .boxed(),
        "act" => {
            select(ACTS.iter().map(|row| row.pattern).collect::<Vec<_>>()).prop_flat_map(sentences).boxed()
        }
        "condition" => one_of(&["(unit 1 is in OP)", "( not (100 cycles are done) )"]).boxed(),
        "conditions" => one_of(&[
            "(unit 1 is in OP)",
            "(unit 1 is in OP;all units are in OP ; not (unit 1 has no error))",
            "(any of (the master has nothing to do; variable N1_a has the value '(;'); unit 1 has no error)",
        ])
        .boxed(),
        other => panic!("no words for the place {other}"),
    }
}

#[test]
fn every_place_has_words_here() {
    for place in Place::all().iter().filter(|place| place.name != "percent") {
        let _ = words(place.name);
    }
}

#[test]
fn a_value_is_written_with_the_verb_of_its_units() {
    let written = |text: &str| Condition::from_sentence(text).expect(text).sentence();
    assert_eq!(written("all units is in OP"), "all units are in OP");
    assert_eq!(written("unit 2 have no error"), "unit 2 has no error");
    assert_eq!(written("all units has recorded 85000000"), "all units have recorded 85000000");
    assert_eq!(written("input byte 0 of unit 1 is 0x1"), "the inputs of unit 1 begin with 01");
    assert_eq!(written("at most 0 answers differ"), "every answer is as captured");
}

#[test]
fn what_is_no_value_is_refused_with_what_was_expected() {
    for (json, expected) in [
        (r#"{ "take": { "units": 0, "state": "OP" } }"#, "\"all\", the number of a unit, from 1, its name"),
        (
            r#"{ "take": { "units": "unit 1", "state": "OP" } }"#,
            "\"all\", the number of a unit, from 1, its name",
        ),
        (r#"{ "take": { "units": 1, "state": "OPS" } }"#, "INIT, PRE-OP, SAFE-OP, OP, BOOT"),
        (r#"{ "take": { "units": 1, "state": "OP", "when": 5 } }"#, "unknown field `when`"),
        (r#"{ "write_sdo": { "unit": 1, "entry": "2002", "value": "01" } }"#, "such as 10F3:05"),
        (r#"{ "write_sdo": { "unit": 1, "entry": "2002:01", "value": "100" } }"#, "bytes such as 01 FF"),
        (r#"{ "read_sdo": { "unit": 0, "entry": "2002:01" } }"#, "the number of a unit, from 1"),
        (r#"{ "write_register": { "unit": 1, "register": 65536, "bytes": "00" } }"#, "from 0 to 0xFFFF"),
        (r#"{ "write_register": { "unit": 1, "register": "0xG", "bytes": "00" } }"#, "from 0 to 0xFFFF"),
        (r#"{ "write_register": { "unit": 1, "register": -1, "bytes": "00" } }"#, "from 0 to 0xFFFF"),
        (r#"{ "exchange_process_data": { "every": "1" } }"#, "not a duration"),
        (r#""behave""#, "expected newtype variant"),
        (r#"{ "behave": { "now": 1 } }"#, "unknown field `now`"),
    ] {
        let refusal = serde_json::from_str::<MasterOrder>(json).expect_err(json).to_string();
        assert!(refusal.contains(expected), "{json}: {refusal}");
    }
}
