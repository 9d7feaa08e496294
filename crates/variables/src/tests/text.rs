//! Values as text.

use iec_types::Elementary;
use proptest::prelude::*;

use crate::*;

const UINTS: VariableType = VariableType::array(Elementary::Uint, 3);

fn single(elementary: Elementary, text: &str) -> Result<Vec<u8>, String> {
    VariableType::single(elementary).parse(text).map_err(|error| error.to_string())
}

#[test]
fn values_are_written_as_in_structured_text() {
    assert_eq!(single(Elementary::Bool, " true "), Ok(vec![1]));
    assert_eq!(single(Elementary::Bool, "BOOL#0"), Ok(vec![0]));
    assert_eq!(single(Elementary::Word, "16#1234"), Ok(vec![0x34, 0x12]));
    assert_eq!(single(Elementary::Word, "WORD#16#12_34"), Ok(vec![0x34, 0x12]));
    assert_eq!(single(Elementary::Byte, "2#1010"), Ok(vec![0x0A]));
    assert_eq!(single(Elementary::Uint, "uint#8#17"), Ok(vec![0x0F, 0]));
    assert_eq!(single(Elementary::Udint, "0xDEADBEEF"), Ok(0xDEAD_BEEF_u32.to_le_bytes().to_vec()));
    assert_eq!(single(Elementary::Int, "-2"), Ok(vec![0xFE, 0xFF]));
    assert_eq!(single(Elementary::Lreal, "1.5E3"), Ok(1500_f64.to_le_bytes().to_vec()));
    assert_eq!(single(Elementary::Time, "T#-1.5ms"), Ok((-1_500_000_i64).to_le_bytes().to_vec()));
    assert_eq!(UINTS.parse("[1, 2(16#FF)]"), Ok(vec![1, 0, 0xFF, 0, 0xFF, 0]));
}

#[test]
fn what_is_wrong_is_told_with_its_place_and_limits() {
    let uint = |text: &str| single(Elementary::Uint, text).expect_err("wrong");
    assert_eq!(uint("65536"), "column 1: out of range of UINT: 0 to 65535");
    assert_eq!(uint(" -1"), "column 2: out of range of UINT: 0 to 65535");
    assert_eq!(uint("INT#5"), "column 1: not of the type UINT");
    for text in ["", "_1", "1_", "1__2", "16#", "16#G", "2#2", "1.5", "--1", "+-1", "8#+7", "x", "5 6", "ä"]
    {
        assert_eq!(uint(text), "column 1: not a number such as 12, -3 or 16#1F", "{text}");
    }
    assert_eq!(single(Elementary::Bool, "2"), Err("column 1: not TRUE or FALSE".into()));
    assert_eq!(single(Elementary::Time, "5"), Err("column 1: not a duration such as T#1.5ms".into()));
    assert_eq!(single(Elementary::Sint, "128"), Err("column 1: out of range of SINT: -128 to 127".into()));
    let list = |text: &str| UINTS.parse(text).expect_err("wrong").to_string();
    assert_eq!(
        list("1, 2, 3"),
        "column 1: not a list of 3 elements in square brackets, such as [1, 2, 3(0)]"
    );
    assert_eq!(list("[1, 2]"), "column 1: 2 elements for an array of 3");
    assert_eq!(list("[1, 2, 3, 4]"), "column 11: 4 elements for an array of 3");
    assert_eq!(list("[65535(0)]"), "column 2: 65535 elements for an array of 3");
    assert_eq!(list("[1, x, 3]"), "column 5: not a number such as 12, -3 or 16#1F");
    assert_eq!(list("[1, x(0)]"), "column 5: not a number such as 12, -3 or 16#1F");
    assert_eq!(list("[1, 2(70000)]"), "column 7: out of range of UINT: 0 to 65535");
}

proptest! {
    #[test]
    fn what_is_shown_is_read_again(at in 0..16usize, elements in prop::option::of(1..4u16), fill: [u8; 32]) {
        let elementary = Elementary::ALL[at];
        let variable_type = VariableType { elementary, elements };
        let mut value = fill[..variable_type.size_bytes()].to_vec();
        match elementary {
            Elementary::Bool => value.iter_mut().for_each(|byte| *byte &= 1),
            // A NaN has many bit patterns and one text; the minimum TIME has no positive counterpart.
            Elementary::Real | Elementary::Lreal | Elementary::Time => {
                value.chunks_mut(elementary.size_bytes()).for_each(|bytes| bytes[bytes.len() - 1] &= 0x3F);
            }
            _ => {}
        }
        let text = variable_type.show(&value).to_string();
        prop_assert_eq!(variable_type.parse(&text), Ok(value), "{}", text);
    }

    #[test]
    fn no_text_is_a_panic(text in "\\PC{0,20}", words in "[\\[\\]()#_,T0-9 -]{0,20}", at in 0..16usize) {
        for elements in [None, Some(3)] {
            let variable_type = VariableType { elementary: Elementary::ALL[at], elements };
            for text in [&text, &words] {
                if let Ok(value) = variable_type.parse(text) {
                    prop_assert_eq!(value.len(), variable_type.size_bytes());
                }
            }
        }
    }
}
