//! A real master is judged by the scenario that the project ships.

use crate::run::{Line, top_folder, with_pysoem};

#[test]
fn pysoem_that_acknowledges_and_returns_to_op_passes_the_shipped_scenario() {
    let test = "judge::pysoem_that_acknowledges_and_returns_to_op_passes_the_shipped_scenario";
    with_pysoem(test, |python| {
        let scenario = top_folder().join("scenarios/judge/start-and-recovery.judge");
        let units = [top_folder().join("units/nx-ect101.toml")];
        let line = Line::start_with(0, &units, None, &["--scenario", &scenario.to_string_lossy()]);
        line.run_master(python, "judged.py", &[]);
        assert_eq!(line.wait(), Some(0), "the verdict");
    });
}
