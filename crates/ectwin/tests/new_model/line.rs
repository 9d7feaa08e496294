use ectwin::master::Master;
use ectwin::plant::{UnitFile, models};
use ectwin::{AlState, Duration, Setup, Twin};
use unit_model::UnitFiles;

use crate::counter::Counter;
use crate::description::device_config;
use crate::model::CounterModel;

/// The models of the registry, and the new one.
fn all_models() -> Vec<&'static dyn UnitFiles> {
    let mut all = models().to_vec();
    all.push(&CounterModel);
    all
}

fn setup(text: &str) -> Setup {
    Setup::from_unit_file(UnitFile::parse_with(&all_models(), text).unwrap()).unwrap()
}

#[test]
fn a_counter_beside_another_model_counts() {
    let files = ["model = \"digital\"\noutputs = 8", "model = \"counter\"\nname = \"C1\"\nstep = 3"];
    let mut bench = Twin::power_on(files.map(setup)).connect(Master::default());
    assert_eq!(bench.search(), Ok(2));
    bench.take_all_to(AlState::Op).unwrap();

    // The master reads the count; 20 ms later it is 20 steps of 3 higher.
    bench.run_for(Duration::from_millis(5));
    let count = |inputs: &[u8]| u16::from_le_bytes([inputs[0], inputs[1]]);
    let before = count(bench.master.inputs(1));
    bench.run_for(Duration::from_millis(20));
    assert_eq!(count(bench.master.inputs(1)) - before, 60);

    // So does the CPU Unit, by the name of the variable, and the test, by the type of the unit.
    let unit = bench.line.unit(1);
    let value = unit.io().read(unit.io().find("C1_Count").unwrap()).unwrap();
    assert!(count(&value) > before);
    assert!(unit.as_model::<Counter>().unwrap().is_exchanging);
}

#[test]
fn its_sii_follows_the_rules() {
    assert_eq!(esi::sii::lint(&device_config().sii_image), []);
}

#[test]
fn a_wrong_unit_file_is_refused_with_its_place() {
    let message =
        |text| UnitFile::parse_with(&all_models(), text).unwrap_err().iter().next().unwrap().to_string();
    assert_eq!(message("model = \"counter\"\nstep = 0"), "2:8: `step` is 0, expected 1 to 1000");
    assert!(message("model = \"count\"").ends_with("did you mean `counter`?"));
    assert_eq!(
        message("model = \"digital\"\nstep = 1"),
        "2:1: `step` is a key of the model counter, not of digital"
    );
}
