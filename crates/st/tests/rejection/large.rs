//! Sources that are too large, too deep, or have too many mistakes.

use crate::problems;

/// This number of pieces, each with its number.
fn pieces(count: usize, piece: impl Fn(usize) -> String) -> String {
    (0..count).map(piece).collect()
}

fn nested(opening: &str, inner: &str, closing: &str, count: usize) -> String {
    opening.repeat(count) + inner + &closing.repeat(count)
}

/// Compiles a wrong source, and searches for a message.
fn expect(source: &str, message: &str) {
    let name: String = source.chars().take(60).collect();
    let told = problems(&name, source);
    assert!(told.contains(message), "{name}: {}", told.lines().take(5).collect::<Vec<_>>().join("\n"));
}

/// Compiles a source that is correct.
fn accept(source: &str) {
    if let Err(problems) = st::compile(source, &[]) {
        panic!("{:?}", problems.list().first());
    }
}

/// A program with one INT and one BOOL.
fn with_statements(statements: &str) -> String {
    format!("VAR x : INT; b : BOOL; a : ARRAY[0..1] OF INT; END_VAR {statements}")
}

#[test]
fn expressions_too_deep_or_too_long() {
    let deep = "nested too deeply";
    expect(&with_statements(&format!("x := {};", nested("(", "1", ")", 500))), deep);
    expect(&with_statements(&format!("x := {}", "(".repeat(100_000))), deep);
    expect(&with_statements(&format!("x := {};", nested("a[", "0", "]", 300))), deep);
    expect(&with_statements(&format!("x := {};", nested("ABS(", "x", ")", 300))), deep);
    expect(&with_statements(&format!("x := {}x;", "- ".repeat(100_000))), deep);
    expect(&with_statements(&format!("b := {}b;", "NOT ".repeat(100_000))), deep);
    let long = "an expression of more than 500 operands";
    expect(&with_statements(&format!("x := 1{};", " + x".repeat(100_000))), long);
    expect(&with_statements(&format!("x := x{};", ".x".repeat(100_000))), long);
    expect(&with_statements(&format!("x := MAX(x{});", ", x".repeat(100_000))), long);
}

#[test]
fn statements_too_deep() {
    expect(&with_statements(&nested("IF b THEN ", "b := FALSE; ", "END_IF; ", 10_000)), "nested too deeply");
    expect(&with_statements(&"WHILE b DO ".repeat(50_000)), "nested too deeply");
    expect(&with_statements(&"CASE x OF 1: ".repeat(50_000)), "nested too deeply");
    let branches = format!("IF b THEN x := 2; {}END_IF;", "ELSIF THEN x := 3; ".repeat(10_000));
    expect(&with_statements(&branches), "expected a condition");
}

#[test]
fn declarations_too_deep() {
    expect(&format!("VAR a : {}INT; END_VAR ;", "ARRAY[0..1] OF ".repeat(20_000)), "nested too deeply");
    let initial = nested("[", "1", "]", 20_000);
    expect(&format!("VAR a : ARRAY[0..1] OF INT := {initial}; END_VAR ;"), "nested too deeply");
    let chain = pieces(10_000, |place| format!("T{place} : T{};\n", place + 1));
    let source = format!("TYPE {chain} T10000 : INT; END_TYPE PROGRAM Main VAR x : T0; END_VAR END_PROGRAM");
    expect(&source, "levels deep");
}

#[test]
fn chains_of_units_too_deep() {
    let blocks = pieces(5_000, |place| {
        format!("FUNCTION_BLOCK B{place} VAR b : B{}; END_VAR b(); END_FUNCTION_BLOCK\n", place + 1)
    });
    let last = "FUNCTION_BLOCK B5000 END_FUNCTION_BLOCK PROGRAM Main VAR b : B0; END_VAR b(); END_PROGRAM";
    expect(&(blocks + last), "levels deep");
    let functions = pieces(10_000, |place| {
        format!("FUNCTION F{place} : INT F{place} := F{}(); END_FUNCTION\n", place + 1)
    });
    let last = "FUNCTION F10000 : INT END_FUNCTION PROGRAM Main VAR x : INT; END_VAR x := F0(); END_PROGRAM";
    expect(&(functions + last), "levels deep");
}

