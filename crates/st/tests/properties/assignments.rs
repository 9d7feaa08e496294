//! Which value is converted to which variable implicitly, for all pairs of types.

use crate::types::{ALL, Kind, Type, meet, widens};

fn is_accepted(source: &str) -> bool {
    st::compile(source, &[]).is_ok()
}

#[test]
fn a_value_is_assigned_exactly_when_its_type_widens() {
    for from in ALL {
        for to in ALL {
            let source = format!("VAR a : {}; b : {}; END_VAR b := a;", from.name, to.name);
            assert_eq!(is_accepted(&source), widens(from, to), "{} to {}", from.name, to.name);
        }
    }
}

#[test]
fn an_argument_and_an_output_widen_as_an_assignment_does() {
    for from in ALL {
        for to in ALL {
            let source = format!(
                "FUNCTION_BLOCK Block VAR_INPUT i : {to}; END_VAR VAR_OUTPUT o : {from}; END_VAR END_FUNCTION_BLOCK
                FUNCTION Call : {from} VAR_INPUT i : {to}; END_VAR VAR_OUTPUT o : {from}; END_VAR END_FUNCTION
                PROGRAM Main VAR f : Block; a : {from}; b : {to}; END_VAR {{}} END_PROGRAM",
                from = from.name,
                to = to.name
            );
            let calls = ["f(i := a);", "f(o => b);", "b := Call(b);", "Call(i := a);", "Call(b, o => b);"];
            for call in calls {
                let source = source.replace("{}", call);
                assert_eq!(is_accepted(&source), widens(from, to), "{call} of {} to {}", from.name, to.name);
            }
        }
    }
}

/// The result type of an operator for two types; none if it does not exist.
fn result(operator: &str, left: Type, right: Type) -> Option<&'static str> {
    let met = meet(left, right);
    let scale = |time: Type, other: Type| time.kind == Kind::Time && other.is_number();
    match operator {
        "+" | "-" if left.kind == Kind::Time && right.kind == Kind::Time => Some("TIME"),
        "*" if scale(left, right) || scale(right, left) => Some("TIME"),
        "/" if scale(left, right) => Some("TIME"),
        "+" | "-" | "*" | "/" => met.filter(|met| met.is_number()).map(|met| met.name),
        "MOD" => met.filter(|met| met.is_integer()).map(|met| met.name),
        "AND" | "OR" | "XOR" => {
            met.filter(|met| matches!(met.kind, Kind::Bool | Kind::Bits)).map(|met| met.name)
        }
        "**" if left.is_number() && right.is_number() => {
            let both = left.name == "REAL" && right.name == "REAL";
            Some(if both { "REAL" } else { "LREAL" })
        }
        "=" | "<>" | "<" | "<=" | ">" | ">=" => met.map(|_| "BOOL"),
        _ => None,
    }
}

/// The types to which `value` is converted implicitly, among all of them: one compiled line for each.
fn targets(declarations: &str, value: &str) -> Vec<&'static str> {
    let names = ALL.map(|to| to.name);
    let variables: String = names.iter().map(|name| format!("to_{name} : {name}; ")).collect();
    let lines: String = names.iter().map(|name| format!("to_{name} := {value};\n")).collect();
    // The first assignment is in line 1.
    let source = format!("VAR {declarations} {variables} END_VAR {lines}");
    let refused = match st::compile(&source, &[]) {
        Ok(_) => Vec::new(),
        Err(problems) => {
            problems.list().iter().map(|problem| problem.span.line_and_column(&source).0).collect::<Vec<_>>()
        }
    };
    let accepted = names.into_iter().enumerate().filter(|(place, _)| !refused.contains(&(place + 1)));
    accepted.map(|(_, name)| name).collect()
}

#[test]
fn an_operator_gives_the_type_in_which_its_operands_meet() {
    for operator in ["+", "-", "*", "/", "MOD", "AND", "OR", "XOR", "**", "=", "<>", "<", "<=", ">", ">="] {
        for left in ALL {
            for right in ALL {
                let declarations = format!("a : {}; b : {};", left.name, right.name);
                let accepted = targets(&declarations, &format!("a {operator} b"));
                let expected = result(operator, left, right).map(crate::types::named);
                let awaited = ALL.iter().filter(|to| expected.is_some_and(|from| widens(from, **to)));
                let awaited = awaited.map(|to| to.name).collect::<Vec<_>>();
                assert_eq!(accepted, awaited, "{} {operator} {}", left.name, right.name);
            }
        }
    }
}
