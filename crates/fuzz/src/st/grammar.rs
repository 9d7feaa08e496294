//! Programs from a grammar: declarations of every kind, and statements with them whose types usually match.

use crate::random::Random;

/// Words of the language.
#[rustfmt::skip]
pub(super) const WORDS: &[&str] = &[
    "IF", "THEN", "ELSIF", "ELSE", "END_IF", "CASE", "OF", "END_CASE", "FOR", "TO", "BY", "DO", "END_FOR", "WHILE",
    "END_WHILE", "REPEAT", "UNTIL", "END_REPEAT", "EXIT", "RETURN", "CONTINUE", "VAR", "VAR_INPUT", "VAR_OUTPUT",
    "VAR_IN_OUT", "VAR_GLOBAL", "VAR_EXTERNAL", "VAR_TEMP", "END_VAR", "CONSTANT", "RETAIN", "AT", "FUNCTION",
    "END_FUNCTION", "FUNCTION_BLOCK", "END_FUNCTION_BLOCK", "PROGRAM", "END_PROGRAM", "TYPE", "END_TYPE", "STRUCT",
    "END_STRUCT", "UNION", "ARRAY", "STRING", "BOOL", "INT", "UINT", "DINT", "LREAL", "BYTE", "WORD", "LWORD", "TIME",
    "DATE_AND_TIME", "TRUE", "FALSE", "AND", "OR", "XOR", "NOT", "MOD", "EN", "ENO", "CONFIGURATION",
    "END_CONFIGURATION", "TASK", "INTERVAL", "T#1s", "16#FF", "INT#-1", "1.5E3", "'text'", "'$41'", "$", "**", "=>",
    ":=", "..", "<>", "<=", "&", "a0", "i0", "TON", "CTU", "R_TRIG", "SEL", "LIMIT", "MID", "CONCAT", "INT_TO_STRING",
    "P_First_Run", "^", "@",
];

/// Types with the values of their literals and their operators.
struct Kind {
    name: &'static str,
    literals: &'static [&'static str],
    operators: &'static [&'static str],
    functions: &'static [&'static str],
}

const INT: Kind = Kind {
    name: "INT",
    literals: &["0", "1", "-1", "7", "100", "32767", "-32768", "16#7F", "INT#5"],
    operators: &["+", "-", "*", "/", "MOD"],
    functions: &[
        "ABS(@)",
        "MAX(@, @)",
        "LIMIT(0, @, 100)",
        "SEL(#, @, @)",
        "(-@)",
        "REAL_TO_INT(INT_TO_REAL(@))",
    ],
};
const UDINT: Kind = Kind {
    name: "UDINT",
    literals: &["0", "1", "4294967295", "16#FFFF", "UDINT#3"],
    operators: &["+", "-", "*", "/", "MOD"],
    functions: &["MIN(@, @)", "DWORD_TO_UDINT(UDINT_TO_DWORD(@))", "SEL(#, @, @)"],
};
const WORD: Kind = Kind {
    name: "WORD",
    literals: &["16#0", "16#FFFF", "WORD#16#12", "2#1010"],
    operators: &["AND", "OR", "XOR"],
    functions: &["NOT @", "SHL(@, 3)", "ROR(@, 70)", "AND(@, @)"],
};
const LREAL: Kind = Kind {
    name: "LREAL",
    literals: &["0.0", "1.5", "-2.0E10", "1.0E308"],
    operators: &["+", "-", "*", "/", "**"],
    functions: &["SQRT(@)", "SIN(@)", "LN(@)", "ABS(@)", "(-@)"],
};
const TEXT: Kind = Kind {
    name: "STRING[20]",
    literals: &["''", "'abc'", "'$41$L'", "'a longer text, with more than fits'"],
    operators: &[],
    functions: &["CONCAT(@, @)", "LEFT(@, 2)", "MID(@, 3, 1)", "INSERT(@, @, 1)", "TO_UCASE(@)"],
};
const TIME: Kind = Kind {
    name: "TIME",
    literals: &["T#0s", "T#1.5ms", "T#-1d2h", "T#106751d"],
    operators: &["+", "-"],
    functions: &["MULTIME(@, 2)", "SEL(#, @, @)"],
};
const KINDS: [&Kind; 6] = [&INT, &UDINT, &WORD, &LREAL, &TEXT, &TIME];

/// Variables of each kind, and those of the structures.
const VARIABLES: usize = 3;
/// Maximum depth of expressions and statements.
const DEPTH_MAX: usize = 4;

/// A whole program.
pub(super) fn program(random: &mut Random) -> String {
    let mut text = String::new();
    if random.once_in(3) {
        text.push_str(&types(random));
    }
    if random.once_in(3) {
        text.push_str("FUNCTION twice : INT\nVAR_INPUT x : INT; END_VAR\ntwice := x + x;\nEND_FUNCTION\n");
    }
    if random.once_in(4) {
        text.push_str(
            "FUNCTION_BLOCK counter\nVAR_INPUT up : BOOL; END_VAR\nVAR_OUTPUT value : INT; END_VAR\n\
             VAR before : BOOL; END_VAR\nIF up AND NOT before THEN value := value + 1; END_IF;\nbefore := up;\n\
             END_FUNCTION_BLOCK\n",
        );
    }
    text.push_str("PROGRAM main\n");
    text.push_str(&declarations(random));
    text.push_str(&statements(0, random));
    text + "END_PROGRAM\n"
}

