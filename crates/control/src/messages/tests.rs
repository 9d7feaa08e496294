//! Lines that are read, written and refused.

use proptest::prelude::*;
use serde_json::{Value, json};
use time::Duration;

use super::*;

fn read(line: &str) -> Result<Request, Refusal> {
    Request::read(line.as_bytes()).map_err(|unread| unread.refusal)
}

fn refused(line: &str) -> Refusal {
    match read(line) {
        Ok(request) => panic!("`{line}` is read as {request:?}"),
        Err(refusal) => refusal,
    }
}

#[test]
fn every_example_of_the_table_is_read_and_written_as_it_is() {
    for row in VERBS {
        let request = read(row.example).unwrap_or_else(|refusal| panic!("{}: {refusal}", row.example));
        let again: Value = serde_json::from_str(&request.line()).unwrap();
        assert_eq!(again, serde_json::from_str::<Value>(row.example).unwrap());
        assert!(again.get(row.name).is_some(), "{} shows its verb", row.example);
    }
}

#[test]
fn a_condition_has_a_time() {
    let request = read(r#"{"expect":"unit 1 is in OP","within":"1500ms","id":[1,{"a":null}]}"#).unwrap();
    assert_eq!(request.id, json!([1, {"a": null}]));
    let within = Some(Duration::from_millis(1_500));
    assert_eq!(request.verb, Verb::Expect { condition: "unit 1 is in OP".to_owned(), within });
}

#[test]
fn an_unknown_key_is_refused_with_the_nearest_one() {
    let refusal = refused(r#"{"id":1,"expct":"unit 1 is in OP"}"#);
    assert_eq!(refusal.message, "there is no key `expct`");
    assert_eq!(refusal.nearest, ["expect"]);
    assert_eq!(refused(r#"{"expect":"unit 1 is in OP","witin":"1s"}"#).nearest, ["within"]);
    assert!(refused(r#"{"qqqqqqq":1}"#).help.starts_with("possible: do, expect"));
}

#[test]
fn a_request_has_one_verb() {
    let two = refused(r#"{"do":"unplug cable 1","expect":"unit 1 is in OP"}"#);
    assert_eq!(two.message, "a request has one verb, and this one has `do` and `expect`");
    assert_eq!(refused(r#"{"do":"a","do":"b"}"#).message, "the request has `do` twice");
    assert!(refused("{}").message.starts_with("the request has no verb: one of do, expect"));
    assert!(refused(r#"{"id":1,"within":"1s"}"#).message.starts_with("the request has no verb"));
}

#[test]
fn values_of_other_kinds_are_refused_with_an_example() {
    let rows = [
        (r#"{"do":1}"#, "`do` takes a sentence, and not a number"),
        (r#"{"status":false}"#, "`status` takes true, and not false"),
        (r#"{"read":[]}"#, "`read` takes a list of variables, and not an empty list"),
        (r#"{"read":"A"}"#, "`read` takes a list of variables, and not a text"),
        (r#"{"read":["A",1]}"#, "`read` takes a list of variables, and not this list"),
        (r#"{"write":{}}"#, "`write` takes an object with values by variables, and not an empty object"),
        (r#"{"clear":null}"#, "`clear` takes the name of a fault, or `all`, and not null"),
    ];
    for (line, message) in rows {
        let refusal = refused(line);
        assert_eq!(refusal.message, message);
        assert!(refusal.help.starts_with("such as {\"id\":"), "{}", refusal.help);
    }
}

#[test]
fn only_a_condition_has_within_and_it_is_a_duration() {
    assert_eq!(refused(r#"{"do":"x","within":"1s"}"#).message, "`do` has no `within`");
    assert_eq!(
        refused(r#"{"expect":"x","within":5}"#).message,
        "`within` takes a duration, and not a number"
    );
    assert!(refused(r#"{"expect":"x","within":"soon"}"#).help.contains("\"5s\""));
}

#[test]
fn a_line_that_is_no_object_is_refused_with_its_place() {
    assert!(refused(r#"{"do":"x""#).message.starts_with("no request: EOF while parsing an object (column"));
    assert!(refused("[1]").message.contains("expected a JSON object"), "{}", refused("[1]").message);
    assert!(refused("").message.starts_with("no request: EOF"));
    let deep = format!("{{\"id\":{}", "[".repeat(60_000));
    assert!(refused(&deep).message.contains("recursion limit exceeded"));
    let long = refused(&format!("{{\"do\":\"{}\"}}", "x".repeat(LINE_BYTES_MAX)));
    assert_eq!(long.message, "a request has more than 65536 bytes");
    let unread = Request::read(b"{\"do\":\"\xFF\"}").unwrap_err();
    assert_eq!(unread.refusal.message, "the line is not UTF-8: byte 8");
}

#[test]
fn an_answer_has_the_id_also_of_a_request_that_is_refused() {
    let unread = Request::read(br#"{"id":"a","qqq":1}"#).unwrap_err();
    let answer = Answer::refused(unread.id, unread.refusal);
    let json: Value = serde_json::from_str(&answer.line()).unwrap();
    assert_eq!((&json["id"], &json["ok"]), (&json!("a"), &json!(false)));
    assert_eq!(json["error"]["nearest"], json!([]));
    assert_eq!(json.as_object().unwrap().len(), 3);
}

#[test]
fn answers_have_the_shapes_of_the_contract() {
    let done = Answer::done(json!(1), 7, &json!({}));
    assert_eq!(done.line(), "{\"id\":1,\"ok\":true,\"at_ns\":7}\n");
    let held = Answer::done(json!(2), 7, &Held { held: false, seen: Some("in INIT".to_owned()) });
    assert_eq!(held.line(), "{\"id\":2,\"ok\":true,\"at_ns\":7,\"held\":false,\"seen\":\"in INIT\"}\n");
    assert_eq!(held.content::<Held>().unwrap().seen.as_deref(), Some("in INIT"));
}

#[test]
fn a_client_tells_answers_and_records_apart() {
    let answer = Answer::done(json!(1), 7, &json!({}));
    assert_eq!(Incoming::read(&answer.line()).unwrap(), Incoming::Answer(answer));
    assert_eq!(Incoming::read(&Incoming::lost_line(3)).unwrap(), Incoming::Lost(3));
    let record = Incoming::read(r#"{"at_ns":7,"kind":"lost","lost":3}"#).unwrap();
    assert!(matches!(record, Incoming::Record(members) if members["kind"] == "lost"));
    assert!(Incoming::read("[]").is_err());
    assert!(Incoming::read(r#"{"ok":1}"#).is_err());
}

proptest! {
    #[test]
    fn no_line_is_a_panic(line in proptest::collection::vec(any::<u8>(), 0..200)) {
        let _ = Request::read(&line);
    }

    #[test]
    fn no_json_is_a_panic(name in "[a-z]{0,12}", value in "[\\[\\]{}\":,0-9a-z ]{0,40}") {
        let _ = Request::read(format!("{{\"{name}\":{value}}}").as_bytes());
    }
}
