//! Values as texts and back.

use proptest::prelude::*;

use crate::calendar::{last, part};
use crate::elementary::Elementary::{self, *};
use crate::library::value_text::read;
use crate::library::{text_of, value_of};
use crate::value::{range, real, real_bits, wrap};

#[test]
fn texts_of_values() {
    let rows = [
        (Bool, 1, "TRUE"),
        (Bool, 0, "FALSE"),
        (Byte, 0x0F, "0F"),
        (Word, 0xFF, "00FF"),
        (Dword, 0xABCD, "0000ABCD"),
        (Lword, u64::MAX, "FFFFFFFFFFFFFFFF"),
        (Int, -5_i64 as u64, "-5"),
        (Ulint, u64::MAX, "18446744073709551615"),
        (Real, u64::from(0.1_f32.to_bits()), "0.1"),
        (Lreal, (-1.5e300_f64).to_bits(), "-1.5e300"),
        (Lreal, f64::INFINITY.to_bits(), "inf"),
        (Lreal, f64::NAN.to_bits(), "NaN"),
        (Time, 0, "T#0s"),
        (Time, 1_500_000_000, "T#1s500ms"),
        (Time, -93_600_000_000_000_i64 as u64, "T#-1d2h"),
        (Time, i64::MIN as u64, "T#-106751d23h47m16s854ms775us808ns"),
    ];
    for (elementary, bits, text) in rows {
        assert_eq!(text_of(elementary, bits), text, "{elementary}");
    }
}

#[test]
fn texts_that_are_no_value_of_their_type() {
    let rows = [
        (Bool, "1"),
        (Byte, "100"),
        (Byte, "+F"),
        (Word, ""),
        (Word, "16#FF"),
        (Sint, "128"),
        (Usint, "-1"),
        (Int, "1.0"),
        (Int, "1_000"),
        (Int, ""),
        (Real, "1e39"),
        (Lreal, "1e999"),
        (Lreal, "one"),
        (Time, "1s"),
        (Time, "T#"),
        (Time, "T#1"),
        (Time, "T#1ms1s"),
        (Time, "T#1s1s"),
        (Time, "T#1s-5ms"),
        (Time, "T#9223372037s"),
        (Time, "T#99999999999999999999d"),
    ];
    for (elementary, text) in rows {
        assert_eq!(read(elementary, text), None, "{text} as {elementary}");
    }
}

#[test]
fn a_person_writes_bit_strings_in_decimal_or_behind_16() {
    assert_eq!(value_of(Word, " 255 "), Some(255));
    assert_eq!(value_of(Word, "16#ff"), Some(255));
    assert_eq!(value_of(Word, "65536"), None);
    assert_eq!(value_of(Bool, "true"), Some(1));
    assert_eq!(value_of(Time, "time#2M"), Some(120_000_000_000));
}

proptest! {
    #[test]
    fn a_value_comes_back(elementary in prop::sample::select(Elementary::ALL.to_vec()), bits in any::<u64>()) {
        let bits = match elementary {
            Real | Lreal => real_bits(elementary, real(elementary, bits)),
            Date | TimeOfDay | DateAndTime => part(elementary, bits % (last(DateAndTime) + 1)),
            _ => wrap(elementary, bits),
        };
        let back = read(elementary, &text_of(elementary, bits));
        if matches!(elementary, Real | Lreal) && real(elementary, bits).is_nan() {
            prop_assert!(back.is_some_and(|back| real(elementary, back).is_nan()));
        } else {
            prop_assert_eq!(back, Some(bits));
        }
    }

    #[test]
    fn an_integer_is_read_if_its_type_holds_it(
        elementary in prop::sample::select(vec![Sint, Int, Dint, Lint, Usint, Uint, Udint, Ulint]),
        beyond in -3..=3_i128,
        upper in any::<bool>(),
    ) {
        let (least, greatest) = range(elementary);
        let number = beyond + if upper { greatest } else { least };
        let expected = (least..=greatest).contains(&number).then_some(number as u64);
        prop_assert_eq!(read(elementary, &number.to_string()), expected);
    }

    #[test]
    fn whatever_is_written_does_no_harm(
        elementary in prop::sample::select(Elementary::ALL.to_vec()),
        text in "(T#)?[-+0-9a-zA-Z#._ ]{0,30}",
    ) {
        for bits in [read(elementary, &text), value_of(elementary, &text)].into_iter().flatten() {
            prop_assert!(matches!(elementary, Real | Lreal) || bits == wrap(elementary, bits));
        }
    }
}
