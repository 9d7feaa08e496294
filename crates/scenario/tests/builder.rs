//! Scenarios that are written in code: an impossible step is refused with its number.

use scenario::model::{Condition, LineOrder, Order, Step};
use scenario::{ErrorPlace, ScenarioBuilder};
use time::Duration;

const SHORT: Duration = Duration::from_millis(1);
const LONG: Duration = Duration::from_millis(2);

/// The steps that are refused, and the reasons.
fn refused(builder: ScenarioBuilder) -> Vec<(usize, String)> {
    let Err(errors) = builder.finish() else { return Vec::new() };
    let numbered = errors.iter().map(|error| match error.place {
        ErrorPlace::Step(number) => (number, error.message.clone()),
        _ => panic!("not of a step: {error}"),
    });
    numbered.collect()
}

fn quiet(builder: ScenarioBuilder) -> ScenarioBuilder {
    builder.line(LineOrder::BeQuiet)
}

/// A call that sets a part of the second step of a scenario.
type Said = fn(ScenarioBuilder) -> ScenarioBuilder;

const ONE_MOMENT: &str = "a step has at most one of `at`, `after` and `when`";
const BELONG: &str = "`within`, `for` and `while` belong to `expect`, `until` to `expect` and `never`";

#[test]
fn a_step_that_contradicts_itself_is_refused_with_its_number() {
    let cases: [(&str, Said, &str); 14] = [
        ("at after line", |it| quiet(it.at(LONG).after(SHORT)), ONE_MOMENT),
        ("after at line", |it| quiet(it.after(SHORT).at(LONG)), ONE_MOMENT),
        ("at when line", |it| quiet(it.at(LONG).when(Condition::MasterIdle)), ONE_MOMENT),
        ("at at line", |it| quiet(it.at(SHORT).at(LONG)), "a step has one `at`"),
        ("after after line", |it| quiet(it.after(SHORT).after(SHORT)), "a step has one `after`"),
        (
            "when when line",
            |it| quiet(it.when(Condition::MasterIdle).when(Condition::SdoTaken { unit: None })),
            "a step has one `when`",
        ),
        ("within line", |it| quiet(it.within(SHORT)), BELONG),
        ("until line", |it| quiet(it.until(Condition::MasterIdle)), BELONG),
        ("within never", |it| it.within(SHORT).never(Condition::MasterGaveUp), "`never` has no `within`"),
        (
            "within until expect",
            |it| it.within(SHORT).until(Condition::MasterIdle).expect(Condition::SdoTaken { unit: None }),
            "`within`, `for`, `until` and `while` contradict each other",
        ),
        (
            "within within expect",
            |it| it.within(SHORT).within(LONG).expect(Condition::MasterIdle),
            "a step has one `within`",
        ),
        (
            "after step",
            |it| it.after(SHORT).step(Step::at_once(Order::Line(LineOrder::BeQuiet))),
            "a typed step has its own time",
        ),
        ("after", |it| it.after(SHORT), "a moment without a step"),
        ("within", |it| it.within(SHORT), "a moment without a step"),
    ];
    for (said, wrong, message) in cases {
        let builder = wrong(quiet(ScenarioBuilder::new("t")));
        assert_eq!(refused(builder), [(2, message.to_owned())], "{said}");
    }
}

#[test]
fn what_is_said_of_a_step_is_not_said_of_the_next_one() {
    // Each wrong step would make its neighbour wrong too, if a part of it remained.
    let builder = ScenarioBuilder::new("t")
        .within(SHORT)
        .line(LineOrder::BeQuiet)
        .until(Condition::MasterIdle)
        .expect(Condition::MasterIdle)
        .at(LONG)
        .line("be loud")
        .after(SHORT)
        .line(LineOrder::BeQuiet)
        .when("it rains")
        .line(LineOrder::BeQuiet)
        .within(SHORT)
        .never(Condition::MasterIdle);
    let numbers: Vec<usize> = refused(builder).iter().map(|(number, _)| *number).collect();
    assert_eq!(numbers, [1, 3, 5, 6]);
}
