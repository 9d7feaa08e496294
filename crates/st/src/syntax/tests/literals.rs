//! The values of literals, up to their limits.

use proptest::prelude::*;

use super::accepted::value;
use super::told;
use crate::elementary::{Class, Elementary};

#[test]
fn literals_of_all_kinds() {
    let cases = [
        ("1_000", "1000"),
        ("16#FF", "255"),
        ("8#17", "15"),
        ("2#1010_1010", "170"),
        ("10#15", "15"),
        ("1.0E-3", "0.001"),
        ("1e5", "100000.0"),
        ("INT#-5", "INT#-5"),
        ("UINT#16#FF", "UINT#255"),
        ("byte#2#1", "BYTE#1"),
        ("BOOL#1", "BOOL#1"),
        ("BOOL#TRUE", "BOOL#1"),
        ("REAL#1.5", "REAL#1.5"),
        ("LREAL#-2", "LREAL#-2.0"),
        ("LREAL#1.5E-3", "LREAL#0.0015"),
        ("WORD#16#1E-3", "(WORD#30 - 3)"),
        ("T#20ms", "T#20000000ns"),
        ("TIME#1h30m15.5s", "T#5415500000000ns"),
        ("T#-5ms", "T#-5000000ns"),
        ("T#1d2h3m4s5ms6us7ns", "T#93784005006007ns"),
        ("t#1.5s", "T#1500000000ns"),
        ("t#1_h_30_m", "T#5400000000000ns"),
        ("18446744073709551615", "18446744073709551615"),
        ("LINT#-9223372036854775808", "LINT#-9223372036854775808"),
        ("'it$'s$0A'", "'it$27s$0A'"),
        ("'$$$\"$L$N$P$R$T$4a'", "'$24$22$0A$0A$0C$0D$09J'"),
        ("STRING#'a'", "'a'"),
        ("true", "TRUE"),
    ];
    for (source, printed) in cases {
        assert_eq!(value(source), printed, "{source}");
    }
}

/// The integer and bit string types.
fn whole() -> impl Strategy<Value = Elementary> {
    let is_whole = |elementary: &Elementary| {
        matches!(elementary.class(), Class::BitString | Class::Signed | Class::Unsigned)
    };
    prop::sample::select(Elementary::ALL.into_iter().filter(is_whole).collect::<Vec<_>>())
}

/// The smallest and the largest value.
fn limits(elementary: Elementary) -> (i128, i128) {
    let values = 1_i128 << elementary.bits();
    if elementary.class() == Class::Signed { (-values / 2, values / 2 - 1) } else { (0, values - 1) }
}

#[test]
fn every_type_takes_its_limits_and_nothing_beyond() {
    for elementary in Elementary::ALL {
        if matches!(elementary.class(), Class::BitString | Class::Signed | Class::Unsigned) {
            let (least, most) = limits(elementary);
            for inside in [least, most] {
                assert_eq!(value(&format!("{elementary}#{inside}")), format!("{elementary}#{inside}"));
            }
            for outside in [least - 1, most + 1] {
                let message = told(&format!("x := {elementary}#{outside};"));
                assert!(message.ends_with(&format!("is out of the range of {elementary}, {least}..{most}")));
            }
        }
    }
}

proptest! {
    #[test]
    fn whole_numbers_read_as_printed(elementary in whole(), number in any::<i128>(), spaced in any::<bool>()) {
        let (least, most) = limits(elementary);
        let number = least + number.rem_euclid(most - least + 1);
        let printed = format!("{elementary}#{number}");
        let written = if spaced { printed.replace("00", "0_0") } else { printed.clone() };
        prop_assert_eq!(value(&written), printed.clone());
        if number >= 0 {
            for written in [format!("16#{number:x}"), format!("8#{number:o}"), format!("2#{number:b}")] {
                prop_assert_eq!(value(&format!("{elementary}#{written}")), printed.clone());
                prop_assert_eq!(value(&written), number.to_string());
            }
        }
    }

    #[test]
    fn real_numbers_read_as_printed(number in any::<f64>()) {
        prop_assume!(number.is_finite());
        let number = number.abs();
        prop_assert_eq!(value(&format!("{number:E}")).parse::<f64>(), Ok(number));
        let typed = value(&format!("LREAL#-{number:E}"));
        prop_assert_eq!(typed.trim_start_matches("LREAL#").parse::<f64>(), Ok(-number));
    }

    #[test]
    fn durations_read_as_the_sum_of_their_parts(nanoseconds in any::<i64>()) {
        let mut rest = nanoseconds.unsigned_abs();
        let mut written = String::from(if nanoseconds < 0 { "T#-" } else { "T#" });
        for (unit, factor) in [("d", 86_400_000_000_000), ("h", 3_600_000_000_000), ("m", 60_000_000_000),
            ("s", 1_000_000_000), ("ms", 1_000_000), ("us", 1_000), ("ns", 1)] {
            written.push_str(&format!("{}{unit}", rest / factor));
            rest %= factor;
        }
        prop_assert_eq!(value(&written), format!("T#{nanoseconds}ns"));
    }

    #[test]
    fn a_fraction_of_seconds_is_exact(seconds in 0_i64..9_000_000_000, fraction in 0_i64..1_000_000_000) {
        let nanoseconds = seconds * 1_000_000_000 + fraction;
        prop_assert_eq!(value(&format!("T#{seconds}.{fraction:09}s")), format!("T#{nanoseconds}ns"));
    }

    #[test]
    fn strings_keep_their_bytes(bytes in prop::collection::vec(any::<u8>(), 0..20)) {
        let written: String = bytes.iter().map(|byte| format!("${byte:02x}")).collect();
        let printed = value(&format!("'{written}'"));
        prop_assert_eq!(value(&printed), printed);
    }
}
