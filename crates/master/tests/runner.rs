//! The runner of dialogues: when the next access is due, which answers count, and when a dialogue is given up.

use master::{
    Answer, Habits, Pace, Progress, RegisterRead, RegisterWrite, Runner, StateRequest, TimeOuts, Wait,
};
use time::{Duration, Instant};
use wire::AlState;

const TAKEN: Answer<'static> = Answer { working_counter: 1, data: &[0; 6] };
const NOT_TAKEN: Answer<'static> = Answer { working_counter: 0, data: &[0; 6] };

fn at(millis: u64) -> Instant {
    Instant::ZERO + Duration::from_millis(millis)
}

/// A request of OP begins at 0 s and is taken at 8 s; then the state is polled. Whether it is given up at this time.
fn is_given_up_at(millis: u64, time_outs: TimeOuts) -> bool {
    let habits = Habits { time_outs, ..Habits::default() };
    let (mut runner, mut request) = (Runner::new(), StateRequest::new(AlState::Op, Wait::SafeOpOp));
    runner.begin(&request, &Pace::new(at(0), &habits));
    let number = runner.depart();
    let progress = runner.answer(number, &mut request, Some(TAKEN), &Pace::new(at(8_000), &habits));
    assert_eq!(progress, Some(Progress::NextStage));
    runner.is_too_late(at(millis))
}

#[test]
fn a_time_out_is_restarted_at_each_stage_or_fixed_for_the_whole_dialogue() {
    // From SAFE-OP to OP a slave usually has 9 s.
    assert!(!is_given_up_at(16_999, TimeOuts::default()));
    assert!(is_given_up_at(17_000, TimeOuts::default()));
    let whole = TimeOuts::WholeDialogue { state: Duration::from_secs(10), other: Duration::from_secs(5) };
    assert!(!is_given_up_at(9_999, whole));
    assert!(is_given_up_at(10_000, whole));
}

#[test]
fn a_dialogue_that_is_not_a_state_has_the_other_time_out() {
    let whole = TimeOuts::WholeDialogue { state: Duration::from_secs(10), other: Duration::from_secs(5) };
    let habits = Habits { time_outs: whole, ..Habits::default() };
    let mut runner = Runner::new();
    runner.begin(&RegisterWrite::new(0x0120, vec![1, 0]), &Pace::new(at(0), &habits));
    assert!(!runner.is_too_late(at(4_999)) && runner.is_too_late(at(5_000)));
}

#[test]
fn an_answer_that_is_awaited_counts_after_the_time_out() {
    let habits = Habits::default();
    let (mut runner, mut read) = (Runner::new(), RegisterRead::new(0x0130, 6));
    runner.begin(&read, &Pace::new(at(0), &habits));
    let number = runner.depart();
    assert!(!runner.is_too_late(at(60_000)));
    let late = Pace::new(at(60_000), &habits);
    assert_eq!(runner.answer(number, &mut read, Some(TAKEN), &late), Some(Progress::Done));
}

#[test]
fn a_lost_access_is_repeated_now_and_one_that_is_not_taken_after_a_poll_period() {
    let habits = Habits { poll_period: Duration::from_millis(3), ..Habits::default() };
    let (mut runner, mut read) = (Runner::new(), RegisterRead::new(0x0130, 6));
    runner.begin(&read, &Pace::new(at(0), &habits));
    for (answer, due) in [(None, 20), (Some(NOT_TAKEN), 23)] {
        let number = runner.depart();
        assert_eq!(runner.deadline(), Instant::NEVER, "it waits for the answer");
        assert!(runner.answer(number, &mut read, answer, &Pace::new(at(20), &habits)).is_some());
        assert_eq!(runner.deadline(), at(due));
    }
}

#[test]
fn the_answer_to_the_dialogue_before_is_ignored() {
    let habits = Habits::default();
    let pace = Pace::new(at(0), &habits);
    let (mut runner, mut read) = (Runner::new(), RegisterRead::new(0x0130, 6));
    runner.begin(&read, &pace);
    let before = runner.depart();
    runner.begin(&read, &pace);
    assert_eq!(runner.answer(before, &mut read, Some(TAKEN), &pace), None);
    let number = runner.depart();
    assert_eq!(runner.answer(before, &mut read, Some(TAKEN), &pace), None, "an older number");
    assert_eq!(runner.answer(number, &mut read, Some(TAKEN), &pace), Some(Progress::Done));
    runner.rest();
    assert_eq!(runner.deadline(), Instant::NEVER);
}
