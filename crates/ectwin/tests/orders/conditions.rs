//! Every condition can be checked in both times, or is refused in both as one of the scripted master.

use ectwin::Reason;
use ectwin::scenario::words::{CONDITIONS, QUANTITIES};

use crate::Line;

/// A condition can be checked, or why not.
#[derive(Debug, PartialEq, Eq)]
enum Outcome {
    Checked,
    Refused(Reason),
}

/// The conditions that a line cannot show, by their beginnings: they are about what a master of a scenario has sent, read
/// and received.
const OF_THE_MASTER: &[&str] = &[
    "the inputs of unit",
    "input byte",
    "program variable CPUUnit_RunMode of the master",
    "user-defined error 16#101 at the master",
    "user-defined error 16#101 2 times at the master",
    "no user-defined error at the master",
    "the working counter of every",
    "100 cycles are done",
    "the number of cycles",
    "the number of emergencies",
    "the master has nothing to do",
    "the master has given up",
    "the master has received emergency",
    "the last SDO",
    "the last register",
    "the last mailbox",
    "the last frame",
    "the capture is replayed",
    "every answer is as captured",
    "at most 3 answers differ",
    "one cycle is done",
    "all of (unit 1 is in OP; 100 cycles are done)",
];

/// Nothing has changed since the beginning of a look that is the only one.
const NOT_THERE: &[&str] = &[
    "the outputs of unit 1 change",
    "object 10F3:02 of unit 1 changes",
    "the master has acknowledged the error of unit 1 in this step",
];

#[test]
fn each_condition_is_checked_or_is_one_of_the_master_in_both_times() {
    let mut lines = Line::both();
    let mut wrong = Vec::new();
    let amount = |example: &str| if example.contains(" period ") { "T#1ms" } else { "1" };
    let compared = QUANTITIES.iter().map(|quantity| {
        let example = quantity.example;
        format!("{example} is at least {}", amount(example))
    });
    let examples = CONDITIONS.iter().map(|row| row.example.to_owned()).chain(compared);
    for example in examples {
        let begins = |known: &&str| example.starts_with(*known);
        let expected = if OF_THE_MASTER.iter().any(&begins) {
            Outcome::Refused(Reason::ScriptedMaster)
        } else if NOT_THERE.iter().any(&begins) {
            Outcome::Refused(Reason::NotThere)
        } else {
            Outcome::Checked
        };
        let outcomes = lines.each_mut().map(|line| match line.holds(&example) {
            Ok(_) => Outcome::Checked,
            Err(refused) => {
                assert!(!refused.message.is_empty());
                Outcome::Refused(refused.reason)
            }
        });
        if outcomes.iter().any(|outcome| *outcome != expected) {
            let words =
                lines.each_mut().map(|line| line.holds(&example).map_err(|refused| refused.to_string()));
            wrong.push(format!("{example}: expected {expected:?}, found {words:?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
