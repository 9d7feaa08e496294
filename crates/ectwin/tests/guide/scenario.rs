use ectwin::Duration;
use ectwin::scenario::{Recording, ScenarioBuilder, ScenarioErrors};

#[test]
fn a_pulled_cable_is_a_watchdog_error() -> Result<(), ScenarioErrors> {
    let scenario = ScenarioBuilder::new("a cable is pulled in OP")
        .unit("model = \"nx-ect101\"")
        .master("take all units to OP")
        .within(Duration::from_millis(100))
        .expect("all units are in OP")
        .after(Duration::from_millis(20))
        .line("unplug cable 1")
        .within(Duration::from_millis(110))
        .expect("unit 1 is in SAFE-OP with AL status code 0x001B")
        .finish()?;

    let report = scenario.replay(1, Recording::new(true, false));
    assert!(report.passes(), "{:?}\n{}", report.failure, report.recording.trace().unwrap_or_default());
    Ok(())
}
