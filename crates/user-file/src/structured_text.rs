//! Whether a text is a program in Structured Text, by how it begins.
//!
//! The other files of users are TOML, where no line has `:=` outside a string, and where no word begins a line unless
//! `=` or `.` follows it.

/// Begins a declaration.
const DECLARATIONS: [&str; 13] = [
    "PROGRAM",
    "FUNCTION_BLOCK",
    "FUNCTION",
    "TYPE",
    "VAR",
    "VAR_GLOBAL",
    "VAR_EXTERNAL",
    "VAR_INPUT",
    "VAR_OUTPUT",
    "VAR_IN_OUT",
    "VAR_TEMP",
    "CONFIGURATION",
    "INTERFACE",
];

/// Begins a statement, and the word that follows it and makes it one: sentences begin with these words too.
const STATEMENTS: [(&str, &str, &str); 5] = [
    ("IF", "THEN", "END_IF"),
    ("CASE", "OF", "END_CASE"),
    ("FOR", "DO", "END_FOR"),
    ("WHILE", "DO", "END_WHILE"),
    ("REPEAT", "UNTIL", "END_REPEAT"),
];

/// Begins a pragma.
const PRAGMAS: [&str; 2] = ["REGION", "ATTRIBUTE"];

const COMMENTS: [(&str, &str); 4] = [("(*", "*)"), ("/*", "*/"), ("//", "\n"), ("{", "}")];

/// Whether the text is a program: a declaration or a statement after comments and pragmas, or a comment or a pragma
/// with which no other kind of file begins.
pub(crate) fn begins(text: &str) -> bool {
    let text = text.trim_start();
    let rest = without_comments(text);
    text.starts_with("(*")
        || begins_with_pragma(text)
        || begins_with_declaration(rest)
        || begins_with_statement(rest)
        || (["//", "/*"].iter().any(|mark| text.starts_with(mark)) && rest.contains(":="))
}

/// The text after its initial comments and pragmas.
fn without_comments(text: &str) -> &str {
    let mut rest = text;
    while let Some((begin, end)) = COMMENTS.iter().find(|(begin, _)| rest.starts_with(begin)) {
        let inside = rest.get(begin.len()..).unwrap_or_default();
        rest = inside.split_once(end).map_or("", |(_, behind)| behind.trim_start());
    }
    rest
}

fn begins_with_pragma(text: &str) -> bool {
    let Some(inside) = text.strip_prefix('{') else { return false };
    let (word, _) = first_word(inside.trim_start());
    is_one_of(word, &PRAGMAS)
}

fn begins_with_declaration(text: &str) -> bool {
    let (word, rest) = first_word(text);
    !is_key(rest) && is_one_of(word, &DECLARATIONS)
}

fn begins_with_statement(text: &str) -> bool {
    let (word, rest) = first_word(text);
    let known = STATEMENTS.iter().find(|(begin, ..)| begin.eq_ignore_ascii_case(word));
    match known {
        Some((_, next, end)) if !is_key(rest) => {
            has_word(rest, next) && (rest.contains(":=") || has_word(rest, end))
        }
        _ => is_assignment_or_call(text),
    }
}

/// `a.b[3] := 4;` or `a(b := 4);`, each in one line or more.
fn is_assignment_or_call(text: &str) -> bool {
    let Some(rest) = behind_variable(text) else { return false };
    let rest = rest.trim_start();
    if rest.starts_with('(') {
        return rest
            .split(';')
            .next()
            .is_some_and(|call| call.contains(":=") && call.trim_end().ends_with(')'));
    }
    let Some((statement, _)) = rest.strip_prefix(":=").and_then(|value| value.split_once(';')) else {
        return false;
    };
    is_one_expression(statement)
}

/// Whether each line of the text continues the one before it: TOML with `:=` in place of `=` has a value in each line.
fn is_one_expression(text: &str) -> bool {
    let code = |line: &'_ str| line.split("//").next().unwrap_or_default().trim().to_owned();
    let lines: Vec<String> = text.lines().map(code).filter(|line| !line.is_empty()).collect();
    lines.windows(2).all(|pair| match pair {
        [line, next] => ends_open(line) || begins_open(next),
        _ => true,
    })
}

