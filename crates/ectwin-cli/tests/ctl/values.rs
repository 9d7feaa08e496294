//! Variables, objects and faults.

use crate::bench::Bench;

#[test]
fn variables_are_read_written_forced_and_released() {
    let bench = Bench::new("values");
    let _twin = bench.twin();
    let name = "N1_UINTs_01_C_to_M[0]";
    let told = bench.told(&["force", &format!("{name}=4660")]);
    assert!(told.starts_with(&format!("{name}  UINT  4660  ")) && told.ends_with(", forced\n"), "{told}");
    bench.told(&["expect", "variable N1_UINTs_01_C_to_M[0] has the value 4660"]);
    let released = bench.document(&["release", name]);
    assert_eq!(released["values"][name]["forced"], false, "{released}");
    bench.told(&["do", "set unit 1 to PROGRAM mode"]);
    let written = bench.document(&["write", &format!("{name}=5"), "N1_UINTs_01_C_to_M[1]=6"]);
    assert_eq!(written["values"][name]["value"], 5, "{written}");
    assert_eq!(
        bench.document(&["read", "N1_UINTs_01_C_to_M[1]"])["values"]["N1_UINTs_01_C_to_M[1]"]["value"],
        6
    );

    let no_value = bench.ctl(&["force", name]);
    assert_eq!(no_value.code, Some(2));
    assert!(
        no_value.stderr.contains("gives no value") && no_value.stderr.contains("help: write NAME=VALUE"),
        "{no_value:?}"
    );
    let unknown = bench.ctl(&["read", "N1_UINTs_01_C_to_N"]);
    assert_eq!(unknown.code, Some(2));
    assert!(unknown.stderr.contains("N1_UINTs_01_C_to_M"), "the nearest one: {unknown:?}");
}

#[test]
fn an_object_is_read_from_the_side_of_the_unit() {
    let bench = Bench::new("object");
    let _twin = bench.twin();
    let told = bench.told(&["object", "N1", "1018:01"]);
    assert!(told.starts_with("N1 1018:01  ") && told.contains("  131  "), "{told}");
    assert_eq!(bench.document(&["object", "N1", "1018:02"])["value"], 380);
    let unknown = bench.ctl(&["object", "N9", "1018:01"]);
    assert_eq!(unknown.code, Some(2), "{unknown:?}");
}

#[test]
fn faults_at_work_are_listed_and_cleared() {
    let bench = Bench::new("faults");
    let _twin = bench.twin();
    assert_eq!(bench.told(&["faults"]), "no fault is at work\n");
    bench.told(&["do", "break Processing of unit 1", "lose 5 % of the frames called storm"]);
    let told = bench.told(&["faults"]);
    assert!(
        told.contains("Processing of unit 1: break Processing of unit 1\n")
            && told.contains("storm: lose 5 %"),
        "{told}"
    );
    let left = bench.told(&["clear", "storm"]);
    assert!(left.contains("Processing") && !left.contains("storm"), "{left}");
    assert_eq!(bench.told(&["clear", "Processing", "of", "unit", "1"]), "no fault is at work\n");
    let unknown = bench.ctl(&["clear", "strm"]);
    assert_eq!(unknown.code, Some(2), "{unknown:?}");
}
