//! The I/O response time in virtual time (manual, 7-9-1): for many seeds, none exceeds the formula, some are
//! close to it.

#![expect(clippy::expect_used, reason = "a scenario of these parts is right")]

use nx_ect101::performance::IoResponse;
use scenario::{Recording, ScenarioBuilder};
use time::Duration;

const SEEDS: u64 = 100;

/// One configuration: entries of 15 UINT in each direction, which determine T_slave; T_cpu and T_master.
struct Case {
    entries: usize,
    slave_us: u64,
    cpu_us: u64,
    master_us: u64,
}

const CASES: &[Case] = &[
    Case { entries: 6, slave_us: 1_000, cpu_us: 7_000, master_us: 250 },
    Case { entries: 20, slave_us: 1_500, cpu_us: 4_000, master_us: 500 },
    Case { entries: 20, slave_us: 1_500, cpu_us: 7_000, master_us: 1_000 },
    Case { entries: 40, slave_us: 2_000, cpu_us: 1_250, master_us: 250 },
    Case { entries: 40, slave_us: 2_000, cpu_us: 3_250, master_us: 250 },
];

impl Case {
    /// T_trans is 0 in virtual time.
    fn maximum(&self) -> Duration {
        let of = Duration::from_micros;
        let times = IoResponse {
            master: of(self.master_us),
            slave: of(self.slave_us),
            cpu: of(self.cpu_us),
            transmission: Duration::ZERO,
        };
        times.maximum()
    }

    /// Whether new outputs return within this time from the frame that carries them. They are set just after a
    /// frame, so that one more cycle passes until the next.
    fn returns_within(&self, seed: u64, limit: Duration) -> bool {
        let master = Duration::from_micros(self.master_us);
        let (entries, cpu_us) = (self.entries, self.cpu_us);
        let unit = format!(
            "model = \"nx-ect101\"\nio_allocation.m_to_c.uints = {entries}\nio_allocation.c_to_m.uints = {entries}\n\
             cpu.task_period = \"{cpu_us}us\"\ncpu.program = \"builtin:copy\"\n"
        );
        let scenario = ScenarioBuilder::new("an I/O response")
            .unit(&unit)
            .master(format!("exchange process data every {master}"))
            .master(format!("let unit 1 map 0x1601 as 7000:01..{entries:02X}"))
            .master(format!("let unit 1 map 0x1A01 as 6000:01..{entries:02X}"))
            .master("take unit 1 to OP")
            .master("set the outputs of unit 1 to 11")
            .within(Duration::from_secs(1))
            .expect("input byte 2 of unit 1 is 11")
            .when(format!("{} cycles are done", 1_000 + seed))
            .master("set the outputs of unit 1 to 22")
            .within(master + limit)
            .expect("input byte 2 of unit 1 is 22")
            .finish()
            .expect("a right scenario");
        scenario.replay(seed, Recording::new(false, false)).passes()
    }
}

#[test]
fn an_io_response_takes_the_formula_at_most_and_reaches_nine_tenths_of_it() {
    for case in CASES {
        let maximum = case.maximum();
        let nearly = Duration::from_nanos(maximum.as_nanos() * 9 / 10 - 1);
        for seed in 1..=SEEDS {
            assert!(case.returns_within(seed, maximum), "seed {seed}: longer than {maximum}");
        }
        let reaches = (1..=SEEDS).filter(|&seed| !case.returns_within(seed, nearly)).count();
        assert!(reaches > 0, "T_slave {} us, T_cpu {} us: none reaches 90 %", case.slave_us, case.cpu_us);
    }
}
