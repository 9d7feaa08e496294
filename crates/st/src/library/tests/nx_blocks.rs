//! NX_ReadObj and NX_WriteObj, scan by scan.

use super::bench::Recorder;
use crate::host::NxFault;
use crate::program::{Instance, compile};

const SCAN_NS: u64 = 1_000_000;

struct Bench {
    instance: Instance,
    host: Recorder,
    now_ns: u64,
}

impl Bench {
    fn new(block: &str, data_type: &str) -> Self {
        let source = format!(
            "PROGRAM Main
            VAR
                nx : {block}; Go : BOOL; Unit : _sNXUNIT_ID; Obj : _sNXOBJ_ACCESS;
                Limit : UINT; Octets : {data_type};
            END_VAR
            nx(Go, Unit, Obj, Limit, Octets);
            END_PROGRAM"
        );
        let mut instance = compile(&source, &[]).unwrap_or_else(|problems| panic!("{problems}")).start();
        for (name, value) in [("Unit.UnitNo", "1"), ("Obj.Index", "24579"), ("Obj.Subindex", "1")] {
            assert!(instance.set(name, value), "{name}");
        }
        Self { instance, host: Recorder::default(), now_ns: 0 }
    }

    fn set(&mut self, name: &str, value: &str) -> &mut Self {
        assert!(self.instance.set(name, value), "{name}");
        self
    }

    /// One scan; returns the pins after it, by their first letters, or the two codes of an error.
    fn scan(&mut self) -> String {
        self.now_ns += SCAN_NS;
        self.instance.scan(self.now_ns, 1000, &mut self.host).unwrap();
        let shown = |name: &str| self.instance.value(&format!("nx.{name}")).unwrap();
        let pins = ["Done", "Busy", "Error"].into_iter().filter(|name| shown(name) == "TRUE");
        let pins = pins.collect::<Vec<_>>().join(" ");
        let codes = [shown("ErrorID"), shown("ErrorIDEx")];
        if codes == ["16#0", "16#0"] { pins } else { format!("{pins} {}", codes.join(" ")) }
    }
}

#[test]
fn a_value_is_read_over_several_scans() {
    let mut bench = Bench::new("NX_ReadObj", "ARRAY[1..2] OF UINT");
    assert_eq!(bench.scan(), "");
    bench.set("Go", "TRUE");
    assert_eq!([bench.scan(), bench.scan(), bench.scan()], ["Busy", "Busy", "Busy"]);
    assert_eq!(bench.host.asked, [(1, 24579, 1, None)]);
    bench.host.answers.push((1, Ok(vec![0x34, 0x12, 0xFF, 0x00])));
    assert_eq!(bench.scan(), "Done");
    assert_eq!(bench.instance.value("Octets").unwrap(), "[4660, 255]");
    // It remains done while Execute is TRUE, and nothing is read again.
    assert_eq!(bench.scan(), "Done");
    bench.set("Go", "FALSE");
    assert_eq!(bench.scan(), "");
    assert_eq!(bench.host.asked.len(), 1);
    bench.set("Go", "TRUE");
    assert_eq!(bench.scan(), "Busy");
    assert_eq!(bench.host.asked.len(), 2);
}

#[test]
fn what_is_done_after_execute_fell_is_told_for_one_scan() {
    let mut bench = Bench::new("NX_ReadObj", "UDINT");
    bench.set("Go", "TRUE").scan();
    bench.set("Go", "FALSE");
    assert_eq!(bench.scan(), "Busy");
    bench.host.answers.push((1, Ok(vec![5, 0, 0, 0])));
    assert_eq!([bench.scan(), bench.scan()], ["Done", ""]);
}

#[test]
fn a_value_is_written_little_endian() {
    let mut bench = Bench::new("NX_WriteObj", "ARRAY[0..1] OF DINT");
    bench.set("Octets[0]", "-2").set("Octets[1]", "258").set("Go", "TRUE");
    assert_eq!(bench.scan(), "Busy");
    let value = vec![0xFE, 0xFF, 0xFF, 0xFF, 0x02, 0x01, 0x00, 0x00];
    assert_eq!(bench.host.asked, [(1, 24579, 1, Some(value))]);
    bench.host.answers.push((1, Ok(vec![])));
    assert_eq!(bench.scan(), "Done");
}

