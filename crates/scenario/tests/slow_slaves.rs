//! Slow and refusing slaves: with each sentence a master sees the effect, and without the sentence it does not.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

use scenario::model::UnitOrder;
use scenario::{Recording, Scenario};

/// A sentence, the steps before it, and a condition that is true after it and only after it.
struct Case {
    before: &'static [&'static str],
    sentence: &'static str,
    behind: &'static [&'static str],
}

const CASES: &[Case] = &[
    Case {
        before: &[],
        sentence: "let every transition of unit 1 take 500ms",
        behind: &[
            r#"{ master = "request PRE-OP of unit 1" }"#,
            r#"{ after = "499ms", expect = "register 0x0120 of unit 1 is 02 00" }"#,
            r#"{ expect = "unit 1 is in INIT" }"#,
        ],
    },
    // The mailboxes are not set: PRE-OP is refused, but only after its time.
    Case {
        before: &[],
        sentence: "let transition IP of unit 1 take 500ms",
        behind: &[
            r#"{ master = "request PRE-OP of unit 1" }"#,
            r#"{ after = "499ms", expect = "unit 1 is in INIT" }"#,
            r#"{ expect = "unit 1 is in INIT with AL status code 0x0016", within = "2ms" }"#,
        ],
    },
    Case {
        before: &[],
        sentence: "let each SII command of unit 1 take 5ms",
        behind: &[
            r#"{ master = "write register 0x0502 of unit 1 as 00 01 08 00 00 00" }"#,
            r#"{ after = "3ms", expect = "register 0x0502 of unit 1 is 40 81" }"#,
        ],
    },
    Case {
        before: &[],
        sentence: "keep the SII of unit 1 busy for 100ms",
        behind: &[
            r#"{ after = "99ms", expect = "register 0x0502 of unit 1 is 40 80" }"#,
            r#"{ after = "2ms", expect = "register 0x0502 of unit 1 is 40 00" }"#,
        ],
    },
    Case {
        before: &[
            r#"{ master = "take unit 1 to PRE-OP" }"#,
            r#"{ expect = "the master has nothing to do", within = "1s" }"#,
        ],
        sentence: "let the SDOs of unit 1 take 300ms",
        behind: &[
            r#"{ master = "read SDO 1018:01 of unit 1" }"#,
            r#"{ after = "299ms", expect = "register 0x080D of unit 1 is 30" }"#,
            r#"{ expect = "the last SDO gave 83 00 00 00", within = "5ms" }"#,
        ],
    },
    Case {
        before: &[
            r#"{ master = "take unit 1 to PRE-OP" }"#,
            r#"{ expect = "the master has nothing to do", within = "1s" }"#,
        ],
        sentence: "let unit 1 refuse SAFE-OP with AL status code 0x0024",
        behind: &[
            r#"{ master = "take unit 1 to OP" }"#,
            r#"{ expect = "unit 1 is in PRE-OP with AL status code 0x0024", within = "1s" }"#,
        ],
    },
    Case {
        before: &[
            r#"{ master = "request OP of unit 1" }"#,
            r#"{ expect = "unit 1 is in INIT with AL status code 0x0011", within = "2ms" }"#,
        ],
        sentence: "let unit 1 ignore acknowledges",
        behind: &[
            r#"{ master = "acknowledge and request INIT of unit 1" }"#,
            r#"{ after = "10ms", expect = "unit 1 is in INIT with AL status code 0x0011" }"#,
        ],
    },
    Case {
        before: &[],
        sentence: "erase the SII of unit 1",
        behind: &[
            r#"{ unit = "cycle the power of unit 1" }"#,
            r#"{ master = "take unit 1 to PRE-OP" }"#,
            r#"{ expect = "unit 1 is in INIT with AL status code 0x0014", within = "1s" }"#,
        ],
    },
    Case {
        before: &[
            r#"{ unit = "let unit 1 refuse PRE-OP with AL status code 0x8001" }"#,
            r#"{ unit = "let unit 1 ignore acknowledges" }"#,
            r#"{ unit = "let every transition of unit 1 take 4s" }"#,
            r#"{ unit = "let each SII command of unit 1 take 4s" }"#,
            r#"{ unit = "let the SDOs of unit 1 take 4s" }"#,
        ],
        sentence: "let unit 1 behave",
        behind: &[r#"{ master = "take unit 1 to OP" }"#, r#"{ expect = "unit 1 is in OP", within = "1s" }"#],
    },
];

/// The failure of these steps when they are replayed, if there is one.
fn failure(steps: &[&str]) -> Option<String> {
    let text = format!("title = \"t\"\nsteps = [\n{}\n]", steps.join(",\n"));
    let scenario = Scenario::parse(&text, |_| Err(String::new())).expect("a right scenario");
    let report = scenario.replay(1, Recording::new(true, false));
    let trace = report.recording.trace().unwrap_or_default().to_owned();
    report.failure.map(|failure| format!("{failure:?}\n{trace}"))
}

#[test]
fn each_sentence_does_what_it_says() {
    for Case { before, sentence, behind } in CASES {
        let order = format!("{{ unit = \"{sentence}\" }}");
        let with: Vec<&str> = [before, &[order.as_str()][..], behind].concat();
        assert_eq!(failure(&with), None, "{sentence}");
        let without: Vec<&str> = [*before, *behind].concat();
        assert!(
            failure(&without).is_some(),
            "`{sentence}` is left out, and the expectations hold all the same"
        );
    }
}

/// The tried sentences are those of the table.
#[test]
fn every_sentence_of_conduct_is_tried() {
    let read = |text: &str| scenario::words::read(scenario::words::UNIT, text);
    let is_conduct =
        |order: &UnitOrder| matches!(order, UnitOrder::Conduct { .. } | UnitOrder::EraseSii { .. });
    for sentence in scenario::words::UNIT {
        let is_tried = CASES.iter().any(|case| case.sentence == sentence.example);
        let order = read(sentence.example).expect("an example is a sentence");
        assert!(is_tried || !is_conduct(&order), "{}", sentence.example);
    }
}

/// A slow transition: a second request does not count, and is accepted later if the master repeats it.
#[test]
fn a_second_request_waits_until_the_first_is_taken() {
    let steps = [
        r#"{ master = "take unit 1 to PRE-OP" }"#,
        r#"{ expect = "the master has nothing to do", within = "1s" }"#,
        r#"{ unit = "let transition PI of unit 1 take 100ms" }"#,
        r#"{ master = "request INIT of unit 1" }"#,
        r#"{ expect = "the master has nothing to do", within = "5ms" }"#,
        r#"{ master = "request OP of unit 1" }"#,
        r#"{ after = "90ms", expect = "register 0x0120 of unit 1 is 01 00" }"#,
        r#"{ expect = "unit 1 is in PRE-OP" }"#,
        r#"{ expect = "unit 1 is in INIT with AL status code 0x0011", within = "20ms" }"#,
    ];
    assert_eq!(failure(&steps), None);
}

/// The times of a unit file apply in a scenario, and `behave` restores them.
#[test]
fn a_unit_file_sets_the_same() {
    let unit = r#"units = [{ model = "nx-ect101", times = { transitions = { IP = "300ms" } }, refuse = { op = 0x8007 } }]"#;
    let steps = [
        r#"{ unit = "let unit 1 behave" }"#,
        r#"{ master = "take unit 1 to OP" }"#,
        r#"{ expect = "unit 1 is in INIT", for = "299ms" }"#,
        r#"{ expect = "unit 1 is in SAFE-OP with AL status code 0x8007", within = "1s" }"#,
    ];
    let text = format!("title = \"t\"\n{unit}\nsteps = [\n{}\n]", steps.join(",\n"));
    let scenario = Scenario::parse(&text, |_| Err(String::new())).expect("a right scenario");
    assert_eq!(scenario.replay(1, Recording::new(false, false)).failure, None);
}
