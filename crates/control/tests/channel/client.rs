//! The client of this crate: requests, refusals, records, an end of the twin.

use control::client::{Answered, Client, ClientError, Streamed};
use control::messages::{Held, Status, Subscribed, Variables, Verb};
use serde_json::{Value, json};
use time::Duration;

use crate::bench::Bench;

#[test]
fn a_client_steers_asks_and_is_refused_with_the_nearest_sentence() {
    let bench = Bench::new("client");
    let mut client = Client::connect(&bench.path()).unwrap();
    let before = client.apply("make it true").unwrap().at_ns;
    let within = Some(Duration::from_secs(60));
    let held: Answered<Held> = client.ask(Verb::Expect { condition: "it true".to_owned(), within }).unwrap();
    assert_eq!(held.content, Held { held: true, seen: None });
    assert!(held.at_ns > before);
    let status: Answered<Status> = client.ask(Verb::Status).unwrap();
    assert_eq!(status.content.units.len(), 40);
    let ClientError::Refused(refusal) = client.apply("mke it true").unwrap_err() else {
        panic!("another error")
    };
    assert_eq!(refusal.nearest, ["make it true"]);
    let force = Verb::Force(vec![("V1".to_owned(), json!(7))]);
    let Answered::<Variables> { content, .. } = client.ask(force).unwrap();
    assert_eq!((&content.values["V1"].value, content.values["V1"].forced), (&json!(7), true));
}

#[test]
fn records_follow_a_subscription_in_their_order_until_the_twin_ends() {
    let bench = Bench::new("client-records");
    let mut client = Client::connect(&bench.path()).unwrap();
    let wanted = Verb::Subscribe(vec!["state".to_owned()]);
    let Answered::<Subscribed> { content, .. } = client.ask(wanted).unwrap();
    assert_eq!(content.subscribed, ["state"]);
    (1..=3).for_each(|number| bench.publish("state", number));
    bench.publish("event", 4);
    let mut next = || match client.next_record(None) {
        Ok(Some(Streamed::Record(record))) => record.get("at_ns").and_then(Value::as_u64),
        other => panic!("{other:?}"),
    };
    assert_eq!([next(), next(), next()], [Some(1), Some(2), Some(3)]);
    bench.end();
    assert!(matches!(client.next_record(None), Err(ClientError::Ended)));
}
