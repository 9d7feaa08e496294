//! Whether output may be coloured.

use std::io::{self, IsTerminal};

/// Whether messages may be coloured: they go to a terminal, and colours are not switched off.
pub(crate) fn colour_on_stderr() -> bool {
    io::stderr().is_terminal() && is_wanted()
}

/// Whether results may be coloured: they go to a terminal, and colours are not switched off.
pub(crate) fn colour_on_stdout() -> bool {
    io::stdout().is_terminal() && is_wanted()
}

fn is_wanted() -> bool {
    std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
}
