//! Terminals and an NX-ECT101 in one line.

use crate::run::Run;

#[test]
fn pysoem_takes_a_line_of_terminals_and_an_nx_ect101_to_op() {
    Run {
        test: "terminals::pysoem_takes_a_line_of_terminals_and_an_nx_ect101_to_op",
        units: &[
            "digital-coupler.toml",
            "digital-8-outputs.toml",
            "digital-8-inputs.toml",
            "nx-ect101.toml",
            "digital-16-inputs.toml",
            "digital-4-outputs-4-inputs.toml",
            "digital-4-outputs-4-inputs.toml",
        ],
        script: "terminals.py",
        arguments: &[],
        visible: &["ecat.reg.alstatus.status == 0x08"],
    }
    .run();
}
