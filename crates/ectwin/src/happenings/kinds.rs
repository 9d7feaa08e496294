//! The kinds of records and their fields: one table, for the records themselves, for the documents and for a schema.

/// A kind of records.
#[derive(Clone, Copy, Debug)]
pub struct KindRow {
    /// Its name: the field `kind`.
    pub name: &'static str,
    /// The level of `-v` from which a log shows it; an aborted SDO is shown by `-v` already.
    pub shown_by: &'static str,
    /// What such a record says.
    pub meaning: &'static str,
    /// Its fields, after the common ones.
    pub fields: &'static [FieldRow],
}

/// A field of a record.
#[derive(Clone, Copy, Debug)]
pub struct FieldRow {
    /// Its name.
    pub name: &'static str,
    /// Its values.
    pub form: Form,
    /// Whether it is in every record of its kind.
    pub presence: Presence,
    /// Its meaning.
    pub meaning: &'static str,
}

/// The values of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// A whole number from 0.
    Number,
    /// A text.
    Text,
    /// One of these texts.
    Word(&'static [&'static str]),
    /// `0x` and this number of hexadecimal digits.
    Hex(u8),
    /// true or false.
    Flag,
    /// A list of whole numbers from 0.
    Numbers,
}

impl Form {
    /// Its type in JSON, in words.
    #[must_use]
    pub const fn words(self) -> &'static str {
        match self {
            Self::Number => "integer",
            Self::Text | Self::Word(_) | Self::Hex(_) => "string",
            Self::Flag => "boolean",
            Self::Numbers => "array of integers",
        }
    }
}

/// Whether a field is in every record of its kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Presence {
    /// It is.
    Always,
    /// It is left out where it has no value.
    Optional,
}

const fn row(
    name: &'static str,
    shown_by: &'static str,
    meaning: &'static str,
    fields: &'static [FieldRow],
) -> KindRow {
    KindRow { name, shown_by, meaning, fields }
}

const fn number(name: &'static str, meaning: &'static str) -> FieldRow {
    FieldRow { name, form: Form::Number, presence: Presence::Always, meaning }
}

const fn text(name: &'static str, meaning: &'static str) -> FieldRow {
    FieldRow { name, form: Form::Text, presence: Presence::Always, meaning }
}

