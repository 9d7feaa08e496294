//! Trying one input: its result and its cost.

use std::cell::RefCell;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;
use std::time::{Duration, Instant};

use allocation_counter::measure;

use crate::fuzzer::{Checked, Fuzzer};

/// Number of tries for a slow input: a machine that is busy with other work is not a finding.
const TRIES: usize = 3;

/// The result of an input.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Examined {
    /// The kind of the input, or the violated condition.
    pub checked: Checked,
    /// How long it took.
    pub took: Duration,
}

thread_local! {
    /// The message of the last panic of this thread.
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

/// The result of `try_it`; a panic in it is an error, and prints nothing.
pub(crate) fn without_panic<T>(try_it: impl FnOnce() -> Result<T, String>) -> Result<T, String> {
    HOOK.call_once(|| {
        panic::set_hook(Box::new(|panic| PANIC.with_borrow_mut(|said| *said = panic.to_string())));
    });
    panic::catch_unwind(AssertUnwindSafe(try_it)).unwrap_or_else(|_| Err(PANIC.take()))
}
