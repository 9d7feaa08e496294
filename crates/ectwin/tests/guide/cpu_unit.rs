use ectwin::{Duration, Io, OperatingMode, Setup, Twin};

/// Counts its own scans, and sends the count to the master in the first element of UINTs 01.
fn count_scans(io: &mut Io) {
    let before = u16::from_le_bytes([io.c_to_m()[0], io.c_to_m()[1]]);
    let mut elements = [0; 15];
    elements[0] = before + 1;
    io.set_uints(1, elements);
}

#[test]
fn the_program_runs_once_in_each_task_period_and_not_in_program_mode() {
    let text = "model = \"nx-ect101\"\n[cpu]\ntask_period = \"2ms\"\n";
    let mut twin = Twin::power_on([Setup::from_toml(text).unwrap().program(count_scans)]);
    let scans = |twin: &mut Twin| twin.unit(0).io().c_to_m()[0];

    let first = scans(&mut twin);
    twin.run_for(Duration::from_millis(20));
    assert_eq!(scans(&mut twin) - first, 10);

    // PROGRAM mode: the program is stopped, I/O refreshing continues, the values are kept.
    twin.unit(0).cpu().set_mode(OperatingMode::Program);
    let stopped = scans(&mut twin);
    twin.run_for(Duration::from_millis(20));
    assert_eq!(scans(&mut twin), stopped);
}
