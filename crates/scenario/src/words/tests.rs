//! The grammar: every example is read and written by its own row, and mistakes are reported.

use super::sentence::fit;
use super::*;
use crate::model::{
    Bytes, Choice, Condition, Controller, CpuOrder, Entry, FrameKind, Frames, LineOrder, MasterOrder,
    Position, UnitNumber, UnitOrder, UserErrorCode,
};

/// The examples of a table are read, each by its own row, and the value gives the same sentence.
fn examples_are_read_and_written<T: Spoken + PartialEq>() {
    for sentence in T::SENTENCES {
        let words: Vec<&str> = sentence.example.split_whitespace().collect();
        let values = fit(sentence, &words).map_err(|(_, problem)| problem.to_string());
        let alone = (sentence.build)(&values.expect(sentence.example)).expect(sentence.pattern);
        assert_eq!(T::from_sentence(sentence.example).as_ref(), Ok(&alone), "{}", sentence.example);
        assert_ne!(sentence.is_old, alone.sentence() == sentence.example, "{}", sentence.example);
        assert!(!sentence.meaning.is_empty());
    }
}

#[test]
fn every_example_is_read_and_written_by_its_own_row() {
    examples_are_read_and_written::<MasterOrder>();
    examples_are_read_and_written::<UnitOrder>();
    examples_are_read_and_written::<CpuOrder>();
    examples_are_read_and_written::<LineOrder>();
    examples_are_read_and_written::<Condition>();
}

#[test]
fn what_is_wrong_is_told_with_the_sentence_that_was_meant() {
    let problem = |text: &str| match Condition::from_sentence(text) {
        Err(NoSentence { message, help }) => format!("{message} / {help}"),
        Ok(condition) => panic!("{condition:?}"),
    };
    assert_eq!(
        problem("unit 1 is in SAVE-OP"),
        "expected INIT, PRE-OP, SAFE-OP, OP or BOOT, found `SAVE-OP` / \
         the sentence is `{units} is in {state}`, such as `unit 1 is in OP`"
    );
    assert!(problem("unit 1 has recorded 8500").contains("an event code of eight hexadecimal digits"));
    assert!(problem("unit is in OP").contains("its number or name such as `unit Conveyor`"));
    assert!(problem("unit 0 is in OP").contains("found `0` / "), "units count from 1");
    assert!(problem("").contains("is not a valid sentence"));
    let help = "the sentence is `{units} has the error {event}`, such as `unit 1 has the error 39170000`";
    assert!(problem("unit 1 wobbles").starts_with("expected `is` or `has`, found `wobbles` / "));
    assert_eq!(
        problem("unit 1 has error"),
        format!("expected `recorded`, `the`, `no`, `new` or `one`, found `error` / {help}")
    );
    assert!(problem("all units is in OP2").starts_with("expected `are` or `have`, found `is` / "));
    assert!(problem("unit 1 are in SAVE-OP").contains("expected `is` or `has`, found `are`"));
    let indicators = "expected RUN, ERR, L/A IN, L/A OUT, TS green or TS red, found `of`";
    assert!(problem("TS of unit 1 is lit").starts_with(indicators), "{}", problem("TS of unit 1 is lit"));
    let al_status = problem("AL status of unit 1 is 08");
    assert!(
        al_status.contains("did you mean `unit 1 is in SAFE-OP with AL status code 0x001B`?"),
        "{al_status}"
    );
}

#[test]
fn the_wrong_word_of_an_order_is_told() {
    let line = |text: &str| match LineOrder::from_sentence(text) {
        Err(NoSentence { message, help }) => format!("{message} / {help}"),
        Ok(order) => panic!("{order:?}"),
    };
    for (text, found) in
        [("lose 101 % of the frames", "101"), ("lose 5 % of frames", "frames"), ("lose 5% frames", "frames")]
    {
        let told = line(text);
        assert!(told.contains("`5 % of the` (0 to 100 %)"), "{told}");
        let sentence = "the sentence is `lose {frames} {way} {lasting} {called}`";
        assert!(told.contains(&format!("found `{found}` / {sentence}")), "{told}");
    }
    let told = MasterOrder::from_sentence("set the outputs of unit 1 to 01 02 300").expect_err("no byte");
    assert_eq!(told.message, "expected bytes such as 01 FF, hexadecimal, found `300`");
}

#[test]
fn places_read_what_they_name() {
    let one = |name, words: &[&str]| Place::named(name).read(words).map(|(value, _)| value);
    assert_eq!(
        one("entries", &["7000:01..03"]),
        Ok(Value::Entries([1, 2, 3].map(|sub| Entry { index: 0x7000, sub }).to_vec()))
    );
    assert_eq!(one("percent", &["5", "%"]), Ok(Value::Percent(5)));
    assert_eq!(one("percent", &["5%"]), Ok(Value::Percent(5)));
    assert_eq!(one("percent", &["0", "%"]), Ok(Value::Percent(0)));
    assert!(one("percent", &["101%"]).is_err());
    assert_eq!(one("bytes", &["01", "0xFF"]), Ok(Value::Bytes(Bytes::from([1, 255]))));
    assert!(one("bytes", &["100"]).is_err() && one("bytes", &[]).is_err());
    assert_eq!(one("request", &["0x05"]), Ok(Value::State(wire::AlState::from_bits(5))));
    assert!(one("request", &["0x15"]).is_err() && one("state", &["0x05"]).is_err());
    assert!(one("event", &["12345678"]).is_err(), "an event of the table");
}

