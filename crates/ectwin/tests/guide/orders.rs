use ectwin::link::memory;
use ectwin::master::Master;
use ectwin::{AlState, Duration, Reason, Twin};

#[test]
fn a_master_loses_its_cable_in_virtual_time() {
    let twin = Twin::from_toml("model = \"nx-ect101\"").unwrap();
    let mut bench = twin.connect(Master::default());
    bench.search().unwrap();
    bench.take_to(0, AlState::Op).unwrap();

    // The sentences of scenarios.
    bench.line.apply("unplug cable 1").unwrap();
    bench.run_for(Duration::from_millis(150));
    assert!(bench.line.holds("unit 1 is in SAFE-OP with AL status code 0x001B").unwrap());
    bench.line.apply("plug cable 1").unwrap();

    // What only the scripted master of a scenario can do is refused: here the master is yours.
    let refused = bench.line.apply("take unit 1 to OP").unwrap_err();
    assert_eq!(refused.reason, Reason::ScriptedMaster);
}

#[test]
fn a_unit_breaks_in_real_time() {
    let (_your_master, units) = memory::pair();
    let live = Twin::from_toml("model = \"nx-ect101\"").unwrap().serve(units).unwrap();

    live.apply("break Processing of unit 1").unwrap();
    live.expect("unit 1 has the error 40200000", Duration::from_secs(5)).unwrap();
    live.apply("force N1_UINTs_01_C_to_M[0] to 5").unwrap();
    assert!(live.holds("variable N1_UINTs_01_C_to_M[0] has the value 5").unwrap());

    // A mistake has the nearest sentences.
    let refused = live.apply("brake Processing of unit 1").unwrap_err();
    assert_eq!(refused.nearest.first().map(String::as_str), Some("break Processing of unit 1"));
}
