//! Numbers of runs and threads, from 1, and the time of a search, above 0.

use std::num::{NonZeroU64, NonZeroUsize};
use std::str::FromStr;

use time::Duration;

/// The number of runs of a search.
pub(super) fn runs(text: &str) -> Result<NonZeroU64, String> {
    from_one(text, "runs", "1000")
}

/// The number of threads of a replay.
pub(super) fn jobs(text: &str) -> Result<NonZeroUsize, String> {
    from_one(text, "threads", "4; without --jobs it is as many as the machine runs at once")
}

/// The time after which a search ends.
pub(super) fn budget(text: &str) -> Result<Duration, String> {
    match text.parse::<Duration>() {
        Ok(budget) if budget.is_zero() => {
            Err("a search without time finds nothing: expected a time above 0, such as 600s".to_owned())
        }
        budget => budget.map_err(|error| error.to_string()),
    }
}

fn from_one<N: FromStr>(text: &str, what: &str, example: &str) -> Result<N, String> {
    text.parse()
        .map_err(|_| format!("{text:?} is not a number of {what}: expected 1 or more, such as {example}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_search_has_time() {
        assert_eq!(budget("600s"), Ok(Duration::from_secs(600)));
        for wrong in ["0s", "0ms", "-1s", "10", ""] {
            assert!(budget(wrong).is_err_and(|message| message.contains("such as")), "{wrong}");
        }
    }

    #[test]
    fn a_number_begins_at_1() {
        assert_eq!((runs("1").map(NonZeroU64::get), jobs("64").map(NonZeroUsize::get)), (Ok(1), Ok(64)));
        for wrong in ["0", "-1", "", "many", "99999999999999999999"] {
            let (runs, jobs) = (runs(wrong).expect_err("refused"), jobs(wrong).expect_err("refused"));
            let value = format!("{wrong:?} is not a number of ");
            assert!(runs.contains(&format!("{value}runs: expected 1 or more, such as 1000")), "{runs}");
            assert!(jobs.contains(&format!("{value}threads: expected 1 or more, such as 4")), "{jobs}");
        }
    }
}
