//! Steps that do nothing, and conditions that can never hold, are mistakes of the file.

use scenario::Scenario;

const LINE: &str =
    "title = \"t\"\nunits = [{ model = \"nx-ect101\" }, { model = \"digital\", inputs = 8 }]\n";

/// The messages for these steps of a line of two units, the second of which has no mailbox.
fn messages(steps: &[&str]) -> Vec<String> {
    let steps: Vec<String> = steps.iter().map(|step| format!("{{ {step} }}")).collect();
    let text = format!("{LINE}steps = [{}]\n", steps.join(", "));
    match Scenario::parse(&text, |name| Err(name.to_owned())) {
        Ok(_) => Vec::new(),
        Err(errors) => errors.iter().map(|error| format!("{}; {}", error.message, error.help)).collect(),
    }
}

/// The steps are refused with a message that has these words, and no other.
fn assert_refused(steps: &[&str], words: &str) {
    let messages = messages(steps);
    assert!(matches!(messages.as_slice(), [one] if one.contains(words)), "{steps:?}: {messages:?}");
}

const OFF: &str = "unit = \"power off unit 1\"";
const BREAK: &str = "unit = \"break Processing of unit 1\"";
const UNPLUG: &str = "line = \"unplug cable 2\"";
const READ: &str = "master = \"read SDO 1018:01 of unit 1\"";

#[test]
fn an_order_that_does_nothing_is_refused() {
    for (steps, words) in [
        (&[UNPLUG, UNPLUG] as &[&str], "cable 2 is unplugged already"),
        (&["line = \"plug cable 2\""], "cable 2 is plugged already"),
        (&[UNPLUG, "line = \"plug cable 2\"", "line = \"plug cable 2\""], "cable 2 is plugged already"),
        (&[BREAK, BREAK], "the cause of Processing is there already in unit 1"),
        (&["unit = \"repair Processing of unit 1\""], "there is no cause of Processing in unit 1"),
        (
            &[
                "unit = \"break MessageCommunications of unit 1\"",
                "unit = \"repair MessageCommunications of unit 1\"",
            ],
            "there is no cause of MessageCommunications in unit 1",
        ),
        (&[OFF, OFF], "unit 1 has no power already"),
        (&["unit = \"power on unit 1\""], "unit 1 has power already"),
        (&["unit = \"power off all units\"", OFF], "unit 1 has no power already"),
        (&["unit = \"power on all units\""], "all units have power already"),
        (&["cpu = \"power on the CPU Rack of unit 1\""], "the CPU Rack of unit 1 has power already"),
        (
            &["cpu = \"power off the CPU Rack of unit 1\"", "cpu = \"power off the CPU Rack of unit 1\""],
            "the CPU Rack of unit 1 has no power already",
        ),
        // Without power its software cannot fail.
        (
            &[OFF, BREAK, "unit = \"power on unit 1\"", "unit = \"repair Processing of unit 1\""],
            "no cause of Processing",
        ),
    ] {
        assert_refused(steps, words);
        assert_refused(steps, "a group accepts it: `{ steps = [ … ] }`");
    }
}

#[test]
fn an_order_that_does_something_is_not_refused() {
    for steps in [
        &[UNPLUG, "line = \"unplug cable 1\"", "line = \"plug cable 2\"", UNPLUG] as &[&str],
        &[BREAK, "unit = \"repair Processing of unit 1\"", BREAK],
        &[
            "unit = \"break MessageCommunications of unit 1\"",
            "unit = \"break MessageCommunications of unit 1\"",
        ],
        &[OFF, "unit = \"cycle the power of unit 1\"", OFF, "unit = \"power on all units\""],
        &[OFF, "cpu = \"power off the CPU Rack of unit 1\"", "unit = \"power on unit 1\""],
        // A cause in the hardware does not need power.
        &[OFF, "unit = \"break Esc of unit 1\"", "unit = \"repair Esc of unit 1\""],
    ] {
        assert_eq!(messages(steps), Vec::<String>::new(), "{steps:?}");
    }
}

