//! The bits of registers, from the tables of docs/reference.

use std::sync::LazyLock;

use esc::Register;
use unit_model::tables::Section;

use super::Fact;
use super::page::{self, Table};

const PAGES: &[&str] = &[
    include_str!("../../../../docs/reference/registers.md"),
    include_str!("../../../../docs/reference/frames.md"),
    include_str!("../../../../docs/reference/sync-managers-and-fmmus.md"),
    include_str!("../../../../docs/reference/distributed-clocks.md"),
];

/// The tables of bits in these pages.
static TABLES: LazyLock<Vec<Table>> = LazyLock::new(|| {
    let tables = PAGES.iter().flat_map(|page| page::sections(page)).flat_map(|section| section.tables);
    tables.filter(|table| table.header.first() == Some(&"Bit")).collect()
});

/// A section for each table of bits; none if no bit of the register has a row.
pub(super) fn sections(register: &Register) -> Vec<Section> {
    TABLES.iter().filter_map(|table| bits(register, table)).collect()
}

/// The rows of a table about the bits of this register; in a bank, of the first one.
fn bits(register: &Register, table: &Table) -> Option<Section> {
    let title = table.title?;
    let inside = offset(title)?.checked_sub(register.offset)?;
    if inside >= register.size_bytes {
        return None;
    }
    let heading = page::plain(title.split([':', ',']).next()?);
    Some(Section { heading: heading.into(), facts: table.rows.iter().filter_map(|row| bit(row)).collect() })
}

/// The first offset in a title such as `DL control 0x0100:0x0103, ECAT rw`.
fn offset(title: &str) -> Option<u16> {
    let (_, digits) = title.split_once("0x")?;
    u16::from_str_radix(digits.get(..4)?, 16).ok()
}

/// A cell after the meaning is in parentheses, such as the side that may write the bit.
fn bit(row: &[&'static str]) -> Option<Fact> {
    let (bits, cells) = row.split_first()?;
    let (meaning, others) = cells.split_first()?;
    let others =
        others.iter().filter(|cell| !cell.is_empty()).map(|cell| format!(" ({})", page::plain(cell)));
    Some(Fact::new(format!("bit {bits}"), page::plain(meaning) + &others.collect::<String>()))
}

#[cfg(test)]
mod tests {
    use esc::REGISTERS;

    use super::*;

    #[test]
    fn every_table_of_bits_has_its_register() {
        assert!(TABLES.len() >= 12, "{TABLES:?}");
        for table in TABLES.iter() {
            let registers = REGISTERS.iter().filter(|register| bits(register, table).is_some()).count();
            assert_eq!(registers, 1, "{:?}", table.title);
        }
    }
}
