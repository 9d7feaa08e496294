use crate::compile;

const DECLARED: &str = "TYPE Pair : STRUCT x : INT; y : REAL; END_STRUCT; Colour : (red, green, blue); END_TYPE\n\
    PROGRAM Main VAR i : INT; u : UINT; ul : ULINT; w : WORD; b : BOOL; r : REAL; l : LREAL; t : TIME; d : DATE;\n\
    s : STRING[6]; a : ARRAY[0..2] OF INT; p : Pair; c : Colour; ps : ARRAY[1..2] OF Pair; END_VAR END_PROGRAM";

/// Variable, text, and the value that is then read back; none: the text is no value.
const ROWS: &[(&str, &str, Option<&str>)] = &[
    ("i", "5", Some("5")),
    ("i", "-5", Some("-5")),
    ("i", "INT#5", Some("5")),
    ("i", "INT#-5", Some("-5")),
    ("i", "SINT#-5", Some("-5")),
    ("i", "DINT#5", None),
    ("i", "16#7F_FF", Some("32767")),
    ("i", "16#8000", None),
    ("i", "1.5", None),
    ("u", "16#FF", Some("255")),
    ("u", "2#101", Some("5")),
    ("u", "-1", None),
    ("ul", "16#FFFFFFFFFFFFFFFF", Some("18446744073709551615")),
    ("w", "WORD#16#1F", Some("16#1F")),
    ("w", "16#1f", Some("16#1F")),
    ("w", "31", Some("16#1F")),
    ("b", "0", Some("FALSE")),
    ("b", "BOOL#1", Some("TRUE")),
    ("b", "true", Some("TRUE")),
    ("b", "2", None),
    ("r", "REAL#1.5", Some("1.5")),
    ("r", "-1.5e1", Some("-15.0")),
    ("r", "2", Some("2.0")),
    ("r", "1e39", None),
    ("r", "NaN", Some("NaN")),
    ("l", "REAL#0.5", Some("0.5")),
    ("t", "T#1.5s", Some("T#1s500ms")),
    ("t", "5", None),
    ("d", "D#2024-02-29", Some("D#2024-02-29")),
    ("d", "5", None),
    ("s", "'abc'", Some("'abc'")),
    ("s", "'abcdef'", None),
    ("s", "abc", None),
    ("a", "[1,2,3]", Some("[1, 2, 3]")),
    ("a", "[INT#1, 2(16#F)]", Some("[1, 15, 15]")),
    ("a", "[1, 2]", None),
    ("a", "[1, 2, 3, 4]", None),
    ("a", "1", None),
    ("p", "(y := 1, x:=2)", Some("(x := 2, y := 1.0)")),
    ("p", "(x := 2)", None),
    ("p", "(x := 2, x := 3)", None),
    ("c", "Green", Some("green")),
    ("c", "Colour#blue", Some("blue")),
    ("c", "1", Some("green")),
    ("c", "pink", None),
    ("ps", "[2((x := 1, y := 2.5))]", Some("[(x := 1, y := 2.5), (x := 1, y := 2.5)]")),
    ("i", "", None),
    ("i", "5 5", None),
    ("i", "5; i := 6", None),
];

#[test]
fn a_variable_takes_the_constants_of_the_language() {
    let program = compile(DECLARED, &[]).unwrap();
    for &(name, text, expected) in ROWS {
        let mut instance = program.start();
        let value = instance.set(name, text).then(|| instance.value(name).unwrap());
        assert_eq!(value.as_deref(), expected, "{name} := {text}");
        if expected.is_none() {
            assert_eq!(instance.value(name), program.start().value(name), "{name} := {text}");
        }
    }
}