const OPERATORS: [&str; 5] = ["AND", "OR", "XOR", "MOD", "NOT"];
const OPERATOR_SIGNS: &str = "+-*/=<>&(,:";

fn ends_open(line: &str) -> bool {
    let word = line.rsplit(|character| !is_letter(character)).next().unwrap_or_default();
    line.ends_with(|last| OPERATOR_SIGNS.contains(last)) || is_one_of(word, &OPERATORS)
}

fn begins_open(line: &str) -> bool {
    let (word, _) = first_word(line);
    line.starts_with(|first| first == ')' || OPERATOR_SIGNS.contains(first)) || is_one_of(word, &OPERATORS)
}

/// The text behind a variable with its members and indices.
fn behind_variable(text: &str) -> Option<&str> {
    let (name, mut rest) = first_word(text);
    if !name.starts_with(|first: char| first.is_alphabetic() || first == '_') {
        return None;
    }
    loop {
        rest = match rest.chars().next() {
            Some('[') => rest.split_once(']')?.1,
            Some('.') => first_word(rest.get(1..)?).1,
            // Nested indices: `a[b[1]]`.
            Some(']') => rest.get(1..)?,
            _ => return Some(rest),
        };
    }
}

/// `type = 3` and `type.x = 3` are TOML.
fn is_key(rest: &str) -> bool {
    rest.trim_start().starts_with(['=', '.'])
}

fn is_letter(character: char) -> bool {
    character.is_alphanumeric() || character == '_'
}

/// The letters with which the text begins, and the rest.
fn first_word(text: &str) -> (&str, &str) {
    text.split_at(text.find(|character| !is_letter(character)).unwrap_or(text.len()))
}

fn is_one_of(word: &str, known: &[&str]) -> bool {
    known.iter().any(|known| known.eq_ignore_ascii_case(word))
}

fn has_word(text: &str, wanted: &str) -> bool {
    text.split(|character| !is_letter(character)).any(|word| word.eq_ignore_ascii_case(wanted))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn programs_are_known_by_their_first_line() {
        for text in [
            "VAR R : NX_ReadObj; END_VAR R(Execute := TRUE);",
            "VAR s : STRING := 'a'; END_VAR",
            "(* counts\n   pulses *)\nVAR x : INT; END_VAR",
            "// counts pulses\n// since 2024\nPROGRAM Main",
            "/* counts */ (* twice *)\r\n{attribute 'x := 1'}\nfunction_block B",
            "(* statements *) x = y",
            "// statements\nx := 1;",
            "(* without an end",
            "TYPE\n",
            "VAR_INPUT a : INT := 1; END_VAR",
            "{region}\nReset();",
            "{ Region 'inputs' }",
            "{attribute 'qualified_only'}\nReset();",
            "{warning 'x'} x := 1;",
            "IF a THEN b(); END_IF;",
            "if a AND\n b then\n c := 1;",
            "CASE n OF 1: a(); END_CASE;",
            "FOR i := 0 TO 3 DO ; END_FOR;",
            "WHILE a DO b(); END_WHILE",
            "REPEAT a(); UNTIL b END_REPEAT;",
            "a.b[3] := 4;",
            "x:=4; y := 5;",
            "a[1, b[2]].c := TRUE; // on",
            "Zähler := 1;",
            "b := a AND\n steps = 3;",
            "b := a\n AND NOT c\n OR (d +\n 1) > 2;",
            "Timer(IN := a,\n  PT := T#1s);",
            "a.timer[2](IN := a);",
        ] {
            assert!(begins(text), "{text}");
        }
    }

    #[test]
    fn other_texts_are_no_programs() {
        for text in [
            "",
            "x < 3",
            "type = 3",
            "VAR.x = 3",
            "for = 1 # do := 2",
            "if.then = \":=\"",
            "variable = 1",
            "model := \"nx-ect101\"\n# a; b",
            "model := \"nx-ect101\"\nserial = 3\n# a; b",
            "a.b = \"x := 1;\"",
            "[a]\nx := 1;",
            "// a sketch\nint main() {}",
            "{ a = 1 }",
            "If a unit does not answer, then wait; see below.",
            "For each unit do this: a; b.",
            "Repeat it until it works.",
            "main(a, b); x := 1;",
            "5 := 4;",
        ] {
            assert!(!begins(text), "{text}");
        }
    }
}
