//! Subscriptions.

use serde_json::{Value, json};

use crate::bench::{Bench, Client};

#[test]
fn a_client_gets_the_kinds_that_it_has_subscribed() {
    let bench = Bench::new("kinds");
    let mut client = bench.client();
    let answer = client.answer(&json!({ "id": 1, "subscribe": ["state"] }));
    assert_eq!(answer["subscribed"], json!(["state"]));
    bench.publish("event", 1);
    bench.publish("state", 2);
    assert_eq!(client.line(), json!({ "at_ns": 2, "kind": "state" }));

    let answer = client.answer(&json!({ "id": 2, "subscribe": ["fault"] }));
    assert_eq!(
        answer["subscribed"],
        json!(["state", "fault", "frame_fault"]),
        "those of frames are faults too"
    );
    bench.publish("frame_fault", 3);
    assert_eq!(client.line()["kind"], "frame_fault");

    let answer = client.answer(&json!({ "id": 3, "unsubscribe": ["state"] }));
    assert_eq!(answer["subscribed"], json!(["fault", "frame_fault"]));
    bench.publish("state", 4);
    bench.publish("fault", 5);
    assert_eq!(client.line()["at_ns"], 5);

    assert_eq!(client.answer(&json!({ "unsubscribe": ["all"] }))["subscribed"], json!([]));
    assert_eq!(client.answer(&json!({ "subscribe": ["all"] }))["subscribed"].as_array().unwrap().len(), 5);
}

#[test]
fn a_kind_that_is_none_is_refused_with_the_nearest_one_and_nothing_is_subscribed() {
    let bench = Bench::new("no_kind");
    let mut client = bench.client();
    let answer = client.answer(&json!({ "id": 1, "subscribe": ["event", "stat"] }));
    assert_eq!(answer["error"]["message"], "there is no kind of records `stat`");
    assert_eq!(answer["error"]["nearest"], json!(["state"]));
    let answer = client.answer(&json!({ "id": 2, "subscribe": ["variable:V3", "event"] }));
    assert_eq!(answer["error"]["message"], "there is no variable `V3`");
    assert_eq!(client.answer(&json!({ "unsubscribe": ["state"] }))["subscribed"], json!([]));
}

fn variable(value: u64, forced: bool) -> Value {
    json!({ "kind": "variable", "variable": "V1", "type": "UINT", "value": value, "validity": "valid", "forced": forced })
}

#[test]
fn a_variable_is_reported_at_first_and_with_each_change() {
    let bench = Bench::new("variable");
    let [mut one, mut other] = [bench.client(), bench.client()];
    let next = |client: &mut Client| {
        let mut record = client.line();
        assert!(record.as_object_mut().unwrap().remove("at_ns").unwrap().is_u64());
        record
    };
    assert_eq!(one.answer(&json!({ "subscribe": ["variable:V1"] }))["subscribed"], json!(["variable:V1"]));
    assert_eq!(next(&mut one), variable(1, false));
    other.request(&json!({ "subscribe": ["variable:V1"] }));
    assert_eq!(other.line()["ok"], true);
    assert_eq!(next(&mut other), variable(1, false));

    bench.client().answer(&json!({ "force": { "V1": 9 } }));
    assert_eq!(next(&mut one), variable(9, true));
    assert_eq!(next(&mut other), variable(9, true));

    assert_eq!(other.answer(&json!({ "unsubscribe": ["variable:V1"] }))["subscribed"], json!([]));
    bench.client().answer(&json!({ "write": { "V1": 10 } }));
    assert_eq!(next(&mut one), variable(10, true));
    assert_eq!(other.answer(&json!({ "id": 7, "status": true }))["id"], 7, "and no record before");
}

#[test]
fn two_hundred_subscribers_get_every_record() {
    let bench = Bench::new("two_hundred");
    let mut clients: Vec<_> = (0..200).map(|_| bench.client()).collect();
    for client in &mut clients {
        assert_eq!(client.answer(&json!({ "subscribe": ["state"] }))["ok"], true);
    }
    (0..20).for_each(|number| bench.publish("state", number));
    for client in &mut clients {
        let numbers: Vec<u64> = (0..20).map(|_| client.line()["at_ns"].as_u64().unwrap()).collect();
        assert_eq!(numbers, (0..20).collect::<Vec<_>>());
    }
}

/// Its records are kept within limits, those that are lost are counted, and nobody else notices anything.
#[test]
fn a_client_that_does_not_read_is_told_what_it_lost() {
    const RECORDS: u64 = 30_000;
    let bench = Bench::new("slow");
    let [mut slow, mut quick] = [bench.client(), bench.client()];
    for client in [&mut slow, &mut quick] {
        assert_eq!(client.answer(&json!({ "subscribe": ["state"] }))["ok"], true);
    }
    for number in 0..RECORDS {
        bench.publish("state", number);
        assert_eq!(quick.line()["at_ns"], number);
    }
    let (mut records, mut lost) = (0, 0);
    while records + lost < RECORDS {
        let line = slow.line();
        match line["lost"].as_u64() {
            Some(count) => {
                assert_eq!(line.as_object().unwrap().len(), 1, "{line}");
                lost += count;
            }
            None => {
                assert_eq!(line["at_ns"], records + lost, "no record is missing without being counted");
                records += 1;
            }
        }
    }
    assert!(lost > 0 && records > 1_000, "{records} records, {lost} lost");
    assert_eq!(slow.answer(&json!({ "id": 1, "do": "make it" }))["id"], 1);
}
