use std::path::PathBuf;

use super::super::read::tests::{parse, variables};
use super::*;

struct Bench {
    io: Io,
    behaviours: Behaviours,
}

impl Bench {
    fn of(text: &str) -> Self {
        let section = parse(text).unwrap_or_else(|errors| panic!("{errors}"));
        let behaviours = Behaviours::of(&section, 1).expect("behaviours");
        Self { io: Io::new(variables()), behaviours }
    }

    fn scan(&mut self, at_ms: u64) {
        self.io.begin_period(Instant::from_nanos(at_ms * 1_000_000), None);
        self.behaviours.scan(&mut self.io);
    }

    fn value(&self, name: &str) -> Vec<u8> {
        let id = self.io.find(name).expect("a variable");
        self.io.read(id).expect("a value").to_vec()
    }

    fn write(&mut self, name: &str, value: &[u8]) {
        let id = self.io.find(name).expect("a variable");
        self.io.write(id, value).expect("written");
    }
}

#[test]
fn a_value_follows_its_behaviour_and_a_loop_its_output() {
    let mut bench = Bench::of(
        "behaviour.Input_1 = { square = { period = \"10ms\" } }\n\
         behaviour.\"Raw[1]\" = { counter = { every = \"4ms\", from = 7 } }\nloopback.Input_2 = \"Output_2\"",
    );
    let mut seen = Vec::new();
    for at_ms in 0..12 {
        bench.io.memory.m_to_c.bytes[0] = if at_ms > 5 { 0b10 } else { 0 };
        bench.scan(at_ms);
        seen.push((bench.value("K1_Input_1")[0], bench.value("K1_Input_2")[0], bench.value("K1_Raw")[2]));
    }
    assert_eq!(
        seen,
        [
            (1, 0, 7),
            (1, 0, 7),
            (1, 0, 7),
            (1, 0, 7),
            (1, 0, 8),
            (0, 0, 8),
            (0, 1, 8),
            (0, 1, 8),
            (0, 1, 9),
            (0, 1, 9),
            (1, 1, 9),
            (1, 1, 9),
        ]
    );
}

#[test]
fn an_array_is_looped_back_as_a_whole() {
    let mut bench = Bench::of("loopback.Copy = \"Raw\"\nbehaviour.\"Raw[1]\" = { hold = 258 }");
    bench.scan(0);
    assert_eq!(bench.value("K1_Copy"), [0, 0, 2, 1]);
}

#[test]
fn a_written_value_stays_until_the_next_change_and_a_forced_one_for_good() {
    let mut bench = Bench::of(
        "behaviour.Input_1 = { hold = true }\nbehaviour.Input_2 = { square = { period = \"10ms\" } }",
    );
    bench.scan(0);
    bench.write("K1_Input_1", &[0]);
    bench.write("K1_Input_2", &[0]);
    bench.scan(1);
    assert_eq!((bench.value("K1_Input_1"), bench.value("K1_Input_2")), (vec![0], vec![0]));
    let forced = bench.io.find("K1_Input_2").expect("a variable");
    bench.scan(10);
    assert_eq!((bench.value("K1_Input_1"), bench.value("K1_Input_2")), (vec![0], vec![1]));
    bench.io.force(forced, &[0]).expect("forced");
    bench.scan(20);
    bench.io.memory.apply_forced();
    assert_eq!(bench.value("K1_Input_2"), [0]);
}

#[test]
fn with_the_power_all_begins_again() {
    for first_scan_ms in [0, 5, 9] {
        let mut bench = Bench::of("behaviour.Input_1 = { hold = true }");
        bench.scan(5);
        bench.io.power_on();
        assert_eq!(bench.value("K1_Input_1"), [0]);
        bench.scan(first_scan_ms);
        assert_eq!(bench.value("K1_Input_1"), [1], "{first_scan_ms} ms");
    }
}

#[test]
fn two_variables_of_one_seed_have_different_numbers() {
    let mut bench = Bench::of(
        "behaviour.\"Raw[0]\" = { random = { high = 60000, every = \"1ms\" } }\n\
         behaviour.\"Raw[1]\" = { random = { high = 60000, every = \"1ms\" } }",
    );
    bench.scan(0);
    let raw = bench.value("K1_Raw");
    assert_ne!(raw[..2], raw[2..]);
}

#[test]
fn a_csv_file_is_read_once_and_its_values_fit_the_variable() {
    let text = "behaviour.Channel_1_Level.csv = { file = \"tank.csv\", column = \"level\" }";
    let mut section = parse(text).expect("a right file");
    let read = |path: &Path| match path.to_str() {
        Some("tank.csv") => Ok("s,level\n0,-3\n0.002,40\n".to_owned()),
        _ => Err("another file"),
    };
    section.read_csv(read).expect("a right table");
    let mut bench = Bench { io: Io::new(variables()), behaviours: Behaviours::of(&section, 1).expect("one") };
    let levels = [0, 1, 2, 9].map(|at_ms| {
        bench.scan(at_ms);
        bench.value("K1_Channel_1_Level")[0]
    });
    assert_eq!(levels, [0xFD, 0xFD, 40, 40]);

    let refused = |answer: Result<&str, &'static str>| {
        let mut section = parse(text).expect("a right file");
        let (path, why) = section.read_csv(|_| answer.map(str::to_owned)).expect_err("refused");
        assert_eq!(path.value, PathBuf::from("tank.csv"));
        why.to_string()
    };
    assert_eq!(refused(Err("it is not there")), "it is not there");
    assert_eq!(refused(Ok("0,1\n")), "there is no column `level`: the first line has no names");
    assert_eq!(
        refused(Ok("s,level\n0,99999\n")),
        "line 2: 99999 is not a value of the variable: -32768 to 32767"
    );
}
