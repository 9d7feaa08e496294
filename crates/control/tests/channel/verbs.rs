//! Each verb, good and bad.

use std::collections::BTreeSet;
use std::net::Shutdown;

use control::messages::VERBS;
use serde_json::{Value, json};

use crate::bench::{Bench, Client};

/// The answer without its time.
fn timeless(mut answer: Value) -> Value {
    let at_ns = answer.as_object_mut().and_then(|members| members.remove("at_ns"));
    assert_eq!(at_ns.is_some_and(|at| at.is_u64()), answer["ok"] == true, "{answer}");
    answer
}

#[track_caller]
fn answers(client: &mut Client, request: &Value, expected: &Value) {
    assert_eq!(timeless(client.answer(request)), *expected, "{request}");
}

#[track_caller]
fn refuses(client: &mut Client, request: &Value, message: &str, nearest: &[&str]) {
    let answer = timeless(client.answer(request));
    assert_eq!((&answer["ok"], &answer["id"]), (&json!(false), &request["id"]), "{answer}");
    assert_eq!(answer["error"]["message"], message, "{answer}");
    assert_eq!(answer["error"]["nearest"], json!(nearest), "{answer}");
    assert!(answer["error"]["help"].as_str().is_some_and(|help| !help.is_empty()), "{answer}");
}

#[test]
fn an_answer_to_each_verb_has_the_members_of_the_table() {
    let bench = Bench::new("each_verb");
    let mut client = bench.client();
    {
        let mut table = bench.table.lock().unwrap();
        for name in ["N1_UINTs_01_M_to_C", "N1_UINTs_01_C_to_M[0]"] {
            table.variables.insert(name.to_owned(), (0, false));
        }
    }
    for row in VERBS {
        // The twin of this test knows another sentence.
        let request = row.example.replace("unplug cable 1", "make it true").replace(",\"within\":\"5s\"", "");
        let answer = client.answer(&serde_json::from_str(&request).unwrap());
        assert_eq!(answer["ok"], true, "{answer}");
        let members: BTreeSet<&str> = answer.as_object().unwrap().keys().map(String::as_str).collect();
        let expected: BTreeSet<&str> =
            ["id", "ok", "at_ns"].into_iter().chain(row.answer.iter().copied()).collect();
        assert_eq!(members, expected, "{request}");
        if row.name == "subscribe" {
            assert_eq!(client.line()["kind"], "variable");
        }
    }
}

#[test]
fn orders() {
    let bench = Bench::new("orders");
    let mut client = bench.client();
    answers(&mut client, &json!({ "id": 1, "do": "make it true" }), &json!({ "id": 1, "ok": true }));
    refuses(&mut client, &json!({ "id": "a", "do": "mak it" }), "`mak it` is no order", &["make it true"]);
    assert_eq!(bench.table.lock().unwrap().orders, ["make it true"]);
}

#[test]
fn any_json_is_an_id_and_no_id_is_null() {
    let bench = Bench::new("ids");
    let mut client = bench.client();
    for id in [json!(null), json!([1, { "a": "b" }]), json!(1.5), json!("x")] {
        answers(&mut client, &json!({ "id": id, "do": "make x" }), &json!({ "id": id, "ok": true }));
    }
    answers(&mut client, &json!({ "do": "make x" }), &json!({ "id": null, "ok": true }));
}

#[test]
fn conditions_now() {
    let bench = Bench::new("conditions");
    let mut client = bench.client();
    let expected = json!({ "id": 1, "ok": true, "held": false, "seen": "not made" });
    answers(&mut client, &json!({ "id": 1, "expect": "it" }), &expected);
    client.answer(&json!({ "do": "make it" }));
    answers(&mut client, &json!({ "id": 2, "expect": "it" }), &json!({ "id": 2, "ok": true, "held": true }));
    refuses(&mut client, &json!({ "id": 3, "expect": "the master" }), "another master is here", &[]);
    let late = json!({ "id": 4, "expect": "the master", "within": "1s" });
    refuses(&mut client, &late, "another master is here", &[]);
}

#[test]
fn a_condition_that_is_awaited_blocks_no_other_request_of_its_client() {
    let bench = Bench::new("awaited");
    let mut client = bench.client();
    client.request(&json!({ "id": 1, "expect": "late", "within": "60s" }));
    client.request(&json!({ "id": 2, "expect": "never", "within": "1us" }));
    client.request(&json!({ "id": 3, "do": "make late" }));
    let mut answers: Vec<Value> = (0..3).map(|_| timeless(client.line())).collect();
    answers.sort_by_key(|answer| answer["id"].as_u64());
    let expected = [
        json!({ "id": 1, "ok": true, "held": true }),
        json!({ "id": 2, "ok": true, "held": false, "seen": "not made" }),
        json!({ "id": 3, "ok": true }),
    ];
    assert_eq!(answers, expected);
}