#[test]
fn an_error_tells_both_codes_and_a_new_call_clears_them() {
    let fault = NxFault { error_id: 0x2C00, error_id_ex: 0x0609_0011 };
    let mut bench = Bench::new("NX_ReadObj", "UINT");
    bench.host.answers.push((1, Err(fault)));
    bench.set("Go", "TRUE").scan();
    assert_eq!([bench.scan(), bench.scan()], ["Error 16#2C00 16#6090011", "Error 16#2C00 16#6090011"]);
    bench.set("Go", "FALSE");
    assert_eq!(bench.scan(), "");
    // A call that is refused immediately is reported immediately.
    bench.host.refusal = Some(fault);
    bench.set("Go", "TRUE");
    assert_eq!(bench.scan(), "Error 16#2C00 16#6090011");
}

#[test]
fn a_call_without_an_answer_times_out() {
    for (limit, scans) in [("0", 2000), ("1", 100), ("20", 2000)] {
        for block in ["NX_ReadObj", "NX_WriteObj"] {
            let mut bench = Bench::new(block, "UINT");
            bench.set("Limit", limit).set("Go", "TRUE");
            for _ in 0..scans {
                assert_eq!(bench.scan(), "Busy");
            }
            assert_eq!(bench.scan(), "Error 16#2C02 16#0", "{block}, TimeOut {limit}");
            assert_eq!(bench.host.forgotten, [1]);
            // A late answer has no effect.
            bench.host.answers.push((1, Ok(vec![9, 9])));
            assert_eq!(bench.scan(), "Error 16#2C02 16#0");
            assert_eq!(bench.instance.value("Octets").unwrap(), "0");
        }
    }
}

#[test]
fn each_call_that_timed_out_is_dropped() {
    for block in ["NX_ReadObj", "NX_WriteObj"] {
        let mut bench = Bench::new(block, "UINT");
        bench.set("Limit", "1");
        for _ in 0..9 {
            bench.set("Go", "TRUE");
            for _ in 0..101 {
                bench.scan();
            }
            bench.set("Go", "FALSE").scan();
        }
        assert_eq!(bench.host.forgotten, [1, 2, 3, 4, 5, 6, 7, 8, 9], "{block}");
    }
}

#[test]
fn a_value_of_another_length_is_an_error_and_changes_nothing() {
    let mut bench = Bench::new("NX_ReadObj", "UINT");
    bench.host.answers.push((1, Ok(vec![1, 2, 3, 4])));
    bench.set("Go", "TRUE").scan();
    assert_eq!(bench.scan(), "Error 16#2C03 16#0");
    assert_eq!(bench.instance.value("Octets").unwrap(), "0");

    let mut bench = Bench::new("NX_WriteObj", "ARRAY[0..200] OF BYTE");
    bench.set("Go", "TRUE");
    assert_eq!(bench.scan(), "Error 16#2C03 16#0");
    assert!(bench.host.asked.is_empty());
}

#[test]
fn inputs_outside_their_range_are_an_error() {
    for (name, value) in [("Unit.UnitNo", "65536"), ("Limit", "60001"), ("Obj.IsCompleteAccess", "TRUE")] {
        for block in ["NX_ReadObj", "NX_WriteObj"] {
            let mut bench = Bench::new(block, "UINT");
            bench.set(name, value).set("Go", "TRUE");
            assert_eq!(bench.scan(), "Error 16#400 16#0", "{block}: {name} = {value}");
            assert!(bench.host.asked.is_empty());
        }
    }
}

#[test]
fn bits_take_a_byte_each_and_structures_are_their_members_one_after_the_other() {
    let mut bench = Bench::new("NX_ReadObj", "_sNXOBJ_ACCESS");
    bench.host.answers.push((1, Ok(vec![0x00, 0x50, 7, 1])));
    bench.set("Go", "TRUE").scan();
    assert_eq!(bench.scan(), "Done");
    assert_eq!(bench.instance.value("Octets.Index").unwrap(), "20480");
    assert_eq!(bench.instance.value("Octets.IsCompleteAccess").unwrap(), "TRUE");
}