#[test]
fn places_of_programs_read_what_they_name() {
    let one = |name, words: &[&str]| Place::named(name).read(words).map(|(value, _)| value);
    assert_eq!(one("controller", &["the", "master", "is"]), Ok(Value::Controller(Controller::Master)));
    assert_eq!(
        one("controller", &["unit", "2"]),
        Ok(Value::Controller(Controller::Unit(UnitNumber::at(1).into())))
    );
    assert!(one("controller", &["all", "units"]).is_err(), "one of them");
    assert_eq!(one("position", &["5:9"]), Ok(Value::Position(Position { line: 5, column: 9 })));
    assert!(one("position", &["0:9"]).is_err() && one("position", &["5"]).is_err());
    assert_eq!(one("error", &["16#101"]), Ok(Value::UserError(UserErrorCode(257))));
    assert!(one("error", &["40001"]).is_err(), "information from there on");
    assert_eq!(one("value", &["[1,", "2]"]), Ok(Value::Text("[1, 2]".to_owned())));
    assert!(one("value", &[]).is_err());
}

#[test]
fn frames_are_chosen_in_several_ways() {
    let read = |text: &str| {
        let words: Vec<&str> = text.split_whitespace().collect();
        Place::named("frames").read(&words).map(|(value, _)| value)
    };
    let frames = |choice, kind| Ok(Value::Frames(Frames { kind, unit: None, choice }));
    assert_eq!(read("all frames"), frames(Choice::All, FrameKind::Any));
    assert_eq!(read("the next 3 mailbox frames"), frames(Choice::Next(3), FrameKind::Mailbox));
    assert_eq!(read("5 % of the process data frames"), frames(Choice::Percent(5), FrameKind::ProcessData));
    assert_eq!(read("number 1 of the frames"), frames(Choice::Behind { skip: 0, count: 1 }, FrameKind::Any));
    assert_eq!(
        read("numbers 3 to 9 of the frames"),
        frames(Choice::Behind { skip: 2, count: 7 }, FrameKind::Any)
    );
    for wrong in [
        "number 0 of the frames",
        "numbers 5 to 4 of the frames",
        "some frames",
        "the next frames",
        "1001 ‰ of the frames",
        "1001 ‰ of the frames",
        "1001 per mille of the frames",
        "every 0th of the frames",
        "every 10st of the frames",
        "every tenth of the frames",
        "all BRDs frames",
        "all frames of unit 0",
        "all frames of all units",
    ] {
        assert!(read(wrong).is_err(), "{wrong}");
    }
    assert_eq!(read("5 per mille of the BRD frames"), frames(Choice::PerMille(5), FrameKind::Brd));
    assert_eq!(read("every 22nd of the SII frames"), frames(Choice::Every(22), FrameKind::Sii));
    let of_unit_2 = Frames::of(Choice::All).of_unit(UnitNumber::at(1));
    assert_eq!(read("all frames of unit 2"), Ok(Value::Frames(of_unit_2)));
}

#[test]
fn the_place_of_a_fault_its_time_and_its_name_can_be_left_out() {
    let written = |text: &str| LineOrder::from_sentence(text).map(|order| order.sentence());
    for (text, same) in [
        ("lose all frames outward", "lose all frames"),
        ("lose all frames on cable 3 outward", "lose all frames on cable 3"),
        (
            "lose 5‰ of the frames on the way back for 3s called storm",
            "lose 5 ‰ of the frames on the way back for 3s called storm",
        ),
        (
            "delay all frames on cable 2 on the way back by 2ms ± 1ms normal called a",
            "delay all frames on cable 2 on the way back by 2ms ± 1ms normal called a",
        ),
        ("cut all frames outward to 40 bytes for 1ms", "cut all frames to 40 bytes for 1ms"),
    ] {
        assert_eq!(written(text).as_deref(), Ok(same));
    }
    for wrong in [
        "lose all frames on cable 0",
        "lose all frames on cable",
        "lose all frames called",
        "lose all frames called 3",
        "lose all frames for 0s",
        "lose all frames called storm for 3s",
        "delay all frames by 3ms to 1ms",
        "delay all frames by 0ms",
        "delay all frames by 1ms ± 2ms",
        "duplicate all frames on cable 2",
        "lower the working counter of all frames by 0",
        "end",
    ] {
        assert!(LineOrder::from_sentence(wrong).is_err(), "{wrong}");
    }
}
