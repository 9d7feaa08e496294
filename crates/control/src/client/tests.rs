//! A client and the other end of its socket.

use std::io::{BufRead, BufReader, Write};
use std::thread;

use serde_json::json;
use time::Duration as Within;

use super::*;
use crate::messages::Held;

/// A client, and a twin that answers each request with the lines of `answers`, in which ID is that of the request.
fn client_of(answers: &'static [&'static str]) -> (Client, thread::JoinHandle<Vec<Value>>) {
    let (ours, theirs) = UnixStream::pair().unwrap();
    let twin = move || {
        let mut requests = Vec::new();
        let mut lines = BufReader::new(theirs.try_clone().unwrap()).lines();
        for answer in answers {
            let Some(Ok(line)) = lines.next() else { break };
            let request: Value = serde_json::from_str(&line).unwrap();
            let text = answer.replace("ID", &request["id"].to_string());
            requests.push(request);
            (&theirs).write_all(text.as_bytes()).unwrap();
        }
        requests
    };
    (Client::over(ours).unwrap(), thread::spawn(twin))
}

#[test]
fn each_request_has_a_new_id_and_gets_its_answer() {
    let (mut client, twin) = client_of(&[
        "{\"id\":ID,\"ok\":true,\"at_ns\":7}\n",
        "{\"id\":ID,\"ok\":true,\"at_ns\":8,\"held\":true}\n",
    ]);
    assert_eq!(client.apply("unplug cable 1").unwrap().at_ns, 7);
    let within = Some(Within::from_millis(1_500));
    let held = client.ask(Verb::Expect { condition: "unit 1 is in OP".to_owned(), within }).unwrap();
    assert_eq!(held, Answered { at_ns: 8, content: Held { held: true, seen: None } });
    let requests = twin.join().unwrap();
    assert_eq!(requests[0], json!({"id": 1, "do": "unplug cable 1"}));
    assert_eq!(requests[1], json!({"id": 2, "expect": "unit 1 is in OP", "within": "1.5s"}));
}

#[test]
fn records_and_late_answers_between_are_no_answer() {
    let (mut client, _twin) = client_of(&[
        "{\"at_ns\":1,\"kind\":\"power\"}\n{\"lost\":3}\n{\"id\":99,\"ok\":true,\"at_ns\":1}\n{\"id\":ID,\"ok\":true,\"at_ns\":2}\n\
         {\"at_ns\":3,\"kind\":\"link\"}\n",
    ]);
    assert_eq!(client.apply("x").unwrap().at_ns, 2);
    let kind = |streamed: Option<Streamed>| match streamed {
        Some(Streamed::Record(record)) => record["kind"].to_string(),
        other => format!("{other:?}"),
    };
    assert_eq!(kind(client.next_record(None).unwrap()), "\"power\"");
    assert_eq!(client.next_record(None).unwrap(), Some(Streamed::Lost(3)));
    assert_eq!(kind(client.next_record(None).unwrap()), "\"link\"");
    assert!(matches!(client.next_record(None), Err(ClientError::Ended)), "the other end is closed");
}

#[test]
fn a_refusal_has_its_message_help_and_nearest_sentences() {
    let (mut client, _twin) = client_of(&[
        "{\"id\":ID,\"ok\":false,\"error\":{\"message\":\"m\",\"help\":\"h\",\"nearest\":[\"n\"]}}\n",
        "{\"id\":null,\"ok\":false,\"error\":{\"message\":\"too many clients\"}}\n",
    ]);
    let ClientError::Refused(refusal) = client.apply("unplg cable 1").unwrap_err() else {
        panic!("another error")
    };
    assert_eq!((refusal.message.as_str(), refusal.help.as_str()), ("m", "h"));
    assert_eq!(refusal.nearest, ["n"]);
    assert_eq!(client.apply("x").unwrap_err().to_string(), "too many clients");
}

#[test]
fn without_an_answer_the_time_is_over_and_half_a_line_is_kept() {
    let (ours, mut theirs) = UnixStream::pair().unwrap();
    let mut client = Client::over(ours).unwrap();
    theirs.write_all(b"{\"lost\"").unwrap();
    assert_eq!(client.next_record(Some(Instant::now())).unwrap(), None);
    theirs.write_all(b":5}\n").unwrap();
    assert_eq!(client.next_record(None).unwrap(), Some(Streamed::Lost(5)));
}

#[test]
fn what_is_no_twin_and_what_has_ended_are_told() {
    let (mut client, _twin) = client_of(&["HTTP/1.1 400 Bad Request\r\n"]);
    assert_eq!(
        client.apply("x").unwrap_err().to_string(),
        "what answers is not a twin: it says `HTTP/1.1 400 Bad Request`"
    );
    let (mut client, twin) = client_of(&[]);
    twin.join().unwrap();
    assert!(matches!(client.apply("x"), Err(ClientError::Ended)));
    let (mut client, _twin) = client_of(&["{\"id\":ID,\"ok\":true,\"at_"]);
    assert!(matches!(client.apply("x"), Err(ClientError::Ended)), "half a line is none");
    let missing = Client::connect(Path::new("/nowhere/twin.sock")).unwrap_err();
    assert!(
        missing.to_string().starts_with("no twin answers at /nowhere/twin.sock: No such file"),
        "{missing}"
    );
}

#[test]
fn records_that_nobody_takes_are_counted() {
    let (ours, _theirs) = UnixStream::pair().unwrap();
    let mut client = Client::over(ours).unwrap();
    for _ in 0..RECORDS_MAX + 2 {
        client.keep(Streamed::Record(Map::new()));
    }
    client.keep(Streamed::Lost(4));
    assert_eq!(client.records.len(), RECORDS_MAX + 1);
    assert_eq!(client.records.back(), Some(&Streamed::Lost(6)));
}
