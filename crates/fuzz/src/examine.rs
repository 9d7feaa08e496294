//! Trying one input: what it came to, with what it took.

use std::cell::RefCell;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;
use std::time::{Duration, Instant};

use allocation_counter::measure;

use crate::fuzzer::{Checked, Fuzzer};

/// How often a slow input is tried: a machine that is busy elsewhere is no finding.
const TRIES: usize = 3;

/// What an input came to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Examined {
    /// What it is, or what did not hold.
    pub checked: Checked,
    /// How long it took.
    pub took: Duration,
}

thread_local! {
    /// What the last panic of this thread said.
    static PANIC: RefCell<String> = const { RefCell::new(String::new()) };
}

static HOOK: Once = Once::new();

/// Tries an input. A panic, too long a time and too much memory are findings.
pub fn examine(fuzzer: &Fuzzer, input: &[u8]) -> Examined {
    let limit = fuzzer.limits.time(input.len());
    let mut examined = once(fuzzer, input);
    for _ in 1..TRIES {
        if examined.took <= limit {
            break;
        }
        let again = once(fuzzer, input);
        examined.took = examined.took.min(again.took);
    }
    if examined.checked.is_ok() && examined.took > limit {
        examined.checked = Err(format!(
            "{} bytes take {} ms, {} are allowed",
            input.len(),
            examined.took.as_millis(),
            limit.as_millis()
        ));
    }
    examined
}

fn once(fuzzer: &Fuzzer, input: &[u8]) -> Examined {
    let mut checked = Ok("");
    let begin = Instant::now();
    let memory = measure(|| checked = without_panic(|| (fuzzer.check)(input)));
    let took = begin.elapsed();
    let allowed = fuzzer.limits.memory_bytes(input.len());
    if checked.is_ok() && memory.bytes_max > allowed {
        checked = Err(format!(
            "{} bytes take {} KiB of memory, {} are allowed",
            input.len(),
            memory.bytes_max / 1024,
            allowed / 1024
        ));
    }
    Examined { checked, took }
}

/// What `try_it` says; a panic in it is an error, and prints nothing.
pub(crate) fn without_panic<T>(try_it: impl FnOnce() -> Result<T, String>) -> Result<T, String> {
    HOOK.call_once(|| {
        panic::set_hook(Box::new(|panic| PANIC.with_borrow_mut(|said| *said = panic.to_string())));
    });
    panic::catch_unwind(AssertUnwindSafe(try_it)).unwrap_or_else(|_| Err(PANIC.take()))
}
