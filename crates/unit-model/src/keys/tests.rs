//! Files that have only the keys of every model.

use device::SiiTiming;
use time::Duration;
use user_file::{FileErrors, Wanted, read_toml};
use wire::{AlState, AlStatusCode};

use super::{CommonKeys, KEYS, OutputsRule, Shape, Timing};

const TERMINAL: Shape = Shape { mailbox: false, boot: false };
const EVERYTHING: Shape = Shape { mailbox: true, boot: true };

fn read(text: &str, shape: Shape) -> Result<CommonKeys, FileErrors> {
    read_toml(text, Wanted::UnitFile, |reader, file| {
        reader.only(file, &KEYS);
        Some(CommonKeys::read(reader, file, shape))
    })
}

fn keys(text: &str) -> CommonKeys {
    read(text, EVERYTHING).unwrap_or_else(|errors| panic!("{errors}"))
}

fn messages(text: &str, shape: Shape) -> Vec<String> {
    match read(text, shape) {
        Ok(keys) => panic!("{keys:?}"),
        Err(errors) => errors.iter().map(ToString::to_string).collect(),
    }
}

#[test]
fn an_empty_file_leaves_everything_to_the_model() {
    assert_eq!(keys(""), CommonKeys::default());
    assert_eq!(keys("").start_up(Duration::from_millis(300)).again, Duration::from_millis(300));
    assert_eq!(keys("").start_up(Duration::from_millis(300)).first, Duration::ZERO);
}

#[test]
fn each_key_is_read() {
    let keys = keys(
        "name = \"K1\"\nserial = 7\nalias = 0x0102\nstart_up = \"50ms\"\nrefresh_phase = \"100us\"\n\
         outputs_before_op = \"not-required\"\nblank_sii = true\n\
         [times]\ntransitions = \"5ms\"\nsii = \"1ms\"\nmailbox = \"7ms\"\n\
         [refuse]\nop = 0x8042\nboot = 0x0013\nacknowledge = true\n",
    );
    let ms = Duration::from_millis;
    assert_eq!(keys.name.as_ref().map(|name| name.value.as_str()), Some("K1"));
    assert_eq!(keys.serial.as_ref().map(|serial| serial.value), Some(7));
    assert_eq!(keys.alias.as_ref().map(|alias| alias.value), Some(0x0102));
    assert_eq!(keys.refresh_phase.as_ref().map(|phase| phase.value), Some(Duration::from_micros(100)));
    assert_eq!((keys.start_up(ms(300)).first, keys.start_up(ms(300)).again), (ms(50), ms(50)));
    let slave = &keys.slave;
    assert_eq!(slave.outputs_before_op, Some(OutputsRule::NotRequired));
    assert!(slave.is_sii_blank && slave.conduct.ignores_acknowledge);
    assert_eq!(slave.conduct.transition_times.of(AlState::Init, AlState::Boot), ms(5));
    assert_eq!((slave.sii_time, slave.mailbox_time), (ms(1), Some(ms(7))));
    assert_eq!(slave.conduct.refusals.of(AlState::Op), Some(AlStatusCode(0x8042)));
    assert_eq!(slave.conduct.refusals.of(AlState::Boot), Some(AlStatusCode(0x0013)));
}

#[test]
fn a_fast_unit_has_no_times_and_refuses_the_same() {
    let text = "start_up = \"50ms\"\ntimes = { transitions = \"5ms\", sii = \"1ms\" }\nrefuse = { op = 1 }\n";
    let (exact, fast) = (keys(text), keys(&format!("timing = \"fast\"\n{text}")));
    let of = |keys: &CommonKeys| {
        let conduct = keys.slave.conduct(keys.timing.value);
        let transition = conduct.transition_times.of(AlState::PreOp, AlState::SafeOp);
        (transition, keys.slave.sii_timing(keys.timing.value), conduct.refusals.of(AlState::Op))
    };
    let (ms, refused) = (Duration::from_millis, Some(AlStatusCode(1)));
    assert_eq!(of(&exact), (ms(5), SiiTiming::Busy(ms(1)), refused));
    assert_eq!(of(&fast), (ms(0), SiiTiming::Immediate, refused));
    assert_eq!((fast.timing.value, fast.start_up(ms(300)).again), (Timing::Fast, ms(0)));
}

/// Keys for features that a model does not have are unknown.
#[test]
fn a_terminal_has_no_keys_for_mailbox_and_boot() {
    assert_eq!(
        messages(
            "[times]\nmailbox = \"1ms\"\ntransitions = { IB = \"1ms\" }\n[refuse]\nboot = 1\n",
            TERMINAL
        ),
        [
            "2:1: unknown key `times.mailbox`, expected `transitions` or `sii`",
            "3:17: unknown key `times.transitions.IB`, expected `II`, `IP`, `PP`, `PI`, `PS`, `SS`, `SP`, `SI`, \
             `SO`, `OO`, `OS`, `OP` or `OI`; did you mean `II`?",
            "5:1: unknown key `refuse.boot`, expected `init`, `pre_op`, `safe_op`, `op` or `acknowledge`",
        ]
    );
}

#[test]
fn wrong_values_are_refused_with_place_and_range() {
    assert_eq!(
        messages("name = \"1K\"\nalias = 0\nstart_up = \"61s\"\ntiming = \"slow\"\n", TERMINAL),
        [
            "1:8: `name` is \"1K\", expected an identifier: letters, digits and single underscores, no digit first, \
             127 characters at most",
            "2:9: `alias` is 0, expected 1 to 65535",
            "3:12: `start_up` is \"61s\", expected a duration, \"0ms\" to \"60s\"",
            "4:10: `timing` is \"slow\", expected \"exact\" or \"fast\"",
        ]
    );
}
