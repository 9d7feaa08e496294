//! `ectwin ctl` beside a twin that runs: what it prints, what it does, how it ends.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

mod bench;
mod twins;
mod values;
mod watch;

use std::io::Write;
use std::process::Stdio;

use bench::Bench;

#[test]
fn orders_are_carried_out_in_their_order_until_one_is_refused() {
    let bench = Bench::new("do");
    let _twin = bench.twin();
    let told = bench.told(&["do", "unplug cable 1", "plug cable 1"]);
    let lines: Vec<&str> = told.lines().collect();
    assert!(lines.iter().all(|line| line.starts_with("ok      ")), "{told}");
    assert!(lines[0].ends_with(" s  unplug cable 1") && lines[1].ends_with(" s  plug cable 1"), "{told}");

    let refused =
        bench.ctl(&["do", "break Processing of unit 1", "brek Processing of unit 1", "power off unit 1"]);
    assert_eq!((refused.code, refused.stdout.lines().count()), (Some(2), 1), "{refused:?}");
    assert!(
        refused.stderr.starts_with("error: ") && refused.stderr.contains("break Processing of unit 1"),
        "{refused:?}"
    );
    bench.told(&["expect", "unit 1 has the error 40200000", "--within", "10s"]);
}

#[test]
fn words_without_quotes_are_one_sentence_and_a_dash_reads_sentences_from_stdin() {
    let bench = Bench::new("words");
    let _twin = bench.twin();
    assert!(
        bench
            .told(&["do", "set", "unit", "1", "to", "PROGRAM", "mode"])
            .ends_with("  set unit 1 to PROGRAM mode\n")
    );
    let mut command = bench.command(&["ctl", "do", "-"]);
    let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(b"# a comment\n\nunplug cable 1\n  plug cable 1\n").unwrap();
    let output = child.wait_with_output().unwrap();
    let told = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success() && told.lines().count() == 2, "{told}");
}

#[test]
fn an_expectation_is_true_now_or_in_its_time_or_the_exit_code_is_1() {
    let bench = Bench::new("expect");
    let _twin = bench.twin();
    assert!(bench.told(&["expect", "unit 1 is in INIT", "--within", "5s"]).starts_with("ok  "));
    let failed = bench.ctl(&["expect", "unit 1 is in OP", "unit 1 is in INIT", "--within", "20ms"]);
    assert_eq!((failed.code, failed.stderr.as_str()), (Some(1), ""));
    assert!(
        failed.stdout.starts_with("FAILED  ") && failed.stdout.contains("  unit 1 is in OP: "),
        "{failed:?}"
    );
    assert_eq!(failed.stdout.lines().count(), 1, "the first that is not true is the last one");
    let wrong = bench.ctl(&["expect", "unit 1 is in OP", "--within", "soon"]);
    assert_eq!(wrong.code, Some(2), "{wrong:?}");
}

#[test]
fn each_result_is_one_json_document_too() {
    let bench = Bench::new("json");
    let _twin = bench.twin();
    let done = bench.document(&["do", "unplug cable 1", "nonsense is here"]);
    let sentences = done["sentences"].as_array().unwrap();
    assert_eq!(sentences.len(), 2);
    assert!(sentences[0]["at_ns"].is_u64() && sentences[0]["sentence"] == "unplug cable 1", "{done}");
    assert!(sentences[1]["error"]["message"].is_string(), "{done}");
    let looked = bench.document(&["expect", "unit 1 is in OP"]);
    assert_eq!(looked["sentences"][0]["held"], false);
    assert!(looked["sentences"][0]["seen"].is_string(), "{looked}");
    let status = bench.document(&["status"]);
    assert_eq!((&status["units"][0]["name"], &status["units"][0]["state"]), (&"N1".into(), &"INIT".into()));
    let refused = bench.document(&["read", "no_such_variable"]);
    assert!(refused["problems"][0]["message"].is_string(), "{refused}");
}

#[test]
fn the_status_shows_each_unit() {
    let bench = Bench::new("status");
    let _twin = bench.twin();
    bench.told(&["do", "break Processing of unit 1"]);
    bench.told(&["expect", "unit 1 has the error 40200000", "--within", "10s"]);
    let told = bench.told(&["status"]);
    let lines: Vec<&str> = told.lines().collect();
    assert!(lines[0].starts_with("udp:127.0.0.1:") && lines[0].contains(", 1 unit, "), "{told}");
    assert!(lines[1].starts_with("unit 1 N1 (nx-ect101): INIT"), "{told}");
    for line in
        ["  CPU Unit    RUN", "  error       40200000 ", "  link        IN yes, OUT no", "  indicators  "]
    {
        assert!(lines.iter().any(|told| told.starts_with(line)), "no `{line}` in\n{told}");
    }
}

#[test]
fn sentences_are_found_by_a_word() {
    let bench = Bench::new("sentences");
    let _twin = bench.twin();
    let all = bench.told(&["sentences"]);
    assert!(
        all.contains("do      unplug cable {cable}\n") && all.contains("expect  {units} is in {state}\n"),
        "{all}"
    );
    let some = bench.told(&["sentences", "cable"]);
    assert!(some.contains("unplug cable") && !some.contains("is in {state}"), "{some}");
    let none = bench.ctl(&["sentences", "xyzzy"]);
    assert_eq!(none.code, Some(2));
    assert!(none.stderr.contains("no sentence has `xyzzy`"), "{none:?}");
}
