//! The programs of docs/user/wasm-programs.md do what the page says.

use crate::bench::Bench;

const PAGE: &str = include_str!("../../../../docs/user/wasm-programs.md");

/// The block of the page with this file name.
pub(crate) fn block(file_name: &str) -> &'static str {
    let begun =
        PAGE.split_once(&format!("```text {file_name}\n")).and_then(|(_, rest)| rest.split_once("```"));
    begun.map_or_else(|| panic!("the page has no {file_name}"), |(block, _)| block)
}

#[test]
fn the_copy_program_copies_as_long_as_the_data_can_be_used() {
    let mut bench = Bench::with(block("copy.wat"));
    let sent = core::array::from_fn(|element| 1_000 + element as u16);
    bench.give(sent, false);
    bench.cycles(2);
    assert_eq!(bench.outputs(), [0; 15], "not valid");
    bench.give(sent, true);
    bench.cycles(2);
    assert_eq!(bench.outputs(), sent);
    bench.give([7; 15], false);
    bench.cycles(2);
    assert_eq!(bench.outputs(), sent, "the values stay");
    assert_eq!(bench.errors(), Vec::<String>::new());
}
