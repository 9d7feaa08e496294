//! Clients that send what is no request, too much, or nothing.

use std::io::Write;
use std::thread;

use control::CLIENTS_MAX;
use control::messages::LINE_BYTES_MAX;
use serde_json::json;
use time::Duration;

use crate::bench::Bench;

#[test]
fn lines_that_are_no_requests_are_answered_and_the_next_one_is_read() {
    let bench = Bench::new("no_requests");
    let mut client = bench.client();
    let deep = format!("{{\"id\":1,\"do\":{}\n", "[".repeat(50_000));
    let lines: [(&[u8], &str); 5] = [
        (b"{\"do\":\"\xFF\xFE\"}\n", "not UTF-8"),
        (b"hello\n", "expected value"),
        (deep.as_bytes(), "recursion limit"),
        (b"{\"id\":1}\n", "has no verb"),
        (b"\0\0\0\n", "expected value"),
    ];
    for (line, words) in lines {
        client.say(line);
        let answer = client.line();
        assert_eq!(answer["ok"], false);
        assert!(answer["error"]["message"].as_str().unwrap().contains(words), "{answer}");
    }
    client.say("\n\r\n  \n");
    assert_eq!(client.answer(&json!({ "id": 7, "do": "make it" }))["id"], 7);
}

#[test]
fn a_half_line_waits_and_delays_nobody() {
    let bench = Bench::new("half_line");
    let mut half = bench.client();
    half.say("{\"id\":1,\"do\":\"ma");
    assert_eq!(bench.client().answer(&json!({ "id": 2, "do": "make it" }))["id"], 2);
    half.say("ke it\"}\n");
    assert_eq!(half.line(), json!({ "id": 1, "ok": true, "at_ns": half_at(&bench) }));
}

fn half_at(bench: &Bench) -> u64 {
    bench.table.lock().unwrap().now
}

#[test]
fn a_line_of_ten_megabytes_is_refused_once_and_the_next_one_is_read() {
    let bench = Bench::new("long_line");
    let mut client = bench.client();
    let mut stream = client.stream.try_clone().unwrap();
    let writing = thread::spawn(move || {
        (0..100).for_each(|_| stream.write_all(&[b'x'; 100_000]).unwrap());
        stream.write_all(b"\n{\"id\":2,\"do\":\"make it\"}\n").unwrap();
    });
    let message = format!("a request has more than {LINE_BYTES_MAX} bytes");
    assert_eq!(client.line()["error"]["message"], message);
    assert_eq!(client.line()["id"], 2);
    writing.join().unwrap();
}

/// A client that never reads its answers is not asked for further requests: it waits in its own `write`.
#[test]
fn a_flood_of_requests_delays_no_other_client_and_takes_no_room() {
    let bench = Bench::new("flood");
    let flood = bench.client();
    flood.stream.set_nonblocking(true).unwrap();
    let request = b"{\"id\":1,\"sentences\":true}\n".repeat(1_000);
    let mut other = bench.client();
    let mut refused = 0;
    for number in 0..500 {
        // The socket is full, and stays so, as nobody reads the answers.
        while (&flood.stream).write(&request).is_ok() {}
        refused += 1;
        assert_eq!(other.answer(&json!({ "id": number, "do": "make it" }))["id"], number);
    }
    assert_eq!(refused, 500);
}

#[test]
fn there_is_room_for_so_many_clients_and_the_next_one_is_told() {
    let bench = Bench::new("clients");
    let mut clients: Vec<_> = (0..CLIENTS_MAX).map(|_| bench.client()).collect();
    for (number, client) in clients.iter_mut().enumerate() {
        assert_eq!(client.answer(&json!({ "id": number, "do": "make it" }))["id"], number);
    }
    let mut one_more = bench.client();
    let refused = one_more.line();
    assert_eq!(refused["error"]["message"], "256 clients are connected already");
    assert!(one_more.is_closed());
    clients.pop();
    // The next one is admitted when the server has noticed that one has left.
    loop {
        let mut next = bench.client();
        if next.stream.write_all(b"{\"id\":1,\"do\":\"make it\"}\n").is_ok() && next.line()["ok"] == true {
            return;
        }
    }
}

#[test]
fn there_is_room_for_so_many_expectations_and_those_of_a_client_that_has_left_are_forgotten() {
    let bench = Bench::new("expectations");
    let mut client = bench.client();
    for id in 0..64 {
        client.request(&json!({ "id": id, "expect": "x", "within": "1000s" }));
    }
    let refused = client.answer(&json!({ "id": 64, "expect": "x", "within": "1000s" }));
    assert_eq!(refused["error"]["message"], "64 expectations of this client wait already");
    assert_eq!(client.answer(&json!({ "id": 65, "expect": "x" }))["held"], false);
    drop(client);

    let mut other = bench.client();
    other.request(&json!({ "id": 1, "expect": "y", "within": "1000s" }));
    other.request(&json!({ "id": 2, "do": "make y" }));
    let ids = [other.line()["id"].clone(), other.line()["id"].clone()];
    assert!(ids.contains(&json!(1)) && ids.contains(&json!(2)), "{ids:?}");

    // The twin is not looked at for anybody any more, as soon as the server has noticed that.
    let mut looks_while_busy = || {
        let before = bench.table.lock().unwrap().looks;
        (0..100).for_each(|id| assert_eq!(other.answer(&json!({ "id": id, "do": "make z" }))["ok"], true));
        bench.table.lock().unwrap().looks - before
    };
    assert!((0..100).any(|_| looks_while_busy() == 0), "those of the client that has left are looked at");
}

/// Looks that take long have a share of the time of their own: requests do not wait until it is made up.
#[test]
fn expectations_that_take_long_delay_no_request() {
    let bench = Bench::new("long-looks");
    bench.table.lock().unwrap().look_takes = Duration::from_millis(10);
    let mut waits = bench.client();
    for id in 0..64 {
        waits.request(&json!({ "id": id, "expect": "x", "within": "1000s" }));
    }
    let mut other = bench.client();
    // After each look there is a pause of 20 ms, in which requests are carried out.
    let mut looks_while_busy = || {
        let before = bench.table.lock().unwrap().looks;
        (0..5).for_each(|id| assert_eq!(other.answer(&json!({ "id": id, "do": "make z" }))["ok"], true));
        bench.table.lock().unwrap().looks - before
    };
    assert!((0..100).any(|_| looks_while_busy() == 0), "each request waits for a look");
}

/// Each client has room for 64, and all together for 1,024.
#[test]
fn there_is_room_for_so_many_expectations_of_all_clients() {
    let bench = Bench::new("all-expectations");
    let mut clients: Vec<_> = (0..17).map(|_| bench.client()).collect();
    for client in &mut clients[..16] {
        for id in 0..64 {
            client.request(&json!({ "id": id, "expect": "x", "within": "1000s" }));
        }
        // The answer shows that those before have been taken.
        assert_eq!(client.answer(&json!({ "id": "now", "expect": "x" }))["held"], false);
    }
    let one_more = json!({ "id": 1, "expect": "x", "within": "1000s" });
    let refused = clients[16].answer(&one_more);
    assert_eq!(refused["error"]["message"], "1024 expectations of all clients wait already");
    drop(clients.remove(0));
    let mut last = clients.remove(15);
    // There is room as soon as the server has noticed that one has left: then only the order is answered.
    loop {
        last.request(&one_more);
        if last.answer(&json!({ "id": 2, "do": "make it" }))["id"] == 2 {
            return;
        }
        assert_eq!(last.line()["id"], 2);
    }
}
