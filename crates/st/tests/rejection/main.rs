//! Programs that are wrong, too large or too deep: each gets its problems, and none exceeds the limits of the
//! compiler or of the thread that runs it.

#![expect(clippy::expect_used, reason = "a panic here is a failed test")]

mod deep;
mod files;
mod large;
mod mutations;

/// The stack of a thread that compiles and runs programs.
const STACK_BYTES: usize = 1 << 20;

/// Runs in a thread with such a stack: an overflow ends the whole test.
fn on_a_small_stack<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> T {
    let thread = std::thread::Builder::new().stack_size(STACK_BYTES).spawn(work).expect("a thread");
    match thread.join() {
        Ok(result) => result,
        Err(panic) => std::panic::resume_unwind(panic),
    }
}

/// The problems of a source that has some, each with a position in it.
fn problems(name: &str, source: &str) -> String {
    let (name, source) = (name.to_owned(), source.to_owned());
    on_a_small_stack(move || {
        let problems = st::compile(&source, &[]).err().unwrap_or_else(|| panic!("{name} is accepted"));
        assert!(!problems.list().is_empty(), "{name} has no problem");
        for problem in problems.list() {
            let range = problem.span.range();
            assert!(
                source.get(range).is_some(),
                "{name}: {problem:?} lies outside of {} bytes",
                source.len()
            );
            assert!(
                !problem.message.is_empty() && problem.message.len() < 400,
                "{name}: {}",
                problem.message
            );
        }
        problems.to_string()
    })
}
