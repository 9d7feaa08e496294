//! Panics of what a replay runs: a model, a program, the runner itself. Each ends its own case only.

use core::cell::RefCell;
use core::fmt;
use std::panic::{AssertUnwindSafe, PanicHookInfo, catch_unwind, set_hook, take_hook};
use std::sync::Once;

/// A panic that was caught.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Panicked {
    /// Its message.
    pub(crate) message: String,
    /// The place in the source code, `FILE:LINE:COLUMN`.
    pub(crate) place: String,
}

impl fmt::Display for Panicked {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "panicked at {}: {}", self.place, self.message)
    }
}

/// The panics of this thread while [`caught`] runs.
#[derive(Default)]
struct Watch {
    /// Number of calls of [`caught`] that are running.
    depth: usize,
    /// The first panic since the outermost of them has begun: a further one is a consequence.
    first: Option<Panicked>,
}

thread_local! {
    static WATCH: RefCell<Watch> = RefCell::default();
}

/// Runs `action`, and returns its panic if it has one. The panic is not printed. Panics of other threads, and those outside
/// of this call, go to the hook of the process as before. The caller must not use values whose invariants the panic may
/// have broken, except to read and to drop them.
pub(crate) fn caught<T>(action: impl FnOnce() -> T) -> Result<T, Panicked> {
    install_hook();
    WATCH.with_borrow_mut(|watch| {
        watch.depth += 1;
        watch.first = None;
    });
    let result = catch_unwind(AssertUnwindSafe(action));
    let first = WATCH.with_borrow_mut(|watch| {
        watch.depth -= 1;
        watch.first.take()
    });
    result.map_err(|payload| first.unwrap_or_else(|| unseen(payload.as_ref())))
}

/// Only the hook of the process knows the place of a panic. It is set once and asks each thread whether it watches.
fn install_hook() {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let of_process = take_hook();
        set_hook(Box::new(move |info| {
            if !note(info) {
                of_process(info);
            }
        }));
    });
}

/// Keeps a panic of a thread that watches. False if it does not.
fn note(info: &PanicHookInfo<'_>) -> bool {
    let note = |watch: &mut Watch| {
        if watch.depth > 0 {
            watch.first.get_or_insert_with(|| Panicked {
                message: message(info.payload()),
                place: info.location().map_or_else(|| UNKNOWN.to_owned(), ToString::to_string),
            });
        }
        watch.depth > 0
    };
    // The thread may be ending, without its values.
    WATCH.try_with(|watch| watch.try_borrow_mut().is_ok_and(|mut watch| note(&mut watch))).unwrap_or_default()
}

const UNKNOWN: &str = "an unknown place";

/// A panic that has not called our hook: another one has replaced it.
fn unseen(payload: &(dyn core::any::Any + Send)) -> Panicked {
    Panicked { message: message(payload), place: UNKNOWN.to_owned() }
}

fn message(payload: &(dyn core::any::Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().copied();
    let text = text.or_else(|| payload.downcast_ref::<String>().map(String::as_str));
    text.unwrap_or("without a message").to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_has_its_message_and_its_place() {
        let line = line!() + 1;
        let panicked = caught(|| -> () { panic!("a buffer of {} bytes", 7) }).unwrap_err();
        assert_eq!(panicked.message, "a buffer of 7 bytes");
        let of_line = format!("caught.rs:{line}:");
        assert!(panicked.place.contains(&of_line), "{}", panicked.place);
        assert_eq!(caught(|| 5), Ok(5));
    }

    #[test]
    fn the_panics_of_two_threads_do_not_mix() {
        let panic_of =
            |name: &'static str| move || caught(|| -> () { panic!("{name}") }).unwrap_err().message;
        std::thread::scope(|scope| {
            for _ in 0..50 {
                let (one, other) = (scope.spawn(panic_of("one")), scope.spawn(panic_of("other")));
                assert_eq!((one.join().unwrap(), other.join().unwrap()), ("one".into(), "other".into()));
            }
        });
    }

    #[test]
    fn outside_of_it_a_panic_is_the_one_of_the_process() {
        let _ = caught(|| ());
        assert!(!WATCH.with_borrow(|watch| watch.depth > 0));
        let inner = caught(|| {
            let _ = caught(|| -> () { panic!("inner") });
            panic!("outer")
        });
        assert_eq!(inner.map(|(): ()| ()).unwrap_err().message, "outer");
    }
}