#[test]
fn status_has_all_units() {
    let bench = Bench::new("status");
    let answer = bench.client().answer(&json!({ "id": 1, "status": true }));
    assert_eq!(answer["link"], "udp:127.0.0.1:1");
    let numbers: Vec<u64> =
        answer["units"].as_array().unwrap().iter().map(|unit| unit["unit"].as_u64().unwrap()).collect();
    assert_eq!(numbers, (1..=40).collect::<Vec<_>>());
}

#[test]
fn variables_are_read_written_forced_and_released() {
    let bench = Bench::new("variables");
    let mut client = bench.client();
    let values = |v1: u64, forced: bool| {
        let report = json!({ "type": "UINT", "value": v1, "validity": "valid", "forced": forced });
        json!({ "id": 1, "ok": true, "values": { "V1": report } })
    };
    answers(&mut client, &json!({ "id": 1, "read": ["V1"] }), &values(1, false));
    answers(&mut client, &json!({ "id": 1, "write": { "V1": 5 } }), &values(5, false));
    answers(&mut client, &json!({ "id": 1, "force": { "V1": 6 } }), &values(6, true));
    answers(&mut client, &json!({ "id": 1, "release": ["V1"] }), &values(6, false));
    for request in [json!({ "id": 9, "read": ["V3"] }), json!({ "id": 9, "force": { "V3": 1 } })] {
        refuses(&mut client, &request, "there is no variable `V3`", &["V1"]);
    }
}

#[test]
fn objects() {
    let bench = Bench::new("objects");
    let mut client = bench.client();
    let expected = json!({ "id": 1, "ok": true, "object": "N1 1018:04", "type": "U32", "value": 7, "bytes": "07 00 00 00" });
    answers(&mut client, &json!({ "id": 1, "object": "N1 1018:04" }), &expected);
    refuses(&mut client, &json!({ "id": 2, "object": "N1" }), "`N1` is no entry", &[]);
}

#[test]
fn faults_are_listed_and_cleared() {
    let bench = Bench::new("faults");
    let mut client = bench.client();
    let listed = client.answer(&json!({ "id": 1, "faults": true }));
    assert_eq!(listed["faults"], json!([{ "clear": "storm", "sentence": "break storm", "unit": 1 }]));
    refuses(&mut client, &json!({ "id": 2, "clear": "strom" }), "there is no fault `strom`", &["storm"]);
    answers(
        &mut client,
        &json!({ "id": 3, "clear": "storm" }),
        &json!({ "id": 3, "ok": true, "faults": [] }),
    );
    answers(&mut client, &json!({ "id": 4, "clear": "all" }), &json!({ "id": 4, "ok": true, "faults": [] }));
}

#[test]
fn sentences() {
    let bench = Bench::new("sentences");
    let answer = bench.client().answer(&json!({ "id": 1, "sentences": true }));
    let expected = json!([{ "about": "unit", "verb": "do", "pattern": "make {condition}", "example": "make it true", "meaning": "it is true from now on" }]);
    assert_eq!(answer["sentences"], expected);
}

#[test]
fn requests_of_a_client_that_says_no_more_are_answered_and_then_the_connection_is_closed() {
    let bench = Bench::new("half_closed");
    let mut client = bench.client();
    client.say("{\"id\":1,\"do\":\"make a\"}\n{\"id\":2,\"expect\":\"b\",\"within\":\"60s\"}\n{\"id\":3,\"do\":\"make b\"}");
    client.stream.shutdown(Shutdown::Write).unwrap();
    let ids: BTreeSet<u64> = (0..3).map(|_| client.line()["id"].as_u64().unwrap()).collect();
    assert_eq!(ids, [1, 2, 3].into());
    assert!(client.is_closed());
}

#[test]
fn orders_of_a_client_that_has_left_are_carried_out() {
    let bench = Bench::new("left");
    let mut client = bench.client();
    client.say("{\"do\":\"make a\"}\n{\"do\":\"make b\"}\n");
    drop(client);
    let answer = bench.client().answer(&json!({ "expect": "b", "within": "60s" }));
    assert_eq!(answer["held"], true);
    assert_eq!(bench.table.lock().unwrap().orders, ["make a", "make b"]);
}
