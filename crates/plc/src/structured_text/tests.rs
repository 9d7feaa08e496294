//! Programs on a CPU Unit's own variables, without a unit.

use nx_ect101::{DataSetKind, Direction, IoAllocation};

use super::*;

fn allocation() -> IoAllocation {
    let mut allocation = IoAllocation::factory();
    allocation.select(Direction::CToM, DataSetKind::Udint, 1);
    allocation
}

fn variables() -> DeviceVariables {
    DeviceVariables::of(nx_ect101::variable_table("N1", 1, &allocation()))
}

fn compile(source: &str) -> Result<StructuredText, Problems> {
    StructuredText::compile(source, &variables())
}

#[test]
fn only_the_device_variables_that_a_program_names_are_taken_along() {
    let program = compile("N1_UDINT_01_C_to_M := N1_UDINT_01_C_to_M + 1;").expect("a program");
    let names = program.bindings.iter().map(|binding| binding.variable).collect::<Vec<_>>();
    assert_eq!(names, [variables().find("N1_UDINT_01_C_to_M").expect("allocated")]);
}

#[test]
fn a_device_variable_is_named_by_its_at_specification_too() {
    let source = "VAR Own AT IOBus://unit#1/UDINT 01 C to M : UDINT; END_VAR Own := 5;";
    assert_eq!(compile(source).expect("a program").bindings.len(), 1);
}

#[test]
fn what_comes_from_the_unit_cannot_be_written() {
    let problems = compile("N1_UINTs_01_M_to_C[0] := 1;").expect_err("an input");
    assert_eq!(problems.to_string(), "1:1: this cannot be written: it comes from the unit");
}

#[test]
fn a_misspelt_device_variable_is_told_with_the_nearest_name() {
    let problems = compile("N1_UDINT_01_C_to_N := 1;").expect_err("misspelt");
    let expected = "1:1: there is no variable `N1_UDINT_01_C_to_N` (did you mean `N1_UDINT_01_C_to_M`?)";
    assert_eq!(problems.to_string(), expected);
}

#[test]
fn a_declaration_of_another_type_is_refused() {
    let source = "VAR_EXTERNAL N1_UDINT_01_C_to_M : UINT; END_VAR ;";
    let problems = compile(source).expect_err("another type");
    assert_eq!(problems.to_string(), "1:35: `N1_UDINT_01_C_to_M` is UDINT, not UINT");
}
