//! Declarations: units, sections, types.

use super::read;
use crate::syntax::ast::{Initial, PouKind, TypeDefinition, TypeKind, VarKind};

#[test]
fn units_of_all_kinds_stand_beside_types_and_globals() {
    let file = read(
        "TYPE Colour : (red, green := 5) := green; Speed : INT := 7;
             Motor : STRUCT a, b : INT := 5; c : Colour; END_STRUCT
             Old : UINT (x, y) := Old#y; New : (p, q) USINT; END_TYPE
         VAR_GLOBAL CONSTANT pi : LREAL := 3.14; END_VAR
         FUNCTION f : INT VAR_INPUT a : INT; END_VAR f := a; END_FUNCTION
         FUNCTION nothing ; END_FUNCTION
         FUNCTION_BLOCK b VAR_OUTPUT q : BOOL; END_VAR VAR RETAIN r : INT; END_VAR END_FUNCTION_BLOCK;
         VAR x : b; END_VAR
         PROGRAM p END_PROGRAM
         x();",
    );
    let kinds: Vec<_> = file.units.iter().map(|unit| (unit.kind, unit.name.text.as_str())).collect();
    let expected = [
        (PouKind::Function, "f"),
        (PouKind::Function, "nothing"),
        (PouKind::FunctionBlock, "b"),
        (PouKind::Program, "p"),
        (PouKind::Program, ""),
    ];
    assert_eq!(kinds, expected);
    assert!(file.units[0].result.is_some() && file.units[1].result.is_none());
    assert!(file.units[2].sections[1].retain && file.globals[0].constant);
    assert_eq!(file.globals[0].kind, VarKind::Global);
    let names: Vec<_> = file.types.iter().map(|declared| declared.name.text.as_str()).collect();
    assert_eq!(names, ["Colour", "Speed", "Motor", "Old", "New"]);
    assert!(matches!(&file.types[2].definition, TypeDefinition::Struct(members) if members.len() == 3));
    let TypeDefinition::Enum { values, initial } = &file.types[3].definition else { panic!("{file:?}") };
    assert_eq!((values.len(), initial.as_ref().map(|name| name.text.as_str())), (2, Some("y")));
}

#[test]
fn paths_go_up_to_the_colon_of_the_type() {
    let source = "VAR_EXTERNAL
        a AT IOBus://unit#1/UINTs 01 M to C : ARRAY[0..14] OF UINT; // a comment
        b AT 'IOBus://unit#1/NX Unit I/O Data Active Status' : BOOL := FALSE;
        c AT ECAT://node#1/UDINT 01 C to M: UDINT;
        d AT IOBus://unit#1/A
          : INT;
    END_VAR";
    let file = read(source);
    let paths: Vec<_> = file.units[0].sections[0]
        .variables
        .iter()
        .map(|variable| variable.at.as_ref().map(|path| path.text.as_str()))
        .collect();
    let expected = [
        "IOBus://unit#1/UINTs 01 M to C",
        "IOBus://unit#1/NX Unit I/O Data Active Status",
        "ECAT://node#1/UDINT 01 C to M",
        "IOBus://unit#1/A",
    ];
    assert_eq!(paths, expected.map(Some));
}

#[test]
fn types_and_initial_values_of_all_forms() {
    let file = read(
        "VAR CONSTANT PERSISTENT
            s1 : STRING; s2 : STRING[20] := 'a'; s3 : string(20);
            m : ARRAY[0..N - 1, -1..1] OF ARRAY[1..2] OF REAL;
            t : TON := (PT := T#1s, IN := TRUE);
            l : ARRAY[0..9] OF INT := [1, 2, 3(0), 2([4, 5]), N];
            q : ARRAY[0..1] OF P := [2((x := 1, y := [1, 2]))];
            r : ARRAY[0..1] OF P := [2(x := 1)];
            z : INT := (1 + 2) * 3;
        END_VAR",
    );
    let variables = &file.units[0].sections[0].variables;
    assert!(matches!(variables[0].type_name.kind, TypeKind::String(None)));
    assert!(matches!(variables[2].type_name.kind, TypeKind::String(Some(_))));
    assert!(matches!(&variables[3].type_name.kind, TypeKind::Array { bounds, .. } if bounds.len() == 2));
    assert!(matches!(&variables[4].initial, Some(Initial::Struct { members, .. }) if members.len() == 2));
    let Some(Initial::Array { elements, .. }) = &variables[5].initial else { panic!("{variables:?}") };
    let repeats: Vec<_> = elements.iter().map(|element| element.repeat.is_some()).collect();
    assert_eq!(repeats, [false, false, true, true, false]);
    for place in [6, 7] {
        let Some(Initial::Array { elements, .. }) = &variables[place].initial else {
            panic!("{variables:?}")
        };
        assert!(matches!(elements[0].value, Initial::Struct { .. }));
    }
    assert!(matches!(variables[8].initial, Some(Initial::Expression(_))));
}

#[test]
fn names_are_unicode_and_keywords_of_any_case() {
    let file = read("Var Größe, 速度 : Int; end_var größe := 速度; If a Then ; end_if;");
    assert_eq!(file.units[0].sections[0].variables.len(), 2);
    assert_eq!(file.units[0].body.len(), 2);
}