#[test]
fn in_a_group_and_after_it_nothing_is_known() {
    for steps in [
        &["steps = [{ line = \"plug cable 2\" }, { line = \"plug cable 2\" }]"] as &[&str],
        &["steps = [{ line = \"be quiet\" }]", "line = \"plug cable 2\"", "unit = \"power on unit 1\""],
        &["random = 3, within = \"1s\"", "line = \"plug cable 2\"", "unit = \"repair Processing of unit 1\""],
    ] {
        assert_eq!(messages(steps), Vec::<String>::new(), "{steps:?}");
    }
    // What is known again after a group is checked again.
    let group = "steps = [{ line = \"be quiet\" }]";
    assert_refused(&[group, UNPLUG, UNPLUG], "cable 2 is unplugged already");
    let esc = "unit = \"break Esc of unit 1\"";
    assert_refused(&[group, esc, esc], "the cause of Esc is there already");
    // The unit may have had no power at the first one.
    assert_eq!(messages(&[group, BREAK, BREAK]), Vec::<String>::new());
}

#[test]
fn what_can_never_come_is_refused() {
    for (steps, words) in [
        (
            &["never = \"unit 1 is in SAFE-OP with AL status code 0xFFFE\""] as &[&str],
            "unit 1: no AL status code 0xFFFE",
        ),
        (
            &["never = \"unit 2 is in SAFE-OP with AL status code 0x8004\""],
            "unit 2: no AL status code 0x8004",
        ),
        (
            &["never = \"register 0xFFF0 of unit 1 is 00\""],
            "behind the memory of the ESC, which ends at 0x2FFF",
        ),
        (&["never = \"register 0x2FFF of unit 1 is 00 00\""], "behind the memory of the ESC"),
        (&["never = \"register 0x0050 of unit 1 is 01\""], "no register and no RAM of the ESC is at 0x0050"),
        (
            &["never = \"register 0x0050 of unit 1 changes\""],
            "no register and no RAM of the ESC is at 0x0050",
        ),
        (
            &["never = \"register 0x0134 of unit 1 is 00 00 00\""],
            "3 bytes for the register at 0x0134: none is at 0x0136",
        ),
        (
            &["never = \"the system event log of unit 1 has 85000000 33 times\""],
            "33 records in a log of unit 1, which holds 32; at most 32: the oldest",
        ),
        (
            &["never = \"the access event log of unit 1 has 94B80000 6 times\""],
            "6 records in a log of unit 1, which holds 5",
        ),
        (&["never = \"unit 1 has 33 diagnosis messages\""], "33 messages in a log of unit 1, which holds 32"),
        (&["never = \"diagnosis message 33 of unit 1 is 85000000\""], "33 messages in a log of unit 1"),
        (&["never = \"unit 1 is in BOOT\""], "which has no state BOOT"),
        (&["never = \"all units are in BOOT\""], "which has no state BOOT"),
        (&[READ, "never = \"the last SDO was refused with 0x12345678\""], "0x12345678 is no abort code"),
        (&["never = \"the last frame did not come back\""], "no step sends a frame"),
        (&["never = \"the last mailbox message has no answer\""], "no step sends a mailbox message"),
        (&["never = \"the last register read gave 00\""], "no step reads a register"),
        (&["never = \"the last SDO was taken\""], "no step sends an SDO"),
        (
            &["master = \"read SDO 1018:01 of unit 2\""],
            "unit 2 is of the model digital, which has no mailbox",
        ),
        (
            &[READ, "never = \"the last SDO of unit 2 was taken\""],
            "unit 2 is of the model digital, which has no mailbox",
        ),
        (
            &["line = \"lose all mailbox frames of unit 2\""],
            "unit 2 is of the model digital, which has no mailbox",
        ),
    ] {
        assert_refused(steps, words);
    }
}

#[test]
fn what_can_come_is_not_refused() {
    for steps in [
        &["never = \"unit 1 is in SAFE-OP with AL status code 0x8004\""] as &[&str],
        &[
            "unit = \"let unit 1 refuse OP with AL status code 0xFFFE\"",
            "never = \"unit 1 is in SAFE-OP with AL status code 0xFFFE\"",
        ],
        &[
            "never = \"register 0x2FFF of unit 1 is 01\"",
            "never = \"register 0x0130 of unit 1 is 01 00 00 00 00 00\"",
        ],
        &["never = \"the system event log of unit 1 has 85000000 32 times\""],
        &[READ, "never = \"the last SDO was refused with 0x06090030\""],
        &[
            "steps = [{ master = \"read register 0x0130 of unit 2\" }]",
            "never = \"the last register read gave 00\"",
        ],
        &["line = \"lose all mailbox frames of unit 1\"", "line = \"lose all frames of unit 2\""],
    ] {
        assert_eq!(messages(steps), Vec::<String>::new(), "{steps:?}");
    }
}