#[test]
fn memory_too_large() {
    let names = pieces(20_000, |place| format!("v{place}, "));
    let type_ = "TYPE T : ARRAY[0..1000000] OF LREAL; END_TYPE";
    let full = "the program has more variables than its memory";
    expect(&format!("{type_} PROGRAM Main VAR {names} v : T; END_VAR END_PROGRAM"), full);
    let types = pieces(20_000, |place| format!("T{place} : ARRAY[0..1000000] OF LREAL;\n"));
    let all_together = "the types of the program are larger than";
    expect(&format!("TYPE {types} END_TYPE PROGRAM Main END_PROGRAM"), all_together);
    let functions = pieces(500, |place| {
        format!("FUNCTION F{place} : T VAR a, b : ARRAY[0..100000] OF INT; END_VAR END_FUNCTION\n")
    });
    expect(&format!("{type_} {functions} PROGRAM Main END_PROGRAM"), "its memory");
    let texts = pieces(4_000, |place| format!("s := '{}{place}';\n", "x".repeat(150)));
    let more = "s := CONCAT(s, s, s);\n".repeat(5_000);
    expect(&format!("VAR s : STRING[1986]; END_VAR {more} {texts}"), "memory");
}

#[test]
fn types_with_too_many_names() {
    let members = pieces(80_000, |place| format!("m{place}:INT;"));
    expect(
        &format!("TYPE T : STRUCT {members} END_STRUCT; END_TYPE PROGRAM Main END_PROGRAM"),
        "2048 are the most",
    );
    let values = pieces(100_000, |place| format!(", v{place}"));
    expect(&format!("TYPE T : (v{values}); END_TYPE PROGRAM Main END_PROGRAM"), "2048 are the most");
}

/// If each name were searched for among all names before it, each of these would take minutes.
#[test]
fn lists_as_long_as_a_source() {
    let labels = pieces(90_000, |place| format!("{place}:;"));
    let case = |last: &str| format!("VAR x : DINT; END_VAR CASE x OF {labels}{last} END_CASE;");
    accept(&case(""));
    expect(&case("70000:;"), "an arm above has this value already");
    let instances = pieces(40_000, |place| format!("PROGRAM P{place} WITH F:A;"));
    let tasks = pieces(20_000, |place| format!("TASK T{place}(PRIORITY:=1);"));
    let configuration = |items: &str| {
        format!("CONFIGURATION C TASK F(PRIORITY:=1); {items} END_CONFIGURATION PROGRAM A END_PROGRAM")
    };
    accept(&configuration(&instances));
    expect(&configuration(&format!("{instances} PROGRAM p7 : A;")), "the name `p7` is declared twice");
    accept(&configuration(&format!("{tasks} PROGRAM P WITH T7 : A;")));
    expect(&configuration(&format!("{tasks} TASK t7(PRIORITY:=1);")), "the name `t7` is declared twice");
    let programs = pieces(15_000, |place| format!("PROGRAM A{place} END_PROGRAM\n"));
    let unknown = pieces(15_000, |place| format!("PROGRAM P{place} : B{place};"));
    expect(&(configuration(&unknown) + " " + &programs), "there is no PROGRAM `B0`");
}

#[test]
fn instances_with_too_much_text() {
    let instances = pieces(30_000, |place| format!("PROGRAM P{place}:A;"));
    let statements = "x := 1;".repeat(50_000);
    let program = format!("PROGRAM A VAR x : INT; END_VAR {statements} END_PROGRAM");
    expect(
        &format!("CONFIGURATION C {instances} END_CONFIGURATION {program}"),
        "the instances of PROGRAMs have 8401032 bytes of text together, 8388608 are the most",
    );
}

#[test]
fn too_many_problems() {
    let names = pieces(20_000, |place| format!("variable_{place} : INT; "));
    let uses = pieces(20_000, |place| format!("varable{place} := 1;\n"));
    expect(
        &format!("PROGRAM Main VAR {names} END_VAR {uses} END_PROGRAM"),
        "there is no variable `varable0`",
    );
    expect(&with_statements(&"x := TRUE;\n".repeat(80_000)), "BOOL is not converted to INT");
    expect(&with_statements(&"x := ;\n".repeat(100_000)), "expected an expression");
    let types = pieces(20_000, |place| format!("v{place} : No_Type_{place}; "));
    expect(&format!("PROGRAM Main VAR {types} END_VAR END_PROGRAM"), "there is no type");
}

#[test]
fn a_source_too_large() {
    expect(&" ".repeat(st::SOURCE_BYTES_MAX + 1), "are the most");
    expect(&with_statements(&format!("(* {} ", "(* ".repeat(300_000))), "never closed");
}