fn types(random: &mut Random) -> String {
    let base = random.one_of(&KINDS).name;
    format!(
        "TYPE\n  colour : (red, green, blue);\n  part : STRUCT a : {base}; b : ARRAY[0..3] OF INT; END_STRUCT;\n\
         END_TYPE\n"
    )
}

fn declarations(random: &mut Random) -> String {
    let mut text = format!("VAR{}\n", random.text_of(&["", "", " RETAIN"]));
    for (number, kind) in KINDS.iter().enumerate() {
        for variable in 0..VARIABLES {
            let initial = if random.once_in(2) {
                format!(" := {}", random.one_of(kind.literals))
            } else {
                String::new()
            };
            text.push_str(&format!("  v{number}_{variable} : {}{initial};\n", kind.name));
        }
    }
    let bound = *random.one_of(&[0, 1, 3, 9, 100, 5_000]);
    text.push_str(&format!("  flag, other : BOOL;\n  list : ARRAY[0..{bound}] OF INT;\n  i : INT;\n"));
    text.push_str("  timer : TON;\n  edge : R_TRIG;\nEND_VAR\n");
    text
}

fn statements(depth: usize, random: &mut Random) -> String {
    (0..random.between(1, if depth == 0 { 12 } else { 3 })).map(|_| statement(depth, random)).collect()
}

fn statement(depth: usize, random: &mut Random) -> String {
    let choices = if depth < DEPTH_MAX { 14 } else { 6 };
    match random.below(choices) {
        0 => format!("flag := {};\n", condition(depth, random)),
        1 => format!("list[{}] := {};\n", expression(&INT, depth, random), expression(&INT, depth, random)),
        2 => format!(
            "N1_UINTs_01_C_to_M[{}] := {};\n",
            random.below(16),
            random.one_of(&["i", "7", "N1_UINTs_01_M_to_C[0]"])
        ),
        3 => format!(
            "timer(IN := {}, PT := {});\nother := timer.Q;\n",
            condition(depth, random),
            expression(&TIME, depth, random)
        ),
        4 | 5 => {
            let number = random.below(KINDS.len());
            let variable = random.below(VARIABLES);
            format!("v{number}_{variable} := {};\n", expression(KINDS[number], depth, random))
        }
        6 | 7 => {
            let otherwise = if random.once_in(2) {
                format!("ELSE\n{}", statements(depth + 1, random))
            } else {
                String::new()
            };
            format!(
                "IF {} THEN\n{}{otherwise}END_IF;\n",
                condition(depth, random),
                statements(depth + 1, random)
            )
        }
        8 => {
            let label = random.text_of(&["1", "2..5", "7, 9"]);
            format!(
                "CASE {} OF\n  {label}:\n{}  ELSE\n{}END_CASE;\n",
                expression(&INT, depth, random),
                statements(depth + 1, random),
                statements(depth + 1, random)
            )
        }
        9 => format!(
            "FOR i := {} TO {} BY {} DO\n{}END_FOR;\n",
            expression(&INT, depth, random),
            random.text_of(&["3", "10", "v0_0", "32767"]),
            random.text_of(&["1", "2", "-1", "0"]),
            statements(depth + 1, random)
        ),
        10 => format!("WHILE {} DO\n{}END_WHILE;\n", condition(depth, random), statements(depth + 1, random)),
        11 => format!(
            "REPEAT\n{}UNTIL {} END_REPEAT;\n",
            statements(depth + 1, random),
            condition(depth, random)
        ),
        12 => format!("IF {} THEN EXIT; END_IF;\n", condition(depth, random)),
        _ => format!("IF {} THEN RETURN; END_IF;\n", condition(depth, random)),
    }
}

fn condition(depth: usize, random: &mut Random) -> String {
    if depth >= DEPTH_MAX {
        return (random.text_of(&["flag", "other", "TRUE", "FALSE", "N1_IN_Port_Link_ON", "timer.Q"]))
            .to_owned();
    }
    match random.below(5) {
        0 => format!(
            "({} {} {})",
            condition(depth + 1, random),
            random.text_of(&["AND", "OR", "XOR", "&", "="]),
            condition(depth + 1, random)
        ),
        1 => format!("NOT {}", condition(depth + 1, random)),
        2 => condition(DEPTH_MAX, random),
        _ => {
            let kind = *random.one_of(&KINDS);
            let comparison = random.text_of(&["=", "<>", "<", "<=", ">", ">="]);
            format!(
                "({} {comparison} {})",
                expression(kind, depth + 1, random),
                expression(kind, depth + 1, random)
            )
        }
    }
}

fn expression(kind: &Kind, depth: usize, random: &mut Random) -> String {
    let number = KINDS.iter().position(|known| known.name == kind.name).unwrap_or_default();
    let leaf = depth >= DEPTH_MAX || random.once_in(3);
    match random.below(3) {
        0 if leaf => (*random.one_of(kind.literals)).to_owned(),
        _ if leaf => format!("v{number}_{}", random.below(VARIABLES)),
        0 if !kind.operators.is_empty() => {
            let operator = random.one_of(kind.operators);
            format!(
                "({} {operator} {})",
                expression(kind, depth + 1, random),
                expression(kind, depth + 1, random)
            )
        }
        _ => {
            let function = random.one_of(kind.functions);
            let parts: Vec<&str> = function.split('@').collect();
            let mut text = String::new();
            for (place, part) in parts.iter().enumerate() {
                let part = part.replace('#', &condition(depth + 1, random));
                text.push_str(&part);
                if place + 1 < parts.len() {
                    text.push_str(&expression(kind, depth + 1, random));
                }
            }
            text
        }
    }
}
