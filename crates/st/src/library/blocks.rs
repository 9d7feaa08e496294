//! The function blocks of the prelude: other names of their pins, and their rows in the documents.

use super::prelude::COUNTER_TYPES;

/// Block, another name of a pin, the pin. Upper and lower case are equal, so `CLK` needs no row.
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

/// The pin of a library block that the standard or the manufacturer calls `name`, if the prelude uses another name.
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
            "counts up at each rising edge of CU, to PV at most; Q is TRUE at PV or above",
        )
    };
}

macro_rules! down {
    ($name:literal, $type:literal) => {
        row(
            $name,
            concat!("CD: BOOL, Load (LD): BOOL, PV: ", $type),
            concat!("Q: BOOL, CV: ", $type),
            "counts down at each rising edge of CD, to 0 at least; Q is TRUE at 0 or below",
        )
    };
}

macro_rules! both_ways {
    ($name:literal, $type:literal) => {
        row(
            $name,
            concat!("CU: BOOL, CD: BOOL, Reset (R): BOOL, Load (LD): BOOL, PV: ", $type),
            concat!("QU: BOOL, QD: BOOL, CV: ", $type),
            "counts up to PV and down to 0; Reset has priority over Load, and Load over the edges; both edges in one call do not change CV",
        )
    };
}

#[rustfmt::skip]
pub(super) const BLOCKS: &[Row] = &[
    row("R_TRIG", "Clk: BOOL", "Q: BOOL", "TRUE for one call when Clk becomes TRUE, also at the first call"),
    row("F_TRIG", "Clk: BOOL", "Q: BOOL", "TRUE for one call when Clk becomes FALSE"),
    row("RS", "Set (S): BOOL, Reset1 (R1): BOOL", "Q1: BOOL", "stays TRUE after Set until Reset1; Reset1 has priority"),
    row("SR", "Set1 (S1): BOOL, Reset (R): BOOL", "Q1: BOOL", "stays TRUE after Set1 until Reset; Set1 has priority"),
    up!("CTU", "INT"), down!("CTD", "INT"), both_ways!("CTUD", "INT"),
    up!("CTU_DINT", "DINT"), down!("CTD_DINT", "DINT"), both_ways!("CTUD_DINT", "DINT"),
    up!("CTU_LINT", "LINT"), down!("CTD_LINT", "LINT"), both_ways!("CTUD_LINT", "LINT"),
    up!("CTU_UDINT", "UDINT"), down!("CTD_UDINT", "UDINT"), both_ways!("CTUD_UDINT", "UDINT"),
    up!("CTU_ULINT", "ULINT"), down!("CTD_ULINT", "ULINT"), both_ways!("CTUD_ULINT", "ULINT"),
    row("TON", "In: BOOL, PT: TIME", "Q: BOOL, ET: TIME", "Q is TRUE when In has been TRUE for PT"),
    row("TOF", "In: BOOL, PT: TIME", "Q: BOOL, ET: TIME", "Q is TRUE from In until In has been FALSE for PT"),
    row("TP", "In: BOOL, PT: TIME", "Q: BOOL, ET: TIME", "Q is TRUE for PT from the rising edge of In, independent of In afterwards"),
    row("AccumulationTimer", "In: BOOL, PT: TIME, Reset: BOOL", "Q: BOOL, ET: TIME",
        "Q is TRUE when In has been TRUE for PT in total since Reset; Reset has priority"),
    row("NX_ReadObj", "Execute: BOOL, UnitProxy: _sNXUNIT_ID, Obj: _sNXOBJ_ACCESS, TimeOut: UINT, ReadDat: a variable",
        "Done: BOOL, Busy: BOOL, Error: BOOL, ErrorID: WORD, ErrorIDEx: DWORD",
        "reads an NX object at the rising edge of Execute; TimeOut in 0.1 s, 0 is 2.0 s"),
    row("ResetNXBError", "Execute: BOOL", "Done: BOOL, Busy: BOOL, Error: BOOL, ErrorID: WORD",
        "resets the errors of the NX Bus Function Module, and the errors of the unit, at the rising edge of Execute"),
    row("NX_WriteObj", "Execute: BOOL, UnitProxy: _sNXUNIT_ID, Obj: _sNXOBJ_ACCESS, TimeOut: UINT, WriteDat: a variable",
        "Done: BOOL, Busy: BOOL, Error: BOOL, ErrorID: WORD, ErrorIDEx: DWORD",
        "writes an NX object at the rising edge of Execute; TimeOut in 0.1 s, 0 is 2.0 s"),
];