const fn word(name: &'static str, words: &'static [&'static str], meaning: &'static str) -> FieldRow {
    FieldRow { name, form: Form::Word(words), presence: Presence::Always, meaning }
}

const fn hex(name: &'static str, digits: u8, meaning: &'static str) -> FieldRow {
    FieldRow { name, form: Form::Hex(digits), presence: Presence::Always, meaning }
}

const fn flag(name: &'static str, meaning: &'static str) -> FieldRow {
    FieldRow { name, form: Form::Flag, presence: Presence::Always, meaning }
}

const fn numbers(name: &'static str, meaning: &'static str) -> FieldRow {
    FieldRow { name, form: Form::Numbers, presence: Presence::Always, meaning }
}

const fn optional(field: FieldRow) -> FieldRow {
    FieldRow { presence: Presence::Optional, ..field }
}

/// The fields that come first in every record.
pub const COMMON: &[FieldRow] = &[
    number("at_ns", "nanoseconds since power-on of the twin"),
    optional(number("unit", "number of the unit in the line, from 1; left out for the whole line")),
    optional(text("name", "name of the unit in its unit file")),
    text("kind", "one of the kinds below"),
    text("text", "what has happened, in words, as in the log"),
];

/// All kinds.
pub const KINDS: &[KindRow] = &[
    row(
        "ready",
        "-",
        "the first record: the twin answers frames from now on",
        &[
            text("link", "the link, with its real port"),
            number("units", "number of units"),
            number("unix_ns", "calendar time of `at_ns` 0, in nanoseconds since 1970-01-01 UTC"),
        ],
    ),
    row(
        "unit",
        "-v",
        "a unit of the line, once after `ready`, and again when another unit takes its place",
        &[text("model", "its model")],
    ),
    row(
        "finding",
        "-v",
        "a setting rule that the unit file does not satisfy, once after `unit`",
        &[
            text("rule", "the rule, as in `ectwin list rules`"),
            text("event", "code of its event"),
            word("level", &["minor_fault", "observation"], "`minor_fault` or `observation`"),
            text("message", "place, value and limit"),
            text("correction", "the correction"),
        ],
    ),
    row(
        "state",
        "-v",
        "a unit shows another state or another AL status code",
        &[
            text("from", "the state before"),
            text("to", "the state"),
            flag("error", "the error indication of AL status"),
            hex("al_status_code", 4, "AL status code, such as `0x001B`"),
            optional(text("al_status_name", "its published meaning, unless it is 0")),
        ],
    ),
    row("power", "-v", "a unit is switched on or off", &[flag("on", "whether it has power now")]),
    row(
        "event",
        "-v",
        "a unit records an event",
        &[
            text("event", "its code, such as `85000000`"),
            text("event_name", "its name"),
            word(
                "level",
                &["minor_fault", "observation", "information"],
                "`minor_fault`, `observation` or `information`",
            ),
            numbers("attached", "attached information 1 to 4, as many as it has"),
        ],
    ),
    row(
        "emergency",
        "-v",
        "an emergency is in the mailbox of the unit, for the master to read",
        &[
            hex("error_code", 4, "emergency error code, such as `0xFF20`"),
            hex("error_register", 2, "error register, such as `0x00`"),
            text("data", "the five bytes of the maker"),
            optional(text("event", "code of the event, if only one has this error code")),
        ],
    ),
    row(
        "emergencies_lost",
        "-v",
        "emergencies are lost: no room for them, or no mailbox",
        &[number("count", "their number")],
    ),
    row(
        "sdo",
        "-vv; -v if aborted",
        "an SDO has ended, in one message or in several",
        &[
            word(
                "direction",
                &["upload", "download", "unknown"],
                "`upload` (the master reads), `download` (it writes) or `unknown`",
            ),
            hex("index", 4, "index of the object, such as `0x1C12`"),
            number("sub", "subindex"),
            flag("complete_access", "whether it is for all entries of the object"),
            optional(text("object", "name of the entry, if the unit has it")),
            number("length_bytes", "length of the value; 0 if it was aborted"),
            text("value", "its first eight bytes"),
            optional(hex("abort_code", 8, "abort code, if it was aborted")),
            optional(text("abort_name", "the published meaning of the abort code")),
            optional(word("aborted_by", &["unit", "master"], "`unit` or `master`")),
        ],
    ),
    row(
        "message",
        "-vv",
        "a mailbox message",
        &[
            word("direction", &["from_master", "to_master"], "`from_master` or `to_master`"),
            text("service", "the service, such as `SDO request`"),
            number("counter", "mailbox counter, 0 to 7"),
            number("length_bytes", "length after the mailbox header"),
            flag("again", "whether it is the message before, repeated"),
        ],
    ),
    row(
        "mapping",
        "-vv",
        "process data of a SyncManager, when the unit has left PRE-OP for SAFE-OP",
        &[
            number("sync_manager", "number of the SyncManager"),
            word("direction", &["outputs", "inputs"], "`outputs` or `inputs`"),
            hex("physical_start", 4, "first byte in the memory of the ESC"),
            number("length_bytes", "length"),
            optional(hex("logical_start", 8, "first logical byte, if an FMMU maps it")),
        ],
    ),
    row(
        "link",
        "-v",
        "a port of a unit has a link, or has lost it",
        &[word("port", &["IN", "OUT"], "`IN` or `OUT`"), flag("present", "whether there is a link")],
    ),
    row(
        "indicator",
        "-",
        "an indicator has another pattern; compared every 50 ms",
        &[
            text("indicator", "its name, such as `RUN`"),
            text("pattern", "its pattern, as in `ectwin list indicators`"),
        ],
    ),
    row(
        "fault",
        "-v",
        "the cause of a fault of a unit is injected or removed; none for a fault without a duration, such as `MessageCommunications`, or with one shorter than until the next poll",
        &[text("fault", "name of the fault"), flag("present", "whether it is there now")],
    ),
    row(
        "frame_fault",
        "-v",
        "a fault of frames begins, or ends by an order or by itself",
        &[
            number("number", "its number on this line, from 1"),
            optional(text("sentence", "its sentence, as in a scenario")),
            flag("present", "whether it is at work now"),
        ],
    ),
    row(
        "carrier",
        "-v",
        "the medium to the master has lost its carrier, or has it again",
        &[flag("present", "whether there is a carrier")],
    ),
    row(
        "master",
        "-v",
        "a master has begun to send frames, or has sent none for one second",
        &[flag("present", "whether it sends frames")],
    ),
    row(
        "cpu",
        "-v",
        "a report of a CPU Unit",
        &[
            word(
                "report",
                &[
                    "mode",
                    "program_loaded",
                    "task_period_exceeded",
                    "program_stopped",
                    "program_error",
                    "task_overrun",
                    "user_defined_error",
                    "user_defined_errors_reset",
                    "io_refreshing_stopped",
                    "io_refreshing_resumed",
                ],
                "`mode`, `program_loaded`, `task_period_exceeded`, `program_stopped`, `program_error`, `task_overrun`, \
             `user_defined_error`, `user_defined_errors_reset`, `io_refreshing_stopped`, `io_refreshing_resumed`",
            ),
            text("message", "the report in words"),
            number("count", "how often it has occurred since the report before"),
            optional(word("mode", &["RUN", "PROGRAM"], "`RUN` or `PROGRAM`, for `mode`")),
            optional(number("missed_periods", "number of task periods that were left out")),
            optional(text("file", "file of the program, if it has several")),
            optional(number("line", "line in the program, from 1")),
            optional(number("column", "column in the line, from 1")),
        ],
    ),
    row(
        "lost",
        "-v",
        "records before this one are missing: more came than could be taken or written",
        &[number("lost", "their number")],
    ),
];
