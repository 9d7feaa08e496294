//! User-defined errors, and durations.

use super::bench::{Bench, Recorder, call};
use crate::elementary::Elementary::{Bool, Time};
use crate::fault::Fault;
use crate::host::Alarm;

#[test]
fn an_alarm_tells_its_code_and_its_information() {
    let (mut bench, mut host) = (Bench::new(), Recorder::default());
    assert_eq!(bench.call_with(&mut host, "SetAlarm", Bool, &[0x101, 20_000_000, 1]), Ok(1));
    assert_eq!(bench.call_with(&mut host, "SetInfo", Bool, &[40_001, 0, 0]), Ok(1));
    assert_eq!(bench.call_with(&mut host, "ResetAlarm", Bool, &[0x101]), Ok(1));
    let expected =
        [Alarm { code: 0x101, info_1: 20_000_000, info_2: 1 }, Alarm { code: 40_001, info_1: 0, info_2: 0 }];
    assert_eq!(host.alarms, expected);
    assert_eq!(host.resets, [0x101]);
}

#[test]
fn codes_outside_their_range_are_a_fault() {
    for (name, code, lower, upper) in [
        ("SetAlarm", 0, 1, 40_000),
        ("SetAlarm", 40_001, 1, 40_000),
        ("SetInfo", 40_000, 40_001, 60_000),
        ("SetInfo", 60_001, 40_001, 60_000),
        ("ResetAlarm", 40_001, 0, 40_000),
    ] {
        let fault = Fault::ArgumentOutOfRange { value: code.into(), lower, upper };
        assert_eq!(call(name, Bool, &[code, 0, 0]), Err(fault), "{name}({code})");
    }
}

#[test]
fn durations_and_numbers() {
    let ns = |duration_ns: i64| duration_ns as u64;
    let rows = [
        ("TimeToSec", vec![ns(1_999_999_999)], ns(1)),
        ("TimeToSec", vec![ns(-1_999_999_999)], ns(-1)),
        ("TimeToNanoSec", vec![ns(-5)], ns(-5)),
        ("NanoSecToTime", vec![ns(-5)], ns(-5)),
        ("SecToTime", vec![ns(-3)], ns(-3_000_000_000)),
        ("ADD_TIME", vec![ns(5), ns(-8)], ns(-3)),
        ("SUB_TIME", vec![ns(5), ns(8)], ns(-3)),
        ("MULTIME", vec![ns(1000), 1.5_f64.to_bits()], ns(1500)),
        ("DIVTIME", vec![ns(1000), 0.5_f64.to_bits()], ns(2000)),
        ("_Now", vec![], 77),
    ];
    for (name, arguments, expected) in rows {
        assert_eq!(call(name, Time, &arguments), Ok(expected), "{name}");
    }
    assert_eq!(call("DIVTIME", Time, &[1, 0]), Err(Fault::DivisionByZero));
    let (lower, upper) = (-9_223_372_036, 9_223_372_036);
    let fault = Fault::ArgumentOutOfRange { value: (upper + 1).into(), lower, upper };
    assert_eq!(call("SecToTime", Time, &[(upper + 1) as u64]), Err(fault));
    assert_eq!(call("SecToTime", Time, &[upper as u64]), Ok(9_223_372_036_000_000_000));
}
