//! The cost of a scan of a user program, including the device variables that it reads and writes: `cargo bench
//! -p ectwin-plc`. Targets and figures: docs/performance.md.

#![expect(clippy::expect_used, reason = "a benchmark ends where something is not as it should be")]

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use criterion::{Criterion, criterion_group, criterion_main};
use nx_ect101::IoAllocation;
use plc::{CpuSettings, CpuUnit, DeviceVariables, Io, Program as _, StructuredText};
use time::Instant;

/// The program that a test compares with the manual, A-3-3: it copies 15 UINTs while all data are valid.
const A_3_3: &str = include_str!("../../../scenarios/programs/a-3-3.st");

/// The variables that A-3-3 checks.
const VALID: [&str; 3] = [
    "NXBus_N1_NX_Unit_I_O_Data_Active_Status",
    "N1_Data_from_EtherCAT_Master_to_CPU_Unit_Valid",
    "N1_Data_from_CPU_Unit_to_EtherCAT_Master_Valid",
];

/// A CPU Unit that repeats the scan of a program within one cycle, and measures the time of this.
struct Bench {
    cpu: CpuUnit,
    repeats: Arc<AtomicU64>,
    spent_ns: Arc<AtomicU64>,
    // The unit's side of the NX bus stays connected.
    _unit: nx_bus::UnitEnd,
}

impl Bench {
    fn new(source: &str) -> Self {
        let allocation = IoAllocation::factory();
        let variables = DeviceVariables::of(nx_ect101::variable_table("N1", 1, &allocation));
        let mut program = StructuredText::compile(source, &variables).expect("a program");
        let (repeats, spent_ns) = (Arc::new(AtomicU64::new(0)), Arc::new(AtomicU64::new(0)));
        let (count, spent) = (repeats.clone(), spent_ns.clone());
        let scans = move |io: &mut Io| {
            VALID.iter().for_each(|name| io.force(io.find(name).expect(name), &[1]).expect("a BOOL"));
            let start = std::time::Instant::now();
            for _ in 0..count.load(Ordering::Relaxed) {
                program.scan(io);
            }
            spent.store(start.elapsed().as_nanos() as u64, Ordering::Relaxed);
            assert_ne!(program.value("C_to_M_Data_is_Valid").as_deref(), Some("FALSE"), "nothing is copied");
        };
        let (unit, bus) = nx_bus::connect(variables.unit().m_to_c_bytes, variables.unit().c_to_m_bytes);
        let cpu = CpuUnit::power_on(Instant::ZERO, CpuSettings::default(), variables, bus, Box::new(scans));
        Self { cpu, repeats, spent_ns, _unit: unit }
    }

    /// The time of this number of scans.
    fn run(&mut self, scans: u64) -> std::time::Duration {
        self.repeats.store(scans, Ordering::Relaxed);
        let deadline = self.cpu.deadline();
        self.cpu.cycle(deadline);
        std::time::Duration::from_nanos(self.spent_ns.load(Ordering::Relaxed))
    }
}

fn scan(criterion: &mut Criterion, name: &str, source: &str) {
    let mut bench = Bench::new(source);
    criterion.bench_function(name, |bencher| bencher.iter_custom(|scans| bench.run(scans)));
}

/// Assignments, branches and arithmetic, 1,000 statements in each scan.
fn thousand_statements() -> String {
    let four = "i := i + 1;\nr := r * 0.5 + 1.0;\nIF i > 100 THEN i := 0; END_IF;\na[i MOD 10] := i;\n";
    format!("VAR i : INT; r : LREAL; a : ARRAY[0..9] OF INT; END_VAR\n{}", four.repeat(250))
}

fn scans(criterion: &mut Criterion) {
    scan(criterion, "scan of A-3-3, its data valid", A_3_3);
    scan(criterion, "scan of 1,000 statements", &thousand_statements());
    let endless = "VAR n : DINT; END_VAR WHILE TRUE DO n := n + 1; END_WHILE;";
    scan(criterion, "scan of an endless loop, to its budget of 100,000 statements", endless);
}

criterion_group!(benches, scans);
criterion_main!(benches);
