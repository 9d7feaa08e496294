use ectwin::scenario::model::{CableNumber, Condition, Hex, LineOrder, Script, UnitNumber, UnitSet};
use ectwin::scenario::{Files, Recording, Scenario, ScenarioBuilder, ScenarioErrors, Wanted};
use ectwin::{AlState, Duration};

#[test]
fn each_cable_is_unplugged() -> Result<(), ScenarioErrors> {
    for number in 1..=2 {
        let mut scenario = ScenarioBuilder::new("a cable is unplugged in OP")
            .unit("model = \"nx-ect101\"")
            .unit("model = \"nx-ect101\"\nname = \"N2\"\nserial = 2")
            .master("take all units to OP")
            .within(Duration::from_millis(200))
            .expect("all units are in OP")
            .line(LineOrder::Unplug { cable: CableNumber::new(number).unwrap() });
        for position in usize::from(number) - 1..2 {
            let units = UnitSet::from(UnitNumber::at(position));
            let al_status_code = Some(Hex(0x001B));
            scenario = scenario.within(Duration::from_millis(110)).expect(Condition::State {
                units,
                state: AlState::SafeOp,
                al_status_code,
            });
        }
        let report = scenario.finish()?.replay(1, Recording::new(false, false));
        assert!(report.passes(), "{:?}", report.failure);
    }
    Ok(())
}

/// The script names no files.
struct NoFiles;

impl Files for NoFiles {
    fn text(&mut self, path: &str, _: Wanted) -> Result<String, String> {
        Err(format!("{path} is not here"))
    }
}

#[test]
fn a_script_from_json() -> Result<(), ScenarioErrors> {
    let script: Script = serde_json::from_str(
        r#"{
            "title": "a unit reaches OP",
            "steps": [
                { "master": { "take": { "units": "all", "state": "OP" } } },
                { "expect": { "state": { "units": 1, "state": "OP" } }, "within": "100ms" }
            ]
        }"#,
    )
    .unwrap();
    let report = Scenario::of(script, &mut NoFiles)?.replay(1, Recording::new(false, false));
    assert!(report.passes(), "{:?}", report.failure);
    Ok(())
}
