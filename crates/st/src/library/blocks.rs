//! The function blocks of the prelude: other names of their pins, and their rows in the documents.

use super::prelude::COUNTER_TYPES;

/// Block, another name of a pin, the pin. Case does not count, so that `CLK` needs no row.
const PIN_ALIASES: &[(&str, &str, &str)] = &[
    ("RS", "S", "Set"),
    ("RS", "R1", "Reset1"),
    ("SR", "S1", "Set1"),
    ("SR", "R", "Reset"),
    ("CTU", "R", "Reset"),
    ("CTD", "LD", "Load"),
    ("CTUD", "R", "Reset"),
    ("CTUD", "LD", "Load"),
];

/// The pin of a block of the library that the standard or the maker calls `name`, where the prelude calls it another.
pub(crate) fn block_pin(block: &str, name: &str) -> Option<&'static str> {
    // Counters of all types have the same pins.
    let counter = COUNTER_TYPES.iter().find_map(|(ending, _)| without_ending(block, ending));
    let block = counter.unwrap_or(block);
    let row =
        PIN_ALIASES.iter().find(|row| row.0.eq_ignore_ascii_case(block) && row.1.eq_ignore_ascii_case(name));
    row.map(|row| row.2)
}

fn without_ending<'n>(name: &'n str, ending: &str) -> Option<&'n str> {
    let (family, behind) = name.split_at_checked(name.len().checked_sub(ending.len())?)?;
    (!ending.is_empty() && behind.eq_ignore_ascii_case(ending)).then_some(family)
}

/// A block for the documents.
pub(super) struct Row {
    pub(super) name: &'static str,
    pub(super) inputs: &'static str,
    pub(super) outputs: &'static str,
    pub(super) does: &'static str,
}

const fn row(name: &'static str, inputs: &'static str, outputs: &'static str, does: &'static str) -> Row {
    Row { name, inputs, outputs, does }
}

macro_rules! up {
    ($name:literal, $type:literal) => {
        row(
            $name,
            concat!("CU: BOOL, Reset (R): BOOL, PV: ", $type),
            concat!("Q: BOOL, CV: ", $type),
            "counts up to PV at the rising edge of CU, and stops there; Q from PV on",
        )
    };
}

macro_rules! down {
    ($name:literal, $type:literal) => {
        row(
            $name,
            concat!("CD: BOOL, Load (LD): BOOL, PV: ", $type),
            concat!("Q: BOOL, CV: ", $type),
            "counts down to 0 at the rising edge of CD, and stops there; Q from 0 down",
        )
    };
}

macro_rules! both_ways {
    ($name:literal, $type:literal) => {
        row(
            $name,
            concat!("CU: BOOL, CD: BOOL, Reset (R): BOOL, Load (LD): BOOL, PV: ", $type),
            concat!("QU: BOOL, QD: BOOL, CV: ", $type),
            "counts up to PV and down to 0; Reset before Load before the edges; both edges in one call leave CV as it is",
        )
    };
}

#[rustfmt::skip]
pub(super) const BLOCKS: &[Row] = &[
    row("R_TRIG", "Clk: BOOL", "Q: BOOL", "TRUE for one call when Clk becomes TRUE, also at the first call"),
    row("F_TRIG", "Clk: BOOL", "Q: BOOL", "TRUE for one call when Clk becomes FALSE"),
    row("RS", "Set (S): BOOL, Reset1 (R1): BOOL", "Q1: BOOL", "keeps what was set; Reset1 wins"),
    row("SR", "Set1 (S1): BOOL, Reset (R): BOOL", "Q1: BOOL", "keeps what was set; Set1 wins"),
    up!("CTU", "INT"), down!("CTD", "INT"), both_ways!("CTUD", "INT"),
    up!("CTU_DINT", "DINT"), down!("CTD_DINT", "DINT"), both_ways!("CTUD_DINT", "DINT"),
    up!("CTU_LINT", "LINT"), down!("CTD_LINT", "LINT"), both_ways!("CTUD_LINT", "LINT"),
    up!("CTU_UDINT", "UDINT"), down!("CTD_UDINT", "UDINT"), both_ways!("CTUD_UDINT", "UDINT"),
    up!("CTU_ULINT", "ULINT"), down!("CTD_ULINT", "ULINT"), both_ways!("CTUD_ULINT", "ULINT"),
    row("TON", "In: BOOL, PT: TIME", "Q: BOOL, ET: TIME", "Q when In has been TRUE for PT"),
    row("TOF", "In: BOOL, PT: TIME", "Q: BOOL, ET: TIME", "Q until In has been FALSE for PT"),
    row("TP", "In: BOOL, PT: TIME", "Q: BOOL, ET: TIME", "Q for PT from the rising edge of In on, whatever In does then"),
    row("AccumulationTimer", "In: BOOL, PT: TIME, Reset: BOOL", "Q: BOOL, ET: TIME",
        "Q when In has been TRUE for PT in all since Reset; Reset wins"),
    row("NX_ReadObj", "Execute: BOOL, UnitProxy: _sNXUNIT_ID, Obj: _sNXOBJ_ACCESS, TimeOut: UINT, ReadDat: a variable",
        "Done: BOOL, Busy: BOOL, Error: BOOL, ErrorID: WORD, ErrorIDEx: DWORD",
        "reads an NX object at the rising edge of Execute; TimeOut in 0.1 s, 0 is 2.0 s"),
    row("ResetNXBError", "Execute: BOOL", "Done: BOOL, Busy: BOOL, Error: BOOL, ErrorID: WORD",
        "resets the errors of the NX Bus Function Module, and with them those of the unit, at the rising edge of Execute"),
    row("NX_WriteObj", "Execute: BOOL, UnitProxy: _sNXUNIT_ID, Obj: _sNXOBJ_ACCESS, TimeOut: UINT, WriteDat: a variable",
        "Done: BOOL, Busy: BOOL, Error: BOOL, ErrorID: WORD, ErrorIDEx: DWORD",
        "writes an NX object at the rising edge of Execute; TimeOut in 0.1 s, 0 is 2.0 s"),
];
