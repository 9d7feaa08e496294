//! Whether what is printed may have colour.

use std::io::{self, IsTerminal};

/// Whether messages may have colour: someone looks at them, and has not asked for none.
pub(crate) fn colour_on_stderr() -> bool {
    io::stderr().is_terminal() && is_wanted()
}

/// Whether results may have colour: someone looks at them, and has not asked for none.
pub(crate) fn colour_on_stdout() -> bool {
    io::stdout().is_terminal() && is_wanted()
}

fn is_wanted() -> bool {
    std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
}
