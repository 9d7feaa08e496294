//! Every node has the position of its text.

use super::read;
use crate::problem::Span;
use crate::syntax::ast::{Expression, ExpressionKind, StatementKind};

/// The texts of an expression and of all in it, from the outside to the inside.
fn texts<'source>(source: &'source str, tree: &Expression, into: &mut Vec<&'source str>) {
    into.push(source.get(tree.span.range()).unwrap_or("?"));
    match &tree.kind {
        ExpressionKind::Binary { left, right, .. } => {
            texts(source, left, into);
            texts(source, right, into);
        }
        ExpressionKind::Unary { operand, .. } => texts(source, operand, into),
        ExpressionKind::Member { of, member } => {
            texts(source, of, into);
            into.push(source.get(member.span.range()).unwrap_or("?"));
        }
        ExpressionKind::Index { of, indices } => {
            texts(source, of, into);
            indices.iter().for_each(|index| texts(source, index, into));
        }
        ExpressionKind::EnumValue { type_name, value } => {
            into.extend([type_name, value].map(|name| source.get(name.span.range()).unwrap_or("?")));
        }
        ExpressionKind::Call(call) => {
            into.push(source.get(call.span.range()).unwrap_or("?"));
            texts(source, &call.callee, into);
        }
        ExpressionKind::Literal(_) | ExpressionKind::Name(_) => {}
    }
}

#[test]
fn expressions_know_their_text() {
    let source = "x := (a + b ) * -c.d[ 1 ] - Colour#red + f( 1 ) ;";
    let file = read(source);
    let StatementKind::Assign { to, value } = &file.units[0].body[0].kind else { panic!("{file:?}") };
    let mut found = Vec::new();
    texts(source, to, &mut found);
    texts(source, value, &mut found);
    let expected = [
        "x",
        "(a + b ) * -c.d[ 1 ] - Colour#red + f( 1 )",
        "(a + b ) * -c.d[ 1 ] - Colour#red",
        "(a + b ) * -c.d[ 1 ]",
        "a + b",
        "a",
        "b",
        "-c.d[ 1 ]",
        "c.d[ 1 ]",
        "c.d",
        "c",
        "d",
        "1",
        "Colour#red",
        "Colour",
        "red",
        "f( 1 )",
        "f( 1 )",
        "f",
    ];
    assert_eq!(found, expected);
}

#[test]
fn statements_types_and_sections_know_their_text() {
    let source = "VAR a : ARRAY[0..1] OF INT := [1, 2]; END_VAR ; IF a THEN b(); END_IF ; RETURN;";
    let file = read(source);
    let text = |span: Span| source.get(span.range());
    let section = &file.units[0].sections[0];
    assert_eq!(text(section.span), Some("VAR a : ARRAY[0..1] OF INT := [1, 2]; END_VAR"));
    assert_eq!(text(section.variables[0].type_name.span), Some("ARRAY[0..1] OF INT"));
    let body = &file.units[0].body;
    assert_eq!(text(body[0].span), Some("IF a THEN b(); END_IF"));
    assert_eq!(text(body[1].span), Some("RETURN"));
}
