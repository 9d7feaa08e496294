//! Types, in declarations and in use.

use super::super::ast::{
    Expression, Name, TypeDeclaration, TypeDefinition, TypeKind, TypeName, VarDeclaration,
};
use super::super::keyword::Keyword;
use super::super::token::Token;
use super::declarations::Owner;
use super::{Failed, Parsed, Parser, spelling};
use crate::elementary::{Class, Elementary};
use crate::problem::{Problem, Span};

/// The values of an enumeration, each with its number if one is given.
type EnumValues = Vec<(Name, Option<Expression>)>;

impl Parser<'_> {
    /// `TYPE … END_TYPE`.
    pub(super) fn type_block(&mut self, types: &mut Vec<TypeDeclaration>) {
        self.open(Keyword::Type);
        while !self.types_end() {
            let before = self.place;
            match self.type_declaration() {
                Ok(declaration) => types.push(declaration),
                Err(_) => self.recover(),
            }
            if self.place == before {
                self.advance();
            }
        }
        self.close();
        self.accept(Token::Semicolon);
    }

    fn types_end(&self) -> bool {
        match self.token() {
            Token::End => true,
            Token::Keyword(word) => word.ends_body() || word.opens_statement(),
            _ => false,
        }
    }

    fn type_declaration(&mut self) -> Parsed<TypeDeclaration> {
        let name = self.new_name("the name of a type")?;
        self.expect(Token::Colon, &format!("`:` after the name of the type `{}`", name.text))?;
        let definition = self.definition()?;
        let is_struct = matches!(definition, TypeDefinition::Struct(_));
        // Other tools write structures without the semicolon that the grammar of the standard requires.
        if !self.accept(Token::Semicolon) && !is_struct {
            let told = self.semicolon(&format!("the declaration of the type `{}`", name.text));
            if told.is_err() && !matches!(self.token(), Token::Keyword(_)) {
                self.recover();
            }
        }
        Ok(TypeDeclaration { name, definition })
    }

    fn definition(&mut self) -> Parsed<TypeDefinition> {
        if self.at(Keyword::Struct) {
            return Ok(TypeDefinition::Struct(self.structure()));
        }
        let has_base = self.token() == Token::Name && self.peek(1) == Token::OpenParenthesis;
        if self.token() == Token::OpenParenthesis || (has_base && self.peek(2) == Token::Name) {
            return self.enumeration();
        }
        let type_name = self.type_name()?;
        let initial = if self.assign_sign() { Some(self.initial()?) } else { None };
        Ok(TypeDefinition::Alias { type_name, initial })
    }

    /// `STRUCT … END_STRUCT`.
    fn structure(&mut self) -> Vec<VarDeclaration> {
        self.open(Keyword::Struct);
        let members = self.declarations(Owner::Struct);
        self.close();
        members
    }

    /// `(a, b := 5)`, with its base type before or behind it.
    fn enumeration(&mut self) -> Parsed<TypeDefinition> {
        let before = self.base_type()?;
        let values = self.enum_values()?;
        if !before {
            self.base_type()?;
        }
        let initial = if self.assign_sign() { Some(self.enum_initial()?) } else { None };
        Ok(TypeDefinition::Enum { values, initial })
    }

    /// The base type of an enumeration, an integer; returns whether there is one.
    fn base_type(&mut self) -> Parsed<bool> {
        let span = self.here();
        if self.token() != Token::Name {
            return Ok(false);
        }
        self.advance();
        let text = self.text(span);
        let is_integer = Elementary::named(text).is_some_and(is_integer);
        if is_integer {
            return Ok(true);
        }
        self.fail(Problem::new(
            span,
            format!("`{text}` cannot be the base of an enumeration, an integer type can"),
        ))
    }

    fn enum_values(&mut self) -> Parsed<EnumValues> {
        self.expect(Token::OpenParenthesis, "`(` and the values of an enumeration")?;
        let mut values = Vec::new();
        loop {
            let name = self.new_name("the name of a value")?;
            let number = if self.assign_sign() { Some(self.expression()?) } else { None };
            values.push((name, number));
            if !self.accept(Token::Comma) {
                break;
            }
        }
        self.expect(Token::CloseParenthesis, "`,` or `)` after the value of an enumeration")?;
        Ok(values)
    }

    /// The initial value of an enumeration: `red` or `Colour#red`.
    fn enum_initial(&mut self) -> Parsed<Name> {
        let span = self.here();
        match self.text(span).split_once('#') {
            Some((_, value)) if self.token() == Token::Hashed && !value.is_empty() => {
                self.advance();
                let start = span.end - Span::from(0..value.len()).end;
                Ok(Name { text: value.to_owned(), span: Span { start, end: span.end } })
            }
            _ => self.name("a value of the enumeration"),
        }
    }

    /// A type in use.
    pub(super) fn type_name(&mut self) -> Parsed<TypeName> {
        let start = self.here();
        let kind = self.deeper(Self::type_kind)?;
        Ok(TypeName { kind, span: self.since(start) })
    }

    fn type_kind(&mut self) -> Parsed<TypeKind> {
        let span = self.here();
        let problem = match self.token() {
            Token::Keyword(Keyword::Array) => return self.array(),
            Token::Name => return self.named_type(span),
            Token::Keyword(Keyword::Struct) => {
                let problem = Problem::new(span, "a structure has no place here");
                self.tell(problem.help("declare it in TYPE … END_TYPE"));
                self.structure();
                return Err(Failed);
            }
            Token::OpenParenthesis => {
                Problem::new(span, "an enumeration has no place here").help("declare it in TYPE … END_TYPE")
            }
            _ => self.missing("a type"),
        };
        self.fail(problem)
    }

    fn named_type(&mut self, span: Span) -> Parsed<TypeKind> {
        let text = self.text(span);
        let is_behind_a_pointer = matches!(self.peek(1), Token::Name | Token::Keyword(Keyword::To));
        if spelling::is_pointer(text) && is_behind_a_pointer {
            let problem = Problem::new(span, format!("{} is not supported", text.to_ascii_uppercase()));
            return self.fail(problem.help(spelling::INSTEAD_OF_A_POINTER));
        }
        self.advance();
        if text.eq_ignore_ascii_case("STRING") {
            return self.string_length();
        }
        let Some(elementary) = Elementary::named(text) else { return Ok(TypeKind::Named(text.to_owned())) };
        if self.token() == Token::OpenParenthesis {
            let problem = Problem::new(self.here(), "subranges are not supported");
            return self
                .fail(problem.help(format!("declare it as {elementary}, and limit its values by LIMIT(…)")));
        }
        Ok(TypeKind::Elementary(elementary))
    }

    /// `[10]` or `(10)` after STRING.
    fn string_length(&mut self) -> Parsed<TypeKind> {
        let (close, sign) = match self.token() {
            Token::OpenBracket => (Token::CloseBracket, "`]`"),
            Token::OpenParenthesis => (Token::CloseParenthesis, "`)`"),
            _ => return Ok(TypeKind::String(None)),
        };
        self.advance();
        let length = self.expression()?;
        self.expect(close, &format!("{sign} after the length of STRING"))?;
        Ok(TypeKind::String(Some(Box::new(length))))
    }

    fn array(&mut self) -> Parsed<TypeKind> {
        self.advance();
        self.expect(Token::OpenBracket, "`[` and the bounds after ARRAY")?;
        if self.token() == Token::Star {
            return self.open_array();
        }
        let mut bounds = vec![self.bounds()?];
        while self.accept(Token::Comma) {
            bounds.push(self.bounds()?);
        }
        self.expect(Token::CloseBracket, "`,` or `]` after the bounds of ARRAY")?;
        self.word(Keyword::Of, "and the type of the elements after the bounds of ARRAY")?;
        let element = Box::new(self.type_name()?);
        Ok(TypeKind::Array { bounds, element })
    }

    /// `*, *] OF INT` after `ARRAY[`.
    fn open_array(&mut self) -> Parsed<TypeKind> {
        let mut dimensions = 0;
        loop {
            self.expect(Token::Star, "`*`, as the other bounds of ARRAY")?;
            dimensions += 1;
            if !self.accept(Token::Comma) {
                break;
            }
        }
        self.expect(Token::CloseBracket, "`,` or `]` after the bounds of ARRAY")?;
        self.word(Keyword::Of, "and the type of the elements after the bounds of ARRAY")?;
        Ok(TypeKind::OpenArray { dimensions, element: Box::new(self.type_name()?) })
    }

    fn bounds(&mut self) -> Parsed<(Expression, Expression)> {
        let from = self.expression()?;
        if self.token() != Token::Range {
            let problem = self.missing("`..` and the upper bound").help("bounds are written `[0..9]`");
            return self.fail(problem);
        }
        self.advance();
        Ok((from, self.expression()?))
    }
}

fn is_integer(elementary: Elementary) -> bool {
    matches!(elementary.class(), Class::Signed | Class::Unsigned)
}
