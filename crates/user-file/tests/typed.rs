//! Values of types that serde reads: all mistakes are reported, with their places and the nearest names.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use serde::Deserialize;
use user_file::{FileErrors, Wanted, field_names, read_toml};

#[derive(Debug, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
enum Order {
    Move(Move),
    Paint {
        colour: Colour,
        #[serde(default)]
        layers: Option<Layers>,
    },
    Name(String),
    Rest,
}

#[derive(Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Move {
    to: Vec<u8>,
    speed: f64,
    back: i8,
}

#[derive(Debug, PartialEq, Deserialize)]
#[serde(transparent)]
struct Layers(u8);

#[derive(Debug, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Colour {
    Red,
    Blue,
    Rgb(u8, u8, u8),
}

fn read(text: &str) -> Result<Order, FileErrors> {
    read_toml(text, Wanted::UnitFile, |reader, file| reader.typed("order", file.get("order")?))
}

fn refusal(text: &str) -> String {
    read(text).expect_err("something is wrong").to_string()
}

#[test]
fn each_form_of_a_value_is_read() {
    let moved = Move { to: vec![1, 0xFF], speed: 1.5, back: -3 };
    for (text, order) in [
        ("order = { move = { to = [1, 0xFF], speed = 1.5, back = -3 } }", Order::Move(moved)),
        (
            "[order.paint]\ncolour = \"red\"\nlayers = 2",
            Order::Paint { colour: Colour::Red, layers: Some(Layers(2)) },
        ),
        ("order.paint.colour.rgb = [1, 2, 3]", Order::Paint { colour: Colour::Rgb(1, 2, 3), layers: None }),
        ("order.paint.colour.blue = {}", Order::Paint { colour: Colour::Blue, layers: None }),
        ("order.name = \"n\"", Order::Name("n".to_owned())),
        ("order = \"rest\"", Order::Rest),
    ] {
        assert_eq!(read(text), Ok(order), "{text}");
    }
    let any: Result<BTreeMap<String, toml::Value>, _> =
        read_toml("t = { a = 1, b = [true, \"x\"] }", Wanted::UnitFile, |reader, file| {
            reader.typed("t", file.get("t")?)
        });
    assert_eq!(any.expect("a table").len(), 2);
}

#[test]
fn everything_that_is_wrong_in_a_value_is_told() {
    let text = "\
order = { move = {
  spead = 1,
  to = [1, 300, 2, \"x\"],
  speed = true,
  back = \"b\",
  bck = 3,
} }";
    let expected = "\
2:3: unknown key `order.move.spead`, expected `to`, `speed` or `back`; did you mean `speed`?
3:12: `order.move.to[1]` is integer `300`, expected u8
3:20: `order.move.to[3]` is \"x\", expected u8
4:11: `order.move.speed` is boolean `true`, expected f64
5:10: `order.move.back` is \"b\", expected i8
6:3: unknown key `order.move.bck`, expected `to`, `speed` or `back`; did you mean `back`?";
    assert_eq!(refusal(text), expected);
    let text = "order = { paint = { colour = { rgb = [1, -2, 3] }, layers = 256 } }";
    let expected = "\
1:42: `order.paint.colour.rgb[1]` is integer `-2`, expected u8
1:61: `order.paint.layers` is integer `256`, expected u8";
    assert_eq!(refusal(text), expected);
}

#[test]
fn a_value_of_another_form_is_told_once() {
    for (text, expected) in [
        ("order = { move = { to = [], speed = 1.0 } }", "1:18: `order.move.back` is missing"),
        (
            "order = { mve = {} }",
            "1:11: unknown key `order.mve`, expected `move`, `paint`, `name` or `rest`; did you mean `move`?",
        ),
        (
            "order = \"rst\"",
            "1:9: `order` is \"rst\", expected `move`, `paint`, `name` or `rest`; did you mean `rest`?",
        ),
        ("order = {}", "1:9: `order` is a table with 0 keys, expected a table with one key"),
        (
            "order = { rest = {}, name = \"n\" }",
            "1:9: `order` is a table with 2 keys, expected a table with one key",
        ),
        (
            "order.paint.colour.rgb = [1, 2]",
            "1:26: `order.paint.colour.rgb` has a length of 2, expected tuple variant Colour::Rgb with 3 elements",
        ),
        ("order = 5", "1:9: `order` is an integer, expected a text, or a table with one key"),
        ("order = { rest = { long = 1 } }", "1:20: unknown key `order.rest.long`, expected nothing"),
        (
            "order = { name = 99999999999999999999999999 }",
            "1:18: `order.name` is 99999999999999999999999999, expected 64 bits",
        ),
    ] {
        assert_eq!(refusal(text), expected, "{text}");
    }
}

#[test]
fn thousands_of_mistakes_in_one_value_are_told_at_once() {
    let keys: String = (0..20_000).map(|at| format!("key_{at} = 1, ")).collect();
    let elements = "300, ".repeat(20_000);
    let begun = Instant::now();
    let unknown = read(&format!("order = {{ move = {{ {keys} }} }}")).expect_err("unknown keys");
    assert_eq!((unknown.iter().count(), unknown.more()), (20, 19_980));
    let wrong = read(&format!("order = {{ move = {{ to = [{elements}] }} }}")).expect_err("wrong elements");
    assert_eq!(wrong.iter().count(), 20);
    assert!(begun.elapsed() < Duration::from_secs(10), "{:?}", begun.elapsed());
}

#[test]
fn the_names_of_the_fields_are_those_that_serde_knows() {
    assert_eq!(field_names::<Move>(), ["to", "speed", "back"]);
    assert_eq!(field_names::<Vec<u8>>(), [""; 0]);
}
