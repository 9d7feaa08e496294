//! Texts, compared with Rust's own strings.

use proptest::prelude::*;

use super::bench::Bench;
use crate::elementary::Elementary;
use crate::fault::Fault;

/// Calls a function with texts first and numbers after them.
fn call(name: &str, texts: &[&str], numbers: &[u64]) -> (Bench, Result<u64, Fault>) {
    let mut bench = Bench::new();
    let mut arguments: Vec<_> =
        texts.iter().enumerate().map(|(place, text)| bench.text(place as u32, text.as_bytes())).collect();
    arguments.extend(numbers);
    let result = bench.call(name, Elementary::Bool, &arguments);
    (bench, result)
}

fn text(name: &str, texts: &[&str], numbers: &[usize]) -> Result<String, Fault> {
    let numbers: Vec<_> = numbers.iter().map(|number| *number as u64).collect();
    let (bench, result) = call(name, texts, &numbers);
    bench.given(result).map(|text| String::from_utf8(text).unwrap())
}

fn number(name: &str, texts: &[&str]) -> Result<u64, Fault> {
    call(name, texts, &[]).1
}

proptest! {
    #[test]
    fn parts_of_a_text(input in "[ -~]{0,40}", length in 0..50_usize, position in 1..50_usize) {
        let characters: Vec<_> = input.chars().collect();
        let count = characters.len();
        let joined = |part: &mut dyn Iterator<Item = &char>| Ok(part.collect::<String>());
        prop_assert_eq!(number("LEN", &[&input]), Ok(count as u64));
        prop_assert_eq!(text("LEFT", &[&input], &[length]), joined(&mut characters.iter().take(length)));
        prop_assert_eq!(text("RIGHT", &[&input], &[length]), joined(&mut characters.iter().skip(count.saturating_sub(length))));
        prop_assert_eq!(text("MID", &[&input], &[length, position]), joined(&mut characters.iter().skip(position - 1).take(length)));
        let kept = characters.iter().take(position - 1).chain(characters.iter().skip(position - 1 + length));
        prop_assert_eq!(text("DELETE", &[&input], &[length, position]), joined(&mut kept.into_iter()));
    }

    #[test]
    fn two_texts(first in "[ab]{0,12}", second in "[ab]{0,3}", length in 0..15_usize, position in 1..15_usize) {
        prop_assert_eq!(text("CONCAT", &[&first, &second, &first], &[]), Ok(format!("{first}{second}{first}")));
        let found = first.find(&second).filter(|_| !second.is_empty());
        prop_assert_eq!(number("FIND", &[&first, &second]), Ok(found.map_or(0, |place| place as u64 + 1)));

        let mut inserted = first.clone();
        inserted.insert_str(position.min(first.len()), &second);
        prop_assert_eq!(text("INSERT", &[&first, &second], &[position]), Ok(inserted));

        let start = first.len().min(position - 1);
        let mut replaced = first.clone();
        replaced.replace_range(start..first.len().min(start + length), &second);
        prop_assert_eq!(text("REPLACE", &[&first, &second], &[length, position]), Ok(replaced));

        prop_assert_eq!(number("EQascii", &[&first, &second]), Ok((first == second).into()));
        prop_assert_eq!(number("NEascii", &[&first, &second]), Ok((first != second).into()));
        prop_assert_eq!(number("LTascii", &[&first, &second]), Ok((first < second).into()));
        prop_assert_eq!(number("LEascii", &[&first, &second]), Ok((first <= second).into()));
        prop_assert_eq!(number("GTascii", &[&first, &second]), Ok((first > second).into()));
        prop_assert_eq!(number("GEascii", &[&first, &second]), Ok((first >= second).into()));
    }
}

#[test]
fn letters_and_blanks() {
    assert_eq!(text("ToUCase", &["aZ9 ~"], &[]).unwrap(), "AZ9 ~");
    assert_eq!(text("ToLCase", &["aZ9 ~"], &[]).unwrap(), "az9 ~");
    assert_eq!(text("TrimL", &["  a b  "], &[]).unwrap(), "a b  ");
    assert_eq!(text("TrimR", &["  a b  "], &[]).unwrap(), "  a b");
    assert_eq!(text("TrimR", &["   "], &[]).unwrap(), "");
}

#[test]
fn the_place_before_the_first_character_is_for_insert_alone() {
    assert_eq!(text("INSERT", &["bc", "a"], &[0]).unwrap(), "abc");
    let fault = Err(Fault::ArgumentOutOfRange { value: 0, lower: 1, upper: 1985 });
    assert_eq!(text("MID", &["bc"], &[1, 0]), fault);
    assert_eq!(text("DELETE", &["bc"], &[1, 0]), fault);
    assert_eq!(text("REPLACE", &["bc", "a"], &[1, 0]), fault);
}

#[test]
fn a_negative_length_is_a_fault() {
    let fault = Err(Fault::ArgumentOutOfRange { value: -3, lower: 0, upper: 1985 });
    for (name, numbers) in
        [("LEFT", vec![-3]), ("RIGHT", vec![-3]), ("MID", vec![-3, 1]), ("DELETE", vec![-3, 1])]
    {
        let numbers: Vec<_> = numbers.into_iter().map(|number: i64| number as u64).collect();
        assert_eq!(call(name, &["abc"], &numbers).1, fault, "{name}");
    }
}

#[test]
fn a_text_that_no_string_holds_is_a_fault() {
    let (long, rest) = ("x".repeat(1500), "y".repeat(485));
    assert_eq!(text("CONCAT", &[&long, &rest], &[]).map(|text| text.len()), Ok(1985));
    let fault = |characters| Err(Fault::TextTooLong { characters, capacity: 1985 });
    assert_eq!(text("CONCAT", &[&long, &rest, "z"], &[]), fault(1986));
    assert_eq!(text("INSERT", &[&long, &long], &[7]), fault(3000));
    assert_eq!(text("REPLACE", &[&long, &long], &[10, 7]), fault(2990));
}

#[test]
fn long_texts_cost_budget() {
    let mut bench = Bench::new();
    bench.budget = 10;
    let (text, piece) = (bench.text(0, &[b'a'; 1900]), bench.text(1, &[b'a'; 900]));
    assert_eq!(bench.call("FIND", Elementary::Bool, &[text, piece]), Err(Fault::BudgetUsedUp));
}
